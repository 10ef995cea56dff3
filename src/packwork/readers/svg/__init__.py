"""Clean drawings to the regions they paint, and to fragments that can be drawn again."""
