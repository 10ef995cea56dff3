"""What layouts are worth, of every use."""
