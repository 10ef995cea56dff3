"""Exact plane geometry: curves, outlines, polygons; no pixels."""
