"""What items look like and are called, once they lie in their places."""
