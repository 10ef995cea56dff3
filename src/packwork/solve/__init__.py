"""Poses to better poses: levels, Adam, the herder."""
