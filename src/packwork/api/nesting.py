"""Nests in Python: parts of true size on as few sheets as possible."""

from __future__ import annotations

import math
import os
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from numbers import Integral, Real
from pathlib import Path
from typing import Any, Literal, TypeAlias

import numpy as np

from packwork import writers
from packwork.api.layout import Layout, public
from packwork.errors import RecipeError
from packwork.geometry.outline import Outline, OutlineLike
from packwork.phrasing import number_of
from packwork.progress import Stop, never
from packwork.readers.engraving import Engraving
from packwork.readers.instances import is_instance
from packwork.readers.layouts.read import is_session
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.units import Unit
from packwork.uses import nested, nesting
from packwork.uses.nest_request import (
    angles_of,
    check_told,
    length_of,
    read_parts,
    read_request,
    read_sheets,
)
from packwork.uses.nest_work import work_of
from packwork.writers.parts_list import all_sheets_bytes, is_for_all

Part: TypeAlias = Any
"""A file, as ``bracket.dxf*12``; or an item or outline in memory, in units of the sheet."""

Parts: TypeAlias = Part | Iterable[Part | tuple[Part, int]] | Mapping[Part, int]


@dataclass(frozen=True, eq=False, repr=False)
class Nest:
    """Sheets with parts on them: what :func:`nest` returns.

    Parameters
    ----------
    layouts
        A layout for each sheet that is used.
    unplaced
        Parts that found no room, by name, and how many of each; optional ones are none.
    length, density
        Used length of the last sheet, and the share that parts cover of what is used of all.
    certified
        Whether exact geometry shows that no two parts overlap and none sticks out.
    """

    layouts: tuple[Layout, ...]
    unplaced: Mapping[str, int]
    length: float
    density: float
    certified: bool
    _nested: nested.NestedSheets

    def __len__(self) -> int:
        return len(self.layouts)

    def __iter__(self) -> Iterator[Layout]:
        return iter(self.layouts)

    def __repr__(self) -> str:
        said = "certified" if self.certified else "not certified"
        return f"<Nest: {number_of(len(self), 'sheet')}, {self.density:.1%} covered, {said}>"

    @property
    def report(self) -> dict[str, Any]:
        """Plain numbers and texts, as ``--report`` has them."""
        return self._nested.report()

    def save(self, path: str | Path, **drawing: Any) -> tuple[Path, ...]:
        """Write a file for each sheet, ``a-1.dxf`` and so on where there are several.

        There is one PDF for all, with a list of parts, and one table (``.csv``) of their places.

        Raises
        ------
        WriteError
            If one cannot be written; then none is.
        """
        options = writers.write_options(**drawing)
        if is_for_all(path):
            sheets: list[Any] = list(self.layouts)
            is_paper = Path(path).suffix.lower() == ".pdf"
            pages = [writers.encoded(one, path, options) for one in sheets if is_paper]
            writers.write_all([(Path(path), all_sheets_bytes(path, sheets, pages))])
            return (Path(path),)
        paths = [nested.sheet_file(Path(path), k, len(self)) for k in range(1, len(self) + 1)]
        if is_session(path):
            for one, layout in zip(paths, self.layouts, strict=True):
                layout.save(one, **drawing)
            return tuple(paths)
        writers.write_all(
            [(one, writers.encoded(layout, one, options))
             for one, layout in zip(paths, self.layouts, strict=True)]
        )  # fmt: skip
        return tuple(paths)


