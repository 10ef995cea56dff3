"""Outlines with few vertices that still hold all of the true ones."""
