"""Sheets and parts of a nest as they are named in words: files, counts, cut lists, instances."""

from __future__ import annotations

import logging
import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Literal, TypeAlias, get_args

import numpy as np

from packwork.errors import ReadError, RecipeError
from packwork.metrics.certificate import changed_since
from packwork.phrasing import enumerated
from packwork.readers.container import read_container
from packwork.readers.cut_list import CutListRow, is_cut_list, read_cut_list
from packwork.readers.engraving import Engraving
from packwork.readers.instances import is_instance, read_instance
from packwork.readers.items import read_items
from packwork.readers.layouts.read import SESSION, holds_layout, read_written
from packwork.readers.maps import ENDINGS, is_ours
from packwork.readers.options import ReadOptions
from packwork.readers.reading import exists, is_folder
from packwork.recipe.rules import Rotation
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.line_art import LineArt
from packwork.sources import names_like
from packwork.units import Unit, as_unit, canvas_size, convert, length_asked, split_length
from packwork.uses.nested import Sheet, SheetPart

_LOG = logging.getLogger("packwork")

ROTATE = "0,90,180,270"
"""Allowed angles where none are said."""

SQUARE = "square"
"""Name of a sheet that is the smallest square."""

Holes: TypeAlias = Literal["keep", "fill"]

MOST_SETS = 1_000
"""Times that a list with parts that go together may be wanted."""

MOST_DIGITS = 9
"""Digits of a priority."""

WITHIN_LIMIT = 4
"""Angles tried to each side where parts may turn within a limit."""

_TIMES = re.compile(r"(?P<source>.+?)\s*\*\s*(?P<count>[0-9]+)")
_LIKE_A_COUNT = re.compile(r"[0-9][^/\\.]*")
_SIZED = re.compile(r"(?P<source>.+?)\s*@\s*(?P<side>[0-9.]+\s*[a-z]*)")

_SIZED_SHEET = re.compile(r"(?P<source>.+?)\s*@\s*(?P<side>[^@]*)")

RULES = ("rotate", "mirror", "optional", "priority", "together", "size")
"""Columns of a cut list that say how its parts may lie, and how large they are."""

_AS_LENGTHS = ReadOptions(is_plane=True)

_COUNT_DIGITS = 6
"""Digits of a count at most."""

_YES, _NO = ("yes", "y", "true", "1", "x"), ("no", "n", "false", "0", "-")


def length_of(option: str, text: str, sheet: Sheet) -> float:
    """Length in the sheet's unit; RecipeError names the option."""
    if text.strip().endswith("%") and math.isinf(sheet.height):
        raise RecipeError(option, f"{text!r} is a share of a side that is not known yet")
    return length_asked(option, text, sheet.unit, sheet.height)


def _counted(text: str) -> tuple[str, int | None]:
    """Source and count of ``part.svg*12``; None where no count is given."""
    met = None if exists(text) else _TIMES.fullmatch(text)
    if met is None and "*" in text:
        _check_no_count(text)
    if met and len(met["count"]) > _COUNT_DIGITS:
        count = met["count"][:20]
        raise ReadError(met["source"], f"a count has {_COUNT_DIGITS} digits at most, not {count}")
    return (met["source"], int(met["count"])) if met else (text, None)


def _check_no_count(text: str) -> None:
    """Refuse ``part.svg*12x``, which is a pattern of names that no file has."""
    source, _, count = (part.strip() for part in text.rpartition("*"))
    is_count = _LIKE_A_COUNT.fullmatch(count) or (count and exists(source))
    if is_count and not is_folder(source) and not names_like(text):
        raise ReadError(
            source, f"a count is a whole number, as in {Path(source).name}*12, not {count[:20]!r}"
        )


SMOOTH = 0.3
"""Turn, rad, up to which edges that follow one another may be chords of a curve. Chosen."""


def _has_lines_to_lose(item: Item) -> bool:
    """Whether a part has curves, or lines on it, that its outline does not hold."""
    if isinstance(item.art, LineArt):
        return False
    for ring in item.outline.rings:
        edges = np.diff(ring, axis=0, append=ring[:1])
        turns = np.abs(np.angle(np.exp(1j * np.diff(np.arctan2(*edges.T[::-1])))))
        is_smooth = (turns > 1e-6) & (turns < SMOOTH)
        if (is_smooth[2:] & is_smooth[1:-1] & is_smooth[:-2]).any():
            return True
    return False


