"""Pixel files to regions: silhouettes of items, masks of containers."""
