"""Quadratic assignment of items to places: its prices, and exchanges of pairs that lower them."""
