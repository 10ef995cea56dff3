"""``WordCloud`` as programs of the other package know it."""

from __future__ import annotations

import io
import logging
import os
import warnings
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from random import Random
from typing import Any, Literal, Self

import numpy as np
import numpy.typing as npt
from PIL import Image, ImageDraw

from packwork import writers
from packwork.fonts import bundled_file
from packwork.phrasing import number_of
from packwork.readers.fonts.fallback import open_fonts
from packwork.readers.words.shaping import EM_PX
from packwork.scene.layout import Layout
from packwork.wordcloud.colours import (
    Chance,
    ColourFunction,
    chances,
    colormap_color_func,
    get_single_color_func,
    own_color_func,
    random_color_func,
    random_of,
    rgba,
)
from packwork.wordcloud.engine import (
    FAINT,
    CloudSettings,
    PlacedWords,
    container_of_mask,
    paint,
    place_words,
    relative_steps,
    scaled_layout,
)
from packwork.wordcloud.tokenization import STOPWORDS, process_tokens, tokens, unigrams_and_bigrams

__all__ = ["STOPWORDS", "WordCloud", "get_single_color_func", "random_color_func"]

_LOG = logging.getLogger("packwork")

Entry = tuple[tuple[str, float], int, tuple[int, int], Any, Any]
"""Word and frequency, font size, place (row, column), orientation, colour."""

FONT_PATH = os.environ.get("FONT_PATH", bundled_file())
"""Font where none is given."""

_WITHOUT_EFFECT = {"ranks_only": None}
"""Arguments of the other package's search that this engine does not have."""


