"""Inks of a PDF: spot colours, black ink, a press's profile, PDF/X-4, by programs of others."""

from __future__ import annotations

import io
import logging
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pikepdf
import pytest
from PIL import Image

from made_profiles import press_profile
from packwork import fill
from packwork.errors import ReadError, RecipeError
from packwork.readers.items import read_items
from packwork.readers.svg.item import item_of_svg
from packwork.scene.item import FlatArt, Item
from packwork.scene.layout import Layout, sheet
from packwork.writers import encoded, write_options
from packwork.writers.prepress.profile import read_press_profile
from scenes import flat_item, poses, square

GRADIENT = (
    b'<svg viewBox="0 0 20 20"><linearGradient id="g"><stop stop-color="#c8102e"/>'
    b'<stop offset=".5" stop-color="#fff"/><stop offset="1" stop-color="#00f"/></linearGradient>'
    b'<g opacity=".5"><path d="M0 0h20v20H0z" fill="url(#g)"/><path d="M0 0h9v9z"/></g></svg>'
)
SPOT = "PANTONE 186 C"


@pytest.fixture
def press(tmp_path: Path) -> Path:
    path = tmp_path / "press.icc"
    path.write_bytes(press_profile())
    return path


def flat(colour: str) -> Item:
    item = flat_item(colour, square(10.0))
    return Item(item.name, "", item.outline, item.ink, FlatArt(colour))


@pytest.fixture
def coloured(tmp_path: Path) -> Layout:
    """A sheet of 120 x 30 mm: squares in red and black, a gradient, a photograph."""
    pixels = np.zeros((40, 40, 4), dtype=np.uint8)
    pixels[..., 3], pixels[:, :20, 0] = 255, 255
    Image.fromarray(pixels).save(tmp_path / "photo.png")
    items = (
        flat("#c8102e"),
        flat("#000000"),
        item_of_svg(GRADIENT, "gradient", "gradient.svg"),
        read_items([str(tmp_path / "photo.png")]).items[0],
    )
    placed = poses([15.0, 45.0, 75.0, 105.0], 15.0, scale=[1, 1, 1, 0.5])
    return Layout(sheet("page", 120.0, 30.0, "mm"), items, placed, placed.scale)


def spaces_painted(pdf: bytes) -> set[str]:
    """Colour spaces of all that is painted but masks."""
    found: set[str] = set()
    with pikepdf.open(io.BytesIO(pdf)) as read:
        page = read.pages[0]
        _paint(page.obj, page.obj.Contents, found)
    return found


def _paint(holder: Any, stream: Any, found: set[str]) -> None:
    resources = holder.get("/Resources", {})
    streams = stream if isinstance(stream, pikepdf.Array) else [stream]
    named: dict[bool, str] = {}
    for one in (step for part in streams for step in pikepdf.parse_content_stream(part)):
        operator = str(one.operator)
        if operator.lower() == "cs":
            space = resources["/ColorSpace"].get(one.operands[0], one.operands[0])
            is_list = isinstance(space, pikepdf.Array)
            named[operator == "CS"] = (
                f"{space[0]} {space[1]}"
                if is_list and space[0] == "/Separation"
                else str(space[0] if is_list else space)
            )
        elif operator.lower() == "scn":
            found.add(named[operator == "SCN"])
        elif operator.lower() in {"k", "rg", "g"}:
            found.add(operator.lower())
    for drawn in resources.get("/XObject", {}).values():
        if drawn.Subtype == "/Image":
            space = drawn.ColorSpace
            found.add(str(space[0] if isinstance(space, pikepdf.Array) else space))
        else:
            _paint(drawn, drawn, found)
    for pattern in resources.get("/Pattern", {}).values():
        if pattern.PatternType == 2:
            space = pattern.Shading.ColorSpace
            found.add(str(space[0] if isinstance(space, pikepdf.Array) else space))


def test_colours_are_those_of_screens_unless_asked(coloured: Layout) -> None:
    assert "/ICCBased" in spaces_painted(encoded(coloured, "a.pdf"))


def test_with_a_profile_all_is_in_the_inks_of_the_press(coloured: Layout, press: Path) -> None:
    found = spaces_painted(encoded(coloured, "a.pdf", write_options(icc=press)))
    assert found == {"k", "/DeviceCMYK", "/Pattern"}


def test_a_spot_colour_is_an_ink_of_its_own(coloured: Layout, press: Path) -> None:
    options = write_options(icc=press, spot=f"{SPOT}=#c8102e")
    assert f"/Separation /{SPOT}" in spaces_painted(encoded(coloured, "a.pdf", options))
    without = spaces_painted(encoded(coloured, "a.pdf", write_options(spot={SPOT: "#c8102e"})))
    assert f"/Separation /{SPOT}" in without
    assert not {"k", "rg"} & without


