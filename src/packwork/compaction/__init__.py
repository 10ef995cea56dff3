"""Compaction and separation of polygons in exact geometry, shared by finish and settle."""
