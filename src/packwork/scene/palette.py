"""Palettes: named lists of colours, and colours that users write down."""

from __future__ import annotations

import logging
import re
from collections.abc import Iterable, Mapping
from types import MappingProxyType

from packwork.errors import RecipeError
from packwork.phrasing import enumerated, meant
from packwork.scene.colour import css_colour, known_colour

PALETTES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        # Okabe and Ito 2008, "Color universal design".
        "okabe-ito": (
            "#e69f00", "#56b4e9", "#009e73", "#f0e442", "#0072b2", "#d55e00", "#cc79a7", "#000000",
        ),
        # Tol 2021, "Colour schemes", SRON technical note; grey ones left out.
        "tol-bright": ("#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377"),
        "tol-vibrant": ("#ee7733", "#0077bb", "#33bbee", "#ee3377", "#cc3311", "#009988"),
        "tol-muted": (
            "#cc6677", "#332288", "#ddcc77", "#117733", "#88ccee", "#882255", "#44aa99",
            "#999933", "#aa4499",
        ),
        "tol-high-contrast": ("#004488", "#ddaa33", "#bb5566"),
        # Ours: deep colours of unlike hue, for words on paper.
        "ink": ("#22304f", "#b5432a", "#1f6f78", "#7b3b5e", "#96690a"),
        # Nunez, Anderton and Renslow 2018, and van der Walt and Smith 2015: even steps of
        # lightness, from dark to light.
        "cividis": (
            "#00224e", "#123570", "#3b496c", "#575d6d", "#707173", "#8a8678", "#a59c74", "#c3b369",
            "#e1cc55", "#fee838",
        ),
        "viridis": (
            "#440154", "#482878", "#3e4989", "#31688e", "#26828e", "#1f9e89", "#35b779", "#6ece58",
            "#b5de2b", "#fde725",
        ),
    }
)  # fmt: skip
"""Palettes by name; most can be told apart by readers who are colour blind."""

LONGEST = 20_000
"""Characters of a palette at most: to part the colours takes time by their square. Chosen."""

MOST_TOLD = 6
"""Values that a message names. Chosen."""

_LOG = logging.getLogger("packwork")

_COMMA = re.compile(r",(?![^(]*\))")
"""Between two colours, not between the channels of one."""


def palette_colours(value: object) -> tuple[str, ...]:
    """Colours of a named palette, of ``red,#457b9d``, a list or a dict, each as ``#rrggbb``.

    Raises ``ValueError`` if there is no such palette or colour.

    Examples
    --------
    >>> palette_colours("tol-high-contrast")
    ('#004488', '#ddaa33', '#bb5566')
    >>> palette_colours("tomato, rgb(0, 0, 255)"), palette_colours(["#ff000080"])
    (('#ff6347', '#0000ff'), ('#ff000080',))
    """
    if isinstance(value, Mapping):
        return tuple((colours_by_name(value) or {}).values())
    spot_inks_in(value)
    if isinstance(value, str):
        named = PALETTES.get(value.strip().lower())
        return named or tuple(_colour(part) for part in _parts_of(value))
    if isinstance(value, list | tuple) and value and all(isinstance(c, str) for c in value):
        return tuple(_colour(part) for part in value)
    raise ValueError(f"use colours such as '#e63946,teal' or a palette's name, not {value!r}")


def _parts_of(text: str) -> list[str]:
    if len(text) > LONGEST:
        raise ValueError(f"takes {LONGEST:,} characters at most, not {len(text):,}")
    return _COMMA.split(text)


