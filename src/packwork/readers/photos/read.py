"""Files, folders and patterns to photographs, several decoded at a time."""

from __future__ import annotations

import glob
import logging
import warnings
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextvars import copy_context
from dataclasses import dataclass
from pathlib import Path
from typing import ParamSpec, TypeVar

from packwork.errors import ReadError
from packwork.geometry.polygon import Region
from packwork.readers.container import read_container
from packwork.readers.files import exists, is_folder, stem
from packwork.readers.folders import LOOK_LIKE_PICTURES, Listing, Sample, listed, matched
from packwork.readers.items import ItemsRead
from packwork.readers.options import AS_DRAWN, HALF
from packwork.readers.photos.options import PhotoOptions
from packwork.readers.photos.photo import read_photo
from packwork.readers.pictures.decode import PICTURE_ENDINGS
from packwork.scene.item import Item
from packwork.threads import thread_count

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

    A file named by itself must be usable; one among many of a folder or a pattern is left
    out with a notice if it is not.

    Parameters
    ----------
    strict
        Whether an unusable file among many is an error too.
    threshold
        Opacity from which a cut-out's pixel is inside, as a share of the most opaque one's.
    sample
        Which are taken where there are more than are needed; few others are read. Of those named
        by themselves all are, unless these alone are too many.

    Raises
    ------
    ReadError
        If a source does not exist or gives no photo at all.

    Examples
    --------
    >>> read_photos(PhotoOptions(sources="no such file.jpg"))
    Traceback (most recent call last):
    packwork.errors.ReadError: no such file.jpg: there is no such file
    """
    unread: list[ReadError] = []
    named = [one for source in options.sources for one in _files(source, unread)]
    if strict and unread:
        raise unread[0]
    # Pillow's own notices are of no use in a collage; and threads may
    # not set aside warnings each for itself.
    with warnings.catch_warnings(), ThreadPoolExecutor(_threads()) as threads:
        warnings.simplefilter("ignore")
        read = _here(_reading(options, threshold, shape_of(options)))
        results: dict[int, Item | ReadError] = {}
        order = list(range(len(named))) if sample is None else _taken_first(named, sample)
        most = len(named) if sample is None else sample.most
        while order and (missing := most - _well(results.values())) > 0:
            now, order = order[:missing], order[missing:]
            made = threads.map(read, (named[k] for k in now), (k + 1 for k in now))
            results |= dict(zip(now, made, strict=True))
    items: list[Item] = []
    skipped: list[ReadError] = []
    for k in sorted(results):
        one, result = named[k], results[k]
        if isinstance(result, Item):
            items.append(result)
        elif one.by_itself or strict:
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


def _well(results: Iterable[Item | ReadError]) -> int:
    """How many could be read."""
    return sum(isinstance(result, Item) for result in results)


def _taken_first(named: Sequence[_Named], sample: Sample) -> list[int]:
    """Indices of photos in the order in which they are taken."""
    alone = [k for k, one in enumerate(named) if one.by_itself]
    drawn = sample.order([stem(one.file) for one in named])
    return list(dict.fromkeys([*(alone if len(alone) <= sample.most else ()), *drawn]))


def shape_of(options: PhotoOptions) -> Region | None:
    """Region that photos are cut to; None where they keep their shape or only lose corners.

    Raises
    ------
    ReadError
        If the shape cannot be read.

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
        try:
            return read_photo(one.file, options, number, threshold, shape)
        except ReadError as error:
            return error

    return read


def _here(read: Callable[P, R]) -> Callable[P, R]:
    """The same in any thread: what is in memory is found in the context of now."""
    context = copy_context()

    def read_here(*args: P.args, **kwargs: P.kwargs) -> R:
        # A context is entered by one thread at a time.
        return context.copy().run(read, *args, **kwargs)

    return read_here


def _threads() -> int:
    return min(MOST_AT_ONCE, thread_count())


def _files(source: str, unread: list[ReadError]) -> list[_Named]:
    """Files of a source; what only looks like photos is added to ``unread``."""
    path = Path(source)
    if is_folder(path):
        return _several(source, listed(path, PICTURE_ENDINGS), unread)
    if glob.has_magic(source) and not exists(path):
        return _several(source, matched(source, PICTURE_ENDINGS), unread)
    ending = path.suffix.lower()
    if ending in LOOK_LIKE_PICTURES and ending not in PICTURE_ENDINGS:
        raise ReadError(source, f"photos that end in {ending} are not read; save it as JPEG first")
    return [_Named(source, by_itself=True)]


def _several(source: str, listing: Listing, unread: list[ReadError]) -> list[_Named]:
    if not listing.files:
        raise ReadError(source, f"holds no photo; those end in {', '.join(PICTURE_ENDINGS)}")
    # Drawings among photos are no photos: they are not expected to be read.
    photos = [one for one in listing.unread if Path(one.file).suffix.lower() not in _DRAWINGS]
    Listing(listing.files, photos).tell(source)
    unread += photos
    return [_Named(file, by_itself=False) for file in listing.files]
