"""Packwork arranges shapes so that they fill a container of any form."""
