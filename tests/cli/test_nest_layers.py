"""Nests as SVG and PDF for a machine: what is cut and engraved, by layer and colour."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path

import ezdxf
import numpy as np
import pikepdf
import pytest
import shapely
from typer.testing import Result

import packwork as pw
from packwork.readers.gate.door import parse_xml
from packwork.readers.layouts.marks import arc_lines_of
from packwork.readers.reading import UnfitError
from packwork.scene.line_art import LineArt

Command = Callable[..., Result]

LABEL = "{http://www.inkscape.org/namespaces/inkscape}label"
MODE = "{http://www.inkscape.org/namespaces/inkscape}groupmode"

CURVED = """<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="30mm" viewBox="0 0 40 30">
<path fill="#333" fill-rule="evenodd"
d="M2 2h20c9 3 9 16 0 20H2zM8 8a3 3 0 1 0 6 0 3 3 0 1 0-6 0z"/>
</svg>"""

BADGE = """<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="30mm" viewBox="0 0 40 30">
<rect width="40" height="30" fill="#123456"/><circle cx="20" cy="15" r="8" fill="gold"/></svg>"""


@pytest.fixture
def shop(folder: Path) -> Path:
    """A plate with a hole, scored and etched in colours; a filled shape of curves; a badge."""
    document = ezdxf.new(units=4)
    document.layers.add("Score", color=3)
    document.layers.add("engrave", color=7)
    space = document.modelspace()
    space.add_lwpolyline([(0, 0, 0), (60, 0, 0.4), (60, 40, 0), (0, 40, 0)], "xyb", close=True)
    space.add_circle((15, 20), 6)
    space.add_circle((40, 20), 5, dxfattribs={"layer": "Score"})
    space.add_line((2, 5), (58, 5), dxfattribs={"layer": "engrave"})
    document.saveas(folder / "plate.dxf")
    (folder / "curved.svg").write_text(CURVED, encoding="utf-8")
    (folder / "badge.svg").write_text(BADGE, encoding="utf-8")
    return folder


def layers(path: Path) -> dict[str, ET.Element]:
    """Layers of an SVG by their names, in their order."""
    root = parse_xml(path.read_bytes())
    return {group.get(LABEL, ""): group for group in root if MODE in group.attrib}


def lines_in(path: Path) -> dict[str, tuple[int, int]]:
    """Of each layer of a DXF how many circles and other lines it has."""
    space = ezdxf.readfile(path).modelspace()
    names = {one.dxf.layer for one in space} - {"container"}
    return {
        name: (len(space.query(f'CIRCLE[layer=="{name}"]')),
               len(space.query(f'LWPOLYLINE[layer=="{name}"]')))
        for name in names
    }  # fmt: skip


LINE = "nest 120x110mm plate.dxf*2 curved.svg badge.svg --kerf 1mm --passes 60"


def test_an_svg_holds_lines_alone_in_layers_by_what_is_done_with_them(
    shop: Path, packwork: Command
) -> None:
    result = packwork(f"{LINE} -o a.svg -o a.dxf -o a.pdf")
    assert result.exit_code == 0, result.output
    found = layers(shop / "a.svg")
    assert list(found) == ["sheet", "artwork", "Score", "engrave", "cut"]
    assert found.pop("sheet").get("display") == "none"
    colours = {name: group.get("stroke") for name, group in found.items()}
    assert (colours["cut"], colours["engrave"]) == ("#ff0000", "#0000ff")
    assert [one.get("stroke") for one in found["Score"]] == ["#00ff00"] * 2
    assert [one.get("stroke") for one in found["engrave"]] == [None] * 2
    assert [len(group) for group in found.values()] == [1, 2, 2, 4]
    for name in ("Score", "engrave", "cut"):
        assert found[name].get("fill") == "none"
        assert all("fill" not in one.attrib for one in found[name])
    # As many rings as the DXF has.
    rings = sum(one.get("d", "").count("M") for one in found["cut"])
    assert rings == sum(lines_in(shop / "a.dxf")["cut"]) == 7
    assert "<use" not in (shop / "a.svg").read_text(encoding="utf-8")


def test_bezier_curves_of_a_filled_part_stay_what_they_are(shop: Path, packwork: Command) -> None:
    assert packwork("nest 60x60mm curved.svg --rotate none --passes 2 -o a.svg").exit_code == 0
    (path,) = layers(shop / "a.svg")["cut"]
    assert path.get("d", "").startswith("M2 2L22 2C31 5 31 18 22 22L2 22ZM8 8C")


def test_an_svg_of_lines_is_a_nest_to_go_on_with(shop: Path, packwork: Command) -> None:
    assert packwork(f"{LINE} -o a.svg -o a.dxf -o a.geojson").exit_code == 0
    assert "certified" in packwork("measure a.svg").output
    one, other = (pw.Layout.load(shop / f"a.{kind}") for kind in ("svg", "geojson"))
    assert one.areas == pytest.approx(other.areas, rel=2e-4)
    assert all(isinstance(item.art, LineArt) for item in one.items)
    result = packwork("nest a.svg badge.svg --passes 900 -o b.svg -o b.dxf")
    assert result.exit_code == 0, result.output
    assert "go into a DXF as outlines" not in result.output
    before, after = lines_in(shop / "a.dxf"), lines_in(shop / "b.dxf")
    cut, more = before.pop("cut"), after.pop("cut")
    assert before == after == {"Score": (2, 0), "engrave": (0, 2)}
    assert (more[0], more[1]) == (cut[0], cut[1] + 1)
    found = layers(shop / "b.svg")
    assert [len(group) for group in found.values()] == [1, 2, 2, 2, 5]
    again = pw.Layout.load(shop / "b.svg")
    assert again.areas[:4] == pytest.approx(one.areas, rel=1e-7)


def test_paths_too_many_to_be_read_again_are_shared(
    shop: Path, packwork: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert packwork(f"{LINE} -o a.svg").exit_code == 0
    # Engraved lines count: the lines to cut alone would stand in full.
    most = sum(len(one.get("d", "")) for one in layers(shop / "a.svg")["cut"])
    monkeypatch.setattr("packwork.writers.svg_lines.MOST_IN_FULL", most)
    assert packwork(f"{LINE} -o b.svg -o b.pdf").exit_code == 0
    text = (shop / "b.svg").read_text(encoding="utf-8")
    assert (text.count("<use"), text.count(' id="shape-')) == (4, 3)
    assert "not certified" not in packwork("measure b.svg").output
    one, other = (pw.Layout.load(shop / f"{name}.svg") for name in "ab")
    assert other.areas == pytest.approx(one.areas, rel=1e-9)
    engraved = [
        [len(item.art.engraved) for item in layout.items if isinstance(item.art, LineArt)]
        for layout in (one, other)
    ]
    assert engraved == [[2, 2, 0, 0]] * 2


def test_a_layer_that_lost_a_part_is_told(shop: Path, packwork: Command) -> None:
    assert packwork(f"{LINE} -o a.svg").exit_code == 0
    text = (shop / "a.svg").read_text(encoding="utf-8")
    start = text.index('<path id="item-1"')
    (shop / "a.svg").write_text(text[:start] + text[text.index("<path", start + 1) :], "utf-8")
    said = " ".join(packwork("measure a.svg").output.split())
    assert "engraved lines of 1 part that is not there are left out" in said
    assert "not certified" in said
    said = " ".join(packwork("nest a.svg badge.svg --passes 2 -o b.packwork").output.split())
    assert "a.svg: engraved lines of 1 part that is not there are left out" in said


ENGRAVED = '<g id="engrave-1" data-lines="engrave"'


def changed_by(shop: Path, *edits: tuple[str, str]) -> tuple[list[str], list[list[str]]]:
    """What is said of a nest that was edited, and colours of the lines engraved on each part."""
    text = (shop / "a.svg").read_text(encoding="utf-8")
    for old, new in edits:
        assert old in text
        text = text.replace(old, new, 1)
    (shop / "b.svg").write_text(text, "utf-8")
    found = pw.Layout.load(shop / "b.svg")
    arts = [item.art for item in found.items if isinstance(item.art, LineArt)]
    colours = [[line.colour for line in art.engraved] for art in arts]
    return found.manifest["changed"], colours


def test_edits_of_what_goes_with_parts_are_followed_or_told(shop: Path, packwork: Command) -> None:
    assert packwork("nest 120x110mm plate.dxf*2 --passes 20 -o a.svg").exit_code == 0
    assert changed_by(shop) == ([], [["#00ff00", ""]] * 2)
    text = (shop / "a.svg").read_text(encoding="utf-8")
    _, other = re.findall(r'<path data-item="item-1"[^>]*/>', text)
    cut = re.findall(r'<path id="item-1"[^>]*/>', text)[0]
    off = "2 engraved lines that leave their parts are left out"
    moved = cut.replace('transform="', 'transform="translate(3 300)')
    assert changed_by(shop, (cut, moved)) == ([off], [[], ["#00ff00", ""]])
    away = f'{ENGRAVED} transform="translate(300 0)"'
    assert changed_by(shop, (ENGRAVED, away)) == ([off], [[""]] * 2)
    together = '<g id="items" transform="translate(9 0)"'
    assert len(changed_by(shop, ('<g id="items"', together))[0]) == 1
    assert changed_by(
        shop, ('<g id="items"', together), (ENGRAVED, f'{ENGRAVED} transform="translate(9 0)"'),
        ('<g id="engrave-2"', '<g id="engrave-2" transform="translate(9 0)"'),
    ) == ([], [["#00ff00", ""]] * 2)  # fmt: skip
    grouped = f'<g stroke="#ff00ff"><g id="g3">{other}</g></g>'
    assert changed_by(shop, (other, grouped)) == ([], [["#00ff00", "#ff00ff"], ["#00ff00", ""]])
    styled = other.replace("<path", '<path style="stroke:#00ffff;stroke-dasharray:none"')
    assert changed_by(shop, (other, styled)) == ([], [["#00ff00", "#00ffff"], ["#00ff00", ""]])


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ('<path data-item="item-1"', '<circle cx="9" cy="9" r="4"/><path data-item="item-1"',
         "1 <circle> beside the lines to cut, of no part, left out"),
        ('<path data-item="item-1"', '<path d="M0 0L90 90"/><path data-item="item-1"',
         "1 <path> beside the lines to cut, of no part, left out"),
        ("</svg>", '<g data-lines="artwork"><rect width="900" height="900"/></g></svg>',
         "1 <rect> beside the lines to cut, of no part, left out"),
        ("</svg>", '<g data-lines="artwork"><g data-item="item-9"/></g></svg>',
         "artwork of 1 part that is not there is left out"),
        ('<path data-item="item-1"', '<path style="stroke-width:90" data-item="item-1"',
         "1 engraved line is filled, or wider than 1 mm, which is not measured"),
        ('<path data-item="item-1"', '<path style="fill:red" data-item="item-1"',
         "1 engraved line is filled, or wider than 1 mm, which is not measured"),
        ('<path data-item="item-1"', '<path style="transform:scale(3)" data-item="item-1"',
         "what goes with a part: style (transform) changes what is drawn, and is not measured"),
        ('id="item-2"', 'id="item-1"',
         "1 id is that of several items, so that what goes with each is not known"),
    ],
)  # fmt: skip
def test_what_is_not_followed_beside_the_lines_to_cut_is_told(
    shop: Path, packwork: Command, old: str, new: str, told: str
) -> None:
    assert packwork("nest 120x110mm plate.dxf*2 --passes 2 -o a.svg").exit_code == 0
    assert told in changed_by(shop, (old, new))[0]
    assert "not certified" in packwork("measure b.svg").output


def test_artwork_that_leaves_its_part_is_told(shop: Path, packwork: Command) -> None:
    assert packwork("nest 120x110mm badge.svg --passes 2 -o a.svg").exit_code == 0
    assert changed_by(shop)[0] == []
    told, _ = changed_by(shop, ('<rect width="40"', '<rect width="60"'))
    assert told == ["artwork of 1 part that it leaves is left out"]
    picture = '<image width="900" height="9" href="data:image/png;base64,"/><rect'
    assert changed_by(shop, ("<rect", picture))[0] == []
    said = " ".join(packwork("measure b.svg").output.split())
    assert "what pictures, filters and masks paint on 1 part is not measured" in said


def test_layers_of_nests_are_strange_in_other_files(folder: Path, packwork: Command) -> None:
    assert packwork("fill square circle -n 3 --effort draft -o a.svg").exit_code == 0
    text = (folder / "a.svg").read_text(encoding="utf-8")
    beside = '<g data-lines="artwork"><rect width="900" height="900"/></g></svg>'
    (folder / "a.svg").write_text(text.replace("</svg>", beside), encoding="utf-8")
    said = " ".join(packwork("measure a.svg").output.split())
    assert "1 drawing outside the group items is not measured" in said


def test_engraved_lines_of_a_dxf_that_leave_their_part_are_told(
    shop: Path, packwork: Command
) -> None:
    assert packwork("nest 120x110mm plate.dxf*2 --passes 2 -o a.dxf").exit_code == 0
    assert "not certified" not in packwork("measure a.dxf").output
    document = ezdxf.readfile(shop / "a.dxf")
    document.modelspace().query('CIRCLE[layer=="Score"]')[0].dxf.radius = 50
    document.saveas(shop / "a.dxf")
    found = pw.Layout.load(shop / "a.dxf")
    assert found.manifest["changed"] == ["1 engraved line that leaves its part is left out"]
    assert "not certified" in packwork("measure a.dxf").output


def test_coordinates_beyond_all_sheets_are_refused() -> None:
    with pytest.raises(UnfitError, match="numbers up to"):
        list(arc_lines_of(f"M0 0L{'9' * 14} 0", 1e-6))
    with pytest.raises(UnfitError, match="numbers up to"):
        list(arc_lines_of(f"M0 0A1{'0' * 14} 1{'0' * 14} 0 0 1 1{'0' * 14} 0", 1e-6))


def test_curves_of_a_small_part_are_as_many_arcs_when_it_is_read_again(
    shop: Path, packwork: Command
) -> None:
    small = CURVED.replace('width="40mm" height="30mm"', 'width="4mm" height="3mm"')
    (shop / "small.svg").write_text(small, encoding="utf-8")
    assert packwork("nest 9x9mm small.svg --passes 2 -o a.svg -o a.dxf").exit_code == 0
    assert packwork("nest a.svg small.svg --passes 2 -o b.dxf").exit_code == 0
    first, again = (
        max(len(one) for one in ezdxf.readfile(shop / name).modelspace().query("LWPOLYLINE"))
        for name in ("a.dxf", "b.dxf")
    )
    assert again == first


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (r'd="M[^"]*"', 'd="M1"'), (r'd="M[^"]*"', 'd="M0 0A1 2"'), (r'd="M[^"]*"', 'd=""'),
        (r'd="M[^"]*"', 'd="M0 0L1.2.3 4L9 9Z"'), (r'd="M[^"]*"', f'd="M0 0L{"9" * 400} 0L9 9Z"'),
        (r'd="M[^"]*"', 'd="M0 0A0 0 0 0 1 9 9A1e300 1e300 0 0 1 0 0Z"'),
        (r"rotate\(90\)|translate", "scale(1 0)translate"), (r"scale\([^)]*\)", "scale(0)"),
        (r"scale\([^)]*\)", "scale(1e-300)"), (r'stroke="#[0-9a-f]*"', 'stroke="url(#x)"'),
        (r'data-item="item-1"', 'data-item=""'), (r'inkscape:label="Score"', 'x="2"'),
        (r'data-lines="artwork"', 'data-lines="engrave"'), (r"<path", "<rect"),
    ],
)  # fmt: skip
def test_what_another_hand_has_spoilt_is_read_or_refused_in_a_line(
    shop: Path, packwork: Command, old: str, new: str
) -> None:
    assert packwork(f"{LINE} -o a.svg").exit_code == 0
    text = (shop / "a.svg").read_text(encoding="utf-8")
    (shop / "b.svg").write_text(re.sub(old, new, text), encoding="utf-8")
    for line in ("measure b.svg", "nest b.svg badge.svg --passes 2 -o c.svg"):
        result = packwork(line)
        assert result.exit_code in {0, 1, 2}, result.output
        assert "Traceback" not in result.output
        assert result.exception is None or isinstance(result.exception, SystemExit)


def test_a_line_that_was_moved_is_measured_where_it_is(shop: Path, packwork: Command) -> None:
    assert packwork(f"{LINE} -o a.svg").exit_code == 0
    one = layers(shop / "a.svg")["cut"][0].get("transform", "")
    text = (shop / "a.svg").read_text(encoding="utf-8")
    other = layers(shop / "a.svg")["cut"][1].get("transform", "")
    (shop / "a.svg").write_text(
        text.replace(
            f'id="item-1" data-name="plate" transform="{one}"',
            f'id="item-1" data-name="plate" transform="{other}"',
        ),
        "utf-8",
    )
    assert packwork("measure a.svg").exit_code == 1


def test_strokes_of_a_pdf_are_hairlines_in_the_same_colours(shop: Path, packwork: Command) -> None:
    assert packwork("nest 120x110mm plate.dxf --passes 3 -o a.pdf").exit_code == 0
    with pikepdf.open(shop / "a.pdf") as pdf:
        content = b"".join(_contents(pdf.pages[0].obj))
    text = content.decode("latin-1")
    assert " f\n" not in text
    assert "\nf*" not in text
    assert text.count("S") >= 3


def _contents(page: pikepdf.Object) -> list[bytes]:
    found = [pikepdf.Page(page).contents_coalesce() or page.Contents.read_bytes()]
    forms = page.Resources.get("/XObject", {})
    return found + [form.read_bytes() for form in forms.values()]


def test_holes_that_nothing_lies_in_are_cut_in_every_file(shop: Path, packwork: Command) -> None:
    frame = [(0, 0), (40, 0), (40, 30), (0, 30)], [(10, 10), (20, 10), (20, 20), (10, 20)]
    found = pw.nest("60x50mm", [shapely.Polygon(frame[0], [frame[1]])], holes="fill", passes=2)
    found.save(shop / "a.svg")
    found.save(shop / "a.dxf")
    assert layers(shop / "a.svg")["cut"][0].get("d", "").count("M") == 2
    assert lines_in(shop / "a.dxf") == {"cut": (0, 2)}
    assert packwork("measure a.svg").exit_code == packwork("measure a.dxf").exit_code == 0


def test_arcs_of_a_path_are_read_as_they_were_written() -> None:
    (slot,) = arc_lines_of("M0 0L9 0A4 4 0 0 1 9 8L0 8Z", 1e-6)
    assert slot.bulges == pytest.approx([0, 1, 0, 0])
    (open_,) = arc_lines_of("M0 0A5 5 0 0 0 5 5", 1e-6)
    assert not open_.is_closed
    assert open_.bulges[0] == pytest.approx(-np.tan(np.pi / 8))


@pytest.mark.parametrize("odd", ["M1.2.3 4", "M1", "M1 2A3 4", "M1 2A1 1 0 0 1 - 3Z", "M1 1L..Z"])
def test_a_path_that_no_writer_of_ours_wrote_is_read_as_any(odd: str) -> None:
    good = "M0 0L9 0L9 9Z"
    assert len([*arc_lines_of(good, 1e-6)]) == 1
    assert len([*arc_lines_of(good + odd, 1e-6)]) >= 1


def test_arcs_of_large_radii_are_arcs() -> None:
    (made,) = arc_lines_of("M0 0A1.5e+06 1.5e+06 0 0 1 100 0L50 80Z", 1e-5)
    assert made.bulges[0] == pytest.approx(100 / 1.5e6 / 4, rel=1e-6)
