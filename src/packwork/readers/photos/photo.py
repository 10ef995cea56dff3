"""One photograph to an item, and to as many pixels as its print needs."""

from __future__ import annotations

import hashlib

import numpy as np

from packwork.geometry.polygon import Region, oriented_rings
from packwork.readers.files import read_bytes, stem
from packwork.readers.options import HALF
from packwork.readers.photos.frames import framed
from packwork.readers.photos.options import PhotoOptions
from packwork.readers.pictures.decode import MAX_PICTURE_BYTES
from packwork.readers.pictures.developing import Negative, inspected
from packwork.readers.pictures.photograph import Photograph
from packwork.readers.regions import centred, clean_union
from packwork.readers.unfit import naming
from packwork.scene.item import Item, PhotoArt
from packwork.shelf import MEMORY

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
    """Item of a photo, its units the pixels of the file.

    Parameters
    ----------
    number
        Which photo of a run it is: one file may be there twice.
    threshold
        Opacity from which a cut-out's pixel is inside, as a share of the most opaque one's.
    shape
        Region that the photo is cut to, of any size; None where ``options`` ask for no shape.

    Raises
    ------
    ReadError
        If it is missing, broken or larger than the limits.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from PIL import Image
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "sea.jpg")
    ...     Image.new("RGB", (300, 200), "teal").save(path)
    ...     item = read_photo(str(path), PhotoOptions(sources=path, border="5%"))
    ...     print_ = item.art.original.printed(0.1)
    >>> item.name, item.outline.bounds
    ('sea', (-160.0, -110.0, 160.0, 110.0))
    """
    data = read_bytes(file, MAX_PICTURE_BYTES)
    with naming(file):
        negative = inspected(data)
        frame = framed(data, negative, options, threshold, shape)
        whole = clean_union(frame.whole, speck=SPECK)
        outline, ink, place = centred(whole, "fill")
    has_border = options.border_share > 0
    photo = Photograph(
        file=file,
        key=f"photo-{number}-{hashlib.sha256(file.encode()).hexdigest()[:8]}",
        window=frame.window,
        picture=_path(frame.picture) if frame.is_cut and not _is_soft(negative, options) else "",
        whole=_path(whole) if has_border else "",
        border_color=options.border_color,
        origin=(float(place[0, 2]), float(place[1, 2])),
        data=data if file.startswith(MEMORY) else None,
    )
    longer = max(np.subtract(frame.window[2:], frame.window[:2]))
    preview = photo.drawn(photo.developed(data, PREVIEW_PX / float(longer)))
    return Item(stem(file), file, outline, ink, PhotoArt(preview, photo))


def _is_soft(negative: Negative, options: PhotoOptions) -> bool:
    """Whether the photo's own opacity says what is seen, so that no edge has to be cut."""
    return negative.has_alpha and options.shape is None


def _path(region: Region) -> str:
    """SVG path of a region in pixels of a photo."""
    rings = oriented_rings(region)
    return "".join(
        "M" + " ".join(f"{v:.{_DIGITS}f}" for v in ring.ravel().tolist()) + "Z" for ring in rings
    )
