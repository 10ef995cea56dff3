"""Similar items side by side: neighbour graphs of vectors, and their assignment to places."""
