"""Preflight of PDFs and SVGs: each finding in a file that has it, and none in one that has not."""

from __future__ import annotations

import base64
import io
import logging
import resource
import tracemalloc
import zlib
from pathlib import Path

import numpy as np
import pikepdf
import pytest
from pikepdf import Array, Dictionary, Name, String
from PIL import Image

from made_profiles import press_profile
from packwork import fill
from packwork.errors import ReadError
from packwork.readers.items import read_items
from packwork.readers.reading import UnfitError
from packwork.scene.layout import Layout, sheet
from packwork.verify.near_trim import ending_near
from packwork.verify.pdf_fonts import FontWidths
from packwork.verify.pdf_objects import check_size
from packwork.verify.preflight import MAX_CONTENT, Check, preflight, preflight_of
from packwork.writers import encoded, write_options
from scenes import flat_item, poses, square

QUICK = {"levels": "24", "epochs": 4, "effort": "draft"}
NEAR = "within 3 mm of the trim"


def by_name(checks: list[Check]) -> dict[str, Check]:
    return {one.about: one for one in checks}


def looked_at(layout: Layout, **options: object) -> dict[str, Check]:
    return by_name(preflight_of(encoded(layout, "a.pdf", write_options(**options)), "a.pdf"))


def svg_checks(tmp_path: Path, content: str) -> dict[str, Check]:
    (tmp_path / "a.svg").write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="50mm" viewBox="0 0 100 50">'
        f"{content}</svg>",
        encoding="utf-8",
    )
    return by_name(preflight(tmp_path / "a.svg"))


def tile(x: float) -> Layout:
    """A square of 20 mm on a sheet of 100 x 50 mm."""
    placed = poses([x], [25.0])
    return Layout(
        sheet("page", 100.0, 50.0, "mm"), (flat_item("a", square(10.0)),), placed, placed.scale
    )


def test_a_sheet_without_bleed_or_inks_is_told() -> None:
    found = looked_at(tile(50.0))
    assert found["trimmed sheet"] == Check("trimmed sheet", "100 x 50 mm, no bleed", False)
    assert not found["colours"].is_well
    assert "RGB" in found["colours"].found
    assert found["output intent"].found == "none"


def test_a_sheet_as_print_shops_want_it_is_well(tmp_path: Path) -> None:
    (tmp_path / "press.icc").write_bytes(press_profile())
    found = looked_at(
        tile(50.0), bleed="3mm", marks="all", background="ivory", icc=tmp_path / "press.icc",
        spot="Slate=#4a5568",
    )  # fmt: skip
    assert [one for one in found.values() if not one.is_well] == []
    assert found["trimmed sheet"].found == "100 x 50 mm, bleed 3 mm"
    assert found["colours"].found == "CMYK 2, ink All, ink Slate"
    assert found["output intent"].found == "FOGRA39 PDF/X-4"


@pytest.mark.parametrize(
    ("x", "bleed", "is_well"),
    [(50, None, True), (11, None, False), (10, None, False), (10, "3mm", True), (12, "3mm", False)],
)
def test_what_ends_near_the_trim_is_counted(x: float, bleed: str | None, is_well: bool) -> None:
    found = looked_at(tile(x), bleed=bleed)[NEAR]
    assert found == Check(NEAR, "none" if is_well else "1 shape ends there", is_well)


@pytest.mark.parametrize(("width", "is_well"), [(0.05, False), (0.2, True)])
def test_thin_lines_are_counted(tmp_path: Path, width: float, is_well: bool) -> None:
    line = (
        f'<g transform="scale(2)"><path d="M10 10h20" stroke="red" stroke-width="{width / 2}"/></g>'
    )
    found = svg_checks(tmp_path, line)["lines"]
    assert found.is_well == is_well
    assert f"thinnest {width / 25.4 * 72:.2f} pt" in found.found


