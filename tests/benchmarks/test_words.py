"""Other packages' programs run with ours in their place; what pages of words make of figures."""

from __future__ import annotations

import importlib
import io
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from PIL import Image

from benchmarks.words import composition, examples_page, pairs, pairs_page, stand_ins, words_page
from benchmarks.words.clouds import vocabulary
from benchmarks.words.drop_in import default_cloud
from benchmarks.words.examples import copied, stamped
from benchmarks.words.one_example import free_pixels, measured
from benchmarks.words.standing_in import standing_in, watching
from benchmarks.words.thin_shapes import thin_shapes
from packwork import wordcloud as ours
from packwork.errors import ReadError

PROGRAM = """
from wordcloud import WordCloud
cloud = WordCloud(width=80, height=40).generate("honey and bear and honey")
cloud.to_image()
"""


def made_up_peer() -> ModuleType:
    """A package by the peer's name that draws one white bar."""

    class WordCloud:
        def __init__(self, width: int = 40, height: int = 20, **_: Any) -> None:
            self.size, self.mask = (width, height), None

        def generate(self, text: str) -> Any:
            return self.generate_from_frequencies(dict.fromkeys(text.split(), 1.0))

        def generate_from_frequencies(self, words: dict[str, float]) -> Any:
            self.layout_ = [((word, 1.0), 8, (0, 0), None, "red") for word in words]
            return self

        def recolor(self, **_: Any) -> Any:
            return self

        def to_image(self) -> Image.Image:
            image = Image.new("RGB", self.size)
            image.paste("white", (0, 0, self.size[0] // 4, self.size[1]))
            return image

    module = ModuleType("a_peer")
    module.WordCloud = WordCloud  # type: ignore[attr-defined]
    return module


def test_a_program_runs_unchanged_by_either_name(tmp_path: Path) -> None:
    script = tmp_path / "example.py"
    script.write_text(PROGRAM, encoding="utf-8")
    peer = made_up_peer()
    found = measured(script, {"wordcloud": peer, "packwork": ours}, 2, tmp_path)
    assert len(found["wordcloud"]["seconds"]) == len(found["packwork"]["seconds"]) == 2
    (theirs,), (own,) = found["wordcloud"]["clouds"], found["packwork"]["clouds"]
    assert (theirs["words"], theirs["ink"]) == (3, pytest.approx(0.25))
    assert own["words"] == 2
    assert own["largest"] >= own["median"]
    assert 0.1 < own["ink"] < 1
    with Image.open(tmp_path / "example-packwork-0.png") as drawn:
        assert drawn.size == (80, 40)


@pytest.mark.parametrize(
    ("program", "found"),
    [
        ("import no_such_package", {"lacks": "no_such_package"}),
        ("raise ValueError('so\\nand so')", {"fails": "ValueError: so"}),
    ],
)
def test_an_example_that_comes_to_nothing_says_why(
    tmp_path: Path, program: str, found: dict[str, str]
) -> None:
    script = tmp_path / "example.py"
    script.write_text(program, encoding="utf-8")
    assert measured(script, {"wordcloud": made_up_peer()}, 2) == {"wordcloud": found}


def test_a_package_stands_in_with_its_modules_and_goes_again() -> None:
    before = {key: one for key, one in sys.modules.items() if key.startswith("wordcloud")}
    with standing_in(ours):
        whole, part = (
            importlib.import_module(f"wordcloud{tail}") for tail in ("", ".tokenization")
        )
        assert whole.STOPWORDS is part.STOPWORDS is ours.STOPWORDS
    assert {k: one for k, one in sys.modules.items() if k.startswith("wordcloud")} == before


def test_methods_within_methods_count_once_and_are_put_back() -> None:
    peer = made_up_peer()
    untouched = peer.WordCloud.generate
    with watching(peer) as watched:
        cloud = peer.WordCloud().generate("a b")
        cloud.to_image()
    assert watched.clouds == [cloud]
    assert 0 <= watched.seconds < 1
    assert peer.WordCloud.generate is untouched


def test_the_default_cloud_is_made_in_turn() -> None:
    found = default_cloud(made_up_peer(), made_up_peer(), rounds=2, count=5)
    assert found["runs"].keys() == {"wordcloud", "packwork"}
    for one in found["runs"].values():
        assert (len(one["again"]), one["placed"]) == (2, 5)


def test_what_is_not_white_is_free() -> None:
    coloured = np.full((2, 2, 4), 255)
    coloured[0, 0, 2] = 0
    assert free_pixels(coloured, (4, 4)).mean() == 0.25
    for all_free in (None, np.full((2, 2), 255)):
        assert free_pixels(all_free, (3, 4)).all()


def test_weight_in_the_middle_and_at_the_edge_is_told() -> None:
    free = np.ones((40, 40), bool)
    middle, edge = np.zeros((40, 40), bool), np.zeros((40, 40), bool)
    middle[15:25, 15:25], edge[:10] = True, True
    inner, outer = (composition.composition(ink, ink * 1.0, free) for ink in (middle, edge))
    assert inner["inwards"] < 0.5 < 1 < outer["inwards"]
    assert min(inner["uneven"], outer["uneven"]) > 0.5
    assert inner["near"] < 0.3
    assert outer["gap"] > 0.5


def test_compositions_stand_in_a_table_of_their_own() -> None:
    cloud = {"words": 1, "inwards": 0.5, "uneven": 0.25, "near": 1.0, "gap": 0.1}
    pair = ({"clouds": [cloud]}, {"clouds": [{**cloud, "inwards": 0.75}]})
    _, table = examples_page.composed({"simple": pair})
    assert "| simple | 0.50 | 0.75 | 0.25 | 0.25 | 100.0% | 100.0% | 0.10 | 0.10 |" in table
    assert examples_page.composed({"simple": ({"clouds": []}, {"clouds": []})}) == []


def test_there_are_words_enough() -> None:
    assert len(vocabulary(1_000)) == 1_000
    assert list(vocabulary(1_000))[:100] == list(vocabulary(100))


def test_thin_shapes_are_ten_and_leave_most_of_their_canvas() -> None:
    shapes = thin_shapes()
    assert len({shape.name for shape in shapes}) == len(shapes) == 10
    for shape in shapes:
        left, top, right, bottom = shape.outline.bounds
        assert min(left, top) >= -1e-6
        assert right <= shape.width + 1e-6
        assert bottom <= shape.height + 1e-6
        assert shape.outline.area < 0.6 * shape.width * shape.height


@pytest.mark.parametrize("name", ["alice_mask.png", "alice_color.png"])
def test_a_stand_in_has_the_size_of_what_it_stands_for(name: str) -> None:
    image = stand_ins.FILES[name]()
    assert image.size == {"alice_mask.png": (900, 900), "alice_color.png": (600, 800)}[name]
    seen = np.asarray(image)
    share = free_pixels(seen, seen.shape).mean()
    assert 0.1 < share < 0.9


def test_published_pictures_are_small() -> None:
    noise = np.random.default_rng(0).integers(0, 256, (700, 900, 3), dtype=np.uint8)
    for picture in (Image.fromarray(noise), Image.new("RGB", (700, 900), "teal")):
        data, ending = pairs.small(picture)
        assert len(data) <= pairs.MOST_BYTES
        with Image.open(io.BytesIO(data)) as image:
            assert max(image.size) == pairs.SIDE
            assert image.format == {"png": "PNG", "jpg": "JPEG"}[ending]


def test_gaps_are_counted_where_both_have_one() -> None:
    rows = [
        {"container": name, "words": 100, "program": program, "gap": gap}
        for name, own, peer in (("cat", 1.0, 2.0), ("bear", 3.0, 2.0))
        for program, gap in (("packwork", own), ("wordcloud", peer), ("wordcloud, scaling 1", 9.0))
    ]
    said = list(words_page.gaps_said(rows))
    assert said == ["Largest gap of packwork: below the peer's in 1 of 2."]


def test_pages_say_what_was_not_run() -> None:
    cloud = {"words": 3, "largest": 8.0, "median": 4.0, "ink": 0.25}
    done = {"seconds": [2.0, 1.0], "clouds": [cloud]}
    examples = {
        "simple": {"wordcloud": done, "packwork": {**done, "seconds": [4.0, 3.0]}},
        "arabic": {"wordcloud": {"lacks": "bidi"}, "packwork": {"lacks": "bidi"}},
        "frequency": {"wordcloud": {"fails": "ValueError: x"}, "packwork": done},
    }
    thinner = {**done, "clouds": [{**cloud, "ink": 0.125}]}
    one_font = {"simple": {"wordcloud": thinner, "packwork": done}}
    stamp = {"machine": "m", "date": "2000-01-01", "command": "c", "peer": "1"}
    text = words_page.page(
        {"sections": {"examples": {**stamp, "examples": examples, "one_font": one_font}}}
    )
    assert (
        "| simple | 3 | 3 | 2.0 | 2.0 | 0.250 | 0.250 | 0.125 | 4 s | 2 s | 2 | 3 s | 1 s | 3 |"
        in text
    )
    assert "at most 4 times the peer's in 1 of 1 programs" in text
    assert "ink in one font at least 1.1 times the peer's in 1 of 1." in text
    assert "- arabic, packwork: not run: lacks bidi" in text
    assert "- frequency, wordcloud: stops with `ValueError: x`" in text
    pair = {"stands_in_for": "a.png", "programs": examples["frequency"]}
    page = pairs_page.page({**stamp, "pairs": {"frequency": pair}})
    assert "With a picture of ours in place of `a.png`." in page
    assert "stops with `ValueError: x`" in page


def test_a_verdict_is_of_the_picture_that_it_was_said_of(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pairs_page, "VERDICTS", {"simple": ("abc", "Ours.")})
    assert pairs_page.verdict("simple", "abcdef") == "Ours."
    assert pairs_page.verdict("simple", "fedcba") == f"Ours. {pairs_page.EARLIER}"
    assert pairs_page.verdict("masked", "abcdef") == pairs_page.NOT_SAID


def test_manifests_name_the_source_distribution_without_its_folder(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(sys, "argv", ["words.py", "fat", "examples=/home/me/wordcloud-1.9.6"])
    assert stamped()["command"] == "packwork bench words fat examples=wordcloud-1.9.6"


def test_a_folder_that_is_no_source_distribution_is_told(tmp_path: Path) -> None:
    with pytest.raises(ReadError, match="no folder examples"), copied(tmp_path):
        pass
