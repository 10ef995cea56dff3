"""Compiled steps of piles down a height, and circle packing."""
