"""Layouts as PDF: the SVG that would be written, on one page of the canvas's true size.

Typst sets the page. It reads SVG with the library that also renders our PNGs, so that
fills, strokes, gradients, clips and masks stay vectors and look as they do there; numbers
keep seven digits. Only drawings with text become pictures: their letters would come from
the fonts of another machine than the one on which they were measured.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from packwork.arrays import FloatArray
from packwork.errors import WriteError
from packwork.scene.colour import parse_colour
from packwork.scene.item import Item, VectorArt
from packwork.scene.layout import Layout
from packwork.scene.notation import number, sound_text
from packwork.units import convert
from packwork.writers.cutting import HAIRLINE_PT, SPOT, cut_rings
from packwork.writers.pictures import DPI, as_picture
from packwork.writers.prepress.options import X4_VERSION, PrintOptions
from packwork.writers.prepress.rim import put_rim, rim_of
from packwork.writers.prepress.sheet import PrintSheet, print_sheet
from packwork.writers.svg import NAME_LENGTH, SvgOptions, svg_text
from packwork.writers.svg_symbols import largest_scales

if TYPE_CHECKING:
    import pikepdf

PICTURE_DPI = 2 * DPI
"""Pixels to the inch of a drawing that becomes a picture: letters want more than photos."""

_PAGE = """\
#set document(title: sys.inputs.title, date: none)
#set page(width: {width:.12f}pt, height: {height:.12f}pt, margin: 0pt)
#image(bytes(sys.inputs.drawing), format: "svg", width: 100%, height: 100%, fit: "stretch")
"""

_LARGER_PAGE = """\
#set document(title: sys.inputs.title, date: none)
#set page(width: {wide:.12f}pt, height: {high:.12f}pt, margin: 0pt)
#place(dx: {near:.12f}pt, dy: {near:.12f}pt, rect(width: {bled_width:.12f}pt,
  height: {bled_height:.12f}pt, fill: {fill}, stroke: none))
#place(dx: {around:.12f}pt, dy: {around:.12f}pt, image(bytes(sys.inputs.drawing), format: "svg",
  width: {width:.12f}pt, height: {height:.12f}pt, fit: "stretch"))
