"""Inner loops of the separation."""
