"""Whatever names a container, to the container."""

from __future__ import annotations

import math
from pathlib import Path

from packwork.errors import ReadError
from packwork.readers.builtin import BUILTIN, builtin_container, container_names
from packwork.readers.files import exists, read_bytes, stem
from packwork.readers.gate.door import MAX_BYTES
from packwork.readers.pictures.decode import PICTURE_ENDINGS
from packwork.readers.pictures.mask import trace_mask
from packwork.readers.svg.container import container_of_svg, placed_container
from packwork.readers.text import PREFIX
from packwork.scene.container import Container

_FORMS = "a PNG or JPEG mask, an SVG, text:WORD or a built-in name such as circle or heart"
_LATER = "around:"


def read_container(
    source: str | Path, side: float = 600.0, font: str | Path | None = None
) -> Container:
    """Container of a mask, an SVG, ``text:WORD`` or a built-in name; a path that exists wins.

    Parameters
    ----------
    side
        Longer side of the canvas, in canvas units.
    font
        Font file for ``text:WORD``; the bundled one if None.

    Raises
    ------
    ReadError
        If there is no such file or name, or it cannot be used.

    Examples
    --------
    >>> read_container("circle", 100.0).outline.area.__round__()
    7854
    """
    text = str(source)
    if not (math.isfinite(side) and side > 0):
        raise ReadError(text, f"the canvas needs a positive side, not {side:g}")
    if text.startswith(BUILTIN):
        return builtin_container(text.removeprefix(BUILTIN), side)
    path = Path(text)
    # A folder or a note that happens to be called "heart" is not what was meant.
    if exists(path) and not (path.suffix == "" and text in container_names()):
        return _container_of_file(path, text, side)
    if text.startswith(PREFIX):
        # Only words need the font library.
        from packwork.readers.text.container import container_of_words

        return container_of_words(text, side, font)
    if text == "none" or text.startswith(_LATER):
        raise ReadError(text, f"this form of container is not known yet; give {_FORMS}")
    if path.suffix.lower() in {".svg", *PICTURE_ENDINGS} or len(path.parts) > 1:
        known = path.stem in container_names() and len(path.parts) == 1
        hint = f"; the built-in shape is {path.stem}" if known else ""
        raise ReadError(text, f"there is no such file{hint}")
    return builtin_container(text, side)


def _container_of_file(path: Path, source: str, side: float) -> Container:
    ending = path.suffix.lower()
    if path.is_dir():
        raise ReadError(source, f"is a folder; a container is {_FORMS}")
    if ending == ".svg":
        return container_of_svg(read_bytes(path, MAX_BYTES), stem(path), source, side)
    if ending in PICTURE_ENDINGS:
        mask = trace_mask(path)
        canvas = (0.0, 0.0, mask.width, mask.height)
        return placed_container(stem(path), source, mask.region, canvas, side)
    raise ReadError(source, f"has the unknown ending {ending!r}; a container is {_FORMS}")