def test_resolution_is_that_on_paper(tmp_path: Path) -> None:
    pixels = np.full((100, 100, 3), 90, dtype=np.uint8)
    pixels[:50] = 200
    Image.fromarray(pixels).save(tmp_path / "photo.png")
    (item,) = read_items([str(tmp_path / "photo.png")]).items
    side = item.outline.bounds[2] - item.outline.bounds[0]
    placed = poses([50.0], [25.0], scale=[25.4 / side])
    layout = Layout(sheet("page", 100.0, 50.0, "mm"), (item,), placed, placed.scale)
    found = looked_at(layout)["pictures"]
    assert found.found == "1 picture, 100 to 100 pixels to the inch; 1 under 300"


def test_transparency_is_told(tmp_path: Path) -> None:
    found = svg_checks(tmp_path, '<g opacity=".5"><path d="M20 20h9v9zM25 25h9v9z"/></g>')
    assert found["transparency"] == Check("transparency", "1 opacity", False)
    assert svg_checks(tmp_path, '<path d="M20 20h9v9z"/>')["transparency"].is_well


def test_small_words_are_told_though_they_are_curves() -> None:
    from packwork import words

    layout = words("page", {"pear": 9, "fig": 1}, canvas="10mm", **QUICK)  # type: ignore[arg-type]
    data = encoded(layout, "a.pdf", write_options())
    assert by_name(preflight_of(data, "a.pdf"))["text"].found.startswith("none; ")
    assert not by_name(preflight_of(data, "a.pdf", layout))["text"].is_well
    large = words("page", {"pear": 9, "fig": 1}, canvas="300mm", **QUICK)  # type: ignore[arg-type]
    found = preflight_of(encoded(large, "a.pdf", write_options()), "a.pdf", large)
    assert by_name(found)["text"].is_well


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b"BT .5 0 0 .5 90 90 cm /F 8 Tf (small) Tj ET", "smallest 4.0 pt; 1 under 5 pt"),
        (
            b"BT /F 1 Tf 4 0 0 4 9 9 Tm (a) Tj 4 0 0 4 20 9 Tm (b) Tj ET",
            "smallest 4.0 pt; 2 under 5 pt",
        ),
        (b"BT /F 1 Tf .5 0 0 .5 9 9 Tm ET BT /F 8 Tf (plain) Tj ET", "smallest 8.0 pt"),
    ],
)
def test_live_text_has_its_size(content: bytes, told: str) -> None:
    assert by_name(preflight_of(made(content), "a.pdf"))["text"].found == told


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b"/S sh", "RGB 1"),
        (b"q 9 0 0 9 90 90 cm BI /W 1 /H 1 /CS /RGB /BPC 8 ID abc EI Q", "RGB 1"),
        (b"q 9 0 0 9 90 90 cm /Indexed Do Q", "CMYK 1"),
        (b"/Pattern cs /Tiles scn 90 90 9 9 re f", "RGB 1"),
        (b"/Inks cs 1 1 scn 90 90 9 9 re f", "ink Gold, Silver"),
        (b"/Self cs 1 scn 90 90 9 9 re f", "none"),
        (b"/Round cs 1 scn 90 90 9 9 re f", "none"),
        (b"1 0 0 rg q 9 0 0 9 90 90 cm BI /W 1 /H 1 /IM true /BPC 1 ID a EI Q", "RGB 1"),
    ],
)
def test_colours_are_found_in_all_that_paints(content: bytes, told: str) -> None:
    assert by_name(preflight_of(made(content), "a.pdf"))["colours"].found == told


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b"BT /F 12 Tf 2 100 Td (near) Tj ET", "1 shape ends there"),
        (b"BT /F 12 Tf 100 100 Td (far off) Tj ET", "none"),
        (b"BT /F 12 Tf 200 100 Td (sixteen letters.) Tj ET", "1 shape ends there"),
        (b"BT /F 12 Tf 50 Tz 200 100 Td (sixteen letters.) Tj ET", "none"),
        (b"BT /F 12 Tf 100 100 Td [(far) -13000 (off)] TJ ET", "1 shape ends there"),
        (b"BT /F 12 Tf 20 TL 100 25 Td (a) Tj (b) ' ET", "1 shape ends there"),
        (b"BT /F 12 Tf 0 1 -1 0 100 280 Tm (up) Tj ET", "1 shape ends there"),
        (b"3 Tr BT /F 12 Tf 2 100 Td (unseen) Tj ET", "none"),
        (b"1 g 0 0 300 300 re f 0 g 90 90 9 9 re f", "none"),
        (b"0 0 0 0 k 0 0 300 300 re f 0 g 90 90 9 9 re f", "none"),
        (b"0 0 300 300 re f 1 g 2 2 5 5 re f", "2 shapes end there"),
    ],
)
def test_what_ends_near_the_trim_is_told(content: bytes, told: str) -> None:
    assert by_name(preflight_of(made(content), "a.pdf"))[NEAR].found == told


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b"/NoLines gs 90 90 9 9 re f", "none"),
        (b"/NoLines gs 90 90 9 9 re S", "1 opacity"),
        (b"/Half gs 90 90 9 9 re f 90 90 9 9 re S BT /F 9 Tf 90 90 Td (a) Tj ET", "2 opacities"),
        (b"q /Half gs Q 90 90 9 9 re f", "none"),
    ],
)
def test_opacity_is_told_where_it_is_painted_with(content: bytes, told: str) -> None:
    assert by_name(preflight_of(made(content), "a.pdf"))["transparency"].found == told


