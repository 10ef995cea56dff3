"""``python -m packwork``: the command line."""

from packwork.cli import app

app()
