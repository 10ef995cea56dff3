"""``around:IMAGE`` to a container: the quiet part of a picture, and the picture behind it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import shapely

from packwork.errors import ReadError, ShapeError
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import difference
from packwork.geometry.polygon import Region
from packwork.geometry.snapping import sound
from packwork.readers.files import read_bytes, stem
from packwork.readers.pictures.decode import MAX_PICTURE_BYTES
from packwork.readers.pictures.developing import Negative, inspected
from packwork.readers.pictures.photograph import Photograph
from packwork.readers.saliency.region import quiet_part
from packwork.readers.unfit import naming
from packwork.recipe_paths import AROUND
from packwork.scene.container import Backdrop, Container
from packwork.scene.item import PhotoArt
from packwork.units import CanvasSize, parse_length

QUIET_SHARE = 0.4
"""Share of the picture that is quiet, unless it is given. Chosen by eye."""

PREVIEW_PX = 1_000
"""Longer side of the copy that is kept, for screens and to see what lies under items. Chosen."""

SMALLEST_SIDE_PX = 16
"""Shorter side of a picture in which anything can be told from the rest. Chosen."""

ReadRegion = Callable[[str, CanvasSize], Container]


@dataclass(frozen=True)
class QuietOptions:
    """Which part of a picture is filled.

    Parameters
    ----------
    share
        Of the picture's area, the quietest.
    keep_clear
        What is left out of that: masks, or boxes as ``left,top,width,height``.
    """

    share: float = QUIET_SHARE
    keep_clear: tuple[str, ...] = ()


def container_around(
    source: str, side: float, options: QuietOptions, read_region: ReadRegion
) -> Container:
    """Container of ``around:IMAGE``, its canvas the whole picture, ``side`` long.

    Parameters
    ----------
    read_region
        Reads a mask, fitted to a canvas.

    Raises
    ------
    ReadError
        If the picture cannot be read, is blank, or nothing of it is left.
    """
    file = source.removeprefix(AROUND)
    data = read_bytes(file, MAX_PICTURE_BYTES)
    with naming(file):
        negative = inspected(data)
        if min(negative.width, negative.height) < SMALLEST_SIDE_PX:
            raise ReadError(
                file,
                f"has only {negative.width} x {negative.height} pixels; give a picture of "
                f"{SMALLEST_SIDE_PX} at least on each side",
            )
        quiet = quiet_part(data, negative, options.share)
    scale = side / max(negative.width, negative.height)
    size = CanvasSize(scale * negative.width, scale * negative.height, "px")
    to_canvas = affine.similarity(0.0, 0.0, 0.0, scale)
    region = shapely.transform(quiet.region, lambda points: affine.apply(to_canvas, points))
    for kept in options.keep_clear:
        region = difference(region, _kept_clear(kept, size, read_region))
    try:
        outline = Outline.from_region(sound(region))
    except ShapeError:
        raise ReadError(
            file, "has no quiet part outside of what is to be kept clear; raise the quiet share"
        ) from None
    art = _art(file, data, negative)
    return Container(
        stem(file), source, outline, size.width, float(size.height or 0.0),
        backdrop=Backdrop(art, to_canvas),
    )  # fmt: skip


def _art(file: str, data: bytes, negative: Negative) -> PhotoArt:
    full = (0.0, 0.0, float(negative.width), float(negative.height))
    photo = Photograph(file, "backdrop", full, "", "", "none", (0.0, 0.0))
    scale = PREVIEW_PX / max(negative.width, negative.height)
    return PhotoArt(photo.drawn(photo.developed(data, scale)), photo)


def _kept_clear(text: str, size: CanvasSize, read_region: ReadRegion) -> Region:
    """Region of a mask's name, or of ``left,top,width,height``."""
    sides = text.split(",")
    if len(sides) != 4:
        return read_region(text, size).outline.region
    wholes = (size.width, float(size.height or 0.0)) * 2
    try:
        left, top, width, height = (
            parse_length(one, size.unit, whole) for one, whole in zip(sides, wholes, strict=True)
        )
    except ValueError as error:
        raise ReadError(text, f"is no box: {error}; give left,top,width,height") from None
    return shapely.box(left, top, left + width, top + height)
