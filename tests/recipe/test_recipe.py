"""What a run is asked to do: every field refuses what has no meaning, by its name."""

from __future__ import annotations

import contextlib
import itertools
import math
import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import BaseModel

import packwork as pw
from packwork.errors import RecipeError
from packwork.pipeline.plan.plan import Plan
from packwork.readers.charts import ChartOptions
from packwork.readers.photo_options import PhotoOptions
from packwork.readers.recipe import read_recipe
from packwork.readers.words.options import WordOptions
from packwork.recipe import EPOCHS, MAX_COUNT, Recipe, Rotation, make_recipe
from packwork.recipe.presets import parse_levels
from packwork.recipe.rules import Rule
from packwork.solve.options import MAX_RESOLUTION, MIN_RESOLUTION
from packwork.writers import recipe_bytes
from scenes import square_container


def plan(**options: Any) -> Plan:
    """What a recipe comes to in a square."""
    return Plan.of(make_recipe(**{"container": "heart", **options}), square_container())


NAN, INF = float("nan"), float("inf")

BAD: dict[str, list[Any]] = {
    "container": [3, None],
    "font": [3, "bold.ttf"],
    "items": [7, ["star", 3]],
    "words": [3, "bear", {}, {"source": 3}, {"source": "a b", "cuont": 3}],
    "chart": [3, "a.csv", {}, {"data": 3}, {"data": "a.csv", "unit": 0}],
    "photos": {"sources": []},
    "share": [3, "words", "trees=3", {"words": -1}],
    "quiet_share": [0, 1, "much"],
    "embeddings": [3, ["a.npy"]],
    "label_regions": ["perhaps", 3],
    "anchors": [3, "warm", "left=", ["left"], "up=a"],
    "arrange": [3, "sideways", "right by=", "right up", ""],
    "picture": [3, ["a.png"]],
    "tint": [-0.1, 1.1, NAN, "much"],
    "detail": [-0.1, 1.1, NAN, "fine"],
    "ground": [3, "mauvish", "#ff000080"],
    "grid": [3, "perhaps"],
    "repeats": [0, -1, 2.5, "often"],
    "keep_clear": [3],
    "count": [0, -1, 2.5, "many", MAX_COUNT + 1],
    "canvas": [0, -600, NAN, INF, 1e7, "wide", "0x5mm", "5parsec", "-3in", "1e99mm", [200, 150]],
    "margin": ["-1mm", "wide", "3parsec", [3]],
    "tile": ["brick", "", 3],
    "seed": [-1, 2**63, 0.5, "lucky"],
    "sizes": ["huge", "", None],
    "size_ratio": [0.99, -2, 101, NAN],
    "stretch": [0.99, 0, -2, 101, NAN, INF, "wide"],
    "rotate": ["twist", "", "0", "-30", "181", "nan", "0,x", "30,inf", ","],
    "padding": ["wide", "-1", "", "2 parsec", NAN, INF],
    "weights": [3, ["bear"], {"bear": "heavy"}],
    "holes": ["drill", True],
    "outline": ["rough", "", True],
    "strict": ["perhaps", 7],
    "delimiter": ["", "ab", "\n", 33],
    "decimal": ["", ";", 5],
    "encoding": ["latin-99", "rot13", 8],
    "keep_totals": ["perhaps", 7],
    "least_dpi": [0, -72, NAN, INF, "fine"],
    "trim": ["perhaps", 7],
    "keep_page": ["perhaps", 7],
    "close_gaps": ["wide", "-1", "", None],
    "stroke_width": ["thin", 2],
    "items_from": ["last", 3, None],
    "alpha_threshold": [0, 1, -1, NAN, "half"],
    "start": ["anywhere", "", 3],
    "effort": ["lazy", 1],
    "epochs": [0, -5, 1_000_001, 1.5],
    "levels": [
        "", "fine", "50,", "50;200", f"{MIN_RESOLUTION - 1}", f"{MAX_RESOLUTION + 1}",
        "50:0", "50:-1", "50:nan", "50:inf", "50:1:2", "1e2", 5,
    ],
    "hero": ["", "@", 3, "bear=", "bear@1"],
    "shades": ["loud", 3],
    "palette": ["nocolour", "", 3],
    "apart": ["perhaps", 7],
    "force": [3, "", "dwn", ["down", 3], "towards 1", "down strength=0", "align"],
    "stay": ["perhaps", 7, True],
    "pile": [3, "open", {"open": "lid"}, {"compact": "very"}, {"opne": "top"}],
    "rules": [3, "star", [3], [{"items": 5}], [{"itmes": "star"}], [{"items": "a", "turn": 3}]],
    "finish": ["rough", "", True],
    "target_coverage": [0, 1, 94, -0.5, NAN, "most"],
    "max_items": [0, -1, 2.5, "many", MAX_COUNT + 1],
    "smallest": ["wide", "0", "-1", 0, NAN],
    "filler": [7, ["star", 3]],
    "time": [0, -1, NAN, INF, "soon", 1e9],
    "threads": [0, -1, 1.5, 100_000],
    "preset": ["Paper", "", None],
    "losses": ["overlap", {"overlap": "much"}, {"overlap": NAN}, {"overlap": INF}],
    "film": ["a.gif", {"fps": 0}, {"speed": 2}, {"seconds": NAN}, {"easing": "bouncy"}],
}  # fmt: skip


