"""Compiled distances, contacts, linear programmes and steps of polygons in place."""
