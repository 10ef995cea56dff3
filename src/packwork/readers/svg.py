"""SVG files to items."""

from __future__ import annotations

from pathlib import Path
from typing import Literal, TypeAlias

import shapely

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.polygon import Region, polygon_parts
from packwork.readers.files import read_bytes, stem
from packwork.readers.gate import MAX_BYTES
from packwork.readers.svg_art import vector_art
from packwork.readers.svg_drawing import clean_union, read_drawing
from packwork.readers.unfit import naming
from packwork.scene.item import Item

Holes: TypeAlias = Literal["fill", "keep"]
"""Whether the outline is the silhouette with its holes filled, or the ink itself."""


def read_svg(path: str | Path, holes: Holes = "fill") -> Item:
    """Item of an SVG file, its units CSS pixels (96 to the inch).

    Curves and round strokes are flattened to ``svg_ink.FLATTENING`` of the drawing's
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


def centred(ink: Region, holes: Holes) -> tuple[Outline, Outline, FloatArray]:
    """Outline and ink with the outline's centroid at the origin, and the map that did it.

    Examples
    --------
    >>> outline, ink, place = centred(shapely.box(2, 2, 4, 6), "fill")
    >>> outline.bounds, place[:, 2].tolist()
    ((-1.0, -2.0, 1.0, 2.0), [-3.0, -4.0])
    """
    outline = Outline.from_region(silhouette(ink) if holes == "fill" else ink)
    x, y = outline.centroid
    place = affine.similarity(-float(x), -float(y), 0.0, 1.0)
    return outline.mapped(place), Outline.from_region(ink).mapped(place), place


def silhouette(ink: Region) -> Region:
    """Region with every hole filled.

    Examples
    --------
    >>> silhouette(shapely.box(0, 0, 3, 3) - shapely.box(1, 1, 2, 2)).area
    9.0
    """
    return shapely.union_all([shapely.Polygon(p.exterior) for p in polygon_parts(ink)])
