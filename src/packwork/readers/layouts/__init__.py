"""Layouts read back from SVG, DXF and GeoJSON files that Packwork wrote."""
