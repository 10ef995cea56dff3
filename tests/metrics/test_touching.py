"""Rectangles that touch: certified where coordinates are exact, and nothing else with them."""

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from packwork.arrays import FloatArray
from packwork.errors import ReadError
from packwork.geometry.outline import Outline
from packwork.geometry.rectangles import ROUNDING, exact_boxes
from packwork.live.certificate import Certificate
from packwork.live.document import Document
from packwork.live.face.exporting import kept_bytes
from packwork.live.file.session_file import read_session
from packwork.live.session import Session
from packwork.metrics.certificate import Promise, unclean
from packwork.metrics.measure import exact_of
from packwork.readers.engraving import Engraving
from packwork.readers.items import read_items
from packwork.readers.layouts.read import read_content
from packwork.scene.container import Container, repeating
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.uses.tilings import is_straight
from packwork.writers.dxf import dxf_bytes
from packwork.writers.geojson import geojson_text
from packwork.writers.svg import svg_text


def _cut(box: FloatArray, count: int, rng: np.random.Generator) -> list[FloatArray]:
    """A box in parts, by cuts through it."""
    if count == 1:
        return [box]
    axis = int(np.ptp(box.reshape(2, 2), axis=0).argmax())
    first, second = box.copy(), box.copy()
    first[2 + axis] = second[axis] = box[axis] + rng.uniform(0.3, 0.7) * (box[2 + axis] - box[axis])
    few = int(rng.integers(1, count))
    return [*_cut(first, few, rng), *_cut(second, count - few, rng)]


def _layout(
    boxes: Sequence[Sequence[float]], size: tuple[float, float], *, coarseness: float = 0.0,
    more: Sequence[Outline] = (),
) -> Layout:  # fmt: skip
    outlines = [Outline.box(*box) for box in boxes]
    items = [Item("tile", outline=one, coarseness=coarseness) for one in outlines]
    items = [replace(one, outline=one.outline.mapped(_back(one.outline)),
                     ink=one.outline.mapped(_back(one.outline))) for one in items]  # fmt: skip
    outlines += more
    items += [Item("disc", outline=one.mapped(_back(one))) for one in more]
    x, y = np.array([one.centroid for one in outlines]).T
    poses = Poses(x, y, np.zeros(len(x)), np.ones(len(x)))
    ground = Container("sheet", "sheet", Outline.box(0, 0, *size), *size, "mm")
    promised = {"promised": {"gap": 0.0, "areas_in_shares": False}}
    return Layout(ground, tuple(items), poses, np.ones(len(x)), promised)


def _back(outline: Outline) -> FloatArray:
    x, y = outline.centroid
    return np.array([[1.0, 0.0, -x], [0.0, 1.0, -y]])


def _faults(layout: Layout, gap: float = 0.0) -> tuple[str, ...]:
    return unclean(Promise(gap), layout, exact_of(layout))


@pytest.mark.parametrize("seed", range(20))
def test_a_sheet_in_parts_is_certified_and_stays_so_in_files(seed: int) -> None:
    rng = np.random.default_rng(seed)
    size = float(rng.uniform(1, 900)), float(rng.uniform(1, 900))
    layout = _layout(_cut(np.array([0.0, 0.0, *size]), int(rng.integers(2, 40)), rng), size)
    assert _faults(layout) == ()
    assert exact_of(layout).coverage == pytest.approx(1.0, abs=1e-12)
    for text, name in ((svg_text(layout), "a.svg"), (geojson_text(layout), "a.geojson")):
        found = read_content(text.encode(), name)
        assert _faults(found) == (), name


@pytest.mark.parametrize(
    ("boxes", "said"),
    [
        # Less than what is taken for rounding, and ten times that.
        ([(0, 0, 50, 100), (50 - 40 * ROUNDING, 0, 100, 100)], ""),
        ([(0, 0, 50, 100), (50 - 1e3 * ROUNDING, 0, 100, 100)], "overlap"),
        ([(0, 0, 100 + 1e3 * ROUNDING, 100)], "stick out"),
        ([(0, 0, 50, 50), (50, 50, 100, 100), (0, 50, 50 + 1e-9, 100)], "overlap"),
    ],
)
def test_an_overlap_beyond_rounding_is_one(boxes: list[Sequence[float]], said: str) -> None:
    found = " ".join(_faults(_layout(boxes, (100, 100))))
    assert said in found
    assert bool(said) == bool(found)


