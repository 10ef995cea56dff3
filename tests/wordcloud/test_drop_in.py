"""Programs written for the other package: same calls, same kinds of answers."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from defusedxml import ElementTree
from PIL import Image, ImageColor

from packwork.readers.layouts.read import read_written
from packwork.readers.words.shaping import EM_PX
from packwork.scene.contrast import contrast, oklab
from packwork.wordcloud import (
    STOPWORDS,
    ImageColorGenerator,
    WordCloud,
    colormap_color_func,
    get_single_color_func,
    random_color_func,
)
from packwork.wordcloud import wordcloud as cloud_module

TEXT = """The bear and the honey bear. Bears like honey, bees make honey in the wood; a bee
stings a bear. White rabbits run, a white rabbit sleeps, the white rabbit eats clover."""
WEIGHTS = {"honey": 8.0, "bear": 4.0, "bee": 2.0, "wood": 1.0}


@pytest.fixture(scope="module")
def cloud() -> WordCloud:
    return WordCloud(width=160, height=100, random_state=1).generate_from_frequencies(WEIGHTS)


@pytest.fixture
def fresh_warnings() -> Iterator[None]:
    before = set(cloud_module._warned)
    cloud_module._warned.clear()
    yield
    cloud_module._warned.update(before)


def test_a_cloud_says_what_it_is(cloud: WordCloud) -> None:
    assert repr(cloud) == "<WordCloud: 4 words>"
    assert repr(WordCloud()) == "<WordCloud: 0 words>"


def test_frequencies_are_relative_to_the_first_and_all_words_are_there(cloud: WordCloud) -> None:
    assert cloud.words_ == {"honey": 1.0, "bear": 0.5, "bee": 0.25, "wood": 0.125}
    assert [entry[0] for entry in cloud.layout_] == list(cloud.words_.items())
    for _, size, place, orientation, colour in cloud.layout_:
        assert isinstance(size, int)
        assert all(isinstance(coordinate, int) for coordinate in place)
        assert orientation in (None, Image.Transpose.ROTATE_90)
        assert colour.startswith("rgb(")


@pytest.mark.parametrize(
    ("scaling", "sizes"), [(1.0, [24, 12, 6, 3]), (0.5, [24, 18, 14, 10]), (0, [24] * 4)]
)
def test_where_there_is_room_sizes_are_what_relative_scaling_says(
    scaling: float, sizes: list[int]
) -> None:
    found = WordCloud(
        width=320, height=200, relative_scaling=scaling, min_font_size=1, max_font_size=24
    ).fit_words(WEIGHTS)
    assert [size for _, size, *_ in found.layout_] == sizes


@pytest.mark.parametrize("scaling", [0, 0.5, 1.0])
def test_where_there_is_none_sizes_give_way_and_ranks_stay(scaling: float) -> None:
    weights = {f"word{k}": 1 / (1 + k) for k in range(40)}
    found = WordCloud(width=160, height=100, relative_scaling=scaling).fit_words(weights)
    sizes = [size for _, size, *_ in found.layout_]
    assert sizes == sorted(sizes, reverse=True)
    assert len(sizes) > 10


def test_nothing_overlaps_or_leaves_the_mask() -> None:
    mask = np.full((100, 160), 255, dtype=np.uint8)
    mask[10:90, 20:140] = 0
    weights = {f"word{k}": 1 / (1 + k) for k in range(40)}
    layout = WordCloud(mask=mask, margin=0, random_state=0).fit_words(weights).layout
    regions = [outline.region for outline in layout.outlines]
    room = layout.container.outline.region
    assert all(room.contains(region) for region in regions)
    assert not any(one.intersects(other) for one, other in combinations(regions, 2))


def test_sizes_are_steps_apart() -> None:
    weights = {f"word{k}": 1.0 for k in range(30)}
    options = {"width": 160, "height": 100, "max_font_size": 20, "min_font_size": 5}
    found = WordCloud(**options, font_step=5, random_state=0).fit_words(weights)
    assert {size for _, size, *_ in found.layout_} <= {20, 15, 10, 5}


def test_pictures_have_the_canvas_size_and_the_background(cloud: WordCloud, tmp_path: Path) -> None:
    image = cloud.to_image()
    assert (image.size, image.mode) == ((160, 100), "RGB")
    assert np.array(cloud).shape == (100, 160, 3)
    assert np.array_equal(np.array(cloud), cloud.to_array())
    assert (np.array(cloud)[0, 0] == 0).all()
    for name in ("c.png", "c.jpg", "c.svg"):
        assert cloud.to_file(tmp_path / name) is cloud
        assert (tmp_path / name).stat().st_size
    ElementTree.fromstring(cloud.to_svg())


def test_a_clear_background_and_a_scale(cloud: WordCloud) -> None:
    clear = WordCloud(
        width=60, height=40, mode="RGBA", background_color=None, scale=1.5, random_state=0
    ).fit_words({"ox": 1})
    assert clear.to_array().shape == (60, 90, 4)
    assert clear.to_array()[0, 0, 3] == 0


def test_recolouring_changes_colours_and_nothing_else(cloud: WordCloud) -> None:
    before = cloud.to_array()
    after = cloud.recolor(random_state=7).to_array()
    assert np.array_equal(before.sum(axis=-1) != 0, after.sum(axis=-1) != 0)
    assert not np.array_equal(before, after)
    assert np.array_equal(after, cloud.recolor(random_state=7).to_array())
    cloud.recolor(color_func=lambda *_, **__: (255, 0, 0))
    assert set(np.unique(cloud.to_array()[..., 1:])) == {0}


def test_the_same_seed_gives_the_same_cloud() -> None:
    first, second = (
        WordCloud(width=100, height=60, random_state=3).fit_words(WEIGHTS) for _ in range(2)
    )
    assert first.layout_ == second.layout_
    assert np.array_equal(np.array(first), np.array(second))


def test_an_empty_mask_is_no_mask_and_a_full_one_leaves_no_room() -> None:
    mask = np.zeros((60, 100), dtype=np.int64)
    plain = WordCloud(width=100, height=60, random_state=3).fit_words(WEIGHTS)
    masked = WordCloud(mask=mask, random_state=3).fit_words(WEIGHTS)
    assert np.array_equal(np.array(plain), np.array(masked))
    with pytest.raises(ValueError, match="Couldn't find space to draw"):
        WordCloud(mask=np.full((60, 100), 255)).fit_words(WEIGHTS)
    with pytest.raises(ValueError, match="invalid shape"):
        WordCloud(mask=np.zeros((9, 9, 2, 2))).fit_words(WEIGHTS)


@pytest.mark.parametrize("channels", [None, 3, 4])
def test_nothing_is_drawn_where_a_mask_is_white(channels: int | None) -> None:
    mask = np.zeros((117, 228), dtype=np.uint8)
    mask[40:80, 120:200] = 255
    shaped = mask if channels is None else np.repeat(mask[..., None], channels, axis=2)
    array = WordCloud(mask=shaped, random_state=0).fit_words(WEIGHTS).to_array()
    assert array.shape == (117, 228, 3)
    assert (array[mask != 0] == 0).all()
    assert array.sum() > 10_000


def test_a_contour_is_drawn() -> None:
    mask = np.full((100, 100), 255, dtype=np.uint8)
    mask[20:80, 20:80] = 0
    options = {"mask": mask, "contour_width": 3, "contour_color": "#ff0000", "random_state": 0}
    array = WordCloud(**options, color_func=lambda **_: "blue").fit_words({"ox": 1}).to_array()
    assert array[20, 50, 0] > 200
    assert array[5, 50].sum() == 0


def test_words_too_small_are_left_out_and_counted(caplog: pytest.LogCaptureFixture) -> None:
    weights = {f"word{k}": 1.0 + k for k in range(60)}
    cloud = WordCloud(width=60, height=40, random_state=0).fit_words(weights)
    assert 0 < len(cloud.layout_) < 60
    assert cloud.layout.poses.scale.min() * EM_PX >= 4
    assert f"{60 - len(cloud.layout_)} of 60 words are left out" in caplog.text


def test_a_largest_font_size_holds() -> None:
    cloud = WordCloud(width=160, height=100, max_font_size=12, random_state=0).fit_words(WEIGHTS)
    assert max(size for _, size, *_ in cloud.layout_) == 12


def test_words_repeat_until_there_are_enough() -> None:
    cloud = WordCloud(
        width=160, height=100, repeat=True, max_words=20, stopwords=[], random_state=0
    ).generate("Some short text")
    assert len(cloud.layout_) == 21
    assert len(cloud.words_) == 3
    assert {entry[0][0] for entry in cloud.layout_} == {"Some", "short", "text"}


def test_functions_that_take_arrays_get_bytes(cloud: WordCloud) -> None:
    """What shows pictures takes floats to be shares of one."""
    assert np.asarray(cloud).dtype == np.uint8
    assert np.asarray(cloud, dtype=np.float64).max() > 1


def test_svg_holds_outlines_or_text(cloud: WordCloud) -> None:
    assert "<text" not in cloud.to_svg()
    assert ">honey</text>" in cloud.to_svg(embed_font=True)


def test_repeated_words_come_in_whole_rounds() -> None:
    options = {"width": 160, "height": 100, "stopwords": [], "random_state": 0}
    cloud = WordCloud(repeat=True, max_words=10, **options).generate("Some short text")
    assert len(cloud.layout_) == 12
    assert len(WordCloud(repeat=True, max_words=2, **options).generate("Some short").layout_) == 2


def test_what_failed_leaves_nothing_behind(cloud: WordCloud) -> None:
    small = WordCloud(width=1, height=1)
    with pytest.raises(ValueError, match="Couldn't find space"):
        small.fit_words({"ox": 1})
    assert small.layout_ == []
    with pytest.raises(ValueError, match="call generate"):
        small.to_image()


def test_texts_become_words_and_pairs() -> None:
    words = WordCloud(collocation_threshold=5).process_text(TEXT)
    assert words["honey"] == 3
    assert words["white rabbit"] == 3
    assert "white" not in words
    assert "the" not in words
    assert "bees" not in words
    alone = WordCloud(collocations=False, normalize_plurals=False).process_text(TEXT)
    assert (alone["white"], alone["rabbits"], alone["bees"]) == (3, 1, 1)


def test_a_variation_selector_alone_is_no_word() -> None:
    found = WordCloud(collocations=False, regexp=r"[^\s\w]").process_text("\u263a\ufe0f")
    assert set(found) == {"\u263a"}


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ({}, {"Bear", "ox", "a1"}),
        ({"include_numbers": True}, {"Bear", "ox", "a1", "42"}),
        ({"min_word_length": 3}, {"Bear"}),
        ({"stopwords": {"BEAR"}}, {"ox", "a1"}),
        ({"regexp": r"\w+r"}, {"Bear"}),
    ],
)
def test_options_of_texts(options: dict, expected: set[str]) -> None:
    found = WordCloud(collocations=False, **options).process_text("Bear's ox 42 a1")
    assert set(found) == expected


@pytest.mark.parametrize("method", ["to_image", "to_array", "to_svg", "recolor"])
def test_nothing_can_be_drawn_before_it_is_made(method: str) -> None:
    with pytest.raises(ValueError, match="call generate"):
        getattr(WordCloud(), method)()


def test_bad_arguments() -> None:
    with pytest.raises(ValueError, match="at least 1 word"):
        WordCloud().fit_words({})
    with pytest.raises(ValueError, match="between 0 and 1"):
        WordCloud(relative_scaling=2)
    with pytest.raises(ValueError, match="Couldn't find space"):
        WordCloud(width=1, height=1).fit_words({"ox": 1})
    with pytest.raises(NotImplementedError):
        WordCloud().to_html()


def test_words_of_frequency_nought_are_left_out() -> None:
    cloud = WordCloud(width=60, height=40, random_state=0).fit_words({"ox": 1, "bee": 0})
    assert len(cloud.layout_) == 1


def test_arguments_without_effect_are_told_once(fresh_warnings: None) -> None:
    with pytest.warns(UserWarning, match="ranks_only has no effect") as caught:
        WordCloud(ranks_only=True)
    assert len(caught) == 1
    WordCloud(ranks_only=True)


def test_words_of_blanks_are_told_and_left_out(caplog: pytest.LogCaptureFixture) -> None:
    frequencies = {"ox": 2, " \n": 1, "bee": 1}
    cloud = WordCloud(width=60, height=40, random_state=0).generate_from_frequencies(frequencies)
    assert [word for (word, _), *_ in cloud.layout_] == ["ox", "bee"]
    assert "has no letters" in caplog.text


def test_stop_words_are_a_set_that_may_grow() -> None:
    mine = set(STOPWORDS)
    mine.add("bear")
    assert "bear" not in WordCloud(stopwords=mine, collocations=False).process_text(TEXT)
    assert "bear" not in STOPWORDS


def test_stop_words_are_those_of_the_other_package() -> None:
    assert len(STOPWORDS) == 192
    assert {"however", "can't", "www"} < STOPWORDS
    assert not {"several", "must", "whose"} & STOPWORDS


def test_colours_come_from_a_picture(cloud: WordCloud) -> None:
    picture = np.zeros((100, 160, 3), dtype=np.uint8)
    picture[..., 2] = 200
    cloud.recolor(color_func=ImageColorGenerator(picture))
    assert {entry[4] for entry in cloud.layout_} == {"rgb(0, 0, 200)"}
    small = ImageColorGenerator(picture[:1, :1], default_color=(1, 2, 3))
    assert small("ox", 9, None, (50, 50), None) == "rgb(1, 2, 3)"
    with pytest.raises(ValueError, match="smaller than the canvas"):
        ImageColorGenerator(picture[:1, :1])("ox", 9, None, (50, 50), None)
    for shape in ((4,), (4, 4, 2)):
        with pytest.raises(ValueError, match=r"ImageColorGenerator|channels"):
            ImageColorGenerator(np.zeros(shape))


@pytest.mark.parametrize("ground", ["black", "white", "#808080", (30, 30, 60)])
def test_colours_that_no_one_asked_for_stand_out(ground: Any) -> None:
    words = {f"word{k}": 1.0 for k in range(60)}
    cloud = WordCloud(background_color=ground, random_state=0).fit_words(words)
    colours = {entry[4] for entry in cloud.layout_}
    assert len(colours) > 20
    channels = ImageColor.getrgb(ground) if isinstance(ground, str) else ground
    seen = "#{:02x}{:02x}{:02x}".format(*channels)
    least = min(contrast(colour, seen) for colour in colours)
    assert least >= 2.0
    asked = WordCloud(background_color=ground, colormap="viridis", random_state=0).fit_words(words)
    assert min(contrast(entry[4], seen) for entry in asked.layout_) < 2.0


def test_words_of_about_one_weight_differ_in_colours_of_our_own() -> None:
    words = {f"word{k}": 1.0 / (k + 1) for k in range(12)}
    for seed in range(5):
        cloud = WordCloud(random_state=seed).fit_words(words)
        for found in (cloud.layout_, cloud.recolor(random_state=seed + 7).layout_):
            labs = np.array([oklab(entry[4]) for entry in found])
            assert np.linalg.norm(np.diff(labs, axis=0), axis=1).min() > 0.1


def test_a_clear_background_and_lists_as_backgrounds_have_colours() -> None:
    for ground in (None, [0, 0, 0], "nosuchcolour"):
        cloud = WordCloud(background_color=ground, mode="RGBA", random_state=0)
        assert cloud.fit_words({"ox": 1.0}).layout_[0][4].startswith("rgb(")


def test_colour_functions_are_of_one_kind() -> None:
    asked = {"word": "ox", "font_size": 9, "position": (0, 0), "orientation": None}
    for function in (
        random_color_func,
        get_single_color_func("red"),
        colormap_color_func("cividis"),
    ):
        first, second = (function(**asked, random_state=Random(4), font_path=None) for _ in "ab")
        assert first == second
    with pytest.raises(ValueError, match="nosuchmap"):
        colormap_color_func("nosuchmap")


def test_a_picture_that_cannot_be_written_leaves_the_older_one(tmp_path: Path) -> None:
    cloud = WordCloud(width=90, height=60, random_state=0).generate_from_frequencies({"ox": 1})
    kept = tmp_path / "keep.png"
    kept.write_bytes(b"older")
    cloud.background_color = "bogus"
    with pytest.raises(ValueError, match="bogus"):
        cloud.to_file(kept)
    assert kept.read_bytes() == b"older"
    cloud.background_color = "white"
    assert cloud.to_file(kept) is cloud
    assert kept.read_bytes()[1:4] == b"PNG"
    with pytest.raises(ValueError, match="unknown file extension"):
        cloud.to_file(tmp_path / "a.bogus")


def test_half_of_a_wide_margin_lies_along_the_edge() -> None:
    made = WordCloud(width=200, height=100, margin=20, random_state=1, prefer_horizontal=1)
    shown = made.generate_from_frequencies(WEIGHTS).to_array().max(axis=2) > 60
    rows, columns = np.nonzero(shown)
    nearest = min(rows.min(), columns.min(), 99 - rows.max(), 199 - columns.max())
    assert 9 <= nearest <= 12


@pytest.mark.parametrize(
    "state",
    [np.random.RandomState, np.random.default_rng, np.int64, Random],
)
def test_any_generator_says_what_is_random(state: Any) -> None:
    entries = [
        WordCloud(width=160, height=100, random_state=state(seed)).fit_words(WEIGHTS).layout_
        for seed in (3, 3, 4)
    ]
    assert entries[0] == entries[1]
    assert [entry[4] for entry in entries[0]] != [entry[4] for entry in entries[2]]
    clouds = [WordCloud(width=60, height=40).fit_words({"ox": 1}) for _ in "ab"]
    again = [cloud.recolor(random_state=state(5)).layout_[0][4] for cloud in clouds]
    assert again[0] == again[1]


def test_what_says_nothing_random_is_refused() -> None:
    with pytest.raises(TypeError, match="random_state is str; give a whole number"):
        WordCloud(random_state="3")  # type: ignore[arg-type]


@pytest.mark.parametrize("scale", [1, 2.5])
def test_vectors_are_as_large_as_pictures(scale: float, tmp_path: Path) -> None:
    mask = np.full((60, 90), 255, np.uint8)
    mask[5:55, 5:85] = 0
    made = WordCloud(mask=mask, scale=scale, random_state=0).fit_words(WEIGHTS)
    plain = WordCloud(mask=mask, random_state=0).fit_words(WEIGHTS).layout
    width, height = made.to_image().size
    assert f'width="{width}" height="{height}" viewBox="0 0 {width} {height}"' in made.to_svg()
    for ending in ("svg", "geojson"):
        made.to_file(tmp_path / f"a.{ending}")
        read = read_written(tmp_path / f"a.{ending}")
        assert (read.container.width, read.container.height) == (width, height)
        assert read.areas == pytest.approx(plain.areas * scale**2, rel=1e-4)
