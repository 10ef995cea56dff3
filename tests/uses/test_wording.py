"""Words as items of a run: proportions, colours, recipes, what could not be set."""

from __future__ import annotations

import io
from collections import Counter
from importlib import resources
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from PIL import Image

import packwork as pw
from made_fonts import EMOJI, STRIKE_PX, emoji_font
from packwork.errors import RecipeError
from packwork.readers.layouts.read import read_written
from packwork.readers.recipe import read_recipe
from packwork.recipe import make_recipe
from packwork.scene.contrast import contrast, oklab
from packwork.uses import fill, words_recipe
from packwork.uses.words import use
from packwork.uses.words.copies import BOX_OVER_INK
from packwork.writers.recipe import recipe_bytes

QUICK = {"levels": "50", "epochs": 20, "effort": "draft"}
WEIGHTS = {"honey": 3.0, "bear": 2.0, "bee": 1.5, "fox": 1.0}


def fills(layout: pw.Layout) -> list[str]:
    """Colour of each word, from its markup."""
    return [item.art.markup.split('fill="')[1][:7] for item in layout.items]


def test_heights_are_in_the_shares_of_the_weights_and_certified() -> None:
    run = fill(words_recipe("circle", WEIGHTS, **QUICK))
    scales = run.layout.poses.scale
    assert scales / scales[-1] == pytest.approx(list(WEIGHTS.values()), rel=1e-9)
    assert run.certified
    assert (run.layout.poses.angle == 0).all()


def test_a_series_and_a_counter_are_weights_too() -> None:
    class Series:
        def items(self):
            return iter([("bear", np.int64(2)), ("fox", np.float64(1.0))])

        def __iter__(self):
            return (value for _, value in self.items())

    for source in (Series(), Counter(bear=2, fox=1)):
        words = words_recipe("heart", source).words
        assert words is not None
        assert words.source == {"bear": 2.0, "fox": 1.0}


def test_a_word_that_no_font_can_draw_is_reported_after_the_others() -> None:
    run = fill(words_recipe("circle", {**WEIGHTS, "中": 1.0}, fonts=["Inter Display"], **QUICK))
    (undrawn,) = run.unplaced
    assert (undrawn.item, undrawn.index) == ("中", 4)
    assert "no font given has '中'" in undrawn.reason
    report = run.report()
    assert (report["items"], report["placed"], report["certified"]) == (5, 4, True)


def test_icons_among_words_are_as_large_as_a_middling_words_box() -> None:
    layout = pw.words("circle", WEIGHTS, add=["star", "moon"], **QUICK)
    assert [item.name for item in layout.items] == [*WEIGHTS, "star", "moon"]
    areas = layout.areas
    assert areas[4] == pytest.approx(areas[5])
    assert areas[4] == pytest.approx(BOX_OVER_INK * np.median(areas[:4]))


def test_colours_by_weight_run_from_the_first_to_the_last() -> None:
    layout = pw.words(
        "circle", WEIGHTS, color_by="weight", palette="#000000,#0000ff", contrast=1, **QUICK
    )
    found = fills(layout)
    assert (found[0], found[-1]) == ("#000000", "#0000ff")
    assert found == sorted(found)


def test_colours_by_a_column_are_alike_for_alike_values(tmp_path: Path) -> None:
    table = tmp_path / "t.csv"
    table.write_text("word,weight,kind\nbear,2,a\nfox,1,a\nfir,1,b\n", encoding="utf-8")
    layout = pw.words("circle", table, color_by="kind", palette="navy,maroon", **QUICK)
    assert fills(layout) == ["#000080", "#000080", "#800000"]
    with pytest.raises(pw.RecipeError, match=r"no column 'sort'; there are kind"):
        pw.words("circle", table, color_by="sort", **QUICK)


