"""Words along limbs and edges, and text round them: certified, readable, near everywhere."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import shapely

import packwork as pw
from packwork.errors import RecipeError
from packwork.geometry.curves import Curve
from packwork.metrics.violations import Violation
from packwork.pipeline import run
from packwork.progress import never
from packwork.readers.container import read_container
from packwork.readers.layouts.svg import layout_of_svg
from packwork.readers.words.items import word_fonts
from packwork.readers.words.options import WordOptions
from packwork.readers.words.shaping import EM_PX
from packwork.readers.words.word import Word
from packwork.start.lanes import WordOnLine
from packwork.start.limbs import edges_of
from packwork.uses import read, words_recipe
from packwork.uses.words import line_of_words

LICENCE = Path(pw.__file__).with_name("bundled") / "fonts" / "LICENCE-Inter.txt"
SPIRAL = Path(pw.__file__).with_name("bundled") / "icons" / "spiral.svg"
FEW = {"honey": 3.0, "bear": 2.0, "bee": 1.0}


def weights(seed: int, count: int = 40) -> dict[str, float]:
    """Words of random lengths, whose weights fall off slowly or quickly, two by two."""
    rng = np.random.default_rng(seed)
    exponent, lengths = rng.uniform(0.3, 1.2), rng.integers(2, 11, count)
    return {
        "".join(rng.choice(list("aegnorst"), length)) + f"{k:x}": (1 + k // 2) ** -exponent
        for k, length in enumerate(lengths)
    }


def points(layout: pw.Layout) -> np.ndarray:
    """Font sizes on a sheet in millimetres."""
    return np.asarray(layout.poses.scale * EM_PX / 25.4 * 72)


@pytest.fixture(scope="module")
def spiral() -> pw.Layout:
    return pw.words(SPIRAL, LICENCE, along="limbs", smallest="6pt", canvas="210x297mm")


def test_a_hundred_words_of_a_licence_can_be_read_in_a_spiral(spiral: pw.Layout) -> None:
    assert spiral.manifest["certified"]
    assert len({item.name for item in spiral.items}) == 100
    assert points(spiral).min() >= 6


def test_nine_tenths_of_the_limb_are_near_a_word(spiral: pw.Layout) -> None:
    assert spiral.metrics["bare"] < 0.1


def test_no_word_stands_on_its_head(spiral: pw.Layout) -> None:
    assert np.cos(spiral.poses.angle).min() > -0.2


def test_heavy_words_are_larger(spiral: pw.Layout) -> None:
    sizes = points(spiral)
    assert np.median(sizes[:10]) > 2 * np.median(sizes[-50:])


def test_the_lightest_words_are_not_set_again_beyond_others() -> None:
    names = ["mountain", "river", "forest", "meadow", "valley", "lake"]
    names += ["stone", "cloud", "rain", "snow", "wind", "mist"]
    words = dict(zip(names, [30.0, 22, 18, 14, 11, 9, 7, 5, 4, 3, 2, 1], strict=True))
    layout = run(read(words_recipe("ring", words, along="limbs"))).layout
    often = [sum(item.name == word for item in layout.items) for word in words]
    assert len(layout.items) < 5 * len(words)
    assert max(often[:6]) > 1
    assert max(often) <= 15


def test_the_edge_of_a_hole_is_followed_too() -> None:
    container = read_container("ring")
    rows = edges_of(container, 0.05 * container.side)
    assert len(rows) == 2
    x, y = container.outline.centroid
    outer, inner = (np.hypot(*(row.axis.points - [x, y]).T).mean() for row in rows)
    layout = run(read(words_recipe("ring", weights(3), along="edge"))).layout
    away = np.hypot(layout.poses.x - x, layout.poses.y - y)
    for radius in (outer, inner):
        assert np.sum(np.abs(away - radius) < 0.03 * container.side) >= 5


def test_few_words_are_set_in_turn_until_the_limb_is_full() -> None:
    words = {"spiral": 9.0, "turn": 7.0, "arm": 6.0, "line": 5.0, "wave": 4.0, "bend": 2.0}
    done = run(read(words_recipe(str(SPIRAL), words, along="limbs")))
    layout = done.layout
    often = [sum(item.name == word for item in layout.items) for word in words]
    assert min(often) > 1
    assert max(often) <= 2 * min(often)
    said = [one for one in done.remarks if "set again" in one]
    assert said == [
        f"{len(layout.items) - 6} words are set again, until the line is full; "
        f"{len(layout.items)} different ones would fill it, and --repeat auto what lies beside it"
    ]


def test_words_that_would_fill_a_line_are_counted_without_the_cloud_beside_it() -> None:
    words = {"solo": 9.0, "chord": 7.0, "fret": 6.0, "bass": 5.0, "tone": 4.0}
    done = run(read(words_recipe("seahorse", words, along="limbs", effort="draft")))
    upright = (np.abs(done.layout.poses.angle) < 1e-9).sum()
    assert upright > 1
    said = next(one for one in done.remarks if "set again" in one)
    assert f"; {len(done.layout.items) - upright} different ones would fill it" in said


@pytest.mark.parametrize("seed", [0, 2])
def test_along_a_limb_no_word_is_larger_than_a_heavier_one(seed: int) -> None:
    known = weights(seed)
    layout = pw.words(SPIRAL, known, along="limbs")
    rising = sorted(zip(layout.items, layout.poses.scale, strict=True), key=lambda one: one[1])
    # Of words that are set again the largest.
    largest = {item.name: scale for item, scale in rising}
    weight, size = np.array([(known[name], scale) for name, scale in largest.items()]).T
    heavier = weight[:, None] > weight[None] * (1 + 1e-9)
    assert layout.certified
    assert (size[:, None] / size[None])[heavier].min() > 0.94
    assert not layout.manifest.get("advice")


def test_small_copies_of_a_word_hold_no_others_down(monkeypatch: pytest.MonkeyPatch) -> None:
    fonts, axis = word_fonts(WordOptions(source=FEW)), Curve.through(np.array([[0.0, 0], [999, 0]]))
    line = line_of_words.LineOfWords([Word("bear", 2.0), Word("bee", 1.0)], (), fonts, "fill")
    found = [
        WordOnLine(word, axis, at, at + 3 * size, size)
        for word, at, size in [(0, 100.0, 40.0), (1, 300.0, 36.0), (0, 600.0, 9.0)]
    ]
    wrong = iter([[Violation(2, None, 1.0, 0.0)], []])
    monkeypatch.setattr(line_of_words, "violations", lambda *_: next(wrong))
    bent = line.bent(found, read_container("circle"), 0.0, never, np.array([2.0, 1.0]))
    assert (bent.poses.scale * EM_PX).tolist() == pytest.approx([40, 36, 9 * line_of_words.SHRUNK])


def test_few_words_are_set_again_and_read_back(tmp_path: Path) -> None:
    layout = pw.words("snake", FEW, along="limbs", effort="draft")
    assert layout.manifest["certified"]
    assert len(layout.items) > 6
    assert len({item.name for item in layout.items}) == 3
    layout.save(tmp_path / "snake.svg")
    again = layout_of_svg((tmp_path / "snake.svg").read_bytes(), "snake.svg")
    assert [item.name for item in again.items] == [item.name for item in layout.items]


def test_what_is_wide_is_a_cloud() -> None:
    layout = pw.words("guitar", weights(1), along="limbs", seed=1)
    is_upright = np.abs(layout.poses.angle) < 1e-9
    assert layout.manifest["certified"]
    assert is_upright.sum() > 10
    assert (~is_upright).sum() > 5


def test_one_word_follows_a_limb_though_most_is_wide() -> None:
    layout = pw.words("guitar", {"solo": 1.0}, along="limbs")
    assert layout.manifest["certified"]
    assert {item.name for item in layout.items} == {"solo"}


def test_words_lie_all_round_a_ring_the_heaviest_at_its_top(tmp_path: Path) -> None:
    path = "M300 20a280 280 0 1 0 .01 0zM300 110a190 190 0 1 1 -.01 0z"
    drawn = f'<svg viewBox="0 0 600 600"><path fill-rule="evenodd" d="{path}"/></svg>'
    (tmp_path / "ring.svg").write_text(drawn, encoding="utf-8")
    layout = pw.words(tmp_path / "ring.svg", weights(0), along="limbs", canvas=600)
    assert layout.certified
    turns = np.linspace(0, 2 * np.pi, 100)
    middle = shapely.points(300 + 235 * np.cos(turns), 300 + 235 * np.sin(turns))
    words = shapely.union_all([outline.region for outline in layout.outlines])
    assert shapely.distance(middle, words).max() < 45
    heights, y = layout.poses.scale, layout.poses.y
    top, bottom = heights[y < 200], heights[y > 400]
    assert np.median(top) > 1.3 * np.median(bottom)


@pytest.mark.parametrize("seed", [0, 1])
def test_words_along_an_edge_lie_all_round(seed: int) -> None:
    known = {f"word{k}": weight for k, weight in enumerate(weights(seed).values())}
    layout = pw.words("circle", known, along="edge", seed=seed)
    bent = np.abs(layout.poses.angle) > 1e-9
    x, y = layout.poses.x[bent], layout.poses.y[bent]
    middle = layout.container.width / 2
    turns = np.sort(np.arctan2(y - middle, x - middle))
    assert layout.manifest["certified"]
    assert np.diff(turns).max() < 1.0


def test_texts_run_round_the_top_and_the_bottom() -> None:
    layout = pw.words("circle", FEW, ring=("HONEY CLUB", "SINCE 1974"))
    top, bottom = layout.items[-2:]
    assert (top.name, bottom.name) == ("HONEY CLUB", "SINCE 1974")
    y = layout.poses.y[-2:] / layout.container.height
    assert y[0] < 0.3
    assert y[1] > 0.7
    assert np.cos(layout.poses.angle[-2:]).min() > 0.99
    assert layout.manifest["certified"]
    assert layout.manifest["words"]["asked"] == 3


@pytest.mark.parametrize(
    ("container", "options", "message"),
    [
        ("circle", {"along": "limbs"}, "has no limbs"),
        ("snake", {"along": "limbs", "sizes": "shared"}, "leave out sizes shared$"),
        ("snake", {"along": "limbs", "hero": "bee", "force": "down"}, "leave out hero, force$"),
        (SPIRAL, {"along": "limbs", "rotate": "free"}, "turns no word that follows a line"),
        ("circle", {"ring": ("A", "B", "C")}, "at the top and one at the bottom, not 3"),
        ("snake", {"along": "limbs", "add": ["star"]}, "sets words alone"),
        ("snake", {"along": "limbs", "padding": "40%"}, "wider than the padding"),
        ("snake", {"along": "limbs", "smallest": 400}, "no word to be read"),
        (SPIRAL, {"ring": "ROUND"}, "ring"),
        ("circle", {"ring": " | "}, "has no letters"),
        ("circle", {"ring": "\U0010fffd"}, "no font"),
    ],
)
def test_what_cannot_be_is_refused(
    container: object, options: dict[str, object], message: str
) -> None:
    with pytest.raises(RecipeError, match=message):
        pw.words(container, FEW, **options)  # type: ignore[arg-type]


@pytest.mark.parametrize("texts", [("STITCH & THREAD", "EST. 1974"), ("TEA", "COFFEE & CAKE")])
def test_letters_of_a_ring_stand_apart(texts: tuple[str, str]) -> None:
    layout = pw.words("circle", {"linen": 3, "wool": 2, "felt": 1}, ring=texts, effort="draft")
    for placed in layout:
        if placed.name in texts:
            letters = shapely.get_parts(placed.outline.region)
            assert len(letters) == len(placed.name.replace(" ", ""))
