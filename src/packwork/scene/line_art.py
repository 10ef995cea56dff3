"""Drawings of lines for a machine, and the colours by which it tells what it cuts from the rest."""

from __future__ import annotations

import re
from dataclasses import dataclass

from packwork.geometry.arcs import ArcLine
from packwork.scene.colour import css_colour, hex_colour, known_colour
from packwork.scene.item import VectorArt

CUT, ENGRAVE = "cut", "engrave"
"""Layers of what is cut through, and of what is not unless its own layer has another name."""

CUT_COLOUR, ENGRAVED_COLOUR = "#ff0000", "#0000ff"
"""Colours of both, red and blue: what drivers of lasers take for them."""

_NEAR_RED = 64
"""Parts of 255 up to which a colour may differ from red and a driver take it for that. Chosen."""

_OTHERS = re.compile(r"0|cut|engrave|items|room|container|artwork|defpoints", re.IGNORECASE)
_NOT_IN_NAMES = re.compile(r"[<>/\\\":;?*|=`,\x00-\x1f\x7f]")


@dataclass(frozen=True, eq=False)
class EngravedLine(ArcLine):
    """A line that a machine does not cut through.

    ``colour``: any CSS colour, ``layer``: a name; each empty where the drawing gives it none. What
    is no colour, as a gradient, counts for none.

    Examples
    --------
    >>> import numpy as np
    >>> line = EngravedLine(np.eye(2), np.zeros(2), False, "lime", "Score")
    >>> line.own_colour, line.own_layer
    ('#00ff00', 'Score')
    >>> line = EngravedLine(np.eye(2), np.zeros(2), False, "#f01010", "cut")
    >>> line.own_colour, line.own_layer
    ('', 'engrave')
    >>> EngravedLine(np.eye(2), np.zeros(2), False, "url(#sunset)").colour
    ''
    """

    colour: str = ""
    layer: str = ""

    def __post_init__(self) -> None:
        # Files keep colours, and refuse what is none.
        object.__setattr__(self, "colour", known_colour(self.colour))

    @property
    def own_colour(self) -> str:
        """``#rrggbb`` by which it is told apart; empty: of black and white, and of the red of cuts.

        Black is how all lines are drawn, and a red one would be cut.
        """
        *rgb, opacity = css_colour(self.colour or "none")
        is_red = max(255 - rgb[0], *rgb[1:]) <= _NEAR_RED
        is_plain = is_red or not opacity or set(rgb) in ({0}, {255})
        return "" if is_plain else hex_colour((*rgb, 255))

    @property
    def own_layer(self) -> str:
        """Name of its layer in files: its own, if that is none of those that say something else."""
        name = _NOT_IN_NAMES.sub("_", self.layer).strip()[:60]
        return ENGRAVE if not name or _OTHERS.fullmatch(name) else name


@dataclass(frozen=True, eq=False)
class LineArt(VectorArt):
    """A drawing of lines for a machine, whose arcs are kept beside the markup that shows them.

    ``cut``: closed lines round the item and its holes; ``engraved``: lines that go with it;
    ``path``: SVG path data of what is cut, where its file had other curves than arcs. All in the
    units of the markup.
    ``is_painted``: whether the markup is a picture in colours of its own.
    """

    cut: tuple[ArcLine, ...] = ()
    engraved: tuple[EngravedLine, ...] = ()
    path: str = ""
    is_painted: bool = False
