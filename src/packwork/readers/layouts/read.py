"""Layouts from any file that holds one, by its ending."""

from __future__ import annotations

import os
import re
from pathlib import Path

from packwork.errors import ReadError, RecipeError
from packwork.readers.gate.door import MAX_BYTES, parse_xml
from packwork.readers.layouts import HANDED_IN, MAX_LAYOUT_BYTES
from packwork.readers.layouts.foreign_svg import group_named
from packwork.readers.layouts.svg import layout_of_svg
from packwork.readers.reading import UnfitError, read_bytes, reading_file, stem
from packwork.scene.layout import Layout

ENDINGS = (".geojson", ".json", ".svg", ".dxf")
"""What can be measured. A PNG has no outlines, and a PDF does not say what was promised of
which paths."""


SESSION = ".packwork"
"""Ending of session files: layouts with all that undo leads to. Their reader is handed in."""


def is_drawn(path: str | Path) -> bool:
    """Whether a file of that name holds shapes in place, and no poses.

    Examples
    --------
    >>> is_drawn("cut.dxf"), is_drawn("layout.geojson")
    (True, False)
    """
    return Path(path).suffix.lower() in {".svg", ".dxf"}


def is_session(path: str | Path) -> bool:
    """Whether a file of that name holds a session, which :mod:`packwork.live.file` reads.

    Examples
    --------
    >>> is_session("work.packwork"), is_session("layout.geojson")
    (True, False)
    """
    return Path(path).suffix.lower() == SESSION


def holds_layout(path: str | Path) -> bool:
    """Whether an SVG or DXF is one of ours, a layout, and no drawing to be packed."""
    if Path(path).suffix.lower() == ".dxf":
        from packwork.readers.layouts.dxf import APPLICATION

        # The tag before what we say of a line.
        ours = rb"^1001\s+" + APPLICATION.encode() + rb"\s*$"
        return re.search(ours, read_bytes(path, MAX_LAYOUT_BYTES), re.MULTILINE) is not None
    try:
        root = parse_xml(read_bytes(path, MAX_BYTES))
    except UnfitError:
        return False
    return all(group_named(root, name) is not None for name in ("container", "items"))


def read_written(path: str | Path) -> Layout:
    """Layout of a file that we wrote, its outlines those that stand in the file.

    A session's file is read as the session stands. GeoJSON and DXF hold the outlines themselves. In
    an SVG each drawing is read anew, as people will see it, and followed to
    ``svg.MEASURED_FLATTENING`` of the canvas.
    """
    if not isinstance(path, str | os.PathLike):
        raise RecipeError("layout", f"is {type(path).__name__}; give a layout or its file")
    if is_session(path):
        return HANDED_IN[SESSION](path)
    ending = Path(path).suffix.lower()
    if ending not in ENDINGS:
        raise ReadError(
            path, "has no outlines to measure; give a .geojson, .svg, .dxf or .packwork"
        )
    if not is_drawn(path):
        from packwork.readers.layouts.geojson import read_layout

        return read_layout(path)
    most = MAX_BYTES if ending == ".svg" else MAX_LAYOUT_BYTES
    return read_content(read_bytes(path, most), path)


def read_content(data: bytes, path: str | Path, *, outlines_only: bool = False) -> Layout:
    """Layout of what is, or is to be, the content of a file whose ending says what it is.

    With ``outlines_only`` items are plain.
    """
    ending = Path(path).suffix.lower()
    with reading_file(str(path)):
        if ending == ".svg":
            return layout_of_svg(data, stem(path), outlines_only=outlines_only)
        if ending == ".dxf":
            from packwork.readers.layouts.dxf import layout_of_dxf

            # Only names may hold other letters than ASCII, and names are for showing.
            text = data.decode("cp1252", errors="replace")
            return layout_of_dxf(text, stem(path), outlines_only=outlines_only)
        from packwork.readers.layouts.geojson import layout_of_geojson

        return layout_of_geojson(data.decode())
