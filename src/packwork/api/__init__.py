"""The Python face: the verbs of the command line, on plain values."""
