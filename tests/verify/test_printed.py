"""PDFs are held against the SVG that they were made of, from their own text."""

from __future__ import annotations

import io
import json
from collections.abc import Callable
from pathlib import Path

import pikepdf
import pytest
from PIL import Image, ImageDraw
from typer.testing import CliRunner

import packwork as pw
from made_profiles import press_profile
from packwork.cli import app
from packwork.cli.running import on_trust_in
from packwork.readers.layouts.pdf import printed_page
from packwork.readers.reading import UnfitError
from packwork.readers.svg.item import item_of_svg
from packwork.scene.item import Item
from packwork.verify.text import faults_in_file
from packwork.writers import pdf, registry
from packwork.writers.registry import encoded, write_options

Step = tuple[list[object], str]
QUICK = {"effort": "draft", "levels": "24", "epochs": 6, "seed": 1}

DRAWING = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"><defs>
<clipPath id="c"><circle cx="35" cy="50" r="25"/><path d="M50 30h40v40H50z"/></clipPath>
<linearGradient id="g"><stop stop-color="red"/><stop offset="1"/></linearGradient>
</defs><g clip-path="url(#c)"><rect width="100" height="100" fill="url(#g)"/>
<ellipse cx="60" cy="50" rx="30" ry="10" fill="navy" opacity="0.5"/></g>
<path d="M20 80q30 -30 60 0" fill="none" stroke="#234" stroke-width="6" stroke-dasharray="9 2"/>
<svg x="10" y="2" width="30" height="20" viewBox="0 0 9 9"><circle cx="4" cy="8" r="6"/></svg>
{}</svg>"""
MASKED = (
    '<mask id="m"><circle cx="50" cy="20" r="9" fill="#fff"/></mask>'
    '<rect x="30" width="60" height="40" mask="url(#m)"/>'
)
MARKED = (
    '<marker id="a" viewBox="0 0 9 9" refX="5" refY="5"><path d="M0 0L9 5L0 9z"/></marker>'
    '<path d="M20 20L80 50L20 80" fill="none" stroke="#234" marker-mid="url(#a)"/>'
)


def drawing(more: str = "") -> Item:
    return item_of_svg(DRAWING.format(more).encode(), "drawing", "drawing.svg")


@pytest.fixture(scope="module")
def layout() -> pw.Layout:
    return pw.fill("circle", ["star", "heart", drawing()], count=9, **QUICK)


def faults(layout: pw.Layout, data: bytes | None = None, **asked: object) -> tuple[str, ...]:
    options = write_options(**asked)
    written = encoded(layout, "a.pdf", options) if data is None else data
    return faults_in_file(written, "a.pdf", layout, options)


def changed(data: bytes, change: Callable[[list[Step]], None]) -> bytes:
    """A PDF whose content was changed: operands and operators in turn."""
    with pikepdf.open(io.BytesIO(data)) as pdf:
        page = pdf.pages[0]
        steps = [([*one.operands], str(one.operator)) for one in pikepdf.parse_content_stream(page)]
        change(steps)
        content = [(operands, pikepdf.Operator(name)) for operands, name in steps]
        page.Contents = pdf.make_stream(pikepdf.unparse_content_stream(content))
        pdf.save(written := io.BytesIO())
    return written.getvalue()


def moved(steps: list[Step], operator: str, operand: int, by: float, skipped: int = 0) -> None:
    operands = [operands for operands, name in steps if name == operator][skipped]
    operands[operand] = float(operands[operand]) + by


def displaced_path(steps: list[Step]) -> None:
    moved(steps, "c", 4, 2.0, skipped=5)


def displaced_item(steps: list[Step]) -> None:
    moved(steps, "cm", 4, 0.01, skipped=2)


def scaled(steps: list[Step]) -> None:
    steps.insert(0, ([0.999, 0, 0, 0.999, 0, 0], "cm"))


def wider_pen(steps: list[Step]) -> None:
    moved(steps, "w", 0, 0.1)


def lost_clips(steps: list[Step]) -> None:
    clips = [k for k, (_, name) in enumerate(steps) if name in {"W", "W*"}]
    for k in reversed(clips[1:]):
        del steps[k]


def lost_path(steps: list[Step]) -> None:
    k = [k for k, (_, name) in enumerate(steps) if name in {"f", "f*"}][1]
    steps[k] = ([], "n")


def added_path(steps: list[Step]) -> None:
    steps += [([9, 9, 30, 30], "re"), ([], "f")]


@pytest.mark.parametrize(
    "asked",
    [
        {},
        {"background": "ivory", "show_container": True},
        {"cut": "outlines"},
        {"kiss_cut": "1", "bleed": "3mm", "background": "#ff8000"},
        {"bleed": "3mm", "marks": "all", "background": "#ff8000"},
        {"halo": "all", "text": "live"},
    ],
)
def test_a_pdf_as_it_is_written_keeps_the_promise(
    layout: pw.Layout, asked: dict[str, object]
) -> None:
    assert faults(layout, **asked) == ()


def test_inks_of_a_press_move_no_path(layout: pw.Layout, tmp_path: Path) -> None:
    press = tmp_path / "press.icc"
    press.write_bytes(press_profile())
    asked = {"bleed": "3mm", "marks": "crop", "background": "#ff8000", "cut": "outlines"}
    assert faults(layout, icc=str(press), spot="Gold=#ff8000", **asked) == ()


@pytest.mark.parametrize("canvas", ["200x150mm", "8in", "A0", "9x9cm"])
def test_canvases_of_any_unit_agree(canvas: str) -> None:
    assert faults(pw.fill("heart", ["moon", drawing()], count=6, canvas=canvas, **QUICK)) == ()


def test_words_pictures_and_stretched_items_agree(tmp_path: Path) -> None:
    words = pw.words("circle", {"pear": 3, "plum": 2, "fig": 1}, **QUICK)
    assert faults(words) == ()
    stretched = pw.fill(
        "square", ["star", drawing()], count=8, stretch=2, rotate="none", canvas="90mm", **QUICK
    )
    assert faults(stretched) == ()
    picture = Image.new("RGBA", (60, 40))
    ImageDraw.Draw(picture).ellipse((5, 5, 50, 30), fill="teal")
    picture.save(tmp_path / "cut.png")
    picture.convert("RGB").save(tmp_path / "photo.jpg")
    assert faults(pw.fill("circle", [tmp_path / "cut.png", "star"], count=5, **QUICK)) == ()
    photos = pw.photos("square", tmp_path, canvas="90mm", **QUICK)
    assert faults(photos) == ()


@pytest.mark.parametrize(
    "change",
    [displaced_path, displaced_item, scaled, wider_pen, lost_clips, lost_path, added_path],
)
def test_a_pdf_that_was_changed_does_not(
    layout: pw.Layout, change: Callable[[list[Step]], None]
) -> None:
    (fault,) = faults(layout, changed(encoded(layout, "a.pdf"), change))
    assert fault.startswith("it lacks ")


def test_a_page_of_another_size_does_not(layout: pw.Layout) -> None:
    with pikepdf.open(io.BytesIO(encoded(layout, "a.pdf"))) as pdf:
        pdf.pages[0].MediaBox = [0, 0, 451, 450]
        pdf.save(written := io.BytesIO())
    (fault,) = faults(layout, written.getvalue())
    assert fault.startswith("its page is 601.333333 x 600 px instead of 600 x")


def test_what_is_no_pdf_of_ours_is_said_in_a_line(layout: pw.Layout) -> None:
    (fault,) = faults(layout, b"%PDF-")
    assert fault.startswith("what is written cannot be read back: it is no PDF")
    assert "\n" not in fault
    text = changed(
        encoded(layout, "a.pdf"), lambda steps: steps.append(([pikepdf.String("a")], "Tj"))
    )
    with pytest.raises(UnfitError, match="paints by Tj"):
        printed_page(text)


def test_what_is_not_compared_is_named(tmp_path: Path) -> None:
    layout = pw.fill("circle", [drawing(MASKED), drawing(MARKED)], count=4, **QUICK)
    data = encoded(layout, "a.pdf")
    assert faults(layout, data) == ()
    drawn = [(tmp_path / "a.pdf", data), (tmp_path / "a.svg", b"")]
    assert on_trust_in(drawn, layout) == ["a.pdf: what markers and masks paint is taken on trust"]
    assert faults(layout, changed(data, displaced_item))


def test_a_run_is_certified_if_its_pdf_is(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    files = ["-o", str(tmp_path / "a.pdf"), "--report", str(tmp_path / "a.json")]
    line = ["fill", "circle", "star", "-n", "4", "--effort", "draft", "--levels", "24", *files]
    done = CliRunner().invoke(app, line, catch_exceptions=False)
    assert (done.exit_code, "\ncertified" in done.output) == (0, True)
    monkeypatch.setattr(
        registry, "pdf_bytes", lambda *given: changed(pdf.pdf_bytes(*given), displaced_item)
    )
    done = CliRunner().invoke(app, line, catch_exceptions=False)
    assert (done.exit_code, "\ncertified" in done.output) == (1, False)
    assert "a.pdf: it lacks 1 shape that was measured, and has 1 path that was not" in done.output
    assert json.loads((tmp_path / "a.json").read_text(encoding="utf-8"))["certified"] is False
