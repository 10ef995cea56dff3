"""Benchmarks, each a script: ``packwork bench NAME``."""
