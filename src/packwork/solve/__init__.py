"""Image-space optimisation of poses: levels, Adam, relocation."""
