"""Measures of a layout, one file each."""
