"""What breaks it, and how files from anywhere are read."""