def test_settings_have_a_width_of_lines() -> None:
    found = by_name(preflight_of(made(b"/Half gs 90 90 9 9 re S"), "a.pdf"))["lines"]
    assert found.found == "thinnest 0.10 pt; 1 under 0.25 pt"


def test_composite_fonts_list_widths_of_characters_and_of_ranges() -> None:
    widths = Array([1, Array([250, 500]), 10, 12, 750, 20, 10**9, 1])
    drawn = Dictionary(DW=900, W=widths)
    font = Dictionary(Subtype=Name.Type0, DescendantFonts=Array([drawn]))
    found = FontWidths.of(font)
    codes = b"".join(code.to_bytes(2) for code in (1, 2, 3, 10, 12, 13))
    assert found.width([String(codes)]) == pytest.approx(0.25 + 0.5 + 0.9 + 0.75 + 0.75 + 0.9)
    assert found.count == 4


def test_ranges_of_many_fonts_are_no_numbers_apiece() -> None:
    with pikepdf.open(io.BytesIO(made(b""))) as pdf:
        fonts = Dictionary()
        for k in range(20):
            drawn = Dictionary(W=Array([k, 10**8, 500]))
            made_font = Dictionary(Subtype=Name.Type0, DescendantFonts=Array([drawn]))
            fonts[f"/F{k}"] = pdf.make_indirect(made_font)
        pdf.pages[0].obj.Resources = Dictionary(Font=fonts)
        shown = " ".join(f"/F{k} 9 Tf <0101> Tj" for k in range(20))
        pdf.pages[0].contents_add(f"BT 99 99 Td {shown} ET".encode())
        pdf.save(written := io.BytesIO())
    tracemalloc.start()
    assert by_name(preflight_of(written.getvalue(), "a.pdf"))["text"].found == "smallest 9.0 pt"
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert most < 20e6


def test_widths_of_a_file_have_one_budget() -> None:
    simple = Dictionary(Subtype=Name.Type1, FirstChar=1, Widths=Array([250] * 9))
    many = Dictionary(
        Subtype=Name.Type0, DescendantFonts=Array([Dictionary(W=Array([*range(99)]))])
    )
    assert [FontWidths.of(font, 5).count for font in (simple, many)] == [5, 5]


def test_what_goes_on_beyond_the_trim_is_what_covers_all_of_an_end() -> None:
    random, trim = np.random.default_rng(3), np.array([[0.0, 0.0], [99.0, 99.0]])
    for _ in range(20):
        low = random.integers(-2, 8, (60, 2)) * 12.375
        boxes = np.stack([low, low + random.integers(1, 5, (60, 2)) * 12.375], axis=1)
        assert ending_near(boxes, trim) == sum(
            any(stops_at(boxes, box, trim, axis, end) for axis in (0, 1) for end in (0, 1))
            for box in boxes
            if (np.minimum(box[1], 99) - np.maximum(box[0], 0) > 0.1).all()
        )


