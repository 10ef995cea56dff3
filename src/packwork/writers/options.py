"""Options of drawing layouts, of all formats together: what faces offer."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from packwork.options import Group, Offer, Options, Verbs
from packwork.writers.prepress.options import MarksChoice

CutLine: TypeAlias = Literal["outlines", "silhouette"]
"""Lines for a cutter as they are, or one round each item."""

HaloChoice: TypeAlias = Literal["none", "faint", "all"]
"""Which items have a rim that makes them stand out from the background."""

TextChoice: TypeAlias = Literal["outlines", "live"]
"""Words as curves or as text."""


GONE_ON_WITH = ("flatten", "show_container", "cut", "kiss_cut")
"""Ways of drawing that an edit of a file goes on with, as its manifest tells them."""

_PRINTED = Offer(group=Group.PRINTED)


class DrawingOptions(Options):
    """Options of drawing a layout; each format heeds its own of these."""

    offers = Offer(group=Group.WRITTEN, verbs=Verbs.EVERY)

    pixels: int = 1_600
    """Longer side of a PNG or JPEG."""

    dpi: float | None = None
    """Pixels to the inch of paper: of photos (default 300), and of a PNG or JPEG in place of
    --pixels."""

    background: Annotated[str | None, Offer(also=Group.COLOURS)] = None
    """Any CSS colour, or none. Default: none in SVG and PDF, white in PNG."""

    halo: Annotated[HaloChoice, Offer(also=Group.COLOURS)] = "none"
    """A rim that makes items stand out from the background, in SVG, PNG, JPEG and PDF: faint (of
    those that are hardly to be seen on it) or all."""

    tiles: Annotated[
        Annotated[int, Field(ge=1, le=20)], Offer(verbs=Verbs.COLLAGES, after="pixels")
    ] = 1
    """Of a tile, draw so many each way side by side, 3 for a preview of 3 x 3: in SVG by a
    <pattern>."""

    show_container: bool | None = None
    """Draw the container's line. Default: of a pile in a drawing of open lines, as drawn there."""

    flatten: Annotated[bool, Offer(verbs=Verbs.EVERY & ~Verbs.PHOTOS)] = False
    """In SVG, repeat each drawing in place, for tools that choke on <use>."""

    text: Annotated[TextChoice, Offer(verbs=Verbs.WORDS)] = "outlines"
    """Words in SVG and PDF: outlines, or live text that can be selected and found (in SVG in parts
    of their fonts that the file carries, in PDF unseen over the outlines)."""

    cut: CutLine | None = None
    """Lines for a cutter in SVG and PDF (there in the spot colour CutContour) too: outlines, or
    silhouette: one closed line round each item. Default: outlines in DXF only."""

    kiss_cut: str | float | None = None
    """Cut at this distance round each item, a length such as 2mm, in DXF, SVG and PDF; the padding
    is at least twice that."""

    bleed: Annotated[str | float | None, _PRINTED] = None
    """Let a PDF's background, and art that touches the sheet's edge, reach beyond the sheet on each
    side, a length such as 3mm; its boxes say where it is trimmed."""

    marks: Annotated[MarksChoice, _PRINTED] = "none"
    """Marks beside the sheet of a PDF, in all inks: crop (where it is trimmed) or all (registration
    marks too)."""

    icc: Annotated[str | Path | None, replace(_PRINTED, metavar="FILE")] = None
    """Profile of a press (ICC, four inks), as a print shop has it: a PDF's colours become its inks,
    black becomes black ink alone, and the file a PDF/X-4."""

    spot: Annotated[str | dict[str, str] | None, _PRINTED] = None
    """Spot inks of a PDF, each with the colour that is printed in it, as
    'PANTONE 186 C=#c8102e,Gold=#b58b2a'."""
