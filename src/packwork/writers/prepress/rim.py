"""Art beyond the trimmed sheet: what touches its edge is mirrored there.

A knife that strays outwards then cuts through more of the same art and not through paper.
"""

from __future__ import annotations

import io
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from packwork.scene.layout import Layout
from packwork.writers.prepress.sheet import PrintSheet

if TYPE_CHECKING:
    import pikepdf

TOUCHING = 1e-4
"""Distance from the sheet's edge, as a share of the canvas, within which art touches it: 30 um of
an A4. Larger mirrors what ends before the edge, and leaves a gap there. Chosen."""

OVERLAP_PT = 0.05
"""Width by which the mirrored art lies over the art itself: 18 um. Without, programs that draw soft
edges show a fine line there."""


def rim_of(layout: Layout) -> Layout | None:
    """Layout of the art that touches the sheet's edge, the picture behind too; None if none does.

    Of a tile none: what is printed is cut from more of them.

    Examples
    --------
    >>> from packwork.scene.layout import blank
    >>> rim_of(blank()) is None
    True
    """
    container = layout.container
    sides, hair = np.array([container.width, container.height]), TOUCHING * container.side
    bounds = [ink.bounds for ink in layout.inks]
    kept = [k for k, box in enumerate(bounds) if min(*box[:2], *(sides - box[2:])) <= hair]
    if container.lattice is not None or not (kept or container.backdrop is not None):
        return None
    return replace(
        layout,
        items=tuple(layout.items[k] for k in kept),
        poses=layout.poses.subset(np.array(kept, dtype=np.intp)),
        weights=layout.weights[kept],
        notes=(),
        track=None,
    )


def put_rim(pdf: pikepdf.Pdf, art: bytes, sheet: PrintSheet) -> None:
    """Mirror a PDF's page, as large as the sheet, in the bleed of the first page of another."""
    import pikepdf
    from pikepdf import Name

    with pikepdf.open(io.BytesIO(art)) as drawn:
        form = pdf.copy_foreign(drawn.pages[0].as_form_xobject())
    page = pdf.pages[0]
    page.add_resource(form, Name.XObject, Name.Rim)
    page.contents_add(b"q\n", prepend=True)
    content = ["Q"]
    columns, rows = (_strips(side, sheet) for side in (sheet.width, sheet.height))
    for m, x, left, wide in columns:
        for n, y, low, high in rows:
            if m > 0 and n > 0:
                continue
            window = f"{left:.6f} {low:.6f} {wide:.6f} {high:.6f} re W n"
            content.append(f"q {window} {m} 0 0 {n} {x:.6f} {y:.6f} cm /Rim Do Q")
    page.contents_add("\n".join([*content, ""]).encode())


def _strips(side: float, sheet: PrintSheet) -> list[tuple[int, float, float, float]]:
    """Factor and shift of a coordinate, beginning and length: before the sheet, on it, beyond."""
    near, length = sheet.around, sheet.bleed + OVERLAP_PT
    return [
        (-1, near + 2 * OVERLAP_PT, near - sheet.bleed, length),
        (1, near, near, side),
        (-1, near + 2 * (side - OVERLAP_PT), near + side - OVERLAP_PT, length),
    ]