def stops_at(boxes: np.ndarray, box: np.ndarray, trim: np.ndarray, axis: int, end: int) -> bool:
    """Whether a box ends on one side of the trim, with nothing beyond that adjoins all of it."""
    sign = 1 if end else -1
    if box[end, axis] != trim[end, axis]:
        return False
    return not any(
        other[end, axis] * sign > trim[end, axis] * sign + 0.1
        and other[1 - end, axis] * sign <= trim[end, axis] * sign + 0.1
        and other[0, 1 - axis] < box[0, 1 - axis] + 0.1
        and other[1, 1 - axis] > box[1, 1 - axis] - 0.1
        for other in boxes
    )


@pytest.mark.parametrize("unit", [1.0, 2.5])
def test_the_unit_of_a_page_counts(unit: float) -> None:
    with pikepdf.open(io.BytesIO(made(b".1 w 90 90 9 9 re S"))) as pdf:
        pdf.pages[0].obj.UserUnit = unit
        pdf.save(written := io.BytesIO())
    found = by_name(preflight_of(written.getvalue(), "a.pdf"))
    side = 300 * unit / 72 * 25.4
    assert found["trimmed sheet"].found == f"{side:.4g} x {side:.4g} mm, no bleed"
    assert found["lines"].found.startswith(f"thinnest {0.1 * unit:.2f} pt")
    assert found["lines"].is_well == (unit > 2)


@pytest.mark.parametrize(("width", "is_well"), [(200, True), (300, False)])
def test_a_form_is_clipped_by_its_box(width: int, is_well: bool) -> None:
    with pikepdf.open(io.BytesIO(made(b"/Form Do"))) as pdf:
        form = pdf.make_stream(b"50 50 900 9 re f", Subtype=Name.Form, BBox=[0, 0, width, 300])
        pdf.pages[0].obj.Resources.XObject.Form = form
        pdf.save(written := io.BytesIO())
    assert by_name(preflight_of(written.getvalue(), "a.pdf"))[NEAR].is_well == is_well


def packed_twice() -> bytes:
    """PDF whose content of a gigabyte is a few kilobytes."""
    packer, size = zlib.compressobj(9), 10**7
    head = packer.compress(b"") + packer.flush(zlib.Z_FULL_FLUSH)
    # A part that ends with a full flush may follow itself; the sum of zeros is known.
    part = packer.compress(bytes(size)) + packer.flush(zlib.Z_FULL_FLUSH)
    end = b"\x03\x00" + ((100 * size % 65_521) << 16 | 1).to_bytes(4, "big")
    packed = head + 100 * part + end
    assert zlib.decompressobj().decompress(packed, 9) == bytes(9)
    with pikepdf.open(io.BytesIO(made(b""))) as pdf:
        flate = Name.FlateDecode
        page = pdf.pages[0].obj
        page.Contents = pdf.make_stream(zlib.compress(packed), Filter=Array([flate, flate]))
        pdf.save(
            written := io.BytesIO(),
            compress_streams=False,
            stream_decode_level=pikepdf.StreamDecodeLevel.none,
        )
    return written.getvalue()


def test_content_is_refused_before_it_is_unpacked() -> None:
    data = packed_twice()
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    with pytest.raises(ReadError, match="more than can be looked at"):
        preflight_of(data, "a.pdf")
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    assert grown * 1024 < 5e8


@pytest.mark.parametrize(
    ("data", "filters"),
    [
        (zlib.compress(bytes(90_000)), [Name.Fl]),
        (
            zlib.compress(bytes(90_000)).hex().encode() + b">",
            [Name.ASCIIHexDecode, Name.FlateDecode],
        ),
        (base64.a85encode(zlib.compress(bytes(90_000))) + b"~>", [Name.A85, Name.FlateDecode]),
        (b"\x80\x0b\x60" * 900, [Name.LZWDecode]),
    ],
)
def test_streams_packed_in_any_way_are_bounded(data: bytes, filters: list[Name]) -> None:
    pdf = pikepdf.new()
    stream = pdf.make_stream(data, Filter=Array(filters))
    with pytest.raises(UnfitError, match="more than can be looked at"):
        check_size(stream, 50_000)
    if data[0] != 0x80:
        check_size(stream, 200_000)


