"""Request resolved against what was read: numbers, limits, forces, regions, counts."""
