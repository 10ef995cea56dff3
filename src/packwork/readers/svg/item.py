"""SVG files to items."""

from __future__ import annotations

import copy
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.readers.account import one_budget
from packwork.readers.budget.filters import drop_filters
from packwork.readers.files import read_bytes, stem
from packwork.readers.gate.door import MAX_BYTES
from packwork.readers.options import ReadOptions
from packwork.readers.pages import PageFate, Read, agreed
from packwork.readers.regions import Holes, centred, clean_union
from packwork.readers.svg.art import vector_art
from packwork.readers.svg.drawing import LARGESSE, Drawing, read_drawing
from packwork.readers.svg.glow import without_glow
from packwork.readers.svg.kept import read_once
from packwork.readers.svg.overpaint import FILTERED, whole_reach, within_outline
from packwork.readers.svg.region.ink import TracedInk
from packwork.readers.svg.region.sheet import WHOLE_PAGE
from packwork.readers.svg.rounds import with_short_arcs
from packwork.readers.unfit import naming, notice
from packwork.scene.item import Item, VectorArt


def read_svg(path: str | Path, holes: Holes = "fill", reading: ReadOptions | None = None) -> Read:
    """Item of an SVG file, its units CSS pixels (96 to the inch).

    Curves and round strokes are flattened to ``bezier.FLATTENING`` of the drawing's
    extent. Text, clips, masks and pictures are rendered and traced. A white page behind
    all else is left out, unless something on it touches its edges or it is to stay.

    Raises
    ------
    ReadError
        If the file cannot be read, is no SVG, passes a limit or paints nothing.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder, "tile.svg")
    ...     _ = file.write_text('<svg viewBox="0 0 9 9"><rect width="4" height="2"/></svg>')
    ...     read_svg(file).item.outline.bounds
    (-2.0, -1.0, 2.0, 1.0)
    """
    data, options = read_bytes(path, MAX_BYTES), reading or ReadOptions()
    read = _read(data, stem(path), str(path), holes, options, is_compared=True)
    if options.keep_page is not None:
        return replace(read, page=PageFate.NONE)

    def again() -> Item:
        kept = replace(options, keep_page=True)
        return _read(data, stem(path), str(path), holes, kept, is_compared=True).item

    return replace(read, again=again)


def item_of_svg(
    data: bytes,
    name: str,
    source: str,
    holes: Holes = "fill",
    reading: ReadOptions | None = None,
    *,
    is_compared: bool = False,
) -> Item:
    """Item of an SVG's bytes.

    Parameters
    ----------
    data
        The file's content.
    name, source
        What the item is called and where it came from.
    holes
        Whether the outline is the silhouette or keeps its holes.
    reading
        How it is read.
    is_compared
        Whether the ink is held against a rendering, as strangers' files should be.

    Raises
    ------
    ReadError
        About ``source``, as for ``read_svg``.

    Examples
    --------
    >>> data = b'<svg><circle r="5" fill="none" stroke="red" stroke-width="2"/></svg>'
    >>> item = item_of_svg(data, "ring", "ring.svg")
    >>> len(item.outline.rings), len(item.ink.rings)
    (1, 2)
    """
    options = reading or ReadOptions()
    return agreed([_read(data, name, source, holes, options, is_compared=is_compared)])[0]


def _read(
    data: bytes, name: str, source: str, holes: Holes, options: ReadOptions, *, is_compared: bool
) -> Read:
    def read() -> Read:
        return _read_anew(data, name, source, holes, options, is_compared=is_compared)

    return read_once(data, (holes, options, is_compared), name, source, read)


def _read_anew(
    data: bytes, name: str, source: str, holes: Holes, options: ReadOptions, *, is_compared: bool
) -> Read:
    with naming(source), one_budget(1.0 if is_compared else LARGESSE):
        drawing = read_drawing(
            data, is_compared=is_compared, is_on_paper=True, keep_page=options.keep_page,
            alpha_threshold=options.alpha_threshold,
        )  # fmt: skip
        outline, ink, place = centred(clean_union(drawing.ink.body), holes)
        if drawing.ink.body is not drawing.ink.whole:
            ink = Outline.from_region(clean_union(drawing.ink.whole)).mapped(place)
        art = _art(drawing, outline, place, is_checked=is_compared)
    item = Item(name, source, outline, ink, art)
    fate = drawing.sheet
    if fate is PageFate.NONE and drawing.page is not None:
        whole = drawing.page.width * drawing.page.height
        fate = PageFate.FILLED if outline.area >= WHOLE_PAGE * whole else fate
    return Read(item, source, fate)


def _art(drawing: Drawing, outline: Outline, place: FloatArray, *, is_checked: bool) -> VectorArt:
    """What is written into files for an item: nothing beyond its outline."""
    root = with_short_arcs(without_glow(drawing))
    is_traced = isinstance(drawing.ink, TracedInk)

    def art(shown: ET.Element, is_cut: bool) -> VectorArt:
        made = vector_art(shown, drawing.page, is_cut=is_cut, place=place)
        return replace(made, is_traced=is_traced)

    is_cut = drawing.ink.is_cut
    first = art(root, is_cut)
    if not is_checked:
        return first
    # As it is, else as viewers show it by itself, else without its filters.
    ways = [is_cut] if is_cut or drawing.page is None else [False, True]

    def arts() -> Iterator[VectorArt]:
        yield first
        yield from (art(root, way) for way in ways[1:])
        if FILTERED in first.markup:
            plain = copy.deepcopy(root)
            drop_filters(plain)
            yield from (art(plain, way) for way in ways)

    found = within_outline(arts(), outline, whole_reach(drawing.shapes, place), drawing.work)
    if FILTERED in first.markup and FILTERED not in found.markup:
        notice("its filters were left out, for they paint beyond its outline")
    return found
