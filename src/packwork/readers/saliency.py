"""The quiet part of a picture, where its saliency is lowest, as a container."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import shapely

from packwork.arrays import FloatArray
from packwork.errors import ReadError, ShapeError
from packwork.fields.filters import spectral_residual
from packwork.geometry import affine
from packwork.geometry.distance import snap_rounded
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import difference
from packwork.geometry.polygon import Region
from packwork.readers.pictures.contours import contour_region
from packwork.readers.pictures.decode import MAX_PICTURE_BYTES
from packwork.readers.pictures.developing import Negative, Photograph, developed, inspected
from packwork.readers.reading import UnfitError, read_bytes, reading_file, stem
from packwork.readers.regions import large_parts
from packwork.recipe_paths import AROUND
from packwork.scene.container import Backdrop, Container
from packwork.scene.item import PhotoArt
from packwork.units import DEFAULT_SIDE, CanvasSize, parse_length

SALIENCY_PX = 64
"""Longer side of the picture whose saliency is found: as in the paper, which found that larger
ones are all detail and no objects."""

MAP_PX = int(DEFAULT_SIDE)
"""Longer side of the image in which the quiet part is traced, as of a usual canvas. Larger is no
truer."""

SMOOTH = 0.025
"""Spread of the smoothing of the map, as a share of the longer side. Larger gives plainer
regions that come nearer to what stands out; smaller leaves coves that hold nothing. Tried."""

SMALLEST_PART = 0.12
"""Share of the quiet area below which a part of it, or a busy hole in it, is dropped. Larger
loses room, smaller leaves scattered islands, and the plain inside of what stands out. Chosen
by eye."""

_SOFTNESS = 0.02
_SIMPLIFY_PX = 0.5


def quiet_part(data: bytes, negative: Negative, share: float) -> Region:
    """The share of a picture in which least is to be seen, small parts left out.

    In the picture's pixels.
    """
    saliency = saliency_map(data, negative)
    limit = float(np.quantile(saliency, share))
    # A soft step, so that the contour runs between pixels.
    inside = np.clip(0.5 + (limit - saliency) / _SOFTNESS, 0.0, 1.0)
    whole = contour_region(inside, _SIMPLIFY_PX)
    traced = shapely.MultiPolygon(large_parts(whole, SMALLEST_PART * whole.area))
    scale = np.array([negative.width / saliency.shape[1], negative.height / saliency.shape[0]])
    return shapely.transform(traced, lambda points: points * scale)


def saliency_map(data: bytes, negative: Negative) -> FloatArray:
    """Saliency of a picture's bytes, ``MAP_PX`` long, smoothed."""
    from scipy.ndimage import gaussian_filter, zoom

    full = (0.0, 0.0, float(negative.width), float(negative.height))
    small = developed(data, full, _size(negative, SALIENCY_PX)).convert("RGB")
    found = spectral_residual(np.asarray(small, dtype=np.float64) / 255)
    if not found.any():
        raise UnfitError(
            "is of one colour all over, so no part of it is quieter than the rest; give a picture "
            "that shows something, or fill a plain container"
        )
    columns, rows = _size(negative, MAP_PX)
    fine = zoom(found, (rows / found.shape[0], columns / found.shape[1]), order=1, grid_mode=True,
                mode="nearest")  # fmt: skip
    smooth = gaussian_filter(fine, SMOOTH * MAP_PX, mode="nearest")
    return np.asarray((smooth - smooth.min()) / np.ptp(smooth))


def _size(negative: Negative, longest: int) -> tuple[int, int]:
    scale = longest / max(negative.width, negative.height)
    return max(8, round(negative.width * scale)), max(8, round(negative.height * scale))


QUIET_SHARE = 0.4
"""Share of the picture that is quiet, unless it is given. Chosen by eye."""

PREVIEW_PX = 1_000
"""Longer side of the copy that is kept, for screens and to see what lies under items. Chosen."""

SMALLEST_SIDE_PX = 16
"""Shorter side of a picture in which anything can be told from the rest. Chosen."""

ReadRegion = Callable[[str, CanvasSize], Container]


@dataclass(frozen=True)
class QuietOptions:
    """Choice of the part of a picture that is filled: the quietest ``share`` of its area.

    ``keep_clear`` are left out of that: masks, or boxes as ``left,top,width,height``.
    """

    share: float = QUIET_SHARE
    keep_clear: tuple[str, ...] = ()


def container_around(
    source: str, side: float, options: QuietOptions, read_region: ReadRegion
) -> Container:
    """Container of ``around:IMAGE``, its canvas the whole picture, ``side`` long."""
    file = source.removeprefix(AROUND)
    data = read_bytes(file, MAX_PICTURE_BYTES)
    with reading_file(file):
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
    region = shapely.transform(quiet, lambda points: affine.apply(to_canvas, points))
    for kept in options.keep_clear:
        region = difference(region, _kept_clear(kept, size, read_region))
    try:
        outline = Outline.from_region(snap_rounded(region))
    except ShapeError:
        raise ReadError(
            file, "has no quiet part outside of what is to be kept clear; raise the quiet share"
        ) from None
    full = (0.0, 0.0, float(negative.width), float(negative.height))
    photo = Photograph(file, "backdrop", full, "", "", "none", (0.0, 0.0))
    preview = photo.drawn(photo.developed(data, PREVIEW_PX / max(negative.width, negative.height)))
    return Container(
        stem(file), source, outline, size.width, float(size.height or 0.0),
        backdrop=Backdrop(PhotoArt(preview, photo), to_canvas),
    )  # fmt: skip


def _kept_clear(text: str, size: CanvasSize, read_region: ReadRegion) -> Region:
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
