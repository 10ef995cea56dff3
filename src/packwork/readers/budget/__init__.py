"""What would take too long, told before it is begun: counts, their limits and their cost."""
