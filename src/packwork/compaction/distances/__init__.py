"""Distances of polygons in place."""
