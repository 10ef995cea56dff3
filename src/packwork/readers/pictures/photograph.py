"""Part of a photograph on disk as art, with as many pixels as its print needs."""

from __future__ import annotations

import base64
import math
from dataclasses import dataclass
from io import BytesIO

import numpy as np
from PIL import Image

from packwork.readers.files import read_bytes
from packwork.readers.pictures.decode import MAX_PICTURE_BYTES
from packwork.readers.pictures.developing import Window, developed
from packwork.readers.unfit import naming
from packwork.scene.item import VectorArt

QUALITY = 92
"""Of JPEGs, up to 95. Larger makes files larger for nothing that is seen; smaller shows its
blocks in skies. Chosen, as cameras do."""

EDGE = 1e-6
"""Pixels that rounding may add to a side without another one being made."""

_PNG_EFFORT = 4


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
    data
        Its content, if it was in memory; None to read the file.
    """

    file: str
    key: str
    window: Window
    picture: str
    whole: str
    border_color: str
    origin: tuple[float, float]
    data: bytes | None = None

    def printed(self, px_per_unit: float) -> VectorArt:
        """The photo with that many pixels per item unit, never more than it has.

        Raises
        ------
        ReadError
            If the file is no longer there, or broken.
        """
        data = read_bytes(self.file, MAX_PICTURE_BYTES) if self.data is None else self.data
        return self.drawn(self.developed(data, px_per_unit))

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


def _embedded(picture: Image.Image) -> str:
    """Address that holds a picture: JPEG, or PNG where it may be clear."""
    file = BytesIO()
    if picture.mode == "RGBA":
        picture.save(file, "PNG", compress_level=_PNG_EFFORT)
    else:
        picture.save(file, "JPEG", quality=QUALITY)
    kind = "png" if picture.mode == "RGBA" else "jpeg"
    return f"data:image/{kind};base64,{base64.b64encode(file.getvalue()).decode('ascii')}"
