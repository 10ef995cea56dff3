"""Object-space losses that pull items: a function of where they are, and its slope."""
