"""Rendering of drawings by resvg, for comparison and for tracing."""
