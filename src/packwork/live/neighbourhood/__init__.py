"""Neighbourhood of a gesture: it flows, and is finished exactly among all others."""
