"""Drawings to pictures, held against shapes, or traced where shapes do not tell."""
