"""Files held against what their run promised, from their own text, before they are written."""

from __future__ import annotations

from collections.abc import Set
from pathlib import Path

from packwork import writers
from packwork.errors import PackworkError
from packwork.metrics.certificate import HAIR, Promise, unclean
from packwork.metrics.measure import exact_of
from packwork.phrasing import number_of
from packwork.readers.gate.door import MAX_BYTES
from packwork.readers.layouts.read import ENDINGS, read_content
from packwork.readers.reading import UnfitError
from packwork.readers.svg_syntax.coordinates import Page
from packwork.readers.svg_syntax.painted import Painted
from packwork.scene.layout import Layout
from packwork.units import convert
from packwork.writers.prepress.rim import OVERLAP_PT

AGREEMENT = HAIR / 2
"""How far paths of a PDF may lie from those of the SVG that it was made of, as a share of the
canvas. Derived: half of the least gap that is certified, so that two items cannot meet."""

UNREADABLE = "what is written cannot be read back"

_BEYOND_PATHS = ("filter", "marker", "mask", "pattern")
"""Elements that in a PDF become what is not held against them: pictures, paths, soft masks."""


def faults_in_file(
    data: bytes,
    path: str | Path,
    layout: Layout,
    options: writers.WriteOptions | None = None,
) -> tuple[str, ...]:
    """Parts of a layout's promise that the text of a file breaks, a sentence each.

    Transforms and outlines are those that stand in the text, curves followed anew. Of a PDF
    those of the SVG that it was made of, with which the paths in its own text have to agree.
    Files that have no outlines break nothing, nor do previews of tiles side by side.

    ``path``: where to; its ending says what it is.

    >>> from packwork.scene.layout import blank
    >>> faults_in_file(b"", "layout.png", blank())
    ()
    """
    ending = Path(path).suffix.lower()
    is_preview = options is not None and options.svg.tiles > 1
    if Promise.of(layout.manifest) is None or ending not in {*ENDINGS, ".pdf"} or is_preview:
        return ()
    if ending != ".pdf":
        return _broken_in(data, path, layout)
    text, bleed = writers.pdf_drawing(layout, options)
    drawing = text.encode()
    return (
        *_broken_in(drawing, Path(path).with_suffix(".svg"), layout),
        *_off_drawing(data, drawing, convert(bleed, "pt", "px"), _beyond_paths(layout)),
    )


def _broken_in(data: bytes, path: str | Path, layout: Layout) -> tuple[str, ...]:
    # Of larger ones mostly pixels.
    if len(data) > MAX_BYTES:
        return ()
    try:
        found = read_content(data, path, outlines_only=True)
    except PackworkError as error:
        return (f"{UNREADABLE}: {error}",)
    if len(found.items) != len(layout.items):
        return (f"{len(found.items)} of {len(layout.items)} items are written",)
    # In the file's own units.
    promise = Promise.of(found.manifest)
    if promise is None:
        return ("what was promised is not written",)
    return unclean(promise, found, exact_of(found, once=True))


def _off_drawing(data: bytes, drawing: bytes, bleed_px: float, beyond: Set[str]) -> tuple[str, ...]:
    """Warning of paint in a PDF that the SVG that it was made of lacks, a sentence or none."""
    from packwork.readers.layouts.agreement import differences, shapes_of_svg
    from packwork.readers.layouts.pdf import printed_page

    try:
        page, drawn = shapes_of_svg(drawing)
        printed = printed_page(data)
    except UnfitError as error:
        return (f"{UNREADABLE}: it {error}",)
    tolerance = AGREEMENT * max(page.width, page.height)
    if max(abs(page.width - printed.width), abs(page.height - printed.height)) > tolerance:
        return (
            f"its page is {printed.width:.9g} x {printed.height:.9g} px instead of "
            f"{page.width:.9g} x {page.height:.9g}",
        )
    shapes = printed.shapes
    if bleed_px and shapes and _is_beyond(shapes[0], page, bleed_px):
        # The background of the whole sheet lies behind all.
        shapes = shapes[1:]
    drawn, shapes = ([one for one in all_ if not _is_off(one, page)] for all_ in (drawn, shapes))
    found = differences(drawn, shapes, tolerance)
    # What is painted besides was named as taken on trust.
    is_known = bool({"filter", "marker"} & beyond) or not found.strange
    if is_known and not found.missing:
        return ()
    missing = number_of(len(found.missing), "shape that was", "shapes that were")
    strange = number_of(len(found.strange), "path that was", "paths that were")
    return (f"it lacks {missing} measured, and has {strange} not",)


def _is_beyond(shape: Painted, page: Page, bleed_px: float) -> bool:
    """Whether a shape covers the sheet and more on each side."""
    left, top, right, bottom = shape.bounds
    least = bleed_px / 2
    return max(left, top) < -least and right > page.width + least and bottom > page.height + least


def _is_off(shape: Painted, page: Page) -> bool:
    """Whether a shape is seen beyond the sheet alone: marks, and art mirrored in the bleed."""
    slack = convert(2 * OVERLAP_PT, "pt", "px")
    boxes = (shape.bounds, *(one.bounds for clip in shape.clips for one in clip.shapes[:1]))
    return any(
        max(left - page.width, top - page.height, -right, -low) >= -slack
        for left, top, right, low in boxes
    )


def _beyond_paths(layout: Layout) -> set[str]:
    arts = dict.fromkeys(item.art for item in layout.items)
    markups = [getattr(art, "markup", "") for art in arts]
    return {tag for tag in _BEYOND_PATHS for markup in markups if f"<{tag}" in markup}


def on_trust_in_file(path: str | Path, layout: Layout, size: int = 0) -> tuple[str, ...]:
    """Warning of a file, or parts of one, not held against what was measured, a sentence or none.

    ``size``: the file's, in bytes.

    >>> from packwork.scene.layout import blank
    >>> on_trust_in_file("layout.pdf", blank())
    ()
    >>> on_trust_in_file("layout.svg", blank(), 30_000_000)
    ('its 30 MB are more than the 20 MB that are read back: what it draws is taken on trust',)
    """
    if Path(path).suffix.lower() in ENDINGS and size > MAX_BYTES:
        return (
            f"its {size / 1e6:.3g} MB are more than the {MAX_BYTES / 1e6:g} MB that are read back: "
            "what it draws is taken on trust",
        )
    beyond = _beyond_paths(layout) if Path(path).suffix.lower() == ".pdf" else set()
    if not beyond:
        return ()
    return (f"what {' and '.join(f'{tag}s' for tag in sorted(beyond))} paint is taken on trust",)
