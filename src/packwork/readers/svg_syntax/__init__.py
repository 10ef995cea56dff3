"""Parsing of clean SVG: numbers, paths, transforms, pages, paints, references."""
