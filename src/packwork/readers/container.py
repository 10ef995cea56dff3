"""Containers from files, built-in names, ``text:`` and ``around:`` sources.

Slits between parts that belong together are closed: a morphological closing of their edges.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import shapely

from packwork.errors import ReadError
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import buffered, difference, intersection, union
from packwork.geometry.polygon import Region, polygon_parts
from packwork.progress import Stop, never
from packwork.readers.builtin import builtin_container, container_names
from packwork.readers.gate.door import MAX_BYTES
from packwork.readers.maps import (
    ENDINGS,
    MAX_MAP_BYTES,
    container_of_map,
    names_on_map,
    parts_of_map,
    region_key,
)
from packwork.readers.memory.items import container_in_memory
from packwork.readers.options import AS_DRAWN, GAPS_AUTO, GAPS_NONE, TEXT_PREFIX, ReadOptions
from packwork.readers.pictures.decode import PICTURE_ENDINGS
from packwork.readers.pictures.mask import trace_mask
from packwork.readers.reading import (
    exists,
    file_text,
    is_folder,
    notice,
    read_bytes,
    reading_file,
    stem,
)
from packwork.readers.regions import canvas_box
from packwork.readers.saliency import QuietOptions, container_around
from packwork.readers.svg.container import Tell, container_of_svg, named_parts, parts_of_svg
from packwork.recipe_paths import AROUND, BUILTIN
from packwork.scene.container import Container, on_canvas, placed_container
from packwork.scene.layout import sheet
from packwork.sources import stored
from packwork.units import DEFAULT_SIDE, CanvasSize, canvas_size, check_side, parse_length

_FORMS = (
    "a PNG or JPEG mask, an SVG, a DXF, a map in GeoJSON, text:WORD, around:IMAGE or a built-in "
    "name such as circle, heart or page"
)

SHEETS = ("page", "none")
"""Names of the whole sheet; of piles and charts, ``none`` is no container at all."""


def read_container(
    source: str | Path,
    canvas: str | float | CanvasSize | None = None,
    font: str | Path | None = None,
    quiet: QuietOptions | None = None,
    reading: ReadOptions | None = None,
) -> Container:
    """Container of a mask, SVG, DXF, map, ``text:WORD``, ``around:IMAGE`` or a built-in name.

    A path that exists wins over a name.

    Parameters
    ----------
    canvas
        Its size, as ``units.canvas_size`` reads it. None: that of an SVG in real units,
        else 600 px on the longer side.
    font
        Font file or installed family for ``text:WORD``; the bundled one if None.
    quiet
        Which part of the picture ``around:IMAGE`` is; 40 % of it if None.

    Raises
    ------
    ReadError
        If there is no such file or name, or it cannot be used.
    RecipeError
        If the canvas has no meaning or no possible size.

    Examples
    --------
    >>> read_container("circle", 100.0).outline.area.__round__()
    7854
    >>> tile = read_container("square", "200x150mm")
    >>> tile.width, tile.height, tile.unit, tile.outline.bounds
    (200.0, 150.0, 'mm', (25.0, 0.0, 175.0, 150.0))
    """
    size = canvas_size(canvas) if isinstance(canvas, str | int | float) else canvas
    made = stored(str(source))
    if isinstance(made, Container):
        return on_canvas(made, size)
    if str(source) in SHEETS and not exists(source):
        whole = CanvasSize(DEFAULT_SIDE, None, "px") if size is None else size
        return sheet(str(source), whole.width, whole.height or whole.width, whole.unit)
    reading = reading or ReadOptions()
    side = None if size is None else size.side
    container = _container(str(source), side, font, quiet, reading)
    if size is not None:
        container = on_canvas(container, size)
    else:
        check_side(container.side, container.unit)
    if not exists(Path(container.source)):
        return container
    with reading_file(container.source):
        return closed_slits(container, reading.close_gaps)


def read_parts(
    container: Container, tell: Tell = notice, stop: Stop = never, asked: Collection[str] = ()
) -> list[tuple[str, Region]]:
    """Names and regions, canvas units, of the parts of a container that was read from a map or SVG.

    None of any other. ``tell``, ``stop``: as of :func:`parts_of_svg`; ``asked`` as of
    :func:`parts_of_map`.
    """
    if container.file is None:
        return []
    if _is_map(container):
        return parts_of_map(file_text(container.file, container.source), container, asked)
    return parts_of_svg(container.file, container, tell, stop)


def part_names(container: Container) -> list[set[str]]:
    """Names that parts of a container's file have, as by :func:`region_key`, by what says them."""
    if container.file is None:
        return []
    with reading_file(container.source):
        if _is_map(container):
            return names_on_map(file_text(container.file, container.source))
        parts = named_parts(container.file, lambda line: None)
        return [{region_key(name) for name, _ in parts}]


