"""Object-space losses that pull items about: a function of where they are, and its slope."""
