"""``ImageColorGenerator`` under the other package's module name."""

from packwork.wordcloud.colours import ImageColorGenerator

__all__ = ["ImageColorGenerator"]