"""


def pdf_bytes(
    layout: Layout, options: SvgOptions | None = None, printing: PrintOptions | None = None
) -> bytes:
    """PDF file of a layout: one page, as large as the canvas; the same bytes every time.

    Lines for a cutter are strokes in the spot colour ``CutContour``. With a bleed the background,
    and art that touches the sheet's edge, reach that far beyond the canvas on each side; the page
    is larger by it and by the room of marks, and its boxes say where it is trimmed. A drawing
    that cannot be rendered is a WriteError.

    Examples
    --------
    >>> from packwork.scene.layout import blank
    >>> pdf_bytes(blank(unit="cm"))[:5]
    b'%PDF-'
    """
    import pikepdf

    options, printing = options or SvgOptions(), printing or PrintOptions()
    container, times = layout.container, options.tiles
    whole = replace(container, width=times * container.width, height=times * container.height)
    sheet = print_sheet(whole, printing.bleed, printing.marks)
    cut = options.cut
    is_cut = cut is not None and cut.is_asked
    rings = cut_rings(layout, cut) if cut is not None and is_cut else []
    rim = rim_of(layout) if sheet.bleed else None
    drawn = _set_page(layout, replace(options, cut=None), sheet)
    with pikepdf.open(io.BytesIO(drawn)) as pdf:
        # False unless it is said; programs made with Poppler call it an error where it is.
        if "/Suspects" in (marked := pdf.Root.get("/MarkInfo", pikepdf.Dictionary())):
            del marked["/Suspects"]
        if rings or not sheet.is_plain or printing.press is not None:
            sheet.put_boxes(pdf.pages[0])
        if rim is not None:
            bare = PrintSheet(width=sheet.width, height=sheet.height)
            put_rim(pdf, _set_page(rim, SvgOptions(), bare), sheet)
        if options.text == "live":
            _put_text(pdf, layout, sheet)
        if rings:
            scale = convert(1.0, layout.container.unit, "pt")
            _put_lines(pdf, [scale * ring for ring in rings], sheet)
        sheet.put_marks(pdf)
        if printing.press is not None or printing.spots:
            _put_inks(pdf, printing, sound_text(layout.container.name[:NAME_LENGTH]))
        written = io.BytesIO()
        version = "" if printing.press is None else X4_VERSION
        pdf.save(written, deterministic_id=True, force_version=version)
        return written.getvalue()


def _put_text(pdf: pikepdf.Pdf, layout: Layout, sheet: PrintSheet) -> None:
    # Load what only text needs.
    from packwork.writers.pdf_unseen_text import put_unseen_text

    put_unseen_text(pdf, layout, sheet)


def _put_inks(pdf: pikepdf.Pdf, printing: PrintOptions, title: str) -> None:
    # Load what only files for a press need.
    from packwork.writers.prepress.inks import InkWriter
    from packwork.writers.prepress.pdfx import put_intent

    InkWriter(pdf, printing.press, printing.spots).convert()
    if printing.press is not None:
        put_intent(pdf, printing.press, title)


def _set_page(layout: Layout, options: SvgOptions, sheet: PrintSheet) -> bytes:
    """PDF of a layout on the page of a sheet, as Typst sets it."""
    import typst

    wide, high = sheet.page
    sizes = {
        "width": sheet.width, "height": sheet.height, "fill": _fill(options.background),
        "wide": wide, "high": high, "around": sheet.around, "near": sheet.around - sheet.bleed,
        "bled_width": sheet.width + 2 * sheet.bleed, "bled_height": sheet.height + 2 * sheet.bleed,
    }  # fmt: skip
    drawing, name = drawing_text(layout, options), layout.container.name
    try:
        return typst.compile(
            (_PAGE if sheet.is_plain else _LARGER_PAGE).format(**sizes).encode(),
            sys_inputs={"drawing": drawing, "title": sound_text(name[:NAME_LENGTH])},
            ignore_system_fonts=True,
        )
    except RuntimeError as error:
        reason = " ".join(str(error).split())
        raise WriteError("PDF", f"an item's drawing cannot be rendered ({reason})") from error


def drawing_text(layout: Layout, options: SvgOptions) -> str:
    """SVG that stands on the page of a PDF: its words are curves.

    What sets the page would take fonts of its own for text.
    """
    return svg_text(without_text(layout), replace(options, text="outlines"))


def _fill(background: str | None) -> str:
    """Fill of the page as Typst writes it, for what lies beyond the canvas."""
    red, green, blue, opacity = parse_colour("background", background or "none")
    return f"rgb({red}, {green}, {blue}, {opacity})" if opacity else "none"


def without_text(layout: Layout) -> Layout:
    """Layout whose drawings with text are replaced by pictures of them."""
    px_per_cu = convert(1.0, layout.container.unit, "in") * PICTURE_DPI
    largest = largest_scales(layout, lambda item: item)
    as_picture = {
        item: _as_picture(item, largest[item] * px_per_cu)
        for item in layout.items
        if isinstance(item.art, VectorArt) and "<text" in item.art.markup
    }
    items = tuple(as_picture.get(item, item) for item in layout.items)
    return replace(layout, items=items) if as_picture else layout


def _as_picture(item: Item, px_per_unit: float) -> Item:
    try:
        return replace(item, art=as_picture(item, px_per_unit))
    except ValueError as error:
        raise WriteError("PDF", f"an item's drawing cannot be rendered ({error})") from error


_DIGITS = 4
"""Decimals of a coordinate, in points: 35 nm."""


def _put_lines(pdf: pikepdf.Pdf, lines: Sequence[FloatArray], sheet: PrintSheet) -> None:
    """Stroke lines for a cutter on the first page in a spot colour, on top of all.

    Print-and-cut programs look for a separation called CutContour, and Typst, which sets the
    page, knows no spot colours. ``lines`` are closed, in points, y down from the sheet's top.
    """
    from pikepdf import Array, Dictionary, Name

    page = pdf.pages[0]
    # Magenta where there is no such ink.
    tint = Dictionary(FunctionType=2, Domain=[0, 1], C0=[0] * 4, C1=[0, 1, 0, 0], N=1)
    ink = Array([Name.Separation, Name(f"/{SPOT}"), Name.DeviceCMYK, tint])
    page.add_resource(pdf.make_indirect(ink), Name.ColorSpace, Name(f"/{SPOT}"))
    over = Dictionary(Type=Name.ExtGState, OP=True, op=True, OPM=1)
    page.add_resource(pdf.make_indirect(over), Name.ExtGState, Name.Overprint)
    page.contents_add(b"q\n", prepend=True)
    page.contents_add(b"Q\n" + _strokes(lines, sheet.around, sheet.around + sheet.height))


def _strokes(lines: Sequence[FloatArray], left: float, top: float) -> bytes:
    """Content that strokes the lines, over what is there and without knocking it out."""
    drawn = ["q", "/Overprint gs", f"/{SPOT} CS", "1 SCN", f"{HAIRLINE_PT:g} w", "4 M"]
    for ring in lines:
        points = [
            f"{number(left + x, _DIGITS)} {number(top - y, _DIGITS)}" for x, y in ring.tolist()
        ]
        drawn.append(f"{points[0]} m " + " ".join(f"{point} l" for point in points[1:]) + " s")
    return "\n".join([*drawn, "Q", ""]).encode()