def test_values_of_a_column_keep_their_colours_whichever_words_are_set(tmp_path: Path) -> None:
    table = tmp_path / "t.csv"
    rows = ["bear,5,mammal", "owl,4,bird", "carp,3,fish", "fox,2,mammal", "ant,1,insect"]
    table.write_text("word,weight,kind\n" + "\n".join(rows), encoding="utf-8")
    found = [
        dict(zip([item.name for item in layout.items], fills(layout), strict=True))
        for layout in (
            pw.words("circle", table, color_by="kind", count=count, **QUICK) for count in (5, 2)
        )
    ]
    assert found[1] == {name: found[0][name] for name in ("bear", "owl")}
    assert found[0]["bear"] == found[0]["fox"]
    assert len(set(found[0].values())) == 4
    # Unlike ones: no two steps of a ramp.
    pairs = combinations(set(found[0].values()), 2)
    assert min(np.linalg.norm(oklab(a) - oklab(b)) for a, b in pairs) > 0.1


def test_values_of_a_column_are_given_colours_by_name(tmp_path: Path) -> None:
    table = tmp_path / "t.csv"
    table.write_text("word,weight,kind\nbear,2,a\nfox,1,b\nfir,1,c\n", encoding="utf-8")
    own: dict[str, Any] = {"color_by": "kind", "palette": {"a": "navy", "C": "maroon"}}
    layout = pw.words("circle", table, **own, **QUICK)
    navy, other, maroon = fills(layout)
    assert (navy, maroon) == ("#000080", "#800000")
    assert other not in {navy, maroon}
    assert fills(pw.run(layout.manifest["recipe"])) == [navy, other, maroon]
    with pytest.raises(pw.RecipeError, match="palette: gives a colour to 'd'; kind has a, b, c"):
        pw.words("circle", table, color_by="kind", palette="d=red", **QUICK)


def test_colours_from_a_picture_are_those_under_the_words(tmp_path: Path) -> None:
    picture = Image.new("RGB", (200, 200), "#000080")
    picture.paste("#800000", (100, 0, 200, 200))
    picture.save(tmp_path / "halves.png")
    layout = pw.words("circle", WEIGHTS, color_by=str(tmp_path / "halves.png"), **QUICK)
    for colour, outline in zip(fills(layout), layout.outlines, strict=True):
        left, _, right, _ = outline.bounds
        if right < 299 or left > 301:
            assert colour == ("#000080" if right < 299 else "#800000")


def test_colours_from_a_function_are_what_it_says_of_each_word() -> None:
    def by_length(word):
        return "#800000" if len(word.text) > 3 else None

    layout = pw.words("circle", WEIGHTS, color_by=by_length, palette="navy", **QUICK)
    assert fills(layout) == ["#800000", "#800000", "#000080", "#000080"]
    assert layout.manifest["recipe"]["words"]["color_by"].endswith("by_length")
    pale = pw.words("circle", WEIGHTS, color_by=lambda _: "yellow", **QUICK)
    assert all(contrast(colour, "white") >= 2.95 for colour in fills(pale))
    with pytest.raises(pw.RecipeError, match="color_by: gave 'honey' the colour 'sky', which is"):
        pw.words("circle", WEIGHTS, color_by=lambda _: "sky", **QUICK)


def test_pictures_of_colour_fonts_keep_their_colours(tmp_path: Path) -> None:
    made = io.BytesIO()
    Image.new("RGBA", (STRIKE_PX, STRIKE_PX), "gold").save(made, format="png")
    (tmp_path / "faces.ttf").write_bytes(emoji_font(made.getvalue()))
    inter = str(resources.files("packwork.bundled").joinpath("fonts/InterDisplay-Black.otf"))
    fonts = [inter, str(tmp_path / "faces.ttf")]
    for by in (None, "weight"):
        layout = pw.words("circle", {"ox": 2, EMOJI: 1}, fonts=fonts, color_by=by, **QUICK)
        assert "<image" in layout.items[1].art.markup
    layout.save(tmp_path / "cloud.svg")
    assert read_written(tmp_path / "cloud.svg").items[1].outline.area > 0


@pytest.mark.parametrize("background", ["white", "#102030"])
def test_words_can_be_read_on_the_background(background: str) -> None:
    layout = pw.words("circle", WEIGHTS, palette="yellow,#112233", background=background, **QUICK)
    assert all(contrast(colour, background) >= 2.95 for colour in fills(layout))


