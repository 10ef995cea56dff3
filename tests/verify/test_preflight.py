"""Preflight of PDFs and SVGs: each finding in a file that has it, and none in one that has not."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pikepdf
import pytest
from PIL import Image

from made_profiles import press_profile
from packwork import fill
from packwork.errors import ReadError
from packwork.readers.items import read_items
from packwork.scene.layout import Layout, sheet
from packwork.verify.preflight import Check, preflight, preflight_of
from packwork.writers import encoded, write_options
from scenes import flat_item, poses, square

QUICK = {"levels": "24", "epochs": 4}
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
    assert by_name(preflight_of(data, "a.pdf"))["text"].found == "none"
    assert not by_name(preflight_of(data, "a.pdf", layout))["text"].is_well
    large = words("page", {"pear": 9, "fig": 1}, canvas="300mm", **QUICK)  # type: ignore[arg-type]
    found = preflight_of(encoded(large, "a.pdf", write_options()), "a.pdf", large)
    assert by_name(found)["text"].is_well


def test_live_text_has_its_size() -> None:
    pdf = pikepdf.new()
    page = pdf.add_blank_page(page_size=(300, 300))
    font = pikepdf.Dictionary(
        Type=pikepdf.Name.Font, Subtype=pikepdf.Name.Type1, BaseFont=pikepdf.Name.Helvetica
    )
    page.add_resource(font, pikepdf.Name.Font, pikepdf.Name.F1)
    page.contents_add(b"BT .5 0 0 .5 90 90 cm /F1 8 Tf (small) Tj ET")
    written = io.BytesIO()
    pdf.save(written)
    found = by_name(preflight_of(written.getvalue(), "a.pdf"))
    assert found["text"] == Check("text", "smallest 4.0 pt; 1 under 5 pt", False)


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