def read_sheets(text: str) -> list[Sheet]:
    """Sheets of ``600x400mm*2,hide.svg``; all in the unit of the first."""
    found = list[Sheet]()
    for one in [text] if exists(text) else text.split(","):
        source, count = _counted(one.strip())
        if not source:
            raise RecipeError("sheet", f"{text[:40]!r} names an empty one; write it as 600x400mm,"
                              "hide.svg")  # fmt: skip
        met = None if exists(source) else _SIZED_SHEET.fullmatch(source)
        # A file that is not there may be called icon@2x.svg.
        if met and not Path(met["side"]).suffix[1:2].isalpha():
            found.append(_of_size(met["source"], met["side"], 1 if count is None else count))
            continue
        if exists(source) and _is_nest(source):
            if count is not None and count != 1:
                raise ReadError(source, "is one sheet with parts on it; there are no more of it")
            layout = _earlier(source)
            for sentence in changed_since(layout.manifest):
                _LOG.warning("%s: %s", source, sentence)
            if Path(source).suffix.lower() not in {".dxf", SESSION} and any(
                map(_has_lines_to_lose, layout.items)
            ):
                _LOG.warning(
                    "%s: its parts go into a DXF as outlines, without arcs and engraved lines; "
                    "give that sheet's DXF or session to keep them", source,
                )  # fmt: skip
            ground = layout.container
            found.append(
                Sheet(height=ground.height, length=ground.width, unit=ground.unit,
                      name=ground.name, outline=ground.outline, count=1, held=layout)
            )  # fmt: skip
            continue
        if exists(source) or Path(source).suffix[1:2].isalpha():
            read = read_container(source, reading=_AS_LENGTHS)
            found.append(
                Sheet(height=read.height, length=read.width, unit=read.unit, name=read.name,
                      outline=read.outline, count=1 if count is None else count)
            )  # fmt: skip
            continue
        if source == SQUARE:
            if count is not None and count != 1:
                raise ReadError(source, "is one sheet, the smallest that holds all; take the count "
                                "away")  # fmt: skip
            found.append(Sheet(height=math.inf, unit="mm", name=SQUARE))
            continue
        try:
            size = canvas_size(source)
        except RecipeError as error:
            raise ReadError(source, str(error).removeprefix("canvas: ")) from None
        sides = (math.inf, size.width) if size.height is None else (size.width, size.height)
        found.append(Sheet(length=sides[0], height=sides[1], unit=size.unit, count=count))
    unit = found[0].unit
    return [one.scaled(convert(1.0, one.unit, unit), unit) for one in found]


def _of_size(source: str, side: str, count: int) -> Sheet:
    """Sheet of an outline whose longer side is told, whatever its file says of its size.

    Raises ``ReadError`` where the side is no length, and for an earlier nest, whose parts would be
    lost.
    """
    said = split_length(side.lower())
    if said is None or as_unit(said[1] or "px") is None:
        raise ReadError(f"{source}@{side}", f"its longer side is one length, as 1200mm, not "
                        f"{side[:20]!r}")  # fmt: skip
    try:
        size = canvas_size(side)
    except RecipeError as error:
        raise ReadError(f"{source}@{side}", str(error).removeprefix("canvas: ")) from None
    ending = Path(source).suffix.lower()
    if exists(source) and (is_ours(Path(source)) if ending in ENDINGS else _is_nest(source)):
        raise ReadError(f"{source}@{side}", "is an earlier nest, whose parts have their sizes; "
                        f"give it without one: {source}")  # fmt: skip
    read = read_container(source, reading=_AS_LENGTHS)
    x0, y0, x1, y1 = read.outline.bounds
    scale = size.width / max(x1 - x0, y1 - y0)
    to_sheet = np.array([[scale, 0.0, -x0 * scale], [0.0, scale, -y0 * scale]])
    return Sheet(
        height=(y1 - y0) * scale, length=(x1 - x0) * scale, unit=size.unit, name=read.name,
        outline=read.outline.mapped(to_sheet), count=count,
    )  # fmt: skip


