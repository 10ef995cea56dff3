"""Displays of a Python session: a layout's picture, a run's progress."""
