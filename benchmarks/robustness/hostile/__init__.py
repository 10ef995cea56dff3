"""What ``packwork bench robustness`` does to the program: inputs, stops, surroundings."""
