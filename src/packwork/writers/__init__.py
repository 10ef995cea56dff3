"""Layouts to files, all through one atomic writer."""
