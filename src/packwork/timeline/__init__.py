"""A layout for each step of a table, all on one scale, items in their places while that goes."""
