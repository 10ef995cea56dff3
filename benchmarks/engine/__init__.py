"""The renderer, the solver, time and memory."""
