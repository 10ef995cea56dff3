"""Piles: items of given sizes, heaped by forces."""
