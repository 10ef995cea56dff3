"""Size of pictures in whole pixels, from the canvas."""

from __future__ import annotations

from dataclasses import dataclass

from packwork.errors import RecipeError
from packwork.raster.coverage import image_shape
from packwork.scene.container import Container
from packwork.units import convert

MAX_SIDE_PX = 20_000
"""Longer side of a picture at most. Larger: no renderer at hand is tested there. Chosen."""

MAX_PIXELS = 150_000_000
"""Pixels of a picture at most: an A0 sheet at 300 dpi fits, 600 MB of memory. Chosen."""


@dataclass(frozen=True, kw_only=True)
class PictureFrame:
    """Size of a picture in whole pixels and its scale.

    The canvas's top left corner is the picture's, and its far edges lie less than a pixel inside
    the picture's.
    """

    rows: int
    columns: int
    px_per_cu: float


def side_at(container: Container, dpi: float) -> int:
    """Longer side, in pixels, of a picture of the canvas with that many to the inch."""
    side_px = max(1, round(dpi * convert(container.side, container.unit, "in")))
    if side_px > MAX_SIDE_PX:
        most = MAX_SIDE_PX / convert(container.side, container.unit, "in")
        raise RecipeError(
            "dpi",
            f"{dpi:g} make {side_px:,} px of {container.side:g} {container.unit}, and "
            f"{MAX_SIDE_PX:,} are the most; use {int(most)} or less",
        )
    return side_px


def dots_per_inch(container: Container, longer_side_px: int) -> float | None:
    """Pixels to the inch of paper; None of a canvas in px, which has no size on paper."""
    if container.unit == "px":
        return None
    return longer_side_px / convert(container.side, container.unit, "in")


def check_side(longer_side_px: int) -> None:
    """Refuse a size that no picture may have, whatever its canvas."""
    if not 1 <= longer_side_px <= MAX_SIDE_PX:
        raise RecipeError(
            "pixels", f"a picture's longer side must be 1 to {MAX_SIDE_PX} px, not {longer_side_px}"
        )


def picture_frame(container: Container, longer_side_px: int) -> PictureFrame:
    """Frame that shows the whole canvas; a RecipeError if that is out of bounds.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> tile = Outline.from_rings([[[0, 0], [9, 0], [9, 4]]])
    >>> picture_frame(Container("tile", "tile", tile, 10.0, 4.1), 100)
    PictureFrame(rows=41, columns=100, px_per_cu=10.0)
    """
    check_side(longer_side_px)
    rows, columns = image_shape(container.width, container.height, longer_side_px)
    if container.lattice is not None:
        # Its edges are those of pixels, the nearest ones.
        per_cu = longer_side_px / container.side
        rows, columns = (max(round(v * per_cu), 1) for v in (container.height, container.width))
    if rows * columns > MAX_PIXELS:
        raise RecipeError(
            "pixels",
            f"{columns} x {rows} px are too many; a picture may have "
            f"{MAX_PIXELS // 1_000_000} million",
        )
    return PictureFrame(rows=rows, columns=columns, px_per_cu=longer_side_px / container.side)
