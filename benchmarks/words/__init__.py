"""Words beside the ``wordcloud`` package, and in its place."""