def test_a_spot_colour_that_nothing_has_is_told(
    coloured: Layout, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.WARNING, "packwork"):
        encoded(coloured, "a.pdf", write_options(spot="Gold=#b58b2a"))
    assert "nothing is drawn in the colour of the spot ink Gold" in caplog.text


@pytest.mark.parametrize(
    "spot",
    [
        "#c8102e",
        "Gold",
        "Gold=mauvish",
        "A=red,B=red",
        "A=#ff000080",
        "A=red,A=blue",
        "All=red",
        "black=red",
        "Go\nld=red",
        "Gold\x00=red",
    ],
)
def test_spot_colours_that_are_none_are_refused(spot: str) -> None:
    with pytest.raises(RecipeError, match="spot"):
        write_options(spot=spot)


def test_black_is_black_ink_and_grey_is_not(press: Path) -> None:
    profile = read_press_profile(press)
    assert profile.inks((0, 0, 0)) == (0, 0, 0, 1)
    assert min(profile.inks((90, 90, 90))) > 0.1
    assert profile.inks((255, 255, 255)) == (0, 0, 0, 0)


def test_a_file_that_is_no_profile_of_a_press_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.icc").write_bytes(b"no profile")
    for path in ("a.icc", "b.icc"):
        with pytest.raises(ReadError, match=path):
            write_options(icc=tmp_path / path)
    from PIL import ImageCms

    screen = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB"))
    (tmp_path / "a.icc").write_bytes(screen.tobytes())
    with pytest.raises(ReadError, match=r"a\.icc: is no profile of a press"):
        write_options(icc=tmp_path / "a.icc")


@pytest.mark.parametrize("name", ["All", "None", "Cyan"])
def test_a_palette_names_no_reserved_ink(name: str) -> None:
    with pytest.raises(RecipeError, match=f"{name} is no spot ink"):
        fill(
            "page",
            "star",
            count=2,
            palette=f"spot:{name} #b58b2a",
            levels="24",
            epochs=4,
            effort="draft",
        )


@pytest.mark.parametrize(
    ("palette", "told"),
    [
        ("spot:Gold #b58b2a,spot:Bronze #b58b2a", "Gold and Bronze have one colour"),
        (["spot:Gold #b58b2a", "spot:Bronze #B58B2A"], "Gold and Bronze have one colour"),
        ("spot:Go\tld #b58b2a", "cannot be called"),
    ],
)
def test_a_palette_gives_each_ink_a_colour_and_a_name_that_prints(
    palette: str | list[str], told: str
) -> None:
    with pytest.raises(RecipeError, match=told):
        fill("page", "star", count=2, palette=palette, levels="24", epochs=4, effort="draft")


@pytest.mark.parametrize("has_press", [False, True])
def test_a_gradient_of_a_spot_colour_is_told(
    coloured: Layout, press: Path, caplog: pytest.LogCaptureFixture, has_press: bool
) -> None:
    for spot, is_told in (("Blue=#0000ff", True), ("Gold=#b58b2a", False)):
        caplog.clear()
        encoded(coloured, "a.pdf", write_options(icc=press if has_press else None, spot=spot))
        assert ("1 gradient has the colour of a spot ink" in caplog.text) == is_told


def test_a_file_for_a_press_says_where_it_is_trimmed(coloured: Layout, press: Path) -> None:
    # ISO 15930-7, 6.11, with or without a bleed.
    with pikepdf.open(io.BytesIO(encoded(coloured, "a.pdf", write_options(icc=press)))) as read:
        page = read.pages[0]
        media, bleed, trim = (
            [float(v) for v in box] for box in (page.mediabox, page.obj.BleedBox, page.obj.TrimBox)
        )
    assert trim == bleed == pytest.approx(media, abs=1e-3)


