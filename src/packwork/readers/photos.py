"""Files, folders and patterns to photographs: decoded, cropped to their frames, made items."""

from __future__ import annotations

import glob
import hashlib
import logging
import warnings
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextvars import copy_context
from dataclasses import dataclass
from pathlib import Path
from typing import ParamSpec, TypeVar

import numpy as np
import shapely

from packwork.errors import ReadError
from packwork.geometry import affine
from packwork.geometry.overlay import buffered
from packwork.geometry.polygon import Region, oriented_rings
from packwork.readers.container import read_container
from packwork.readers.folders import LOOK_LIKE_PICTURES, Listing, Sample, listed, matched
from packwork.readers.items import ItemsRead
from packwork.readers.options import AS_DRAWN, HALF
from packwork.readers.photo_options import PhotoOptions
from packwork.readers.pictures.decode import MAX_PICTURE_BYTES, PICTURE_ENDINGS
from packwork.readers.pictures.developing import Negative, Photograph, Window, developed, inspected
from packwork.readers.pictures.silhouette import outline_of_cut_out, solidity, tell_what_is_faint
from packwork.readers.reading import exists, is_folder, read_bytes, reading_file, stem
from packwork.readers.regions import centred, clean_union
from packwork.scene.item import Item, PhotoArt
from packwork.sources import MEMORY
from packwork.threads import thread_count

CUT_OUT_PX = 800
"""Longer side at which the outline of a cut-out is traced. Larger traces finer and gives the
outline more points. Chosen."""

CORNER_SEGMENTS = 16
"""Chords of a quarter circle, of borders and rounded corners. More: longer runs; these lie
within a thousandth of the radius. Chosen."""

MITRE = 10.0
"""How far a border reaches beyond a sharp corner, in widths. Larger than that of any
right angle, so that prints keep their corners."""


@dataclass(frozen=True, eq=False)
class PhotoCrop:
    """Part of a photo that is shown, in its upright pixels.

    ``is_cut`` says that the picture is less than its window: shaped, or clear in places.
    """

    window: Window
    picture: Region
    whole: Region
    is_cut: bool


def framed(
    data: bytes,
    negative: Negative,
    options: PhotoOptions,
    threshold: float = HALF,
    shape: Region | None = None,
) -> PhotoCrop:
    """Frame of a photo: its rectangle, its cut-out, or the largest ``shape`` in its middle.

    ``threshold`` is the opacity from which a cut-out's pixel is inside, over that of the most
    opaque.
    """
    width, height = negative.width, negative.height
    full = (0.0, 0.0, float(width), float(height))
    shorter = min(width, height)
    if options.rounding:
        window, picture = full, _rounded(full, options.rounding * shorter)
    elif shape is not None:
        window, picture = _shaped(shape, full)
    elif negative.has_alpha:
        window, picture = full, _cut_out(data, negative, threshold)
    else:
        window, picture = full, shapely.box(*full)
    is_cut = picture.area < (1 - 1e-9) * shapely.box(*window).area
    return PhotoCrop(window, picture, _bordered(picture, options.border_share * shorter), is_cut)


def _rounded(full: Window, radius: float) -> Region:
    left, top, right, bottom = full
    xs, ys = (left + radius, right - radius), (top + radius, bottom - radius)
    middles = shapely.multipoints([(x, y) for x in xs for y in ys])
    return buffered(middles.convex_hull, radius, quad_segs=CORNER_SEGMENTS)


def _shaped(shape: Region, full: Window) -> tuple[Window, Region]:
    """The largest copy of a shape in the middle of a photo, and the box about it."""
    left, top, right, bottom = shape.bounds
    scale = min(full[2] / (right - left), full[3] / (bottom - top))
    middle = full[2] / 2 - scale * (left + right) / 2, full[3] / 2 - scale * (top + bottom) / 2
    place = affine.similarity(*middle, 0.0, scale)
    placed = shapely.transform(shape, lambda points: affine.apply(place, points))
    x0, y0, x1, y1 = placed.bounds
    return (max(x0, 0.0), max(y0, 0.0), min(x1, full[2]), min(y1, full[3])), placed


