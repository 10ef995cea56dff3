"""Items put one after another, the largest first, where they touch most."""
