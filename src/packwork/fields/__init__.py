"""Images derived from images: distances, box sums."""