def _cut_out(data: bytes, negative: Negative, threshold: float) -> Region:
    scale = min(1.0, CUT_OUT_PX / max(negative.width, negative.height))
    size = max(1, round(negative.width * scale)), max(1, round(negative.height * scale))
    full = (0.0, 0.0, float(negative.width), float(negative.height))
    pixels = np.asarray(developed(data, full, size))
    tell_what_is_faint(solidity(pixels), threshold)
    traced = outline_of_cut_out(pixels, threshold)
    ratio = np.array([negative.width / size[0], negative.height / size[1]])
    return shapely.transform(traced, lambda points: points * ratio)


def _bordered(picture: Region, width: float) -> Region:
    """Region with a border round it; corners stay corners, as those of prints do."""
    if width == 0:
        return picture
    is_box = picture.area > (1 - 1e-9) * shapely.box(*picture.bounds).area
    join = "mitre" if is_box else "round"
    return buffered(picture, width, quad_segs=CORNER_SEGMENTS, join_style=join, mitre_limit=MITRE)


PREVIEW_PX = 320
"""Longer side of the copy that is kept. Larger costs memory, and time as JPEGs are then
decoded finer. Chosen: what a collage of a dozen shows of each on a screen."""

SPECK = 1e-4
"""Share of the area below which a part of a cut-out counts as dust. As of other pictures."""

_DIGITS = 3


def read_photo(
    file: str,
    options: PhotoOptions,
    number: int = 1,
    threshold: float = HALF,
    shape: Region | None = None,
) -> Item:
    """Item of a photo, its units the file's pixels; ``number`` is its place in the run."""
    data = read_bytes(file, MAX_PICTURE_BYTES)
    with reading_file(file):
        negative = inspected(data)
        frame = framed(data, negative, options, threshold, shape)
        whole = clean_union(frame.whole, speck=SPECK)
        outline, ink, place = centred(whole, "fill")
    has_border = options.border_share > 0
    # Then the photo's own opacity says what is seen, and no edge has to be cut.
    is_soft = negative.has_alpha and options.shape is None
    photo = Photograph(
        file=file,
        key=f"photo-{number}-{hashlib.sha256(file.encode()).hexdigest()[:8]}",
        window=frame.window,
        picture=_path(frame.picture) if frame.is_cut and not is_soft else "",
        whole=_path(whole) if has_border else "",
        border_color=options.border_color,
        origin=(float(place[0, 2]), float(place[1, 2])),
        data=data if file.startswith(MEMORY) else None,
    )
    longer = max(np.subtract(frame.window[2:], frame.window[:2]))
    preview = photo.drawn(photo.developed(data, PREVIEW_PX / float(longer)))
    return Item(stem(file), file, outline, ink, PhotoArt(preview, photo))


def _path(region: Region) -> str:
    rings = oriented_rings(region)
    return "".join(
        "M" + " ".join(f"{v:.{_DIGITS}f}" for v in ring.ravel().tolist()) + "Z" for ring in rings
    )


MOST_AT_ONCE = 4
"""Photos decoded at a time. More need more memory: a broken header's worth of pixels each.
Chosen."""

_DRAWINGS = (".svg", ".svgz", ".dxf", ".pdf", ".ai", ".eps")

_LOG = logging.getLogger("packwork")

P = ParamSpec("P")
R = TypeVar("R")


@dataclass(frozen=True)
class _Named:
    """A file, and whether it was named by itself: then it must be usable."""

    file: str
    by_itself: bool