def _is_map(container: Container) -> bool:
    return Path(container.source).suffix.lower() in ENDINGS


def read_again(container: Container) -> Container:
    """The whole container of the file that one was read from, which a chart has made smaller."""
    name, source, file = container.name, container.source, container.file or b""
    with reading_file(source):
        return closed_slits(_of_named_parts(file, name, source, None, ReadOptions()), GAPS_AUTO)


def _of_named_parts(
    data: bytes, name: str, source: str, side: float | None, reading: ReadOptions
) -> Container:
    """Container of a map or an SVG, which keeps it."""
    if Path(source).suffix.lower() in ENDINGS:
        text = file_text(data, source)
        made = container_of_map(text, name, source, side or DEFAULT_SIDE, is_plane=reading.is_plane)
    else:
        made = container_of_svg(data, name, source, side, reading)
    return replace(made, file=data)


def _container(
    text: str,
    side: float | None,
    font: str | Path | None,
    quiet: QuietOptions | None,
    reading: ReadOptions,
) -> Container:
    """Container whose canvas is ``side`` long; None lets the file decide."""
    shape = container_in_memory(stored(text), text, side or DEFAULT_SIDE, reading)
    if shape is not None:
        return shape
    if text.startswith(BUILTIN):
        return builtin_container(text.removeprefix(BUILTIN), side or DEFAULT_SIDE)
    path = Path(text)
    # A folder or a note that happens to be called "heart" is not what was meant.
    if exists(path) and not (path.suffix == "" and text in container_names()):
        return _container_of_file(path, text, side, reading)
    if text.startswith(TEXT_PREFIX):
        # Only words need the font library.
        from packwork.readers.text import container_of_words

        return container_of_words(text, side or DEFAULT_SIDE, font)
    if text.startswith(AROUND):
        as_drawn = partial(read_container, reading=AS_DRAWN)
        return container_around(text, side or DEFAULT_SIDE, quiet or QuietOptions(), as_drawn)
    endings = {".svg", ".svgz", ".dxf", *ENDINGS, *PICTURE_ENDINGS}
    if path.suffix.lower() in endings or len(path.parts) > 1:
        known = path.stem in container_names() and len(path.parts) == 1
        hint = f"; the built-in shape is {path.stem}" if known else ""
        raise ReadError(text, f"there is no such file{hint}")
    return builtin_container(text, side or DEFAULT_SIDE)


def _container_of_file(
    path: Path, source: str, side: float | None, reading: ReadOptions
) -> Container:
    ending = path.suffix.lower()
    if is_folder(path):
        raise ReadError(source, f"is a folder; the container comes first, and is {_FORMS}")
    if ending in {".svg", ".svgz", *ENDINGS}:
        data = read_bytes(path, MAX_MAP_BYTES if ending in ENDINGS else MAX_BYTES)
        return _of_named_parts(data, stem(path), source, side, reading)
    if ending == ".dxf":
        # Loads what no other file needs.
        from packwork.readers.dxf.entities import MAX_DXF_BYTES
        from packwork.readers.dxf.item import container_of_dxf

        return container_of_dxf(read_bytes(path, MAX_DXF_BYTES), stem(path), source, side)
    if ending in PICTURE_ENDINGS:
        mask = trace_mask(path, reading.alpha_threshold)
        with reading_file(source):
            page = mask.width, mask.height
            canvas = canvas_box(mask.region.bounds, page, reading.trim, None)
        return placed_container(stem(path), source, mask.region, canvas, side or DEFAULT_SIDE)
    raise ReadError(
        source, f"has the unknown ending {ending!r}; the container comes first, and is {_FORMS}"
    )