def colours_by_name(value: object) -> dict[str, str] | None:
    """Colours of ``bear=red,fox=#457b9d`` or a dict of them; None if they are given to no names.

    Raises ``ValueError`` if a name has no colour, or one that there is not.

    Examples
    --------
    >>> colours_by_name("bear=tomato, fox=rgb(0, 0, 255)"), colours_by_name("red,blue")
    ({'bear': '#ff6347', 'fox': '#0000ff'}, None)
    """
    if isinstance(value, str) and "=" in value:
        parts = [part.rpartition("=") for part in _parts_of(value)]
        names = [name.strip() for name, _, _ in parts]
        if len(set(names)) < len(names):
            raise ValueError(f"give each name one colour, not {value!r:.60}")
        value = dict(zip(names, (colour for _, _, colour in parts), strict=True))
    if not isinstance(value, Mapping):
        return None
    if not value or not all(name and isinstance(colour, str) for name, colour in value.items()):
        raise ValueError(f"give each name its colour, as bear=red,fox=#457b9d, not {value!r:.60}")
    return {str(name): _colour(colour) for name, colour in value.items()}


def own_colours(palette: object) -> dict[str, str]:
    """Colours that a palette gives by name, in small letters; none if it is a list."""
    named = colours_by_name(palette) or {}
    return {name.casefold(): colour for name, colour in named.items()}


def check_named(palette: Mapping[str, str], column: str, values: Iterable[str]) -> None:
    """Tell of names that have a colour and that no value of a column has.

    Raises ``RecipeError`` if none has.
    """
    known = {value.casefold(): value for value in values}
    vain = [name for name in palette if name.casefold() not in known]
    if not vain:
        return
    told = enumerated([repr(name[:40]) for name in vain])
    text = f"gives a colour to {told}; {column} has {enumerated(list(known.values()), MOST_TOLD)}"
    if len(vain) == len(palette):
        raise RecipeError("palette", text)
    _LOG.warning("palette %s", text)


SPOT = "spot:"
"""Beginning of a colour that is printed in an ink of its own, as ``spot:Gold #b58b2a``."""


def spot_inks_in(palette: object) -> dict[str, str]:
    """Names of the spot inks that a palette asks for, by colour.

    Raises ``ValueError`` if two have one colour.

    Examples
    --------
    >>> spot_inks_in("spot:PANTONE 186 C #c8102e, black"), spot_inks_in("okabe-ito")
    ({'#c8102e': 'PANTONE 186 C'}, {})
    """
    listed = palette if isinstance(palette, list | tuple) else ()
    parts = _parts_of(palette) if isinstance(palette, str) else map(str, listed)
    spots = (part.strip() for part in parts if part.strip().lower().startswith(SPOT))
    inks = dict[str, str]()
    for part in spots:
        colour, name = _colour(part), part[len(SPOT) :].rpartition(" ")[0].strip()
        if name and inks.setdefault(colour, name) != name:
            raise ValueError(f"{inks[colour]} and {name} have one colour; give each its own")
    return inks


_RESERVED = frozenset({"all", "none", "cyan", "magenta", "yellow", "black"})
"""Separations that are no spot inks: every ink, none, and those of a press (ISO 32000-1,
8.6.6.4)."""


def check_ink(name: str) -> None:
    """Raise ``ValueError`` if a spot ink cannot be called so."""
    if name.casefold() in _RESERVED:
        raise ValueError(f"{name} is no spot ink in a PDF; give it another name")
    if not name.isprintable():
        raise ValueError(f"an ink cannot be called {name[:40]!r}; leave out what is not printed")


def _colour(text: str) -> str:
    if text.strip().lower().startswith(SPOT):
        name, _, text = text.strip()[len(SPOT) :].rpartition(" ")
        check_ink(name.strip())
    try:
        red, green, blue, opacity = css_colour(text)
    except ValueError:
        raise ValueError(_unknown(text.strip())) from None
    if opacity == 0:
        raise ValueError(f"{text.strip()!r} cannot be seen; use a colour such as #e63946")
    return f"#{red:02x}{green:02x}{blue:02x}" + ("" if opacity == 255 else f"{opacity:02x}")


def _unknown(text: str) -> str:
    hint = meant(text, PALETTES) or f"palettes are {', '.join(PALETTES)}"
    parts = re.split(r"[\s;]+", text)
    if len(parts) > 1 and all(map(known_colour, parts)):
        hint = f"put commas between colours: {','.join(parts)[:80]}"
    return f"{text[:40]!r} is no colour; {hint}"