def key_and_value(field: str, values: list[Any]) -> list[Any]:
    return [pytest.param(field, value, id=f"{field}={value!r}") for value in values]


def test_a_font_may_be_a_path() -> None:
    assert make_recipe(container="text:A", font=Path("bold.ttf")).font == "bold.ttf"


def test_every_field_has_a_bad_value_here() -> None:
    assert BAD.keys() == Recipe.model_fields.keys()


@pytest.mark.parametrize(
    ("field", "value"), [pair for key, values in BAD.items() for pair in key_and_value(key, values)]
)
def test_a_bad_value_is_refused_under_its_name_on_one_line(field: str, value: Any) -> None:
    with pytest.raises(RecipeError) as refusal:
        plan(**{field: value})
    assert refusal.value.key == field
    assert str(refusal.value).startswith(f"{field}: ")
    assert "\n" not in str(refusal.value)
    assert len(str(refusal.value)) < 200


@pytest.mark.parametrize("value", [0, -3, "many"])
def test_a_message_says_what_was_met(value: object) -> None:
    with pytest.raises(RecipeError, match=f"not {value!r}$"):
        make_recipe(container="heart", count=value)


def test_a_missing_container_is_named() -> None:
    with pytest.raises(RecipeError, match=r"^container: must be given$"):
        make_recipe(items=["star"])


def test_an_unknown_key_lists_the_known() -> None:
    with pytest.raises(RecipeError) as refusal:
        make_recipe(container="heart", zigzag="red")
    assert refusal.value.key == "zigzag"
    for name in Recipe.model_fields:
        assert name in refusal.value.problem


def test_a_recipe_cannot_be_changed() -> None:
    recipe = make_recipe(container="heart")
    with pytest.raises(ValueError, match="frozen"):
        recipe.seed = 3


def test_a_recipe_survives_json() -> None:
    recipe = make_recipe(
        container="heart", items=["star"], count=3, rotate="0,90", losses={"overlap": 2}
    )
    assert Recipe.model_validate_json(recipe.model_dump_json()) == recipe


@pytest.mark.parametrize(
    ("text", "limit", "choices"),
    [
        ("free", None, None),
        (" Free ", None, None),
        ("none", 0.0, None),
        ("30", 30.0, None),
        ("180", 180.0, None),
        ("12.5", 12.5, None),
        ("0,90", None, (0.0, 90.0)),
        ("-45, 0 ,45", None, (-45.0, 0.0, 45.0)),
        ("90,", None, (90.0,)),
        # What was stored by versions that did not ask about decimal commas.
        ("22,5", None, (22.0, 5.0)),
    ],
)
def test_rotations(text: str, limit: float | None, choices: tuple[float, ...] | None) -> None:
    rotation = Rotation.parse(text)
    assert rotation.limit == (None if limit is None else pytest.approx(math.radians(limit)))
    assert rotation.choices == (
        None if choices is None else pytest.approx([math.radians(c) for c in choices])
    )


