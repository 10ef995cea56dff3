"""SVG files to items."""

from __future__ import annotations

from pathlib import Path

from packwork.readers.files import read_bytes, stem
from packwork.readers.gate.door import MAX_BYTES
from packwork.readers.regions import Holes, centred, clean_union
from packwork.readers.svg.art import vector_art
from packwork.readers.svg.drawing import read_drawing
from packwork.readers.unfit import naming
from packwork.scene.item import Item


def read_svg(path: str | Path, holes: Holes = "fill") -> Item:
    """Item of an SVG file, its units CSS pixels (96 to the inch).

    Curves and round strokes are flattened to ``ink.FLATTENING`` of the drawing's
    extent. Text, clips, masks and pictures are rendered and traced.

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
    ...     read_svg(file).outline.bounds
    (-2.0, -1.0, 2.0, 1.0)
    """
    return item_of_svg(read_bytes(path, MAX_BYTES), stem(path), str(path), holes)


def item_of_svg(data: bytes, name: str, source: str, holes: Holes = "fill") -> Item:
    """Item of an SVG's bytes.

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
    with naming(source):
        drawing = read_drawing(data)
        ink = clean_union(drawing.ink.fills, drawing.ink.strokes)
        outline, centred_ink, place = centred(ink, holes)
        art = vector_art(drawing.root, drawing.page, is_cut=drawing.ink.is_cut, place=place)
    return Item(name, source, outline, centred_ink, art)
