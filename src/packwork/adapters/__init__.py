"""Bridges to other frameworks: nothing in the package needs them, users import them."""
