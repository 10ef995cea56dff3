"""Word segmentation of Chinese, Japanese and Thai, which are written without spaces."""

from __future__ import annotations

import re
from functools import cache
from typing import Any

_HAN = "\u3005\u3400-\u4dbf\u4e00-\u9fff\uf900-\ufaff\U00020000-\U0003ffff"
_KANA = "\u3041-\u3096\u30a1-\u30fa\u30fc"
_THAI = "\u0e01-\u0e4e"
_UNSPACED = re.compile(f"[{_HAN}{_KANA}{_THAI}]")
_KANA_RUN = re.compile(f"[{_KANA}]")
_THAI_RUN = re.compile(f"[{_THAI}]")
_PIECES = re.compile(f"[{_HAN}{_KANA}]+|[{_THAI}]+|[^{_HAN}{_KANA}{_THAI}]+")
_HIRAGANA = re.compile("[\u3041-\u3096]+")

_TRADITIONAL = frozenset("個們來時國學為說會對過還沒這裡與從開門問東車馬見長風飛魚龍愛書")

_PARTICLES = (
    "でした", "ました", "ません", "ます", "です", "から", "まで", "より", "など", "には", "では",
    "とは", "だけ", "ほど", "は", "が", "を", "に", "で", "と", "も", "の", "へ", "や", "だ", "な",
)  # fmt: skip
"""What the phrases of the Japanese segmenter end in, longest first."""

MOST_AT_ONCE = 10_000
"""Characters that are segmented in one go; the rest is cut there. Chosen."""


def is_unspaced(character: str) -> bool:
    """Whether a character belongs to a script that is written without spaces.

    Examples
    --------
    >>> [is_unspaced(character) for character in "语กa"]
    [True, True, False]
    """
    return _UNSPACED.match(character) is not None


def segments(text: str) -> list[str]:
    """Words of a text without spaces; single Han characters and kana endings are left out.

    BudouX segments, into phrases: of Japanese ones the particles at the end are taken off.

    Examples
    --------
    >>> segments("我们的世界"), segments("日本の自然と文化")
    (['我们', '世界'], ['日本', '自然', '文化'])
    """
    found: list[str] = []
    for piece in _PIECES.findall(text):
        if not is_unspaced(piece[0]):
            found += [piece] if len(piece) > 1 and not piece.isnumeric() else []
            continue
        language = _language(piece)
        for start in range(0, len(piece), MOST_AT_ONCE):
            words = _segmenter(language).parse(piece[start : start + MOST_AT_ONCE])
            found += [_bare(word) for word in words] if language == "ja" else words
    return [word for word in found if _is_word(word)]


def _language(piece: str) -> str:
    if _THAI_RUN.match(piece):
        return "th"
    if _KANA_RUN.search(piece):
        return "ja"
    return "zh-hant" if _TRADITIONAL.intersection(piece) else "zh-hans"


@cache
def _segmenter(language: str) -> Any:
    """BudouX' parser, whose model takes a moment to load."""
    import budoux

    return {
        "th": budoux.load_default_thai_parser,
        "ja": budoux.load_default_japanese_parser,
        "zh-hans": budoux.load_default_simplified_chinese_parser,
        "zh-hant": budoux.load_default_traditional_chinese_parser,
    }[language]()


def _bare(phrase: str) -> str:
    """A Japanese phrase without the particles that end it."""
    while True:
        ending = next((p for p in _PARTICLES if phrase.endswith(p)), "")
        rest = phrase.removesuffix(ending) if ending else phrase
        if not ending or _HIRAGANA.fullmatch(rest) or not rest:
            return phrase
        phrase = rest


def _is_word(word: str) -> bool:
    return len(word) > 1 and not (len(word) < 3 and _HIRAGANA.fullmatch(word))
