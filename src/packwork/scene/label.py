"""Label of one placed item: its name, link and tooltip in a file."""

from __future__ import annotations

import re
from dataclasses import dataclass
from urllib.parse import urlsplit

from packwork.errors import RecipeError

SCHEMES = ("", "http", "https", "mailto")
"""Where a link may lead; the first stands for addresses relative to the file."""

MAX_LENGTH = 2_000
"""Characters of a name, a title or a link. Chosen: what browsers take as an address."""

_UNSEEN = re.compile(r"[\x00-\x20\x7f-\xa0\u2028\u2029\\]")
"""What no address holds; browsers pass over some of it, even inside ``java script:``."""


@dataclass(frozen=True)
class Label:
    """Name, link and tooltip of one placed item; empty where there is none.

    Parameters
    ----------
    name
        What it is called in the file.
    link
        Where a click leads: http, https, mailto, or relative to the file.
    title
        What is shown when a pointer rests on it.

    Raises
    ------
    RecipeError
        Under the field's name, if a text is too long or a link leads elsewhere.

    Examples
    --------
    >>> Label(link="javascript:alert(1)")
    Traceback (most recent call last):
        ...
    packwork.errors.RecipeError: link: must begin with http:, https: or mailto:, or be relative,
    not 'javascript:alert(1)'
    """

    name: str = ""
    link: str = ""
    title: str = ""

    def __post_init__(self) -> None:
        for key in ("name", "link", "title"):
            if len(getattr(self, key)) > MAX_LENGTH:
                raise RecipeError(key, f"may have {MAX_LENGTH} characters, not more")
        if not _is_sound(self.link):
            raise RecipeError(
                "link",
                f"must begin with http:, https: or mailto:, or be relative, not {self.link[:60]!r}",
            )


def _is_sound(link: str) -> bool:
    if _UNSEEN.search(link):
        return False
    try:
        return urlsplit(link).scheme in SCHEMES
    except ValueError:  # such as an unfinished [address]
        return False
