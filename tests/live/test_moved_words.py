"""A word of a cloud that is moved or scaled by hand: the cloud flows full again about it."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import packwork as pw
from packwork.live.face.templates import WORDS
from packwork.live.relayout import poured_again

NAMES = ["bear", "fox", "owl", "snail", "ant", "tiger"]
WEIGHTS = {f"{name}{end}": 1 / (k + 2) for k, name in enumerate(NAMES) for end in ("", "s", "y")}


@cache
def cloud(container: str, seed: int) -> pw.Layout:
    return pw.words(container, WEIGHTS, sizes="shared", padding=0, seed=seed, effort="draft")


@pytest.mark.parametrize(("container", "seed"), [("circle", 0), ("circle", 1), ("heart", 0)])
def test_the_largest_word_is_where_it_was_put_and_the_cloud_is_full(
    container: str, seed: int
) -> None:
    session = cloud(container, seed).edit()
    before = session.document
    k = int(np.argmax(before.areas))
    x, y = 300.0, 360.0 if before.poses.y[k] < 300 else 230.0
    session.move(int(before.ids[k]), x, y)
    assert session.finish().certified
    after = session.document
    is_there = (after.poses.x[k], after.poses.y[k]) == (x, y)
    assert is_there or "there is no room for it" in " ".join(session.unmet)
    assert np.hypot(after.poses.x[k] - x, after.poses.y[k] - y) < 60
    assert np.ptp(after.poses.scale / before.poses.scale) < 1e-9
    assert after.covered > before.covered - 0.08
    assert session.undo()
    assert session.document is before


def test_a_word_that_would_stick_out_comes_to_the_nearest_place_and_none_is_dwarfed() -> None:
    session = cloud("circle", 0).edit()
    before = session.document
    k = int(np.argmax(before.areas))
    session.move(int(before.ids[k]), 300, 20)
    assert session.finish().certified
    after = session.document
    (said,) = session.unmet
    assert "not at 300, 20: there is no room for it" in said
    assert abs(after.poses.x[k] - 300) < 20
    assert after.poses.y[k] < 200
    assert np.median(after.poses.scale / before.poses.scale) > 0.7


def test_a_word_that_is_to_be_larger_than_the_cloud_is_as_large_as_there_is_room() -> None:
    session = cloud("circle", 1).edit()
    before = session.document
    k = int(np.argmax(before.areas))
    session.scale(int(before.ids[k]), 9)
    assert session.finish().certified
    (said,) = session.unmet
    assert "not 9 times: there is no room for more" in said
    assert session.document.poses.scale[k] > before.poses.scale[k]
    assert session.document.covered > 0.5 * before.covered


def test_a_cloud_whose_sizes_give_way_is_as_full_poured_anew_or_in_another_font() -> None:
    words = dict(list(WORDS.items())[:16])
    layout = pw.words("bird", words, effort="draft")
    session = layout.edit()
    session.apply(poured_again(session.document, 1))
    assert session.finish().certified
    assert (session.document.poses.x != layout.poses.x).any()
    assert session.document.covered > 0.9 * layout.edit().document.covered
    session.words(words, font="DejaVu Serif")
    assert session.finish().certified
    fresh = pw.words("bird", words, font="DejaVu Serif", effort="draft")
    assert session.document.covered > 0.9 * fresh.edit().document.covered
