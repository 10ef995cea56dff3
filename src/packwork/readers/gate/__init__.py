"""Sanitising of SVG: what comes out is small, plain and refers to nothing outside."""
