"""What a layout is worth: one file per measure."""
