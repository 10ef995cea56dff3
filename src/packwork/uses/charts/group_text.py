"""Font size of the names of groups."""

SMALLEST_EM = 0.62
"""Letters of names over those of the legend at least; narrower rooms have every second name, or
shorter ones. Smaller cannot be read. Chosen by eye."""

FULL = 0.94
"""Share of a cell's width that its name may take. Chosen by eye."""

TURNED_EM, MOST_TURNED_EM = 0.72, 6.0
"""Letters of names that are read upwards, and their length at most, in ems. Chosen by eye."""
