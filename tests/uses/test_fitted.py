"""Words of one common scale stand apart by their letters."""

from __future__ import annotations

import numpy as np
import pytest

import packwork as pw
from packwork.geometry.outline import Outline
from packwork.readers.words.shaping import EM_PX
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.uses.words.fitted import BESIDE, FEW_BETWEEN, OF_ONE_COLOUR
from packwork.uses.words.grown import barred

NAMES = ("harbour", "tide", "gull", "mast", "rope", "oar", "in", "of")
WORDS = {f"{NAMES[k % 8]}{chr(97 + k // 8)}": (k + 1) ** -0.5 for k in range(40)}


def _gaps(layout: pw.Layout) -> np.ndarray:
    """Gaps beside each other of words that share most of a line, in ems of the smaller one."""
    boxes = np.array([outline.bounds for outline in layout.outlines])
    left, top, right, bottom = boxes.T
    ems = EM_PX * layout.poses.scale
    found = []
    for k in range(len(boxes)):
        shared = np.minimum(bottom, bottom[k]) - np.maximum(top, top[k])
        is_line = shared > 0.7 * np.maximum(bottom - top, bottom[k] - top[k])
        gap = (left - right[k])[is_line]
        found.append((gap / np.minimum(ems, ems[k])[is_line])[gap > 0])
    return np.concatenate(found)


@pytest.fixture(scope="module")
def wide() -> pw.Layout:
    """Words two units apart, and their film."""
    return pw.words("circle", WORDS, sizes="shared", padding="2", effort="draft", record=True)


def test_words_of_a_line_stand_apart_whatever_their_size(wide: pw.Layout) -> None:
    layout = pw.words("circle", WORDS, sizes="shared", padding="0", effort="draft")
    assert layout.manifest["certified"]
    assert layout.manifest["start"] == "first-fit"
    assert _gaps(layout).min() > 0.9 * BESIDE
    sizes = layout.poses.scale / layout.poses.scale[0]
    np.testing.assert_allclose(sizes, list(WORDS.values()), rtol=1e-6)
    # Where room is asked for there is less for the words.
    assert layout.poses.scale[0] > wide.poses.scale[0]


def test_words_of_one_colour_stand_further_apart() -> None:
    layout = pw.words("circle", WORDS, sizes="shared", palette="black", effort="draft")
    assert layout.manifest["certified"]
    assert _gaps(layout).min() > 0.9 * OF_ONE_COLOUR * BESIDE


def test_few_words_do_not_run_together() -> None:
    names = dict.fromkeys(NAMES, 1.0)
    asked = {"sizes": "shared", "effort": "draft"}
    apart, near = (pw.words("circle", names, **asked, **more) for more in ({}, {"padding": "0.3%"}))
    em = EM_PX * float(apart.poses.scale.min())
    assert apart.manifest["certified"]
    assert apart.metrics["exact"]["min_gap"] > 0.7 * FEW_BETWEEN * em
    assert near.metrics["exact"]["min_gap"] < 0.5 * FEW_BETWEEN * em


@pytest.mark.parametrize(("canvas", "palette", "times"), [
    ("10x1000", None, 1.0), ("6x1000", "black,black", OF_ONE_COLOUR),
])  # fmt: skip
def test_few_words_of_a_thin_page_stand_apart_by_their_letters(
    canvas: str, palette: str | None, times: float
) -> None:
    asked = {"sizes": "shared", "canvas": canvas, "effort": "draft"}
    layout = pw.words("page", dict.fromkeys(NAMES, 1.0), palette=palette, **asked)
    gap = layout.metrics["exact"]["min_gap"] / (EM_PX * float(layout.poses.scale.min()))
    assert 0.9 * times < gap / FEW_BETWEEN < 1.5 * times


def test_a_padding_that_is_asked_for_is_kept(wide: pw.Layout) -> None:
    assert wide.manifest["certified"]
    assert wide.metrics["exact"]["min_gap"] >= 2.0
    assert _gaps(wide).min() > BESIDE


def test_a_film_shows_such_words_come_in(wide: pw.Layout) -> None:
    assert wide.track is not None
    assert 0 < (wide.track.at(0.3).scale > 0).sum() < len(WORDS)


def test_words_grow_until_they_touch_and_keep_the_room_beside(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def fitted() -> pw.Layout:
        return pw.words("heart", WORDS, sizes="shared", effort="draft")

    # Those that lie loosely have grown apart already.
    monkeypatch.setattr("packwork.start.first_fit.tiled.MOST_LOOSE", 0)
    grown = fitted()
    monkeypatch.setattr("packwork.uses.words.grown.MOST_GROWN", 0)
    left = fitted()
    assert grown.manifest["certified"]
    assert grown.poses.scale[0] > 1.003 * left.poses.scale[0]
    assert _gaps(grown).min() > 0.8 * BESIDE


def test_bars_reach_half_of_the_room_and_not_beyond_the_edge() -> None:
    box = Outline.box(-10.0, -5.0, 10.0, 5.0)
    wall = Container("", "", Outline.box(0.0, 0.0, 60.0, 20.0), 60.0, 20.0)
    poses = Poses(np.array([10.5, 34.5]), np.full(2, 10.0), np.zeros(2), np.ones(2))
    first, second = barred([box, box], poses, 6.0, 0.0, wall)
    # Four units lie between them; left of the first is the edge, right of the second there is room.
    assert first.bounds == pytest.approx((-10, -5, 12, 5))
    assert second.bounds == pytest.approx((-12, -5, 13, 5))
