"""Images derived from images: distances and room."""
