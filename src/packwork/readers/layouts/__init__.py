"""Layouts back from the files that people use: drawings and cut sheets that we wrote."""
