"""Layouts without items: what lies under the items of a picture, and what examples draw."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from packwork.geometry.outline import Outline
from packwork.scene.container import Container
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.units import Unit


def sheet(name: str, width: float, height: float, unit: Unit = "px") -> Container:
    """Container that is all of a canvas.

    Examples
    --------
    >>> sheet("page", 200.0, 150.0, "mm").outline.bounds
    (0.0, 0.0, 200.0, 150.0)
    """
    return Container(name, name, Outline.box(0.0, 0.0, width, height), width, height, unit)


def blank(width: float = 4.0, height: float = 4.0, unit: Unit = "px") -> Layout:
    """Layout of no items on a sheet.

    Examples
    --------
    >>> blank().container.width, len(blank().items)
    (4.0, 0)
    """
    none = np.zeros(0)
    return Layout(sheet("sheet", width, height, unit), (), Poses(none, none, none, none), none)


def without_items(layout: Layout) -> Layout:
    """The same layout, its items left out.

    Examples
    --------
    >>> without_items(blank()).container.name
    'sheet'
    """
    return replace(layout, items=(), poses=blank().poses, weights=np.zeros(0))
