"""Benchmarks of the studio, in a browser that is there."""
