"""Photographs: balanced about upright, cut at the edge where that is asked."""
