"""Arrays, pictures and geometries in memory, as items and containers."""