def test_what_is_not_exact_keeps_a_hair() -> None:
    halves = [(0, 0, 50, 100), (50, 0, 100, 100)]
    assert "smallest gap" in _faults(_layout(halves, (100, 100), coarseness=1.0))[0]
    assert "smallest gap" in _faults(_layout(halves, (100, 100)), gap=0.5)[0]
    apart_by = [(10, 10, 50, 90), (50.5 - 1e-11, 10, 90, 90)]
    assert _faults(_layout(apart_by, (100, 100)), gap=0.5) == ()
    apart_by = [(10, 10, 50, 90), (50.5 - 1e-9, 10, 90, 90)]
    assert "smallest gap" in _faults(_layout(apart_by, (100, 100)), gap=0.5)[0]
    angle = np.arange(64) * (2 * math.pi / 64)
    disc = Outline.from_rings([np.column_stack([75 + 25 * np.cos(angle), 50 + 25 * np.sin(angle)])])
    beside = _layout(halves[:1], (120, 100), more=[disc])
    assert "smallest gap is 0 instead" in _faults(beside)[0]
    apart = _layout(halves[:1], (120, 100), more=[disc.mapped(np.array([[1, 0, 1], [0, 1, 0.0]]))])
    assert _faults(apart) == ()
    assert exact_of(apart).min_gap == 0.0
    turned = replace(apart, poses=replace(apart.poses, angle=np.array([math.pi, 0.0])))
    assert _faults(turned) == ()
    askew = [Outline.from_rings([[[50, 0], [100, 50], [50, 100], [0, 50]]])]
    assert exact_boxes(askew) is None


def test_a_file_whose_numbers_overlap_is_not_certified() -> None:
    layout = _layout([(0, 0, 50, 100), (50, 0, 100, 100)], (100, 100))
    text = svg_text(layout)
    assert "translate(75 50)" in text
    nearer = text.replace("translate(75 50)", "translate(74.999999999 50)")
    assert "overlap" in _faults(read_content(nearer.encode(), "a.svg"))[0]
    # Sides that bulge by less than a curve is followed.
    curved = text.replace("M-25 -50 25 -50 25 50", "M-25 -50 25 -50C25.00001 -9 25.00001 9 25 50")
    assert curved != text
    assert _faults(read_content(curved.encode(), "a.svg")) != ()


FAR = 2.0**23
"""Doubles there are 1.9e-9 apart."""


def test_places_of_numbers_so_large_that_they_swallow_overlaps_keep_a_hair() -> None:
    halves = _layout([(0, 0, 50, 100), (50, 0, 100, 100)], (100, 100))
    assert _faults(halves) == ()
    away, back = np.array([[1.0, 0, FAR], [0, 1, 0]]), np.array([[1.0, 0, -FAR], [0, 1, 0]])
    items = [replace(one, outline=one.outline.mapped(away), ink=one.outline.mapped(away))
             for one in halves.items]  # fmt: skip
    far = replace(halves, items=tuple(items), poses=halves.poses.moved(-FAR, 0.0))
    assert "smallest gap is 0 instead" in _faults(far)[0]
    text = geojson_text(halves)
    for place in ('"x":25', '"x":75', '"x": 25', '"x": 75'):
        text = text.replace(place, f'"x": {FAR:.0f}')
    assert "smallest gap is 0 instead" in _faults(read_content(text.encode(), "a.geojson"))[0]
    assert far.items[0].outline.mapped(back).extent == 100


