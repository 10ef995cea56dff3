"""Functions that give each word its colour, called as the other package calls them."""

from __future__ import annotations

import colorsys
from collections.abc import Callable
from functools import lru_cache
from numbers import Integral
from random import Random
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt
from PIL import ImageColor, ImageFont

from packwork.scene.contrast import between, contrast
from packwork.scene.palette import PALETTES

LEGIBLE = 2.0
"""Contrast with the background, as WCAG counts it, that words have at least where no colours are
asked for. Larger leaves out half of the palette, smaller words that can hardly be seen. By eye."""

_SHARES = 257

ColourFunction: TypeAlias = Callable[..., Any]
"""Of word, font_size, position, orientation, font_path and random_state, by name."""


Chance: TypeAlias = int | Random | np.random.RandomState | np.random.Generator | None
"""What random choices may come from."""


def random_of(state: Chance) -> Random | None:
    """The generator itself, or one that begins with a whole number or one of NumPy's."""
    if state is None or isinstance(state, Random):
        return state
    if isinstance(state, np.random.RandomState):
        state = state.randint(2**31)
    elif isinstance(state, np.random.Generator):
        state = int(state.integers(2**31))
    if not isinstance(state, Integral):
        raise TypeError(
            f"random_state is {type(state).__name__}; give a whole number, a random.Random or a "
            "generator of NumPy"
        )
    return Random(int(state))


def random_color_func(*_: Any, random_state: Random | None = None, **__: Any) -> str:
    """Any hue, at one saturation and lightness.

    Examples
    --------
    >>> random_color_func(random_state=Random(0)).startswith("hsl(")
    True
    """
    return f"hsl({(random_state or Random()).randint(0, 255)}, 80%, 50%)"


def get_single_color_func(color: str) -> ColourFunction:
    """Function that gives one hue and saturation in changing brightness.

    Examples
    --------
    >>> get_single_color_func("red")(random_state=Random(0)).endswith(", 0, 0)")
    True
    """
    red, green, blue = ImageColor.getrgb(color)[:3]
    hue, saturation, _ = colorsys.rgb_to_hsv(red / 255, green / 255, blue / 255)

    def single_color_func(*_: Any, random_state: Random | None = None, **__: Any) -> str:
        value = (random_state or Random()).uniform(0.2, 1)
        channels = colorsys.hsv_to_rgb(hue, saturation, value)
        return "rgb({:.0f}, {:.0f}, {:.0f})".format(*(255 * c for c in channels))

    return single_color_func


class colormap_color_func:  # noqa: N801 - the other package's name
    """Colours drawn at random from a colour map.

    Parameters
    ----------
    colormap
        A palette of ours by name, a name that matplotlib knows, if that is installed, or
        one of its colour maps.

    Raises
    ------
    ValueError
        If there is no such map.

    Examples
    --------
    >>> colormap_color_func("viridis")(random_state=Random(0))
    'rgb(155, 216, 67)'
    """

    def __init__(self, colormap: Any) -> None:
        self.colormap = colormap
        self._palette = PALETTES.get(colormap) if isinstance(colormap, str) else None
        self._map = colormap if callable(colormap) else None
        if self._palette is None and self._map is None:
            self._map = _matplotlib_map(colormap)

    def __call__(self, *_: Any, random_state: Random | None = None, **__: Any) -> str:
        """Colour of one word."""
        share = (random_state or Random()).uniform(0, 1)
        if self._palette is not None:
            channels: Any = ImageColor.getrgb(between(self._palette, share))
        else:
            assert self._map is not None  # noqa: S101 - one of the two is there
            channels = np.maximum(0, 255 * np.array(self._map(share)))[:3]
        return "rgb({:.0f}, {:.0f}, {:.0f})".format(*channels)


GOLDEN = (5**0.5 - 1) / 2


class ColourSpread(Random):
    """Numbers from 0 to 1, each far from those just before, the first drawn by another.

    Drawn one by one, three of the four largest words of a cloud may well look alike.
    """

    def __init__(self, drawn: Random) -> None:
        super().__init__(0)
        self._share = drawn.random()

    def random(self) -> float:
        """The next one."""
        self._share = (self._share + GOLDEN) % 1.0
        return self._share


