"""Painted shapes to the regions that their fills and strokes cover."""
