"""Colours of words by their weight, by a column of their table, or from a picture."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from packwork.arrays import FloatArray
from packwork.errors import RecipeError
from packwork.phrasing import no_column
from packwork.raster.coverage import coverage
from packwork.readers.pictures.decode import (
    MAX_PICTURE_BYTES,
    PICTURE_ENDINGS,
    decode_picture,
)
from packwork.readers.reading import exists, read_bytes, reading_file
from packwork.readers.words.items import WordsRead
from packwork.readers.words.options import ColourOf, WordOptions
from packwork.readers.words.word import Word
from packwork.recipe import Recipe
from packwork.scene.contrast import between, readable
from packwork.scene.layout import Layout
from packwork.scene.palette import check_named, own_colours, palette_colours
from packwork.scene.recolour import has_one_colour
from packwork.uses.words.recipe import WEIGHT, words_colours

PICTURE_PX = 400
"""Longer side of the image in which a word's colour is looked up. Larger is slower and no
truer: it is one colour a word. Chosen."""

PAPER = "white"
"""What words are read on where no background is given."""


def word_colours(recipe: Recipe, read: WordsRead, layout: Layout) -> list[str | None] | None:
    """Colour of each item, None for one that keeps its own; None if neighbours decide."""
    asked = recipe.words
    if asked is None or asked.color_by is None:
        return None
    # Not by name: an icon may be called as a word is.
    said = dict(zip(read.items, read.words, strict=True))
    # Emoji in colours of their own keep them.
    words = [said.get(item) if has_one_colour(item.art) else None for item in layout.items]
    by = asked.color_by
    if callable(by):
        return _by_function(words, by, asked, _palette(recipe)[0])
    if by == WEIGHT:
        return _by_weight(words, _palette(recipe))
    if _is_picture(by):
        return _by_picture(words, layout, by, asked)
    return _by_column(words, asked, recipe.palette, read.values[by])


def check_colours(recipe: Recipe, words: WordsRead) -> None:
    """Refuse pictures that cannot be read and columns that are not there, before a run."""
    by = None if recipe.words is None else recipe.words.color_by
    if by is None or by == WEIGHT or callable(by):
        return
    if _is_picture(by):
        _covering(by, (1, 1))
        return
    if by not in words.values:
        raise RecipeError(
            "color_by",
            f"there is no column {no_column(by, list(words.values))}, and no such picture",
        )
    if isinstance(recipe.palette, Mapping):
        check_named(recipe.palette, by, words.values[by])


def _is_picture(by: str) -> bool:
    return Path(by[-20:]).suffix.lower() in PICTURE_ENDINGS or exists(by)


def _palette(recipe: Recipe) -> tuple[str, ...]:
    return palette_colours(recipe.palette or "viridis")


def _by_weight(words: list[Word | None], palette: tuple[str, ...]) -> list[str | None]:
    """From the first colour for the largest to the last for the smallest, by ratio."""
    logs = np.log([word.weight for word in words if word is not None])
    span = float(np.ptp(logs)) or 1.0
    return [
        None
        if word is None
        else between(palette, (float(logs.max()) - float(np.log(word.weight))) / span)
        for word in words
    ]


def _by_function(
    words: list[Word | None], colour_of: ColourOf, options: WordOptions, otherwise: str
) -> list[str | None]:
    """Colours that a function gives to words, kept readable; ``otherwise`` where it says None."""
    paper = options.paper or PAPER
    found: list[str | None] = []
    for word in words:
        said = None if word is None else colour_of(word)
        colour = otherwise if said is None else said
        try:
            legible = readable(colour, paper, options.contrast)
        except (ValueError, TypeError, AttributeError):
            text = "" if word is None else word.text
            raise RecipeError(
                "color_by", f"gave {text[:40]!r} the colour {str(said)[:40]!r}, which is none"
            ) from None
        found.append(None if word is None else legible)
    return found


def _by_column(
    words: list[Word | None], options: WordOptions, asked: object, values: Sequence[str]
) -> list[str | None]:
    """One colour for each value that a column has anywhere, in the order of the palette."""
    column, own = str(options.color_by), own_colours(asked)
    is_list = asked is not None and not own
    free = palette_colours(asked) if is_list else words_colours(None, options, "")
    free = tuple(colour for colour in free if colour not in own.values())
    others = [value for value in values if value.casefold() not in own]
    most = max(len(others) - 1, 1)
    found = {value: _nth(free, k, most) for k, value in enumerate(others)}
    found |= {value: own[value.casefold()] for value in values if value.casefold() in own}
    return [None if word is None else found[word.columns.get(column, "")] for word in words]


def _nth(palette: tuple[str, ...], number: int, most: int) -> str:
    """A colour of the palette; in between, where there are more values than colours."""
    return palette[number] if most < len(palette) else between(palette, number / most)


def _by_picture(
    words: list[Word | None], layout: Layout, file: str, options: WordOptions
) -> list[str | None]:
    """Mean colour of the picture under each word, kept readable."""
    container = layout.container
    scale = PICTURE_PX / container.side
    shape = (
        max(1, round(container.height * scale)), max(1, round(container.width * scale))
    )  # fmt: skip
    pixels = _covering(file, shape)
    paper = options.paper or PAPER
    found: list[str | None] = []
    for word, ink in zip(words, layout.inks, strict=True):
        if word is None:
            found.append(None)
            continue
        weights = coverage(ink.points * scale, ink.starts, shape, np.float32).astype(np.float64)
        weights = weights * pixels[..., 3]
        total = float(weights.sum())
        mean = np.tensordot(weights, pixels[..., :3], 2) / total if total > 0 else np.zeros(3)
        colour = "#{:02x}{:02x}{:02x}".format(*(round(float(c)) for c in mean))
        found.append(readable(colour, paper, options.contrast))
    return found


def _covering(file: str, shape: tuple[int, int]) -> FloatArray:
    """``(rows, columns, 4)`` of a picture that covers the canvas, its middle kept."""
    from PIL import Image, ImageOps

    with reading_file(file):
        picture = decode_picture(read_bytes(file, MAX_PICTURE_BYTES), 2 * PICTURE_PX)
    fitted = ImageOps.fit(Image.fromarray(picture.pixels), (shape[1], shape[0]))
    return np.asarray(fitted, dtype=np.float64)
