"""Appearance of placed items: colours, line weights, halos, labels."""