def read_photos(
    options: PhotoOptions,
    *,
    strict: bool = False,
    threshold: float = HALF,
    sample: Sample | None = None,
) -> ItemsRead:
    """Items of all photos, in the order of the sources, files of a folder by name.

    A file that is broken is left out with a notice where others are not, since a shell names all
    files of a pattern by themselves, and refused if ``strict``. Of those named by themselves a
    sample takes all, unless these alone are too many.
    """
    unread: list[ReadError] = []
    named = [one for source in options.sources for one in _files(source, unread)]
    if strict and unread:
        raise unread[0]
    count = min(MOST_AT_ONCE, thread_count())
    # Pillow's own notices are of no use in a collage; and threads may
    # not set aside warnings each for itself.
    with warnings.catch_warnings(), ThreadPoolExecutor(count) as threads:
        warnings.simplefilter("ignore")
        read = _here(_reading(options, threshold, shape_of(options)))
        results: dict[int, Item | ReadError] = {}
        order, most = list(range(len(named))), len(named)
        if sample is not None:
            most = sample.most
            alone = [k for k, one in enumerate(named) if one.by_itself]
            order = sample.order_of_files([one.file for one in named], alone, most)
        while order and (missing := most - sum(isinstance(r, Item) for r in results.values())) > 0:
            now, order = order[:missing], order[missing:]
            made = threads.map(read, (named[k] for k in now), (k + 1 for k in now))
            results |= dict(zip(now, made, strict=True))
    items: list[Item] = []
    skipped: list[ReadError] = []
    for k in sorted(results):
        one, result = named[k], results[k]
        if isinstance(result, Item):
            items.append(result)
        elif strict or not exists(one.file):
            raise result
        else:
            skipped.append(result)
    if not items:
        raise skipped[0]
    for refusal in skipped:
        _LOG.warning("left out %s", refusal)
    if sample is not None and len(results) < len(named):
        sample.tell(options.sources, len(named))
    return ItemsRead(tuple(items), (*skipped, *unread))


def shape_of(options: PhotoOptions) -> Region | None:
    """Region that photos are cut to; None where they keep their shape or only lose corners.

    Examples
    --------
    >>> round(shape_of(PhotoOptions(sources="a.jpg", shape="square")).area)
    360000
    """
    if options.shape is None or options.rounding is not None:
        return None
    return read_container(options.shape, reading=AS_DRAWN).outline.region


def _reading(
    options: PhotoOptions, threshold: float, shape: Region | None
) -> Callable[[_Named, int], Item | ReadError]:
    def read(one: _Named, number: int) -> Item | ReadError:
        ending = Path(one.file).suffix.lower()
        if ending in LOOK_LIKE_PICTURES and ending not in PICTURE_ENDINGS:
            why = f"photos that end in {ending} are not read; save it as JPEG first"
            return ReadError(one.file, why)
        try:
            return read_photo(one.file, options, number, threshold, shape)
        except ReadError as error:
            return error

    return read


def _here(read: Callable[P, R]) -> Callable[P, R]:
    """A reader for any thread: what is in memory is found in the context of now."""
    context = copy_context()

    def read_here(*args: P.args, **kwargs: P.kwargs) -> R:
        # A context is entered by one thread at a time.
        return context.copy().run(read, *args, **kwargs)

    return read_here


def _files(source: str, unread: list[ReadError]) -> list[_Named]:
    """Files of a source; what only looks like photos is added to ``unread``."""
    path = Path(source)
    if is_folder(path):
        return _several(source, listed(path, PICTURE_ENDINGS), unread)
    if glob.has_magic(source) and not exists(path):
        return _several(source, matched(source, PICTURE_ENDINGS), unread)
    return [_Named(source, by_itself=True)]


def _several(source: str, listing: Listing, unread: list[ReadError]) -> list[_Named]:
    if not listing.files:
        raise ReadError(source, f"holds no photo; those end in {', '.join(PICTURE_ENDINGS)}")
    # Drawings among photos are no photos: they are not expected to be read.
    photos = [one for one in listing.unread if Path(one.file).suffix.lower() not in _DRAWINGS]
    Listing(listing.files, photos).tell(source)
    unread += photos
    return [_Named(file, by_itself=False) for file in listing.files]
