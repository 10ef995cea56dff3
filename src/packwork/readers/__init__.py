"""Readers: files to items and containers; every SVG is sanitised before it is parsed further."""
