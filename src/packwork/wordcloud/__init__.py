"""The classes of the well-known ``wordcloud`` package, on this one's engine.

A program written for it runs with ``from packwork.wordcloud import WordCloud``.

>>> cloud = WordCloud(random_state=0).generate_from_frequencies({"honey": 2, "bear": 1})
>>> [word for (word, _), *_ in cloud.layout_]
['honey', 'bear']
"""

from packwork.wordcloud.colours import (
    ImageColorGenerator,
    colormap_color_func,
    get_single_color_func,
    random_color_func,
)
from packwork.wordcloud.tokenization import STOPWORDS
from packwork.wordcloud.wordcloud import WordCloud

__all__ = [
    "STOPWORDS",
    "ImageColorGenerator",
    "WordCloud",
    "colormap_color_func",
    "get_single_color_func",
    "random_color_func",
]
