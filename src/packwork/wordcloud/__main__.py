"""``python -m packwork.wordcloud``: a text on standard input, a PNG on standard output."""

import sys

from packwork.wordcloud.wordcloud_cli import run

if __name__ == "__main__":
    run(sys.argv[1:])
