"""Words whose sizes give way with hierarchy: ranks hold, nothing overlaps, thin shapes fill."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import packwork as pw
from packwork.errors import RecipeError
from packwork.pipeline import Run, run
from packwork.readers.words.shaping import EM_PX
from packwork.uses import read, words_recipe
from packwork.uses.words.graded import graded_places

NAMES = ("lorem", "ipsum", "dolor", "sit", "amet")
WEIGHTS = {f"{NAMES[k % 5]}{k}": 1 / (1 + k) for k in range(30)}
RING = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"><circle cx="50" cy="50" r="45" '
    'fill="none" stroke="black" stroke-width="6"/></svg>'
)
QUICK = {"effort": "draft", "sizes": "graded", "rotate": "mixed"}


def words(container: object = "heart", weights: object = WEIGHTS, **options: object) -> pw.Layout:
    return pw.words(container, weights, **{**QUICK, **options})  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def heart() -> pw.Layout:
    """Graded words in a heart."""
    return words()


@pytest.fixture(scope="module")
def bounded() -> pw.Layout:
    """The same with letters of bounded sizes."""
    return words(smallest=8, largest=40)


@pytest.fixture(scope="module")
def plain() -> pw.Layout:
    """Words in a heart, of whose sizes nothing is said."""
    return pw.words("heart", WEIGHTS, effort="draft")


def test_no_word_is_larger_than_a_heavier_one(heart: pw.Layout, bounded: pw.Layout) -> None:
    for layout in (heart, bounded):
        assert [item.name for item in layout.items] == list(WEIGHTS)
        assert (np.diff(layout.poses.scale) <= 1e-6).all()
        assert layout.manifest["certified"]


def test_the_report_says_how_far_from_true_each_is(heart: pw.Layout, plain: pw.Layout) -> None:
    of_true = heart.manifest["words"]["of_true"]
    heights = np.array(list(WEIGHTS.values()))
    expected = heart.poses.scale / heart.poses.scale[0] / (heights / heights[0])
    assert list(of_true.values()) == pytest.approx(expected.tolist(), abs=1e-4)
    assert plain.manifest["words"]["of_true"] == {}


def test_a_thin_shape_is_filled_more_than_by_true_sizes(tmp_path: Path) -> None:
    ring = tmp_path / "ring.svg"
    ring.write_text(RING, encoding="utf-8")
    graded, true = words(str(ring)), words(str(ring), sizes="shared")
    assert graded.metrics["LC"] > true.metrics["LC"]
    assert (np.diff(graded.poses.scale) <= 1e-6).all()


def test_letters_keep_their_bounds(bounded: pw.Layout) -> None:
    sizes = bounded.poses.scale * EM_PX
    assert sizes.max() <= 40 + 1e-9
    assert sizes.min() >= 8 - 1e-9


def test_words_that_find_no_place_are_named() -> None:
    layout = words(smallest=60)
    named = {one["item"] for one in layout.manifest["unplaced"]}
    assert named
    assert named | {item.name for item in layout.items} == set(WEIGHTS)


def test_words_that_are_not_there_are_not_repeated_in_voids() -> None:
    layout = words(smallest=60, target_coverage=0.9)
    gone = {one["item"] for one in layout.manifest["unplaced"] if one["item"] in WEIGHTS}
    assert gone
    assert not gone & {item.name for item in layout.items}
    assert layout.manifest["certified"]


def test_icons_among_words_take_their_turn() -> None:
    layout = words(add=["star"])
    assert "star" in {item.name for item in layout.items}
    assert layout.manifest["certified"]


def test_words_turn_as_asked() -> None:
    angles = words(rotate="20").poses.angle
    assert np.abs(angles).max() <= np.radians(20) + 1e-9
    assert len(set(np.round(angles, 6))) > 5


@pytest.mark.parametrize(
    "options",
    [
        {"losses": {"evenness": 1}},
        {"rules": [{"items": "lorem0", "pin": {"x": 300, "y": 100}}]},
        {"force": ["towards centre"]},
        {"start": "distance-field"},
        {"add": ["star"], "share": {"words": 3, "items": 1}},
    ],
)
def test_what_it_cannot_heed_is_refused_and_true_sizes_heed_it(options: dict) -> None:
    few = dict(list(WEIGHTS.items())[:6])
    with pytest.raises(RecipeError, match="sizes: graded sets words one after another"):
        words("ring", few, **options)
    # Where nobody asked for graded sizes, proportions are kept instead.
    layout = words("ring", few, sizes="auto", **options)
    assert not layout.manifest["words"]["of_true"]


def test_a_run_that_is_stopped_has_the_first_words() -> None:
    layout = words(stop=lambda: True)
    assert layout.items[0].name == "lorem0"


def test_thin_shapes_are_graded_by_default_and_fat_ones_true(plain: pw.Layout) -> None:
    thin = pw.words("ring", WEIGHTS, effort="draft")
    assert thin.manifest["words"]["of_true"]
    assert pw.words("ring", WEIGHTS, effort="draft", sizes="shared").manifest["words"] == {
        "found": 30,
        "asked": 30,
        "of_true": {},
    }
    assert not plain.manifest["words"]["of_true"]


def test_icons_alone_have_no_ranks() -> None:
    with pytest.raises(RecipeError, match="graded is for words"):
        pw.fill("heart", ["star"], sizes="graded")


def test_one_seed_gives_one_cloud(heart: pw.Layout) -> None:
    first, second = heart.poses, words().poses
    assert np.array_equal(first.x, second.x)
    assert np.array_equal(first.scale, second.scale)


def test_the_finish_shrinks_no_word() -> None:
    """The heaviest stood nearer to the edge than the padding asks, and was made small."""
    recipe = words_recipe("ring", WEIGHTS, effort="draft", padding="1%")
    job = read(recipe)
    places = graded_places(job, job.use.letters)  # type: ignore[attr-defined]
    layout = pw.words("ring", WEIGHTS, effort="draft", padding="1%")
    assert (layout.poses.scale >= places.poses.scale * (1 - 1e-6)).all()


def test_a_large_word_among_small_ones_stays_large() -> None:
    weights = {"lion": 9.0, **{f"ant{k}": 1 + 1 / (1 + k) for k in range(150)}}
    layout = words("heart", weights)
    sizes = layout.poses.scale * EM_PX
    assert layout.items[0].name == "lion"
    assert sizes[0] > sizes[1]
    assert (np.diff(sizes) <= 1e-6).all()


def test_proportions_give_way_until_words_can_be_read() -> None:
    weights = {f"{NAMES[k % 5]}{k}": 100.0 / (1 + k) for k in range(80)}
    layout = words("heart", weights)
    true = layout.manifest["words"]["of_true"]
    assert max(true.values()) > 1
    # True to its weight the lightest would have an eightieth of the heaviest's size.
    assert (layout.poses.scale > layout.poses.scale[0] / 40).mean() > 1 / 2


def _text(heavy: int, count: int) -> str:
    """A text in which one word is far heavier than all others."""
    rng = np.random.default_rng(1)
    letters = "bdfgklmnprst", "aeiou"
    words = {"".join(rng.choice(list(letters[k % 2])) for k in range(7)) for _ in range(4 * count)}
    rest = sorted(words)[:count]
    said = ["mountains"] * heavy + [word for k, word in enumerate(rest) for _ in range(2 + k % 4)]
    return ". ".join(rng.permutation(said).tolist())


def test_sizes_give_way_where_one_word_would_leave_the_container_bare() -> None:
    text = _text(heavy=90, count=50)
    found, true = (
        pw.words("heart", text, count=50, seed=0, effort="draft", **one)
        for one in ({}, {"sizes": "shared"})
    )
    assert found.metrics["bare"] < true.metrics["bare"]
    assert found.certified
    assert found.manifest["words"]["of_true"]
    few = pw.words("heart", text, count=30, seed=0, effort="draft")
    assert not few.manifest["words"]["of_true"]


def test_a_cloud_by_default_shows_its_shape_or_sizes_gave_way() -> None:
    """Where one word is far heavier than all others, the rest was specks at one side."""
    text = _text(heavy=40, count=40)
    found = pw.words("circle", text, count=40, seed=1, effort="draft")
    assert found.certified
    assert found.metrics["shape"] >= 0.9 or found.manifest["words"]["of_true"]
    true = pw.words("circle", text, count=40, seed=1, effort="draft", sizes="shared")
    assert found.metrics["shape"] >= true.metrics["shape"]


@pytest.fixture(scope="module")
def bar(tmp_path_factory: pytest.TempPathFactory) -> str:
    path = tmp_path_factory.mktemp("bar") / "bar.svg"
    drawn = '<path d="M0 0h100v3H0z"/>'
    path.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 3">{drawn}</svg>',
        encoding="utf-8",
    )
    return str(path)


def _run(container: str, count: int, **options: object) -> Run:
    """A cloud of so many words whose weights fall slowly."""
    weights = {f"{NAMES[k % 5]}{k}": (k + 3.0) ** -0.6 for k in range(count)}
    job = read(words_recipe(container, weights, count=count, **{**QUICK, **options}))
    return run(job)


@pytest.fixture(scope="module")
def apart(bar: str) -> Run:
    """A cloud of many words that keep a gap."""
    return _run(bar, 200, padding="1.8")


def test_many_words_stand_closer_unless_a_gap_is_asked_for(bar: str, apart: Run) -> None:
    """A share of the canvas left thousands of words no room between them, and most no place."""
    close, asked = _run(bar, 200), apart
    assert close.certified
    assert close.metrics.exact.min_gap < 1
    assert any("apart, not 1.8 px" in said for said in close.remarks)
    assert len(close.layout.items) > 150
    assert asked.metrics.exact.min_gap >= 1.8
    assert not any("apart" in said for said in asked.remarks)


def test_heavy_words_are_held_down_where_many_others_would_find_no_place(apart: Run) -> None:
    assert len(apart.layout.items) > 100
    assert (np.diff(apart.layout.poses.scale) <= 1e-6).all()
