"""Values in memory to items and containers; arrays and pictures to files or shares of pixels."""

from __future__ import annotations

from dataclasses import dataclass, replace
from io import BytesIO
from typing import Any

import numpy as np
import shapely
from PIL import Image, ImageOps

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.polygon import Region, united
from packwork.readers.memory.shapes import GivenShape, GivenShapes
from packwork.readers.options import ReadOptions
from packwork.readers.pictures.decode import MAX_PIXELS, MAX_SIDE_PX, eight_bit
from packwork.readers.pictures.silhouette import SPECK, outline_of_coverage
from packwork.readers.reading import UnfitError, reading_file
from packwork.readers.regions import Box, Holes, canvas_box, centred, clean_union
from packwork.scene.colour import css_colour
from packwork.scene.container import Container, placed_container
from packwork.scene.item import FlatArt, Item, PhotoArt

_KEPT_MODES = {"1", "L", "LA", "P", "RGB", "RGBA", "I;16"}
_FORMS = "give (rows, columns), or (rows, columns, 3 or 4) of colours"


@dataclass(frozen=True, eq=False)
class CoverageArray:
    """Share 0..1 of each pixel ``[row, col]`` that is inside."""

    name: str
    shares: FloatArray

    @property
    def region(self) -> Region:
        """Shape of the inside, in pixels; UnfitError if nothing is."""
        if self.shares.max() < 0.5:
            raise UnfitError("is False, or 0, all over; True, or 1, is inside")
        return clean_union(outline_of_coverage(self.shares), speck=SPECK)


def coverage_of_array(array: Any, name: str) -> CoverageArray | bytes:
    r"""Coverage of an array of bools or floats; of one of whole numbers, a picture file.

    True, and 1.0, is inside. Whole numbers from 0 to 255 are grey or colours, as in a picture
    file, where dark is inside; if all of them are 0 or 1, they are bools.

    >>> float(coverage_of_array(np.ones((9, 9), bool), "all").shares.mean())
    1.0
    >>> coverage_of_array(np.full((9, 9, 3), 99, np.uint8), "grey")[:4]
    b'\x89PNG'
    """
    values, low, high = _checked(array)
    is_whole = values.dtype.kind in "iu"
    if is_whole and high > 1 and 0 <= low <= high <= 255:
        return png_of_picture(Image.fromarray(values.astype(np.uint8)))
    if not (0 <= low <= high <= 1):
        raise UnfitError(
            f"has numbers from {low:g} to {high:g}; give bools, shares from 0 to 1 (1 is inside), "
            "or whole numbers from 0 to 255 (dark is inside)"
        )
    if values.ndim == 3:
        return png_of_picture(Image.fromarray(np.round(values * 255.0).astype(np.uint8)))
    return CoverageArray(name, values.astype(np.float64))


def picture_of_array(array: Any) -> Image.Image:
    """Picture of an array of light or colours: shares from 0 to 1, or whole numbers to 255.

    >>> picture_of_array(np.ones((2, 3))).size
    (3, 2)
    """
    values, low, high = _checked(array)
    most = 255 if values.dtype.kind in "iu" else 1
    if not (0 <= low <= high <= most):
        raise UnfitError(
            f"has numbers from {low:g} to {high:g}; give shares from 0 to 1 (1 is light), or whole "
            "numbers from 0 to 255"
        )
    return Image.fromarray(np.round(values * (255.0 / most)).astype(np.uint8))


def png_of_picture(picture: Image.Image) -> bytes:
    r"""PNG file of a picture, turned upright as files are.

    >>> png_of_picture(Image.new("CMYK", (3, 2)))[:4]
    b'\x89PNG'
    """
    _check_size(picture.height, picture.width)
    file = BytesIO()
    try:
        upright = ImageOps.exif_transpose(picture)
        kept = upright if upright.mode in _KEPT_MODES else eight_bit(upright)
        kept.save(file, "PNG", compress_level=1)
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError) as error:
        reason = " ".join(str(error).split())[:120] or type(error).__name__
        raise UnfitError(f"is a broken picture ({reason}); load it again") from None
    return file.getvalue()


