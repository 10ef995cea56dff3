"""One photograph to an item, and to as many pixels as its print needs."""

from __future__ import annotations

import base64
import hashlib
import math
from dataclasses import dataclass
from io import BytesIO

import numpy as np
from PIL import Image

from packwork.geometry.polygon import Region, oriented_rings
from packwork.readers.files import read_bytes, stem
from packwork.readers.options import HALF
from packwork.readers.photos.developing import Negative, Window, developed, inspected
from packwork.readers.photos.frames import framed
from packwork.readers.photos.options import PhotoOptions
from packwork.readers.pictures.decode import MAX_PICTURE_BYTES
from packwork.readers.regions import centred, clean_union
from packwork.readers.unfit import naming
from packwork.scene.item import Item, PhotoArt, VectorArt

PREVIEW_PX = 320
"""Longer side of the copy that is kept. Larger costs memory, and time as JPEGs are then
decoded finer. Chosen: what a collage of a dozen shows of each on a screen."""

QUALITY = 92
"""Of JPEGs, up to 95. Larger makes files larger for nothing that is seen; smaller shows its
blocks in skies. Chosen, as cameras do."""

SPECK = 1e-4
"""Share of the area below which a part of a cut-out counts as dust. As of other pictures."""

EDGE = 1e-6
"""Pixels that rounding may add to a side without another one being made."""

_PNG_EFFORT = 4
_DIGITS = 3


@dataclass(frozen=True)
class Photograph:
    """A photo on disk, and what of it is printed.

    Parameters
    ----------
    file
        Where it lies.
    key
        Name of its own in any document.
    window
        The part that is shown, in pixels of the upright photo.
    picture, whole
        SVG paths of what is seen, without and with the border; none where that is just
        the window.
    border_color
        Of the border.
    origin
        Where the photo's top left corner lies in item units.
    """

    file: str
    key: str
    window: Window
    picture: str
    whole: str
    border_color: str
    origin: tuple[float, float]

    def printed(self, px_per_unit: float) -> VectorArt:
        """The photo with that many pixels per item unit, never more than it has.

        Raises
        ------
        ReadError
            If the file is no longer there, or broken.
        """
        return self.drawn(self.developed(read_bytes(self.file, MAX_PICTURE_BYTES), px_per_unit))

    def developed(self, data: bytes, px_per_unit: float) -> Image.Image:
        """The window of a photo's bytes, with that many pixels per item unit at most."""
        left, top, right, bottom = self.window
        share = min(px_per_unit, 1.0)
        size = (max(1, math.ceil(side * share - EDGE)) for side in (right - left, bottom - top))
        with naming(self.file):
            return developed(data, self.window, (next(size), next(size)))

    def drawn(self, picture: Image.Image) -> VectorArt:
        """Art that shows this picture of the window."""
        left, top, right, bottom = self.window
        image = (
            f'<image x="{left:.9g}" y="{top:.9g}" width="{right - left:.9g}"'
            f' height="{bottom - top:.9g}" preserveAspectRatio="none"'
            f' xlink:href="{_embedded(picture)}"/>'
        )
        clip = ""
        if self.picture:
            clip = f'<clipPath id="{self.key}"><path clip-rule="evenodd" d="{self.picture}"/>'
            clip += "</clipPath>"
            image = f'<g clip-path="url(#{self.key})">{image}</g>'
        border = f'<path fill="{self.border_color}" d="{self.whole}"/>' if self.whole else ""
        place = np.array([[1.0, 0.0, self.origin[0]], [0.0, 1.0, self.origin[1]]])
        return VectorArt(clip + border + image, place, is_traced=True)


def read_photo(file: str, options: PhotoOptions, number: int = 1, threshold: float = HALF) -> Item:
    """Item of a photo, its units the pixels of the file.

    Parameters
    ----------
    number
        Which photo of a run it is: one file may be there twice.
    threshold
        Opacity from which a cut-out's pixel is inside, as a share of the most opaque one's.

    Raises
    ------
    ReadError
        If it is missing, broken or larger than the limits.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
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
        frame = framed(data, negative, options, threshold)
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


def _embedded(picture: Image.Image) -> str:
    """Address that holds a picture: JPEG, or PNG where it may be clear."""
    file = BytesIO()
    if picture.mode == "RGBA":
        picture.save(file, "PNG", compress_level=_PNG_EFFORT)
    else:
        picture.save(file, "JPEG", quality=QUALITY)
    kind = "png" if picture.mode == "RGBA" else "jpeg"
    return f"data:image/{kind};base64,{base64.b64encode(file.getvalue()).decode('ascii')}"
