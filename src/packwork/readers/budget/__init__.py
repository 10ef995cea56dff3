"""Limits on the cost of reading: counts that are checked before costly work begins."""
