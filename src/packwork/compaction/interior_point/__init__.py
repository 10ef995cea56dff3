"""Linear programmes over small steps of items, by an interior-point method."""
