"""Photographs, or parts of them, decoded at the size that is needed, upright and in sRGB."""

from __future__ import annotations

import base64
import math
from dataclasses import dataclass
from io import BytesIO
from typing import TypeAlias

import numpy as np
from PIL import Image, ImageCms

from packwork.readers.pictures.decode import (
    MAX_PICTURE_BYTES,
    as_it_lies,
    eight_bit,
    is_sideways,
    opened,
    orientation,
    shrunk,
    upright,
)
from packwork.readers.reading import read_bytes, reading_file
from packwork.scene.item import VectorArt

REDUCING_GAP = 2.0
"""How much larger than asked for a picture is when the good filter takes over from the quick
one. Larger is slower, smaller a little softer. Chosen, after Pillow's own advice."""

Window: TypeAlias = tuple[float, float, float, float]
"""Left, top, right, bottom, in pixels of the upright photo."""

_CLEAR = ("RGBA", "LA", "PA", "La", "RGBa")


@dataclass(frozen=True)
class Negative:
    """Header of a photo."""

    width: int
    height: int
    has_alpha: bool


def inspected(data: bytes) -> Negative:
    """Size, as it is seen upright, and kind of a photo, without decoding it.

    >>> file = BytesIO()
    >>> exif = Image.Exif(); exif[0x0112] = 6
    >>> Image.new("RGB", (30, 20)).save(file, "JPEG", exif=exif)
    >>> inspected(file.getvalue())
    Negative(width=20, height=30, has_alpha=False)
    """
    with opened(data, shrinking=True) as image:
        width, height = image.size
        if is_sideways(orientation(image)):
            width, height = height, width
        return Negative(width, height, image.mode in _CLEAR or "transparency" in image.info)


def developed(data: bytes, window: Window, size: tuple[int, int]) -> Image.Image:
    """Part of a photo, upright, in sRGB, re-sampled once; RGBA of one that may be clear.

    Sides of the window need not be whole. No JPEG is decoded much finer than ``size`` needs.

    >>> file = BytesIO()
    >>> Image.new("RGB", (300, 200), "teal").save(file, "JPEG")
    >>> print_ = developed(file.getvalue(), (0, 0, 150, 200), (15, 20))
    >>> print_.size, print_.mode
    ((15, 20), 'RGB')
    """
    with opened(data, shrinking=True) as image:
        lies, whole = orientation(image), image.size
        left, top, right, bottom = as_it_lies(window, whole, lies)
        size = size[::-1] if is_sideways(lies) else size
        share = max(size[0] / (right - left), size[1] / (bottom - top))
        image.draft(None, _scaled(whole, share))
        profile = image.info.get("icc_profile")
        plain = _reduced(image, _scaled(whole, REDUCING_GAP * share))
        across, down = plain.width / whole[0], plain.height / whole[1]
        box = (left * across, top * down, min(right * across, plain.width),
               min(bottom * down, plain.height))  # fmt: skip
        small = plain.resize(size, Image.Resampling.LANCZOS, box)
        return _in_screen_colours(upright(small, lies), profile)


def _scaled(size: tuple[int, int], share: float) -> tuple[int, int]:
    """Size of the whole picture, scaled."""
    return max(1, int(size[0] * share)), max(1, int(size[1] * share))


def _reduced(image: Image.Image, size: tuple[int, int]) -> Image.Image:
    """Picture of that size, if it is larger, in a mode whose values may be averaged."""
    if size[0] < image.width and size[1] < image.height:
        return shrunk(image, size, _resizable)
    return _resizable(image)


def _resizable(image: Image.Image) -> Image.Image:
    """Picture in a mode whose values may be averaged."""
    if image.mode in _CLEAR or "transparency" in image.info:
        # Pillow weighs colours by alpha only in this mode: else edges darken.
        return image.convert("RGBA").convert("RGBa")
    if image.mode in ("RGB", "CMYK"):
        return image
    return eight_bit(image, "RGB")


def _in_screen_colours(image: Image.Image, profile: bytes | None) -> Image.Image:
    """Picture in sRGB; one whose profile cannot be used is taken for that already."""
    mode = "RGBA" if image.mode == "RGBa" else "RGB"
    plain = image.convert("RGBA") if mode == "RGBA" else image
    if profile:
        try:
            own = ImageCms.ImageCmsProfile(BytesIO(profile))
            target = ImageCms.createProfile("sRGB")
            return ImageCms.profileToProfile(plain, own, target, outputMode=mode) or plain
        except (ImageCms.PyCMSError, OSError, ValueError, TypeError):
            pass
    return plain.convert(mode)


QUALITY = 92
"""Of JPEGs, up to 95. Larger makes files larger for nothing that is seen; smaller shows its
blocks in skies. Chosen, as cameras do."""

EDGE = 1e-6
"""Pixels that rounding may add to a side without another one being made."""

_PNG_EFFORT = 4


@dataclass(frozen=True)
class Photograph:
    """A photo on disk, or in memory as ``data``, and what of it is printed.

    Parameters
    ----------
    key
        Name of its own in any document.
    window
        The part that is shown, in pixels of the upright photo.
    picture, whole
        SVG paths of what is seen, without and with the border; none where that is just
        the window.
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
    data: bytes | None = None

    def printed(self, px_per_unit: float) -> VectorArt:
        """The photo with that many pixels per item unit, never more than it has."""
        data = read_bytes(self.file, MAX_PICTURE_BYTES) if self.data is None else self.data
        return self.drawn(self.developed(data, px_per_unit))

    def developed(self, data: bytes, px_per_unit: float) -> Image.Image:
        """The window of a photo's bytes, with that many pixels per item unit at most."""
        left, top, right, bottom = self.window
        share = min(px_per_unit, 1.0)
        size = (max(1, math.ceil(side * share - EDGE)) for side in (right - left, bottom - top))
        with reading_file(self.file):
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
