"""``python -m packwork.wordcloud``: a text on standard input, a PNG on standard output."""

import sys

from packwork.wordcloud.wordcloud_cli import run


def main() -> None:
    """Do what the command line asks."""
    run(sys.argv[1:])


if __name__ == "__main__":
    main()