def nest(
    sheet: str | os.PathLike[str] | OutlineLike | Container,
    parts: Parts = (),
    *,
    optional: Parts = (),
    rotate: str = "0,90,180,270",
    mirror: bool = False,
    holes: Literal["keep", "fill"] = "keep",
    engrave: str | Sequence[str] = (),
    kerf: str | float = 0.0,
    tool: str | float = 0.0,
    margin: str | float | None = None,
    effort: Literal["draft", "normal", "best"] = "normal",
    time: float | None = None,
    passes: int | None = None,
    seed: int = 0,
    stop: Stop = never,
) -> Nest:
    """Lay parts of true size on as few sheets and as little of the last one as possible.

    Parameters
    ----------
    sheet
        As on the command line: ``"600x400mm"``, ``"600x400mm*2"``, ``"400mm"`` for a strip of open
        length, ``"hide.svg,600x400mm"``, an instance of strip packing (``.json``); or an outline or
        a :class:`Container`, of which there is one.
    parts, optional
        Files, as ``"bracket.dxf*12"`` or ``"icon.svg@80mm"``, or outlines and items in memory, in
        units of the sheet; each by itself or with a count, ``(outline, 12)``. Optional ones only
        fill what is left.
    rotate
        Allowed angles in degrees, as ``"0,180"``; ``"free"``, ``"none"``, or ``"30"``: up to that.
    mirror
        Whether parts may be turned over.
    holes
        ``"fill"``: no part lies in the hole of another.
    engrave
        Colours, or names of layers, of lines that are engraved and not cut.
    kerf, margin
        Smallest distance of parts, and of parts from the edge; a number is in units of the sheet.
    tool
        Diameter of a mill's tool: ``kerf`` is as much at least, and a notice names places that it
        cannot enter.
    effort, time, passes
        How long is searched; or seconds, in place of it, which give another nest on another
        machine; or passes.
    stop
        Asked before every pass; True ends with the best so far.

    Raises
    ------
    ReadError, RecipeError
        If a file cannot be used, or a part is larger than every sheet.

    Examples
    --------
    >>> tile = [(0, 0), (4, 0), (4, 3), (0, 3)]
    >>> found = nest("10x10mm", [(tile, 6)], kerf=0.1, passes=200)
    >>> len(found), len(found.layouts[0]), found.certified
    (1, 6, True)
    """
    engraving = Engraving([engrave] if isinstance(engrave, str) else engrave)
    if isinstance(sheet, str | os.PathLike) and is_instance(os.fspath(sheet)):
        named, others = ([str(part) for part, _ in _pairs(group)] for group in (parts, optional))
        sheets, laid = read_request(
            os.fspath(sheet), named, others, rotate, mirror=mirror, holes=holes,
            engraving=engraving,
        )  # fmt: skip
    else:
        sheets = _sheets(sheet)
        laid = [
            made
            for group, is_optional in ((parts, False), (optional, True))
            for part, count in _pairs(group)
            for made in _parts(part, count, sheets[0].unit, rotate=rotate, mirror=mirror,
                               holes=holes, engraving=engraving, optional=is_optional)
        ]  # fmt: skip
        check_told(sheets, laid, engraving)
    gap = _length("kerf", kerf, sheets[0])
    away = None if margin is None else _length("margin", margin, sheets[0])
    bit = _length("tool", tool, sheets[0])
    work = work_of(laid, effort=effort, passes=passes, time=time)
    found = nesting.nest(
        laid, sheets, gap=gap, margin=away, tool=bit, seed=seed, work=work, stop=stop
    )
    unplaced = Counter[str]()
    for item, count in found.unplaced:
        unplaced[item.name] += count
    return Nest(
        tuple(public(one.layout) for one in found.sheets), unplaced,
        found.length, found.density, found.certified, found,
    )  # fmt: skip


def _pairs(parts: Parts) -> Iterator[tuple[Part, int]]:
    """Parts, each with its count."""
    if isinstance(parts, Mapping):
        yield from parts.items()
    elif isinstance(parts, str | os.PathLike | Item | Outline) or not isinstance(parts, Iterable):
        yield parts, 1
    else:
        several: Iterable[Any] = [parts] if _is_pair(parts) else parts
        for one in several:
            yield one if _is_pair(one) else (one, 1)


def _is_pair(value: Any) -> bool:
    is_two = isinstance(value, tuple) and len(value) == 2
    return is_two and isinstance(value[1], Real) and not isinstance(value[0], Real)


def _sheets(sheet: Any) -> list[nested.Sheet]:
    if isinstance(sheet, str | os.PathLike):
        return read_sheets(os.fspath(sheet))
    sides = sheet.tolist() if isinstance(sheet, np.ndarray) else sheet
    if isinstance(sides, Real | bytes) or (
        isinstance(sides, Sequence) and all(isinstance(side, Real | str) for side in sides)
    ):
        raise RecipeError("sheet", f"use a size such as '600x400mm', not {sides!r:.40}")
    ground = sheet if isinstance(sheet, Container) else Container("sheet", outline=sheet)
    return [
        nested.Sheet(height=ground.height, length=ground.width, unit=ground.unit,
                      name=ground.name, outline=ground.outline, count=1)
    ]  # fmt: skip


def _parts(
    part: Part, count: int, unit: Unit, *, rotate: str, mirror: bool, holes: Any,
    engraving: Engraving, optional: bool,
) -> Iterator[nested.SheetPart]:  # fmt: skip
    if not isinstance(count, Integral) or count < 0:
        whole = "0 or more" if isinstance(count, Integral) else "a whole number such as 3"
        raise RecipeError("parts", f"a count is {count!r:.40}; use {whole}")
    if isinstance(part, str | os.PathLike):
        text = os.fspath(part) if count == 1 else f"{os.fspath(part)}*{count}"
        yield from read_parts(
            text, unit, rotate, mirror=mirror, holes=holes, engraving=engraving, optional=optional
        )
        return
    item = part if isinstance(part, Item) else Item("part", outline=part)
    if holes == "fill":
        item = Item(item.name, outline=item.outline.without_holes(), ink=item.ink, art=item.art)
    yield nested.SheetPart(
        item=item, count=count, angles=angles_of(rotate), mirrors=mirror, is_optional=optional
    )


def _length(option: str, value: str | float, sheet: nested.Sheet) -> float:
    if isinstance(value, str):
        return length_of(option, value, sheet)
    if not (math.isfinite(value) and value >= 0.0):
        raise RecipeError(option, f"is a distance of 0 or more, not {value:g}")
    return float(value)
