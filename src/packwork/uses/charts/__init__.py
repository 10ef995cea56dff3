"""Unit charts: marks for rows of a table, in a container, in copies of it or in bars."""
