"""Images derived from images: distances, room, box sums."""