@given(text=st.text(max_size=12) | st.text("0123456789,.-+e ", max_size=12))
def test_any_text_is_a_rotation_or_refused(text: str) -> None:
    try:
        rotation = Rotation.parse(text)
    except RecipeError as refusal:
        assert refusal.key == "rotate"  # noqa: PT017
    else:
        assert all(math.isfinite(v) for v in (rotation.limit or 0.0, *(rotation.choices or ())))


@pytest.mark.parametrize(
    ("rotate", "rate_is_zero", "limit"),
    [
        ("none", True, None),
        ("0,90", True, None),
        ("free", False, None),
        ("30", False, math.radians(30)),
    ],
)
def test_the_solver_turns_items_only_as_far_as_asked(
    rotate: str, rate_is_zero: bool, limit: float | None
) -> None:
    options = plan(rotate=rotate).solve_options()
    assert (options.turn_rate == 0) == rate_is_zero
    assert options.turn_limit == limit


@pytest.mark.parametrize(
    ("text", "levels", "shares"),
    [
        ("50", (50,), (1,)),
        ("50,200", (50, 200), (1, 1)),
        ("50:12,200:20", (50, 200), (12, 20)),
        (" 50 : 0.5 , 600", (50, 600), (0.5, 1)),
        ("600,50", (600, 50), (1, 1)),
    ],
)
def test_levels(text: str, levels: tuple[int, ...], shares: tuple[float, ...]) -> None:
    assert parse_levels(text) == (levels, shares)


@given(text=st.text(max_size=12) | st.text("0123456789,:.-+e ", max_size=12))
def test_any_text_is_levels_or_refused(text: str) -> None:
    try:
        levels, shares = parse_levels(text)
    except RecipeError as refusal:
        assert refusal.key == "levels"  # noqa: PT017
    else:
        assert len(levels) == len(shares) > 0
        assert all(MIN_RESOLUTION <= level <= MAX_RESOLUTION for level in levels)


def test_effort_bounds_epochs_and_a_number_of_epochs_wins() -> None:
    counts = [plan(effort=effort).solve_options().epochs for effort in EPOCHS]
    assert counts == sorted(set(counts))
    assert plan(effort="best", epochs=7).solve_options().epochs == 7


@pytest.mark.parametrize("start", ["earlier.geojson", "EARLIER.GEOJSON", "folder/a.json"])
def test_a_start_with_the_ending_of_a_layout_is_a_file(start: str) -> None:
    assert make_recipe(container="heart", start=start).layout_file == start


@pytest.mark.parametrize("method", ["distance-field", "scatter"])
def test_a_start_is_a_method_else(method: str) -> None:
    assert make_recipe(container="heart", start=method).layout_file is None
    assert plan(start=method).start_options().method == method


def test_numbers_and_tuples_say_the_same_as_text() -> None:
    recipe = make_recipe(container="heart", rotate=30, levels=(50, 200))
    assert recipe == make_recipe(container="heart", rotate="30", levels="50,200")
    assert make_recipe(container="heart", rotate=(0,)).rotation.choices == (0.0,)
    assert make_recipe(container="heart", rotate=(22, 5)).rotation.choices == pytest.approx(
        (math.radians(22), math.radians(5))
    )
    assert plan(levels=[64]).solve_options().levels == (64,)


@pytest.mark.parametrize(
    ("text", "pixels"),
    [
        ("4", 4),
        (2.5, 2.5),
        ("3pt", 4),
        ("25.4mm", 96),
        ("1 in", 96),
        ("2%", 12),
        (".5cm", 48 / 2.54),
    ],
)
def test_lengths(text: str | float, pixels: float) -> None:
    container = square_container(600.0)
    padding = make_recipe(container="heart", padding=text).padding_cu(container)
    assert padding == pytest.approx(pixels)


@pytest.mark.parametrize(
    ("text", "padding_mm"), [("1mm", 1), ("2", 2), (0.5, 0.5), ("1%", 2), ("72pt", 25.4)]
)
def test_lengths_are_in_units_of_the_canvas(text: str | float, padding_mm: float) -> None:
    sheet = replace(square_container(200.0), unit="mm")
    recipe = make_recipe(container="heart", padding=text)
    assert recipe.padding_cu(sheet) == pytest.approx(padding_mm)


