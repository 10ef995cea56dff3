"""Films of a run: one file per format, all drawn from the layout's track."""
