"""Draw the small pictures of the studio's templates, ``src/packwork/studio/static/templates/``."""

from __future__ import annotations

import io
from pathlib import Path

from PIL import Image

from packwork import studio, uses
from packwork.live.face.exporting import layout_bytes
from packwork.live.face.templates import TEMPLATES, template

PLACE = Path(studio.__file__).parent / "static" / "templates"

EXAMPLES = Path(__file__).parent.parent / "examples"

OF_EXAMPLES = {
    "photos": EXAMPLES / "photos-fish" / "expected.png",
    "mosaic": EXAMPLES / "mosaic" / "expected.png",
    "chart": EXAMPLES / "chart-coffee" / "expected.png",
}
"""Templates of a person's own files are shown by examples."""

SIZE, QUALITY = (320, 240), 80


def drawn(name: str) -> Image.Image:
    """Picture of what a template begins with."""
    if name in OF_EXAMPLES:
        return Image.open(OF_EXAMPLES[name])
    opening = template(name)
    layout = uses.fill(opening.recipe).layout if opening.recipe else opening.document.layout
    options = {"pixels": 2 * SIZE[0], "show_container": name in {"nest", "jar"}}
    return Image.open(io.BytesIO(layout_bytes(layout, "png", options)))


if __name__ == "__main__":
    PLACE.mkdir(exist_ok=True)
    for one in (*TEMPLATES, "chart"):
        picture = drawn(one).convert("RGBA")
        picture.thumbnail(SIZE, Image.Resampling.LANCZOS)
        picture.save(PLACE / f"{one}.webp", quality=QUALITY, method=6)
