"""Bounds of the words' font size: kept exactly, and what they leave out is named."""

from __future__ import annotations

import numpy as np
import pytest

import packwork as pw
from packwork.readers.words.shaping import EM_PX
from packwork.uses import fill, read, words_recipe
from packwork.uses.words.sizes import Letters, heaviest_of, readable_count
from packwork.uses.words.use import WordsUse

QUICK = {"levels": "50", "epochs": 20, "effort": "draft"}
WEIGHTS = {f"word{k}": 1.0 / k for k in range(1, 13)}
PT = 96 / 72


def sizes(layout: pw.Layout) -> np.ndarray:
    return layout.poses.scale * EM_PX


def test_words_too_small_are_left_out_by_name_and_the_others_grow() -> None:
    free = fill(words_recipe("circle", WEIGHTS, **QUICK))
    run = fill(words_recipe("circle", WEIGHTS, smallest="20pt", **QUICK))
    assert sizes(free.layout).min() < 20 * PT
    assert sizes(run.layout).min() >= 20 * PT
    kept = [item.name for item in run.layout.items]
    assert kept == list(WEIGHTS)[: len(kept)]
    assert [one.item for one in run.unplaced] == list(WEIGHTS)[len(kept) :]
    assert "px high, less than the 26.7 px of --smallest" in run.unplaced[0].reason
    assert not run.is_as_asked
    expected = np.array([WEIGHTS[name] for name in kept])
    assert sizes(run.layout) / sizes(run.layout)[0] == pytest.approx(expected, rel=1e-6)


def test_where_all_words_are_large_enough_nothing_changes() -> None:
    plain = fill(words_recipe("circle", WEIGHTS, **QUICK))
    bounded = fill(words_recipe("circle", WEIGHTS, smallest=0.5, largest="90%", **QUICK))
    assert bounded.certified
    assert bounded.layout.poses.x.tolist() == plain.layout.poses.x.tolist()


def test_the_largest_word_is_held_down_in_proportion_and_certified() -> None:
    run = fill(words_recipe("circle", WEIGHTS, largest="24pt", **QUICK))
    assert sizes(run.layout).max() == pytest.approx(24 * PT)
    assert len(run.layout.items) == 12
    assert sizes(run.layout) / sizes(run.layout)[-1] == pytest.approx(
        12 * np.array(list(WEIGHTS.values())), rel=1e-6
    )
    assert run.certified


def test_both_bounds_leave_out_what_proportions_forbid() -> None:
    run = fill(words_recipe("circle", WEIGHTS, smallest=5, largest=20, **QUICK))
    assert [item.name for item in run.layout.items] == ["word1", "word2", "word3", "word4"]


def test_words_that_are_left_out_leave_the_shares_of_kinds() -> None:
    share = {"words": 0.8, "items": 0.2}
    bounds = {"smallest": "20pt", "share": share}
    job = read(words_recipe("circle", WEIGHTS, add=["star", "moon"], **bounds, **QUICK))
    heights = np.sqrt(job.weights / np.array([item.outline.area for item in job.items]))
    assert isinstance(job.use, WordsUse)
    sizes = EM_PX * heights / heights.max()
    count = readable_count(job.use.read, 26.7, sizes[: len(WEIGHTS)], 1)
    fewer = heaviest_of(job, count, sizes[: len(WEIGHTS)], 26.7)
    count = len(fewer.use.words)
    assert count < len(WEIGHTS)
    assert fewer.weights[:count].sum() == pytest.approx(0.8)


def test_letters_count_in_the_unit_of_the_canvas() -> None:
    job = read(words_recipe("circle", WEIGHTS, canvas="100mm", smallest="9pt", **QUICK))
    assert isinstance(job.use, WordsUse)
    assert job.use.letters == Letters(smallest=pytest.approx(9 * 25.4 / 72))


def test_bounds_alone_put_no_copies_into_voids() -> None:
    assert not words_recipe("circle", WEIGHTS, smallest="2pt").fills_gaps


def test_copies_in_voids_are_no_smaller_either() -> None:
    run = fill(words_recipe("circle", WEIGHTS, smallest=6, max_items=20, **QUICK))
    assert len(run.layout.items) > len(WEIGHTS) - len(run.unplaced)
    assert sizes(run.layout).min() >= 6 * (1 - 1e-9)


def test_icons_among_the_words_stay() -> None:
    run = fill(words_recipe("circle", WEIGHTS, add=["star"], smallest="20pt", **QUICK))
    assert run.unplaced
    assert run.layout.items[-1].name == "star"


def test_each_attempt_keeps_fewer_words() -> None:
    job = read(words_recipe("circle", WEIGHTS, smallest=1, **QUICK))
    poses = fill(job.recipe).layout.poses
    tiny = type(poses)(poses.x, poses.y, poses.angle, 0.9 * poses.scale)
    least = 0.95 * float(poses.scale[-1]) * EM_PX
    assert isinstance(job.use, WordsUse)
    words = job.use.read
    assert [readable_count(words, least, EM_PX * tiny.scale, k) for k in (1, 3)] == [11, 8]
    assert readable_count(words, least, EM_PX * poses.scale, 1) == len(words.items)
    assert heaviest_of(job, len(words.items), poses.scale, least) is job


@pytest.mark.parametrize(
    ("options", "problem"),
    [
        ({"smallest": "5%", "largest": "2%"}, "smallest: is 30, more than the 12 of largest"),
        ({"smallest": 0}, "smallest: must be more than nothing"),
        ({"largest": "tall"}, "largest: "),
        ({"largest": 9, "sizes": "free"}, "largest: bounds words in proportion"),
        ({"smallest": 500}, "smallest: not even 'word1' can be so large"),
    ],
)
def test_bounds_that_cannot_be_are_one_clear_line(options: dict, problem: str) -> None:
    with pytest.raises(pw.RecipeError) as caught:
        pw.words("circle", WEIGHTS, **{**QUICK, **options})
    assert str(caught.value).startswith(problem)
