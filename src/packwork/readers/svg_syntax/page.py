"""The page of a drawing: what viewers show, and where its user units lie."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import dataclass

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.readers.reading import UnfitError
from packwork.readers.svg_syntax.lengths import MAX_COORDINATE, parse_length, parse_numbers
from packwork.readers.svg_syntax.shapes import Viewport
from packwork.readers.svg_syntax.transforms import view_matrix

PLAIN_VIEWPORT: Viewport = (100.0, 100.0)
"""What percentages refer to in a drawing that states no size."""


@dataclass(frozen=True, eq=False)
class Page:
    """The rectangle of a drawing that viewers show, in CSS pixels from the origin.

    Parameters
    ----------
    matrix
        2 x 3 map from the root's user units to CSS pixels.
    """

    width: float
    height: float
    matrix: FloatArray


def read_page(root: ET.Element) -> Page | None:
    """Page of a clean ``<svg>``; None if it states neither its size nor a ``viewBox``.

    Raises
    ------
    UnfitError
        If the page or its ``viewBox`` has no area.

    Examples
    --------
    >>> page = read_page(ET.Element("svg", {"viewBox": "0 0 24 12", "width": "1in"}))
    >>> page.width, page.height, page.matrix[0, 0].item()
    (96.0, 48.0, 4.0)
    """
    view = view_box(root)
    width, height = (_absolute(root.get(name)) for name in ("width", "height"))
    if view is not None:
        if width is None:
            width = view[2] if height is None else height * view[2] / view[3]
        if height is None:
            height = width * view[3] / view[2]
    if width is None or height is None:
        return None
    if min(width, height) <= 0 or max(width, height) > MAX_COORDINATE:
        raise UnfitError(f"has a page of {width:g} x {height:g} px; give it a width and a height")
    fit = root.get("preserveAspectRatio", "")
    matrix = view_matrix(view, width, height, fit) if view else affine.identity()
    return Page(width, height, matrix)


def view_box(element: ET.Element) -> tuple[float, float, float, float] | None:
    """Left, top, width and height of a ``viewBox``, if the element has one.

    Raises
    ------
    UnfitError
        If it has no area.

    Examples
    --------
    >>> view_box(ET.Element("svg", {"viewBox": "0,0,2,1"}))
    (0.0, 0.0, 2.0, 1.0)
    """
    numbers = parse_numbers(element.get("viewBox"))
    if len(numbers) != 4:
        return None
    left, top, width, height = numbers
    if min(width, height) <= 0:
        raise UnfitError(f"has a viewBox of {width:g} x {height:g}; give it a width and a height")
    return left, top, width, height


def root_viewport(root: ET.Element, page: Page | None) -> Viewport:
    """Width and height in user units that percentages in a clean drawing refer to.

    Examples
    --------
    >>> root_viewport(ET.Element("svg", {"viewBox": "0 0 2 1"}), None)
    (2.0, 1.0)
    """
    view = view_box(root)
    if view is not None:
        return view[2], view[3]
    return PLAIN_VIEWPORT if page is None else (page.width, page.height)


def _absolute(text: str | None) -> float | None:
    """A page's side; a share of an unknown window is none."""
    return None if text is not None and "%" in text else parse_length(text, 0.0)
