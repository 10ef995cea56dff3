"""Many at once: rates, crashes, tables with bad rows, the best of several, series."""