def _earlier(source: str) -> Layout:
    """Layout of an earlier nest; of a GeoJSON that is none, it is said what would do."""
    try:
        return read_written(source)
    except ReadError as error:
        if Path(source).suffix.lower() == ".geojson":
            sized = f"{source}@1200mm"
            meant = (
                f"of an outline that is no earlier nest say how long its longer side is: {sized}"
            )
            raise ReadError(source, f"{error.problem}; {meant}") from None
        raise


def _is_nest(source: str) -> bool:
    """Whether a file holds a layout of ours, on whose sheet more parts can be laid."""
    ending = Path(source).suffix.lower()
    return ending in {".geojson", SESSION} or (ending in {".svg", ".dxf"} and holds_layout(source))


def read_request(
    sheet: str, named: Sequence[str], optional: Sequence[str], rotate: str, *, mirror: bool,
    holes: Holes, engraving: Engraving,
) -> tuple[list[Sheet], list[SheetPart]]:  # fmt: skip
    """Sheets and parts, as a command line names them; an instance holds its parts.

    Raises
    ------
    ReadError, RecipeError
        If a file cannot be read, or a rule has no meaning.
    """
    if is_instance(sheet):
        if named or optional:
            raise RecipeError("items", "an instance holds its parts; name none besides")
        asked = {"rotate": rotate != ROTATE, "mirror": mirror, "holes": holes != "keep",
                 "engrave": engraving.asked}  # fmt: skip
        for name, is_asked in asked.items():
            if is_asked:
                raise RecipeError(name, "an instance says how its parts lie; leave that out")
        instance = read_instance(sheet)
        parts = [
            SheetPart(item=one.item, count=one.count,
                  angles=None if one.angles is None else tuple(map(math.radians, one.angles)))
            for one in instance.parts
        ]  # fmt: skip
        return [Sheet(height=instance.height, name=instance.name)], parts
    if not named and not optional:
        raise RecipeError("items", "there is nothing to nest; name parts, as bracket.dxf*12")
    if named and named[0].casefold() in {"x", "*", *get_args(Unit)} and not exists(named[0]):
        raise RecipeError("sheet", f"{sheet} {named[0]} ... has spaces; write it as 600x400mm")
    for before, text in zip([sheet, *named], named, strict=False):
        if text.isdecimal() and not exists(text):
            meant = f"{before}*{text}" if before != sheet else f"bracket.dxf*{text}"
            raise ReadError(text, f"is no part; {meant} asks for so many")
    sheets = read_sheets(sheet)
    parts = [
        part
        for k, text in enumerate([*named, *optional])
        for part in read_parts(
            text, sheets[0].unit, rotate, mirror=mirror, holes=holes, engraving=engraving,
            optional=k >= len(named),
        )
    ]  # fmt: skip
    check_told(sheets, parts, engraving)
    return sheets, parts


def check_told(sheets: Sequence[Sheet], parts: Sequence[SheetPart], engraving: Engraving) -> None:
    """Tell of files and a sheet of which one alone states a unit.

    Raises ``RecipeError`` for what is to be engraved that no part has.
    """
    engraving.check_met()
    in_px = sheets[0].unit == "px"
    files = dict.fromkeys(part.item.source for part in parts)
    # That a DXF states none is told where it is read.
    known = {**dict.fromkeys((one for one in files if one.lower().endswith(".dxf")), True),
             **engraving.stated}  # fmt: skip
    odd = [file for file in files if known.get(file) is in_px]
    if odd:
        named = enumerated(odd)
        what, other = f"the sheet is in px, and {named} in real units", "give it one, as 600x400mm"
        if not in_px:
            what = f"no unit is stated in {named}, and the sheet is in {sheets[0].unit}"
            other = f"give a longer side, as {Path(odd[0]).name}@80mm"
        _LOG.warning("%s; a px is taken for 1/96 inch; %s", what, other)


