"""Rows of a table to the marks of a unit chart."""
