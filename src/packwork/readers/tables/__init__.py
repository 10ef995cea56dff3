"""Rows under named columns, from files and from other libraries."""
