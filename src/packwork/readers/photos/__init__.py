"""Photographs to items: read small, opened again when they are printed."""
