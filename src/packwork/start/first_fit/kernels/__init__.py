"""Compiled loops of first fits: places on rows of pixels, and ways through them."""
