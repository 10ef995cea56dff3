"""``python -m packwork.wordcloud``: a text on standard input, a PNG on standard output."""

import sys


def main() -> None:
    """Do what the command line asks; Ctrl-C is one line once the package is loaded."""
    try:
        from packwork.wordcloud.wordcloud_cli import run

        run(sys.argv[1:])
    except KeyboardInterrupt:
        sys.exit("packwork-wordcloud: stopped before there was anything to write")


if __name__ == "__main__":
    main()
