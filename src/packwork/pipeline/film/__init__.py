"""The way of the items, kept for films."""