def made(content: bytes, encryption: pikepdf.Encryption | None = None) -> bytes:
    """PDF of one page with that content."""
    pdf = pikepdf.new()
    page = pdf.add_blank_page(page_size=(300, 300))
    ramp = Dictionary(FunctionType=2, Domain=[0, 1], C0=[0, 0, 0], C1=[1, 1, 1], N=1)
    shading = Dictionary(
        ShadingType=2, ColorSpace=Name.DeviceRGB, Coords=[0, 0, 9, 0], Function=ramp
    )
    palette = Array([Name.Indexed, Name.DeviceCMYK, 0, String(bytes(4))])
    indexed = pdf.make_stream(
        b"0", Subtype=Name.Image, Width=1, Height=1, BitsPerComponent=8, ColorSpace=palette
    )
    tiles = pdf.make_stream(b"1 0 0 rg 0 0 5 5 re f", PatternType=1, Resources=Dictionary())
    inks = Array([Name.DeviceN, Array([Name.Gold, Name.Silver]), Name.DeviceCMYK, ramp])
    turning = pdf.make_indirect(Array([Name.Indexed, Name.DeviceRGB, 0, String(b"abc")]))
    turning[1] = turning
    form = pdf.make_stream(b"/Form Do /Form Do", Subtype=Name.Form)
    form.Resources = Dictionary(XObject=Dictionary(Form=form))
    page.obj.Resources = Dictionary(
        Font=Dictionary(F=Dictionary(Subtype=Name.Type1, BaseFont=Name.Helvetica)),
        Shading=Dictionary(S=shading),
        XObject=Dictionary(Indexed=indexed, Form=form),
        Pattern=Dictionary(Tiles=tiles),
        ColorSpace=Dictionary(Inks=inks, Self=Name.Self, Round=turning),
        ExtGState=Dictionary(NoLines=Dictionary(CA=0, ca=1), Half=Dictionary(ca=0.5, LW=0.1)),
    )
    page.contents_add(content)
    written = io.BytesIO()
    pdf.save(written, encryption=encryption)
    return written.getvalue()


@pytest.mark.parametrize(
    ("data", "told"),
    [
        (made(b"/Form Do"), "more than can be looked at"),
        (made(b"q Q\n" * (MAX_CONTENT // 4)), "more than can be looked at"),
        (made(b"/Nothing Do"), "no PDF that can be read"),
        (made(b"1 0 rg m 5 re f"), "no PDF that can be read"),
        (made(b"", encryption=pikepdf.Encryption(owner="a", user="b")), "is encrypted"),
    ],
    ids=["form in itself", "long", "no such picture", "operands", "encrypted"],
)
def test_hostile_and_broken_files_are_errors_of_one_line(data: bytes, told: str) -> None:
    with pytest.raises(ReadError, match=told):
        preflight_of(data, "a.pdf")


def test_a_damaged_file_is_told(caplog: pytest.LogCaptureFixture) -> None:
    data = made(b"")
    with caplog.at_level(logging.WARNING, "packwork"):
        preflight_of(data[: data.rindex(b"xref")], "a.pdf")
    assert "is damaged" in caplog.text


def test_other_files_are_refused(tmp_path: Path) -> None:
    (tmp_path / "a.pdf").write_bytes(b"no PDF")
    with pytest.raises(ReadError, match="no PDF"):
        preflight(tmp_path / "a.pdf")
    with pytest.raises(ReadError, match="no PDF or SVG"):
        preflight(tmp_path / "a.png")


def test_what_a_run_writes_can_be_looked_at(tmp_path: Path) -> None:
    layout = fill("page", "star", count=3, canvas="A6", margin="8mm", **QUICK)
    layout.save(tmp_path / "a.svg")
    assert by_name(preflight(tmp_path / "a.svg"))[NEAR].is_well
