"""Density image to value and adjoint."""