class WordCloud:
    """Words in the proportion of their frequencies, none over another.

    Arguments, methods, attributes and defaults are those of the ``wordcloud`` package. In the
    order of frequencies each word takes the largest size at which it finds a place, at most
    that of the word before by ``relative_scaling``. What differs: places are the best of all
    instead of any, letters lie in each other's bays and counters, and no two overlap. Where a
    word would be less than ``min_font_size`` it is left out, and the log says how many.

    Examples
    --------
    >>> cloud = WordCloud(width=120, height=80, random_state=1).generate("bear, honey and bear")
    >>> cloud.words_, cloud.to_array().shape
    ({'bear': 1.0, 'honey': 0.5}, (80, 120, 3))
    """

    def __init__(
        self,
        font_path: str | os.PathLike[str] | None = None,
        width: int = 400,
        height: int = 200,
        margin: int = 2,
        ranks_only: Any = None,
        prefer_horizontal: float = 0.9,
        mask: npt.NDArray[Any] | None = None,
        scale: float = 1,
        color_func: ColourFunction | None = None,
        max_words: int = 200,
        min_font_size: int = 4,
        stopwords: Any = None,
        random_state: Chance = None,
        background_color: Any = "black",
        max_font_size: int | None = None,
        font_step: int = 1,
        mode: str = "RGB",
        relative_scaling: float | Literal["auto"] = "auto",
        regexp: str | None = None,
        collocations: bool = True,
        colormap: Any = None,
        normalize_plurals: bool = True,
        contour_width: float = 0,
        contour_color: Any = "black",
        repeat: bool = False,
        include_numbers: bool = False,
        min_word_length: int = 0,
        collocation_threshold: float = 30,
    ) -> None:
        _warn_of({"ranks_only": ranks_only})
        if relative_scaling == "auto":
            relative_scaling = 0 if repeat else 0.5
        if not 0 <= relative_scaling <= 1:
            raise ValueError(
                f"relative_scaling needs to be between 0 and 1, got {relative_scaling:f}."
            )
        self.font_path = FONT_PATH if font_path is None else str(font_path)
        self.width, self.height = width, height
        if mask is not None:
            self.height, self.width = mask.shape[:2]
        self.margin, self.prefer_horizontal = margin, prefer_horizontal
        self.mask, self.scale = mask, scale
        is_free = color_func is None and colormap is None
        self.colormap = "viridis" if is_free else colormap
        if is_free:
            color_func = own_color_func(background_color)
        self.color_func = color_func or colormap_color_func(self.colormap)
        self.max_words, self.min_font_size, self.font_step = max_words, min_font_size, font_step
        self.stopwords = STOPWORDS if stopwords is None else stopwords
        self.random_state = random_of(random_state)
        self.background_color, self.mode = background_color, mode
        self.max_font_size, self.relative_scaling = max_font_size, relative_scaling
        self.regexp, self.collocations = regexp, collocations
        self.normalize_plurals, self.repeat = normalize_plurals, repeat
        self.contour_width, self.contour_color = contour_width, contour_color
        self.include_numbers, self.min_word_length = include_numbers, min_word_length
        self.collocation_threshold = collocation_threshold

    def fit_words(self, frequencies: Mapping[str, float]) -> Self:
        """Place words of known frequencies."""
        return self.generate_from_frequencies(frequencies)

    def generate_from_frequencies(
        self, frequencies: Mapping[str, float], max_font_size: int | None = None
    ) -> Self:
        """Place words of known frequencies; those of 0 are left out.

        Raises
        ------
        ValueError
            If there is no word, or no room for one.
        """
        ranked = sorted(frequencies.items(), key=lambda pair: -pair[1])[: self.max_words]
        self.layout_ = []
        self.__dict__.pop("_placed", None)
        if not ranked:
            raise ValueError("We need at least 1 word to plot a word cloud, got 0.")
        most = float(ranked[0][1]) or 1.0
        shares = [(word, count / most) for word, count in ranked]
        self.words_ = dict(shares)
        entries = [pair for pair in self._repeated(shares) if pair[1] > 0]
        steps = relative_steps([share for _, share in entries], float(self.relative_scaling))
        largest = max_font_size or self.max_font_size
        random = self.random_state or Random()
        found = place_words(self._setting(largest), [word for word, _ in entries], steps, random)
        self._say_what_is_missing(len(entries), found)
        self._placed = found
        drawn = chances(self.color_func, random)
        self.layout_ = [
            self._entry(entries[number], position, drawn)
            for position, number in enumerate(found.entries)
        ]
        return self

    def process_text(self, text: str) -> dict[str, int]:
        """Frequencies of a text's words, and of pairs that belong together."""
        words = tokens(
            text,
            self.regexp,
            include_numbers=self.include_numbers,
            min_word_length=self.min_word_length,
        )
        stops = {word.lower() for word in self.stopwords}
        if self.collocations:
            return unigrams_and_bigrams(
                words, stops, self.normalize_plurals, self.collocation_threshold
            )
        kept = [word for word in words if word.lower() not in stops]
        return process_tokens(kept, self.normalize_plurals)[0]

    def generate_from_text(self, text: str) -> Self:
        """Place the words of a text."""
        return self.generate_from_frequencies(self.process_text(text))

    def generate(self, text: str) -> Self:
        """Place the words of a text."""
        return self.generate_from_text(text)

    def recolor(
        self,
        random_state: Chance = None,
        color_func: ColourFunction | None = None,
        colormap: Any = None,
    ) -> Self:
        """Give the placed words new colours."""
        self._check_generated()
        if color_func is None:
            color_func = self.color_func if colormap is None else colormap_color_func(colormap)
        random = chances(color_func, random_of(random_state))
        self.layout_ = [
            (*entry[:4], self._colour(entry[0][0], *entry[1:4], random, color_func))
            for entry in self.layout_
        ]
        return self

    def to_image(self) -> Image.Image:
        """Picture of the cloud, ``scale`` times as large as its canvas."""
        self._check_generated()
        size = (int(self.width * self.scale), int(self.height * self.scale))
        shown = Image.new("RGBA", size, rgba(self.background_color))
        if any(word.has_pictures for word in self._placed.words):
            data = writers.png_bytes(self.layout, max(size), writers.SvgOptions())
            with Image.open(io.BytesIO(data)) as drawn:
                shown.alpha_composite(_without_traces(drawn.convert("RGBA").crop((0, 0, *size))))
        else:
            colours = [rgba(entry[4]) for entry in self.layout_]
            paint(shown, zip(self._placed.outlines, colours, strict=True), float(self.scale))
        return self._with_contour(shown).convert(self.mode)

    def to_file(self, filename: str | os.PathLike[str]) -> Self:
        """Write the picture; or, by the ending, an SVG, PDF, DXF or GeoJSON."""
        self._check_generated()
        if Path(filename).suffix.lower() in {".svg", ".pdf", ".dxf", ".geojson"}:
            options = writers.write_options(background=self._css_background())
            writers.write(scaled_layout(self.layout, float(self.scale)), str(filename), options)
        else:
            writers.write_atomic(str(filename), self._encoded(filename))
        return self

    def _encoded(self, filename: str | os.PathLike[str]) -> bytes:
        """The picture as a file whose ending says the format."""
        made = io.BytesIO()
        ending = Path(filename).suffix.lower()
        Image.preinit()  # tells of the usual formats, in a tenth of the time of all
        kind = Image.EXTENSION.get(ending) or Image.registered_extensions().get(ending)
        if kind is None or kind not in Image.SAVE:
            raise ValueError(f"unknown file extension: {ending}")
        self.to_image().save(made, format=kind, optimize=True)
        return made.getvalue()

    def to_array(self, copy: bool | None = None) -> npt.NDArray[np.uint8]:
        """Pixels of the picture, ``(rows, columns, channels)``."""
        image = np.asarray(self.to_image())
        return np.array(image) if copy else image

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> npt.NDArray[Any]:
        """Pixels, for functions that take arrays."""
        pixels = self.to_array(copy=copy)
        return pixels if dtype is None else pixels.astype(dtype, copy=False)

    def to_svg(
        self,
        embed_font: bool = False,
        optimize_embedded_font: bool = True,
        embed_image: bool = False,
    ) -> str:
        """SVG of the cloud; its words are outlines, or text in fonts that it carries."""
        self._check_generated()
        if embed_image:
            _warn_once("embed_image has no effect: the outlines are what the picture shows")
        if not optimize_embedded_font:
            _warn_once("optimize_embedded_font has no effect: only letters in use are embedded")
        return str(
            writers.svg_text(
                scaled_layout(self.layout, float(self.scale)),
                writers.SvgOptions(
                    background=self._css_background(), text="live" if embed_font else "outlines"
                ),
            )
        )

    def _repr_png_(self) -> bytes | None:
        return self._encoded("cloud.png") if hasattr(self, "_placed") else None

    def to_html(self) -> str:
        """Not there, as in the other package; ``to_svg`` is."""
        raise NotImplementedError("use to_svg, which browsers show")

    @property
    def layout(self) -> Layout:
        """The engine's layout, in the colours of ``layout_``."""
        from packwork.scene.recolour import recoloured

        self._check_generated()
        layout = self._placed.layout
        items = [
            recoloured(item, "#{:02x}{:02x}{:02x}{:02x}".format(*rgba(entry[4])))
            for item, entry in zip(layout.items, self.layout_, strict=True)
        ]
        named = [
            replace(item, name=entry[0][0]) for item, entry in zip(items, self.layout_, strict=True)
        ]
        return replace(layout, items=tuple(named))

    def _repeated(self, shares: list[tuple[str, float]]) -> list[tuple[str, float]]:
        """Words, again and again and each time rarer, in whole rounds to ``max_words`` or more."""
        if not self.repeat:
            return shares
        rounds = -(-self.max_words // len(shares))
        least = shares[-1][1]
        return [(word, share * least**turn) for turn in range(rounds) for word, share in shares]

    def _setting(self, largest: float | None) -> CloudSettings:
        return CloudSettings(
            container_of_mask(self.mask, self.width, self.height),
            open_fonts([self.font_path]),
            float(self.margin),
            self.prefer_horizontal,
            float(self.min_font_size),
            None if largest is None else float(largest),
            float(max(self.font_step, 1)),
        )

    def _entry(self, pair: tuple[str, float], position: int, random: Random | None) -> Entry:
        """Entry of ``layout_`` for a word: whole numbers, of its box's upper left corner."""
        left, top, _, _ = self._placed.outlines[position].bounds
        size = round(float(self._placed.poses.scale[position]) * EM_PX)
        turned = abs(float(self._placed.poses.angle[position])) > 1e-6
        orientation = Image.Transpose.ROTATE_90 if turned else None
        place = (int(top), int(left))
        colour = self._colour(pair[0], size, place, orientation, random, self.color_func)
        return pair, size, place, orientation, colour

    def _colour(
        self,
        word: str,
        size: int,
        place: tuple[int, int],
        orientation: Any,
        random: Random | None,
        color_func: Callable[..., Any],
    ) -> Any:
        return color_func(
            word=word,
            font_size=size,
            position=place,
            orientation=orientation,
            random_state=random,
            font_path=self.font_path,
        )

    def _say_what_is_missing(self, asked: int, found: PlacedWords) -> None:
        for word, reason in found.undrawn.items():
            _LOG.warning("not placed: %s: %s", word[:40], reason)
        small = asked - len(found.entries) - len(found.undrawn)
        if small:
            told = "%d of %d words are left out: they would be smaller than min_font_size, %s"
            _LOG.warning(told, small, asked, self.min_font_size)

    def __repr__(self) -> str:
        return f"<WordCloud: {number_of(len(getattr(self, 'layout_', ())), 'word')}>"

    def _check_generated(self) -> None:
        if not hasattr(self, "_placed"):
            raise ValueError("WordCloud has not been calculated, call generate first.")

    def _css_background(self) -> str | None:
        red, green, blue, alpha = rgba(self.background_color)
        return f"#{red:02x}{green:02x}{blue:02x}{alpha:02x}" if alpha else None

    def _with_contour(self, image: Image.Image) -> Image.Image:
        if self.mask is None or self.contour_width == 0:
            return image
        draw = ImageDraw.Draw(image)
        for ring in self._placed.container.outline.rings:
            points = [tuple(point) for point in (ring * self.scale).tolist()]
            width = max(1, round(self.contour_width * self.scale))
            draw.line([*points, points[0]], rgba(self.contour_color), width, joint="curve")
        return image


def _without_traces(image: Image.Image) -> Image.Image:
    """Picture without pixels so faint that some colours would not show in them."""
    alpha = image.getchannel("A").point(lambda value: value if value >= FAINT else 0)
    image.putalpha(alpha)
    return image


_warned: set[str] = set()


def _warn_of(given: Mapping[str, Any]) -> None:
    for name, value in given.items():
        if value != _WITHOUT_EFFECT[name]:
            _warn_once(f"{name} has no effect: places are optimised, not searched for")


def _warn_once(text: str) -> None:
    if text not in _warned:
        _warned.add(text)
        warnings.warn(text, UserWarning, stacklevel=3)
