"""Rectangles that touch: certified where coordinates are exact, and nothing else with them."""

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.geometry.rectangles import ROUNDING, exact_boxes
from packwork.metrics.certificate import Promise, unclean
from packwork.metrics.measure import exact_of
from packwork.readers.engraving import Engraving
from packwork.readers.items import read_items
from packwork.readers.layouts.read import read_content
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.uses.tilings import is_straight
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