def test_a_saved_recipe_repeats_the_run(tmp_path: Path) -> None:
    (tmp_path / "words.csv").write_text("bear,2\nfox,1\n", encoding="utf-8")
    recipe = words_recipe("circle", str(tmp_path / "words.csv"), **QUICK)
    (tmp_path / "run.toml").write_bytes(recipe_bytes(recipe.plain(), tmp_path))
    again = make_recipe(**read_recipe(tmp_path / "run.toml"))
    assert 'source = "words.csv"' in (tmp_path / "run.toml").read_text(encoding="utf-8")
    first, second = fill(recipe).layout, fill(again).layout
    assert first.poses.x.tolist() == second.poses.x.tolist()


def test_a_recipe_of_words_has_no_icons_unless_it_names_them() -> None:
    recipe = make_recipe(container="circle", words={"source": WEIGHTS}, **QUICK)
    assert len(fill(recipe).layout.items) == 4


@pytest.mark.parametrize(
    ("options", "problem"),
    [
        ({"count": 0}, "count: must be at least 1, not 0"),
        ({"cuont": 3}, "cuont: no such option; did you mean count"),
        ({"weight_is": "width"}, "weight_is: must be 'height'"),
        ({"background": "nocolour"}, "background: 'nocolour' is no colour"),
        ({"palette": "nocolour"}, "palette: 'nocolour' is no colour"),
        ({"language": "xx"}, "language: there is no list"),
        ({"color_by": "kind"}, "color_by: there is no column"),
    ],
)
def test_bad_options_are_one_clear_line(options, problem: str) -> None:
    source = "a bear and a fox are in the wood" if "language" in options else WEIGHTS
    with pytest.raises(pw.RecipeError) as caught:
        pw.words("circle", source, **{**QUICK, **options})
    assert problem in str(caught.value)


def test_voids_are_filled_with_smaller_copies_of_the_words() -> None:
    run = fill(words_recipe("circle", WEIGHTS, max_items=8, smallest="2%", **QUICK))
    names = [item.name for item in run.layout.items]
    assert names[:4] == list(WEIGHTS)
    assert len(names) > 4
    assert set(names[4:]) <= set(WEIGHTS)
    own = dict(zip(names[:4], run.layout.poses.scale, strict=False))
    copies = zip(names[4:], run.layout.poses.scale[4:], strict=True)
    assert all(scale < own[name] for name, scale in copies)
    scales = run.layout.poses.scale[:4]
    assert scales / scales[-1] == pytest.approx(list(WEIGHTS.values()), rel=1e-6)
    assert run.certified


def test_names_of_turns() -> None:
    layout = pw.words("circle", WEIGHTS, rotate="vertical", **QUICK)
    assert layout.poses.angle == pytest.approx(-np.pi / 2)
    layout = pw.words("circle", WEIGHTS, rotate="mixed", **QUICK)
    assert set(layout.poses.angle.round(6)) <= {0.0, round(-np.pi / 2, 6)}


@pytest.mark.parametrize(("outline", "may"), [("hull", False), ("exact", True)])
def test_words_stand_between_the_letters_of_others_unless_hulls_are_asked_for(
    outline: str, may: bool
) -> None:
    weights = {"lily": 6.0} | {f"o{k}": 1.0 for k in range(24)}
    layout = pw.words("square", weights, outline=outline, padding=0, seed=3, **QUICK)
    hulls = [placed.region.convex_hull for placed in layout.outlines]
    meeting = [(i, j) for i in range(len(hulls)) for j in range(i) if hulls[i].intersects(hulls[j])]
    assert bool(meeting) == may


@pytest.mark.parametrize(
    ("options", "are_free"),
    [({"nest": False}, False), ({"nest": True}, True), ({"nest": False, "holes": "keep"}, True)],
)
def test_counters_are_free_for_words_if_they_nest_or_holes_are_kept(
    options: dict[str, Any], are_free: bool
) -> None:
    run = fill(words_recipe("circle", {"O": 9.0, "i": 1.0}, **options, **QUICK))
    assert run.layout.items[0].outline.has_holes == are_free
    assert run.certified


