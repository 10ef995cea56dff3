"""Compiled sweeps of polygons and pictures over pixels."""
