"""Outlines of a few cubic curves, fitted to silhouettes by the renderer."""
