"""Packs with nothing round them: few items in the smallest circle."""