class legible_color_func:  # noqa: N801 - as those beside it
    """Colours drawn at random from those of a palette of ours that stand out from a background.

    All colours are drawn where none stands out from ``ground`` (``#rrggbb``), or there is none.
    """

    def __init__(self, palette: str, ground: str | None) -> None:
        every = [between(PALETTES[palette], share) for share in np.linspace(0, 1, _SHARES)]
        legible = [one for one in every if ground is None or contrast(one, ground) >= LEGIBLE]
        self._colours = legible or every

    def __call__(self, *_: Any, random_state: Random | None = None, **__: Any) -> str:
        """Colour of one word."""
        share = (random_state or Random()).random()
        red, green, blue = ImageColor.getrgb(self._colours[int(share * len(self._colours))])[:3]
        return f"rgb({red}, {green}, {blue})"


def own_color_func(background: Any) -> ColourFunction:
    """Colours where none were asked for: all of the palette on a clear background."""
    try:
        red, green, blue, alpha = rgba(background)
    except (TypeError, ValueError):
        # What is no colour is told once a picture is asked for.
        return _legible_on(None)
    return _legible_on(f"#{red:02x}{green:02x}{blue:02x}" if alpha else None)


@lru_cache(16)
def _legible_on(ground: str | None) -> ColourFunction:
    return legible_color_func("viridis", ground)


def chances(color_func: ColourFunction, drawn: Random | None) -> Random | None:
    """Random numbers that a function of colours draws with: of ours, those that are spread."""
    return ColourSpread(drawn or Random()) if isinstance(color_func, legible_color_func) else drawn


def rgba(colour: Any) -> tuple[int, int, int, int]:
    """Channels of any colour that Pillow knows; None is clear."""
    if colour is None:
        return (0, 0, 0, 0)
    channels = ImageColor.getrgb(colour) if isinstance(colour, str) else tuple(colour)
    red, green, blue, alpha = (*(int(c) for c in channels), 255)[:4]
    return red, green, blue, alpha


class ImageColorGenerator:
    """Colour of a picture under a word's box.

    Parameters
    ----------
    image
        ``(rows, columns, 3 or 4)``, as large as the canvas.
    default_color
        For words beyond the picture; None makes them an error.

    Raises
    ------
    ValueError
        If the array is no picture.

    Examples
    --------
    >>> ImageColorGenerator(np.full((4, 4), 9))("ox", 2, None, (0, 0), None)
    'rgb(9, 9, 9)'
    """

    def __init__(
        self, image: npt.NDArray[Any], default_color: tuple[int, int, int] | None = None
    ) -> None:
        if image.ndim not in {2, 3}:
            raise ValueError(
                f"ImageColorGenerator needs an image with ndim 2 or 3, got {image.ndim}"
            )
        if image.ndim == 3 and image.shape[2] not in {3, 4}:
            raise ValueError(f"A color image needs to have 3 or 4 channels, got {image.shape[2]}")
        self.image = np.stack([image] * 3, axis=2) if image.ndim == 2 else image
        self.default_color = default_color

    def __call__(
        self,
        word: str,
        font_size: int,
        font_path: str | None,
        position: tuple[int, int],
        orientation: Any,
        **_: Any,
    ) -> str:
        """Mean colour under the word's box."""
        width, height = font_size * len(word), font_size
        if font_path is not None:
            font = ImageFont.TransposedFont(
                ImageFont.truetype(font_path, font_size), orientation=orientation
            )
            width, height = (int(side) for side in font.getbbox(word)[2:])
        row, column = position
        patch = self.image[row : row + height, column : column + width, :3].reshape(-1, 3)
        if len(patch) == 0:
            if self.default_color is None:
                raise ValueError("ImageColorGenerator is smaller than the canvas")
            return "rgb({}, {}, {})".format(*self.default_color)
        return "rgb({:.0f}, {:.0f}, {:.0f})".format(*patch.mean(axis=0))


def _matplotlib_map(name: Any) -> Callable[[float], Any]:
    try:
        from matplotlib import colormaps
    except ImportError:
        raise ValueError(
            f"{name!r} is none of the palettes {', '.join(PALETTES)}; install matplotlib for others"
        ) from None
    if name not in colormaps:
        raise ValueError(f"{name!r} is not a valid value for colormap")
    found: Callable[[float], Any] = colormaps[name]
    return found
