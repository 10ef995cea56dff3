"""What a Python session shows by itself: a layout's picture, a run's progress."""
