"""Distances of polygons in place, and what keeps them apart."""