@pytest.mark.parametrize("canvas", [None, 600, 600.5, "600", "200x150mm", "A4-landscape"])
def test_a_canvas_survives_toml_and_json(canvas: str | float | None) -> None:
    recipe = make_recipe(container="heart", canvas=canvas)
    assert make_recipe(**recipe.plain()) == recipe
    again = tomllib.loads(recipe_bytes(recipe.plain(), Path()).decode())
    assert make_recipe(**again).canvas_size == recipe.canvas_size


ODD = [
    3, 2.5, True, None, [], {}, [[1]], [None], {"a": 1}, {"a": [1], "b": 2}, {"a": "xy"}, "x\0",
    [{"a": [1]}], {"a": {"b": 1}}, 10**400,
]  # fmt: skip
SOUND = {
    "chart": {"data": "table.csv"}, "words": {"source": "table.csv"},
    "photos": {"sources": ["a.jpg"]}, "rules": {"items": "star"},
}  # fmt: skip


@pytest.mark.parametrize(
    ("part", "model"),
    [("", Recipe), ("chart", ChartOptions), ("words", WordOptions), ("photos", PhotoOptions),
     ("rules", Rule)],
)  # fmt: skip
def test_an_odd_value_of_any_option_is_taken_or_refused(part: str, model: type[BaseModel]) -> None:
    for key, odd in itertools.product(model.model_fields, ODD):
        options: dict[str, Any] = {key: odd}
        if part:
            options = {part: {**SOUND[part], key: odd}}
        if part == "rules":
            options = {"rules": [options["rules"]]}
        with contextlib.suppress(RecipeError):
            make_recipe(**{"container": "heart", **options})


@pytest.mark.parametrize(
    ("key", "options"),
    [
        ("container", {"container": ""}),
        ("items", {"items": [""]}),
        ("items", {"items": ["star", "  "]}),
        ("filler", {"filler": [""], "target_coverage": 0.9}),
        ("weights", {"weights": ""}),
        ("font", {"container": "text:A", "font": ""}),
        ("keep_clear", {"keep_clear": [""]}),
        ("sources", {"photos": {"sources": [""]}}),
        ("fonts", {"words": {"source": "ox", "fonts": [""]}}),
        ("data", {"chart": {"data": ""}}),
    ],
)
def test_a_name_of_nothing_is_refused_before_anything_is_read(key, options):
    with pytest.raises(RecipeError, match=f"^{key}: is an empty name"):
        make_recipe(**{"container": "heart", **options})


def test_verbs_refuse_names_of_nothing_too():
    for verb, arguments in (
        (pw.photos, {"sources": [""]}),
        (pw.words, {"source": "ox", "fonts": [""]}),
        (pw.fill, {"items": ["star"], "filler": [""]}),
    ):
        with pytest.raises(RecipeError, match="is an empty name"):
            verb("heart", **arguments)


def test_a_recipe_that_reads_files_elsewhere_names_them(tmp_path, caplog):
    own = tmp_path / "sets"
    own.mkdir()
    (own / "text.txt").write_text("bears and bees", encoding="utf-8")
    (tmp_path / "private.txt").write_text("a secret", encoding="utf-8")
    recipe = own / "r.toml"
    table = 'container = "heart"\n[words]\nsource = "{}"\n'
    recipe.write_text(table.format("text.txt"), encoding="utf-8")
    read_recipe(recipe)
    assert caplog.text == ""
    for name in ("../private.txt", (tmp_path / "private.txt").as_posix()):
        caplog.clear()
        recipe.write_text(table.format(name), encoding="utf-8")
        read_recipe(recipe)
        assert "reads files outside its folder: " in caplog.text
        assert "private.txt" in caplog.text


@pytest.mark.parametrize("key", ["target_coverage", "quiet_share"])
def test_a_share_in_percent_without_its_sign_is_understood(key: str) -> None:
    with pytest.raises(RecipeError, match=rf"{key}: must be .*not 60.0; did you mean 60%\?"):
        make_recipe(container="circle", items=["star"], **{key: 60.0})
    with pytest.raises(RecipeError) as met:
        make_recipe(container="circle", items=["star"], **{key: 160.0})
    assert "did you mean" not in str(met.value)
