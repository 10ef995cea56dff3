"""What a clean drawing says: numbers, paths, transforms, pages, paints, references."""
