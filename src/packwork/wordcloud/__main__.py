"""``python -m packwork.wordcloud``: a text on standard input, a PNG on standard output."""

import sys

from packwork.wordcloud.wordcloud_cli import main, parse_args

if __name__ == "__main__":
    main(*parse_args(sys.argv[1:]))
