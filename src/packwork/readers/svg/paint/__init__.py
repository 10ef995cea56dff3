"""A clean drawing to its painted shapes, in painting order."""