def test_a_file_for_a_press_says_what_pdf_x_4_asks(coloured: Layout, press: Path) -> None:
    # ISO 15930-7, 6: what can be read off a file of one page without fonts or annotations.
    pdf = encoded(coloured, "a.pdf", write_options(icc=press, bleed="3mm", marks="all"))
    assert pdf.startswith(b"%PDF-1.6")
    with pikepdf.open(io.BytesIO(pdf)) as read:
        (intent,) = read.Root.OutputIntents
        assert intent.S == "/GTS_PDFX"
        assert intent.OutputConditionIdentifier == "FOGRA39"
        assert intent.DestOutputProfile.read_bytes() == press_profile()
        assert intent.DestOutputProfile.N == 4
        with read.open_metadata() as meta:
            assert meta["pdfxid:GTS_PDFXVersion"] == "PDF/X-4"
            assert meta["pdf:Trapped"] == "False"
            assert meta["dc:title"] == "page"
            dates = {meta[f"xmp:{name}Date"] for name in ("Create", "Modify", "Metadata")}
        assert len(dates) == 1
        assert {"/CreationDate", "/ModDate", "/Title"} <= read.docinfo.keys()
        assert read.docinfo.Trapped == "/False"
        assert len(read.trailer.ID) == 2
        assert "/Encrypt" not in read.trailer
        page = read.pages[0]
        assert "/ArtBox" not in page.obj
        assert "/Annots" not in page.obj
        assert page.obj.Group.CS == "/DeviceCMYK"
        media, bleed, trim = (
            [float(v) for v in box] for box in (page.mediabox, page.BleedBox, page.TrimBox)
        )
        for inner, outer in ((trim, bleed), (bleed, media)):
            assert all(a >= b - 1e-4 for a, b in zip(inner[:2], outer[:2], strict=True))
            assert all(a <= b + 1e-4 for a, b in zip(inner[2:], outer[2:], strict=True))
        filters = {str(one.get("/Filter")) for one in read.objects if hasattr(one, "read_bytes")}
        assert not filters & {"/LZWDecode", "/Crypt"}


def run(*command: str, folder: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)


@pytest.mark.skipif(shutil.which("pdfinfo") is None, reason="poppler is not installed")
def test_poppler_calls_it_pdf_x_4(coloured: Layout, press: Path, tmp_path: Path) -> None:
    (tmp_path / "a.pdf").write_bytes(encoded(coloured, "a.pdf", write_options(icc=press)))
    told = run("pdfinfo", "a.pdf", folder=tmp_path)
    assert "PDF/X-4" in told.stdout
    assert told.stderr == ""


@pytest.mark.skipif(shutil.which("qpdf") is None, reason="qpdf is not installed")
def test_qpdf_finds_no_errors(coloured: Layout, press: Path, tmp_path: Path) -> None:
    options = write_options(icc=press, bleed="3mm", marks="all")
    (tmp_path / "a.pdf").write_bytes(encoded(coloured, "a.pdf", options))
    assert (
        "No syntax or stream encoding errors"
        in run("qpdf", "--check", "a.pdf", folder=tmp_path).stdout
    )


@pytest.mark.skipif(shutil.which("gs") is None, reason="ghostscript is not installed")
def test_ghostscript_separates_the_inks(coloured: Layout, press: Path, tmp_path: Path) -> None:
    options = write_options(icc=press, spot=f"{SPOT}=#c8102e", cut="outlines")
    (tmp_path / "a.pdf").write_bytes(encoded(coloured, "a.pdf", options))
    run(
        "gs", "-q", "-dNOPAUSE", "-dBATCH", "-dPDFSTOPONERROR", "-dPDFSTOPONWARNING",
        "-sDEVICE=tiffsep", "-r50.8", "-sOutputFile=a.tif", "a.pdf", folder=tmp_path,
    )  # fmt: skip
    inks = {}
    for path in tmp_path.glob("a.tif*.tif"):
        inks[path.name[6:-5]] = np.asarray(Image.open(path)).astype(int)
    for path in tmp_path.glob("a(*).tif"):
        inks[path.name[2:-5]] = 255 - np.asarray(Image.open(path)).astype(int)
    assert inks.keys() == {"Cyan", "Magenta", "Yellow", "Black", SPOT, "CutContour"}
    # Two pixels a mm; the middles of the red, the black and the photograph's red half.
    amounts = {name: [int(ink[30, x]) for x in (30, 90, 205)] for name, ink in inks.items()}
    assert amounts[SPOT] == [255, 0, 0]
    assert amounts["Black"][:2] == [0, 255]
    assert [amounts[name][:2] for name in ("Cyan", "Magenta", "Yellow")] == [[0, 0]] * 3
    assert amounts["Magenta"][2] > 200
    assert amounts["Cyan"][2] < 40
    assert inks["CutContour"].max() == 255


def test_a_palette_may_name_spot_inks() -> None:
    layout = fill(
        "page",
        "star",
        count=2,
        palette="spot:Gold #b58b2a,black",
        levels="24",
        epochs=4,
        effort="draft",
    )
    found = spaces_painted(encoded(layout, "a.pdf"))
    assert "/Separation /Gold" in found
    assert "/ICCBased" in found
