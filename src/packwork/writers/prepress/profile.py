"""Profiles of presses (ICC): colours of screens to amounts of four inks."""

from __future__ import annotations

import io
import re
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import cast, final

from PIL import Image, ImageCms

from packwork.errors import ReadError
from packwork.sources import here_of, note_input

MAX_PROFILE_BYTES = 50_000_000
"""Bytes of a profile at most. Chosen: the largest of presses have some four million."""

_REGISTERED = re.compile(r"FOGRA\d{2}", re.IGNORECASE)
"""Name of a characterisation that the ICC lists."""

BLACK = (0, 0, 0)


@final
@dataclass(frozen=True, eq=False)
class PressProfile:
    """Profile of a press with four inks.

    ``data``: the whole file.
    ``name``: as it calls itself.
    """

    data: bytes = field(repr=False)
    name: str

    @property
    def condition(self) -> str:
        """Registered name of the printing condition; ``Custom`` if the profile names none."""
        found = _REGISTERED.search(self.name)
        return "Custom" if found is None else found.group().upper()

    def inks(self, rgb: tuple[int, int, int]) -> tuple[float, float, float, float]:
        """Cyan, magenta, yellow and black, 0 to 1, of an sRGB colour; black is black ink alone."""
        if rgb == BLACK:
            return (0.0, 0.0, 0.0, 1.0)
        pixel = self.separated(Image.new("RGB", (1, 1), rgb)).tobytes()
        cyan, magenta, yellow, black = (value / 255 for value in pixel)
        return (cyan, magenta, yellow, black)

    def separated(self, picture: Image.Image) -> Image.Image:
        """Picture in sRGB, in the press's inks."""
        return cast("Image.Image", ImageCms.applyTransform(picture, self._transform))

    @cached_property
    def _transform(self) -> ImageCms.ImageCmsTransform:
        return ImageCms.buildTransform(
            ImageCms.createProfile("sRGB"),
            ImageCms.ImageCmsProfile(io.BytesIO(self.data)),
            "RGB",
            "CMYK",
            ImageCms.Intent.RELATIVE_COLORIMETRIC,
            ImageCms.Flags.BLACKPOINTCOMPENSATION,
        )


def read_press_profile(path: str | Path) -> PressProfile:
    """Profile of a file; a ReadError unless it is one of a press with four inks."""
    here = here_of(path)
    if here.exists() and not here.is_file():
        raise ReadError(path, "is no file")
    try:
        with here.open("rb") as file:
            data = file.read(MAX_PROFILE_BYTES + 1)
    except OSError as error:
        raise ReadError(path, f"cannot be read: {error.strerror or error}") from None
    if len(data) > MAX_PROFILE_BYTES:
        raise ReadError(path, "is too large for a profile of a press")
    note_input(here, str(path))
    try:
        about = ImageCms.ImageCmsProfile(io.BytesIO(data)).profile
    except (OSError, ImageCms.PyCMSError) as error:
        raise ReadError(path, f"is no ICC profile that can be used ({error})") from None
    if about.xcolor_space.strip() != "CMYK" or about.device_class != "prtr":
        raise ReadError(path, "is no profile of a press with four inks (CMYK)")
    try:
        found = PressProfile(data, (about.profile_description or here.stem).strip())
        found.inks((1, 1, 1))
    except (OSError, ImageCms.PyCMSError) as error:
        raise ReadError(path, f"is no ICC profile that can be used ({error})") from None
    return found
