"""A contact sheet: small pictures of all rows on one, from their files."""

from __future__ import annotations

import io
import math
import re
from collections.abc import Iterable, Sequence
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

from packwork.errors import RecipeError
from packwork.fonts import bundled_file
from packwork.raster.drawing import drawn_png, encoded_picture

THUMB_PX = 240
"""Longer side of a small picture. Larger takes more room, smaller shows less. Chosen."""

GAP_PX = THUMB_PX // 15
"""Between pictures, and round all."""

CAPTION_PX, MOST_LETTERS, CAPTION = 18, 24, "#4a5568"
"""Height of what stands under pictures, its letters at most, its colour. Chosen by eye."""

ASPECT = 4 / 3
"""Width of a sheet over its height, about. Chosen."""

MOST_PICTURES = 2_000
"""On one sheet. More make a picture that few programs open. Chosen."""

SEEN = (".png", ".webp", ".jpg", ".jpeg", ".svg")
"""Endings of files that a sheet shows, the quickest first."""

_SIZE = re.compile(
    r'(<svg\b[^>]*?) width="(?P<width>[0-9.]+)[a-z]*" height="(?P<height>[0-9.]+)[a-z]*"'
)


def pictured_file(outputs: Iterable[Path]) -> Path | None:
    """The file of a row that a sheet shows; None if it has none such."""
    by_ending = {path.suffix.lower(): path for path in outputs}
    return next((by_ending[ending] for ending in SEEN if ending in by_ending), None)


def sheet_bytes(pictures: Sequence[Path | bytes], captions: Sequence[str] = ()) -> bytes:
    """PNG of small pictures in rows, a caption under each if there are captions.

    The pictures are files that we have written, or such files' bytes.
    """
    if not 0 < len(pictures) <= MOST_PICTURES:
        raise RecipeError(
            "contact_sheet", f"takes 1 to {MOST_PICTURES:,} pictures, not {len(pictures):,}"
        )
    small = [_small(one) for one in pictures]
    wide = max(one.width for one in small) + GAP_PX
    high = max(one.height for one in small) + GAP_PX + (CAPTION_PX + GAP_PX if captions else 0)
    across = min(len(small), math.ceil(math.sqrt(len(small) * ASPECT * high / wide)))
    down = math.ceil(len(small) / across)
    sheet = Image.new("RGB", (across * wide + GAP_PX, down * high + GAP_PX), "white")
    for k, one in enumerate(small):
        x = GAP_PX + k % across * wide + (wide - GAP_PX - one.width) // 2
        room = high - GAP_PX - (CAPTION_PX + GAP_PX if captions else 0)
        y = GAP_PX + k // across * high + (room - one.height) // 2
        sheet.paste(one, (x, y), one)
        if captions:
            middle = GAP_PX + k % across * wide + (wide - GAP_PX) // 2
            bottom = GAP_PX + k // across * high + room
            _write(sheet, captions[k], (middle, bottom))
    return encoded_picture(sheet, "PNG")


def _write(sheet: Image.Image, text: str, place: tuple[int, int]) -> None:
    """Write under a picture, in the bundled font."""
    font = ImageFont.truetype(bundled_file(), CAPTION_PX)
    short = text if len(text) <= MOST_LETTERS else text[: MOST_LETTERS - 1] + "…"
    ImageDraw.Draw(sheet).text(place, short, CAPTION, font, anchor="mt")


def _small(file: Path | bytes) -> Image.Image:
    if isinstance(file, bytes):
        source = io.BytesIO(file)
    elif file.suffix.lower() != ".svg":
        source = io.BytesIO(file.read_bytes())
    else:
        source = io.BytesIO(drawn_png(_SIZE.sub(_smaller, file.read_text("utf-8"), count=1)))
    with Image.open(source) as picture:
        small = picture.convert("RGBA")
    small.thumbnail((THUMB_PX, THUMB_PX), Image.Resampling.LANCZOS)
    return small


def _smaller(found: re.Match[str]) -> str:
    width, height = float(found["width"]), float(found["height"])
    factor = 2 * THUMB_PX / max(width, height)
    return f'{found[1]} width="{width * factor:g}" height="{height * factor:g}"'