def _checked(array: Any) -> tuple[np.ndarray[Any, Any], Any, Any]:
    """Values of grey or colours, the smallest and the largest."""
    values = np.asarray(array)
    if values.ndim == 3 and values.shape[2] == 1:
        values = values[:, :, 0]
    if values.ndim not in {2, 3} or (values.ndim == 3 and values.shape[2] not in {3, 4}):
        raise UnfitError(f"is an array of shape {values.shape}; {_FORMS}")
    if values.dtype.kind not in "biuf":
        raise UnfitError(f"is an array of {values.dtype}; give bools, floats or whole numbers")
    _check_size(*values.shape[:2])
    if values.dtype.kind == "f" and not np.isfinite(values).all():
        raise UnfitError("holds numbers that are NaN or infinite; replace them by 0 or 1")
    return values, values.min(), values.max()


def _check_size(rows: int, columns: int) -> None:
    if rows * columns == 0:
        raise UnfitError(f"has {columns} x {rows} pixels; give some")
    if rows * columns > MAX_PIXELS or max(rows, columns) > MAX_SIDE_PX:
        raise UnfitError(
            f"has {columns} x {rows} pixels; {MAX_PIXELS // 1_000_000} million and "
            f"{MAX_SIDE_PX:,} on a side are the most, so scale it down"
        )


def container_in_memory(
    value: object, source: str, side: float, reading: ReadOptions
) -> Container | None:
    """Container of a value in memory, its longer side ``side``; None of a file's bytes.

    The canvas of an array is the array; that of geometries is their box.
    """
    with reading_file(source):
        if isinstance(value, Item):
            return _boxed(value.name, source, value.ink.region, side)
        if isinstance(value, GivenShapes):
            return _boxed(value.name, source, united(s.region for s in value.shapes), side)
        if isinstance(value, CoverageArray):
            (rows, columns), region = value.shares.shape, value.region
            page = float(columns), float(rows)
            canvas = canvas_box(region.bounds, page, reading.trim, None)
            return placed_container(value.name, source, region, canvas, side)
    return None


def _boxed(name: str, source: str, region: Region, side: float) -> Container:
    left, top, right, bottom = region.bounds
    # About its own corner first: far from the origin few digits are left for the shape.
    near = clean_union(shapely.transform(region, lambda points: points - (left, top)))
    canvas: Box = (0.0, 0.0, right - left, bottom - top)
    return placed_container(name, source, near, canvas, side)


OFF_CENTRE = 0.01
"""Distance of an outline's centroid from its origin, as a share of its extent, from which the
item is moved there. Below lie items whose lines have become thinner. Chosen."""


def items_in_memory(value: object, source: str, holes: Holes) -> list[Item] | None:
    """Items of a value in memory; None of one that readers of files understand."""
    with reading_file(source):
        if isinstance(value, Item):
            return [recentred(value)]
        if isinstance(value, GivenShapes):
            return [_item_of_shape(shape, source, holes) for shape in value.shapes]
        if isinstance(value, CoverageArray):
            return [_item_of_shape(GivenShape(value.name, value.region), source, holes)]
        if isinstance(value, Container):
            return [_item_of_shape(GivenShape(value.name, value.outline.region), source, holes)]
    return None


def recentred(item: Item) -> Item:
    """The item with its outline's centroid at the origin; itself, if it is there.

    >>> import shapely
    >>> from packwork.geometry.outline import Outline
    >>> far = Outline.from_region(shapely.box(10, 10, 12, 12))
    >>> recentred(Item("tile", "", far, far, FlatArt())).outline.bounds
    (-1.0, -1.0, 1.0, 1.0)
    """
    x, y = item.outline.centroid
    if np.hypot(x, y) <= OFF_CENTRE * item.outline.extent:
        return item
    place = affine.similarity(-float(x), -float(y), 0.0, 1.0)
    art = item.art
    if isinstance(art, PhotoArt):
        raise UnfitError("has an outline off its photograph's middle; recentre both")
    if not isinstance(art, FlatArt):
        art = replace(art, matrix=affine.compose(place, art.matrix))
    return replace(item, outline=item.outline.mapped(place), ink=item.ink.mapped(place), art=art)


def _item_of_shape(shape: GivenShape, source: str, holes: Holes) -> Item:
    outline, ink, _ = centred(clean_union(shape.region), holes)
    art = FlatArt(shape.fill) if _is_colour(shape.fill) else FlatArt()
    return Item(shape.name, source, outline, ink, art, weight=shape.weight, row=shape.row)


def _is_colour(text: str) -> bool:
    try:
        return css_colour(text)[3] > 0
    except ValueError:
        return False
