"""Coverage of the pixels by all items at once, and its exact pullback."""