@pytest.mark.parametrize(("container", "are_free"), [("heart", False), ("ring", True)])
def test_words_nest_where_sizes_give_way(container: str, are_free: bool) -> None:
    layout = fill(words_recipe(container, {"O": 9.0, "i": 1.0})).layout
    assert layout.items[0].outline.has_holes == are_free


def test_a_word_lies_in_the_counter_of_a_larger_one() -> None:
    run = fill(words_recipe("circle", {"O": 9.0, "i": 1.0}, sizes="graded"))
    large, small = (outline.region for outline in run.layout.outlines)
    assert run.certified
    assert shapely.Polygon(large.geoms[0].exterior).covers(small)


def test_words_that_turn_freely_never_stand_upside_down() -> None:
    words = {f"word{k}": 1.0 + k for k in range(12)}
    rule = {"items": "word3", "rotate": "free"}
    for options in ({"rotate": "free"}, {"rotate": "horizontal", "rules": [rule]}):
        layout = fill(words_recipe("circle", words, seed=3, **options, **QUICK)).layout
        turns = np.abs(np.angle(np.exp(1j * layout.poses.angle)))
        assert turns.max() <= np.pi / 2 + 1e-9
        assert turns.max() > 0.1


def test_a_container_of_words_has_their_font_or_its_own() -> None:
    def container(**fonts: object) -> str | None:
        return words_recipe("text:ox", WEIGHTS, **fonts).font

    assert container() is None
    assert container(fonts=["DejaVu Serif", "DejaVu Sans"]) == "DejaVu Serif"
    assert container(font="DejaVu Serif", container_font="DejaVu Sans") == "DejaVu Sans"
    assert container(fonts="DejaVu Serif", font="DejaVu Sans") == "DejaVu Sans"
    assert words_recipe("circle", WEIGHTS, fonts="DejaVu Serif").font is None
    with pytest.raises(RecipeError, match="container_font: sets a container of words"):
        words_recipe("circle", WEIGHTS, container_font="DejaVu Sans")


@pytest.mark.parametrize(("size", "seed"), [("50%", 0), ("20%", 1)])
def test_no_word_is_larger_than_the_hero(size: str, seed: int) -> None:
    weights = {"licence": 10, "copyright": 30, "software": 25, "work": 12, "terms": 7, "use": 4}
    layout = pw.words("circle", weights, hero=f"licence={size}", seed=seed, effort="draft")
    sizes = {
        item.name: item.outline.extent * scale
        for item, scale in zip(layout.items, layout.poses.scale, strict=True)
    }
    assert layout.certified
    assert max(sizes, key=sizes.__getitem__) == "licence"
    heights = dict(zip((i.name for i in layout.items), layout.poses.scale, strict=True))
    assert heights["copyright"] >= heights["work"] * (1 - 1e-9) >= heights["use"] * (1 - 2e-9)


def test_few_words_of_one_weight_are_lines_that_fill_more() -> None:
    words = {"Anna": 1, "Sebastian": 1, "Mia": 1, "Tom": 1, "Grandma": 1}
    lines = pw.words("circle", words)
    alike = pw.words("circle", words, sizes="shared")
    assert lines.manifest["certified"]
    assert lines.metrics["exact"]["coverage"] > 1.1 * alike.metrics["exact"]["coverage"]
    y = np.sort(lines.poses.y)
    assert np.diff(y).min() > 0.04 * lines.container.side
    upwards = pw.words("circle", words, rotate="vertical")
    assert np.ptp(upwards.poses.scale) < 1e-9


def test_letters_of_a_container_have_no_line_of_words_through_all_of_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(use, "StackWords", None)
    words = dict.fromkeys(("Anna", "Ben", "Clara", "David", "Emma", "Hugo"), 1)
    found = pw.words("text:GO", words, effort="draft", repeat="none")
    assert found.manifest["certified"]


def test_few_words_whose_weights_tell_something_stay_in_proportion() -> None:
    layout = pw.words("circle", {"one": 3, "two": 2, "three": 1})
    heights = layout.poses.scale / layout.poses.scale[0]
    np.testing.assert_allclose(heights, [1, 2 / 3, 1 / 3], rtol=1e-3)