def read_parts(
    text: str, unit: Unit, rotate: str, *, mirror: bool = False, holes: Holes = "keep",
    engraving: Engraving | None = None, optional: bool = False,
) -> Iterator[SheetPart]:  # fmt: skip
    """Parts of a file, a folder or a cut list, as ``bracket.dxf*12``, on sheets of a unit.

    Of ``gear.svg@80mm*12`` the longer side is 80 mm, whatever the file says.

    Parameters
    ----------
    rotate
        Allowed angles, as ``0,180``, ``free``, ``none`` or ``30``: up to that far.
    mirror
        Whether parts may be turned over.
    holes
        Whether the holes of parts stay free for others.
    engraving
        What of them is engraved.
    optional
        Whether they only fill what is left.
    """
    usual = {"rotate": rotate, "mirror": "yes" if mirror else "no",
             "optional": "yes" if optional else "no"}  # fmt: skip
    return _parts(text, usual, holes, engraving or Engraving(), unit)


def _parts(
    text: str, usual: Mapping[str, str], holes: Holes, engraving: Engraving, unit: Unit
) -> Iterator[SheetPart]:
    """Parts of a file, a folder or a cut list; rules that none of its rows has are the usual."""
    source, times = _counted(text)
    if not exists(source) and (met := _SIZED.fullmatch(source)):
        source, usual = met["source"], {**usual, "size": met["side"]}
    rows: Iterable[CutListRow] = [CutListRow(file=source)]
    if is_cut_list(source):
        rows = read_cut_list(source, RULES)
    for row in rows:
        rules = {**usual, **row.rules}
        try:
            angles, priority = angles_of(rules["rotate"]), _whole(rules.get("priority", "0"))
            mirrors, is_optional = (_is_yes(name, rules[name]) for name in ("mirror", "optional"))
            side = _side(rules["size"], unit) if rules.get("size") else None
        except RecipeError as error:
            raise ReadError(source, f"{row.where}: {error}") if row.where else error from None
        items = read_items(row.file, holes=holes, engraving=engraving).items
        if side is not None:
            engraving.stated.update(dict.fromkeys((one.source for one in items), unit != "px"))
        sets = _sets(source, rules.get("together", ""), 1 if times is None else times)
        for k, item in enumerate(items, start=1):
            name = f"{row.name} {k}" if len(items) > 1 else row.name
            named = replace(item, name=name) if row.name else item
            scale = convert(1.0, "px", unit) if side is None else side / item.outline.extent
            for together, copies in sets:
                yield SheetPart(
                    item=named, count=row.count * copies, angles=angles, scale=scale,
                    mirrors=mirrors, is_optional=is_optional, priority=priority, together=together,
                )  # fmt: skip


def _sets(source: str, name: str, times: int) -> list[tuple[str, int]]:
    """Names of what goes together, and how often each part is in it: a list wanted twice is two."""
    if not name:
        return [("", times)]
    if times > MOST_SETS:
        wanted = f"parts go together, and it is wanted {times:,} times; {MOST_SETS:,} at most"
        raise ReadError(source, f"column 'together': {wanted}")
    return [(f"{source} {name} {k}", 1) for k in range(times)]


def angles_of(rotate: str) -> tuple[float, ...] | None:
    """Allowed angles in radians; None for any."""
    turned = Rotation.parse(rotate)
    if turned.limit is None:
        return turned.choices
    steps = WITHIN_LIMIT if turned.limit > 0 else 0
    return tuple(turned.limit * k / max(steps, 1) for k in range(-steps, steps + 1))


def _side(text: str, unit: Unit) -> float:
    """Longer side of a part, in the sheet's unit."""
    side = length_asked("size", text.replace(" ", "").replace(",", "."), unit, math.nan)
    if not 0.0 < side < math.inf:
        raise RecipeError("size", f"is a length above 0, as 80mm, not {text[:20]!r}")
    return side


def _whole(text: str) -> int:
    try:
        return int(text) if len(text) <= MOST_DIGITS else int("-")
    except ValueError:
        raise RecipeError("priority", f"is a whole number, not {text[:20]!r}") from None


def _is_yes(name: str, text: str) -> bool:
    word = text.casefold()
    if word not in {*_YES, *_NO}:
        raise RecipeError(name, f"is yes or no, not {text[:20]!r}")
    return word in _YES