SLIT = 0.002
"""Width of the slits that are closed unless another is given, as a share of the container's
extent: 1.2 px of 600. Larger closes thin channels that were drawn, smaller leaves the seams of
maps. Tried on maps of states and countries."""

LONG = 10.0
"""Length of a slit, in widths, from which it is one though it parts nothing: shorter ones are
the tips of notches. Larger leaves open seams, smaller fills notches. Chosen."""

LEAST_SHARE = 1e-4
"""Share of the container's area below which slits are left as they are: too little to be seen.
Chosen."""

MOST_POINTS = 300_000
"""Vertices of a container whose slits are looked for. More take minutes. Chosen."""

MOST_DENSE = 0.5
"""Area within the slits' width of the edges, counted edge by edge, as a share of the bounds, up
to which slits are looked for. Larger takes minutes on hairs and spirals, smaller leaves slits of
fine maps. Tried."""

MOST_FINE = 12.0
"""Vertices within a slit's width of a vertex, on average, up to which slits are looked for. Larger
takes minutes on fine stairs, smaller leaves slits of what is drawn finely. Tried."""

_WELD = 1e-3
_LEAST = 1e-3


def closed_slits(container: Container, asked: str) -> Container:
    """Container whose slits are closed, which is said: ``auto``, ``none`` or up to a width.

    Examples
    --------
    >>> import numpy as np
    >>> halves = [[[0, 0], [4, 0], [4, 9], [0, 9]], [[4.01, 0], [9, 0], [9, 9], [4.01, 9]]]
    >>> outline = Outline.from_rings([np.array(half, float) for half in halves])
    >>> tile = Container("a", "a", outline, 9.0, 9.0)
    >>> len(closed_slits(tile, "auto").outline.rings), len(closed_slits(tile, "none").outline.rings)
    (1, 2)
    """
    outline = container.outline
    if asked == GAPS_NONE:
        return container
    is_auto = asked == GAPS_AUTO
    width = (
        SLIT * outline.extent if is_auto else parse_length(asked, container.unit, container.side)
    )
    if width <= 0:
        return container
    if len(outline.points) > MOST_POINTS:
        notice(f"has {len(outline.points):,} points, so its slits were not looked for")
        return container
    before = outline.region
    left, top, right, bottom = outline.bounds
    if before.length * width > MOST_DENSE * (right - left) * (bottom - top):
        notice("is all edges, so its slits were not looked for")
        return container
    if _fineness(outline, width) > MOST_FINE:
        notice("is drawn far more finely than its slits would be wide, so they were not looked for")
        return container
    after = without_slits(before, width, is_auto=is_auto)
    if after is before:
        return container
    share = (after.area - before.area) / before.area
    notice(
        f"its slits of up to {width:.3g} {container.unit} were closed ({share:.2%} of its area); "
        "--close-gaps none keeps them"
    )
    return replace(container, outline=Outline.from_region(after))


def without_slits(region: Region, width: float, *, is_auto: bool) -> Region:
    """Region with what lies between edges that face each other within a width; outer edges stay.

    With ``is_auto`` it is left alone if nothing of that parts it or is long: notches are not
    slits.
    """
    style = {"join_style": "mitre", "mitre_limit": 2.0}
    grown = buffered(region, width / 2, **style)
    closing = buffered(grown, -width / 2, **style)
    filled = [
        part for part in polygon_parts(difference(closing, region)) if part.area > _LEAST * width**2
    ]
    if not filled:
        return region
    # A little wider than they are, or rounding would leave hairs on both sides.
    wider = buffered(shapely.MultiPolygon(filled), _WELD * width, **style)
    allowed = union([region, closing])
    closed = union([region, intersection(wider, allowed)])
    is_long = max(part.length for part in filled) > 2 * LONG * width
    is_little = closed.area - region.area < LEAST_SHARE * region.area
    if is_auto and (is_little or not (is_long or _seams(closed) < _seams(region))):
        return region
    return closed


def _fineness(outline: Outline, width: float) -> float:
    """Vertices in the same cell of a width, on average."""
    cells = np.floor(outline.points / width).astype(np.int64)
    _, counts = np.unique(cells, axis=0, return_counts=True)
    return float((counts**2).sum() / len(cells))


def _seams(region: Region) -> int:
    return sum(1 + len(part.interiors) for part in polygon_parts(region))