@pytest.mark.parametrize(
    ("ours", "theirs"),
    [
        ('d="M-25 -50', f'd="M{FAR:.0f} 0m-{FAR + 25:.0f} -50 0 0M-25 -50'),
        ("translate(25 50)", f"translate({FAR:.0f} 50) translate({25 - FAR:.0f} 0)"),
        ("translate(25 50)", f"translate({FAR:.0f} 50)matrix(1 0 0 1 {25 - FAR:.0f} 0)"),
        ("translate(25 50)", f"translate({FAR:.0f} 50)"),
        ('<g id="items"', f'<g transform="translate({FAR:.0f} 0)" id="items"'),
    ],
)
def test_paths_and_transforms_there_and_back_are_not_exact(ours: str, theirs: str) -> None:
    text = svg_text(_layout([(0, 0, 50, 100), (50, 0, 100, 100)], (100, 100)))
    assert read_content(text.encode(), "a.svg").items[0].coarseness == 0.0
    assert ours in text
    found = read_content(text.replace(ours, theirs).encode(), "a.svg")
    assert found.items[0].coarseness > 0.0 or _faults(found) != ()


def test_a_sheet_so_high_that_its_turn_swallows_overlaps_is_not_exact() -> None:
    text = (
        dxf_bytes(_layout([(0, 0, 50, 100), (50, 0, 100, 100)], (100, 100)))
        .decode("cp1252")
        .replace("\r", "")
    )
    assert _faults(read_content(text.encode(), "a.dxf")) == ()

    def high(size: str) -> bytes:
        lines = text.split("\n")
        at = next(k for k, line in enumerate(lines) if line.strip() == "$LIMMAX")
        lines[at + 4] = size
        return "\n".join(lines).encode()

    assert _faults(read_content(high("8e6"), "a.dxf")) != ()
    with pytest.raises(ReadError, match=r"1e\+17; up to 1e\+07"):
        read_content(high("1e17"), "a.dxf")


def test_a_session_certifies_what_a_measure_does() -> None:
    halves = _layout([(30, 30, 50, 70), (50, 30, 70, 70)], (100, 100))
    angle = np.arange(64) * (2 * math.pi / 64)
    disc = Outline.from_rings([50 + 50 * np.column_stack([np.cos(angle), np.sin(angle)])])
    round_one = replace(halves, container=replace(halves.container, outline=disc))
    over = replace(round_one, poses=replace(halves.poses, x=np.array([40.0, 59.99])))
    whole = _layout([(0, 0, 50, 100), (50, 0, 100, 100)], (100, 100))
    for layout, is_clean in ((round_one, True), (over, False), (whole, True)):
        assert (_faults(layout) == ()) is is_clean
        assert (Certificate().in_the_way(Document.from_layout(layout)) == ()) is is_clean
    tile = _layout([(20, 0, 120, 90)], (100, 100))
    tile = replace(tile, container=repeating(tile.container, "square"))
    assert _faults(tile) != ()
    assert Certificate().in_the_way(Document.from_layout(tile)) != ()


def test_a_session_file_is_not_believed_that_curves_are_straight(tmp_path: Path) -> None:
    file, path = tmp_path / "a.svg", "M0 0C3 -0.000001 6 -0.000001 9 0L9 9L0 9Z"
    file.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg" width="9mm" height="9mm" viewBox="0 0 9 9">'
        f'<path d="{path}"/></svg>', encoding="utf-8",
    )  # fmt: skip
    bent = read_items(str(file), holes="keep", engraving=Engraving()).items[0]
    layout = _layout([(0, 0, 50, 100), (50, 0, 100, 100)], (100, 100))
    layout = replace(layout, items=(layout.items[0], replace(bent, coarseness=0.0)))
    read, _ = read_session(kept_bytes(Session(Document.from_layout(layout)).kept()), "a.packwork")
    assert [one.coarseness for one in read.document.items] == [0.0, 1.0]


def test_sides_that_bulge_are_not_straight(tmp_path: Path) -> None:
    def read(path: str) -> Item:
        file = tmp_path / "a.svg"
        file.write_text(
            '<svg xmlns="http://www.w3.org/2000/svg" width="9mm" height="9mm" viewBox="0 0 9 9">'
            f'<path d="{path}"/></svg>', encoding="utf-8",
        )  # fmt: skip
        return read_items(str(file), holes="keep", engraving=Engraving()).items[0]

    bulging = read("M0 0C3 -0.000001 6 -0.000001 9 0L9 9L0 9Z")
    assert not is_straight(bulging)
    assert not is_straight(read("M0 0A9e6 9e6 0 0 1 9 0L9 9L0 9Z"))
    assert is_straight(read("M0 0H9V9H0Z"))
