"""Recipes of every verb: saved, run again from elsewhere, changed on the line, never trusted."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

QUICK = "--levels 16 --epochs 2 --effort draft"
DOT = '<svg viewBox="0 0 9 9"><circle cx="4" cy="4" r="3"/></svg>'
CURVE = '<svg viewBox="0 0 9 9"><path d="M1 1L8 8" fill="none" stroke="#000"/></svg>'


def items_of(path: Path) -> list[dict[str, Any]]:
    """Items of a layout, but for the path of their file, which is seen from elsewhere."""
    features = json.loads(path.read_text(encoding="utf-8"))["features"]
    items = [f for f in features if f["properties"]["role"] == "item"]
    return [{**f, "properties": {**f["properties"], "source": ""}} for f in items]


@pytest.fixture
def artwork(folder: Path) -> Path:
    """A folder whose name has a space, and files of every kind in it."""
    art = folder / "my art"
    (art / "icons").mkdir(parents=True)
    (art / "icons" / "dot.svg").write_text(DOT, encoding="utf-8")
    (art / "curve.svg").write_text(CURVE, encoding="utf-8")
    (art / "weights.csv").write_text("dot,2\nstar,1\n", encoding="utf-8")
    (art / "words.csv").write_text("word,weight,kind\nbear,2,x\nfox,1,y\n", encoding="utf-8")
    (art / "text.txt").write_text("bear fox bear owl", encoding="utf-8")
    (art / "stops.txt").write_text("owl\n", encoding="utf-8")
    (art / "table.csv").write_text("kg,what\n1,a\n2,b\n", encoding="utf-8")
    Image.new("RGB", (40, 30), "red").save(art / "seen.png")
    return art


VERBS = [
    f"fill heart icons/*.svg star -n 4 --weights weights.csv --filler icons --max-items 5 {QUICK}",
    f"fill circle star -n 3 --force 'towards curve.svg' --loss overlap=9 --padding 1% {QUICK}",
    f"fill square icons star -n 3 --hero star=30% --palette red,blue --stretch 1.2 --apart {QUICK}",
    f"words circle words.csv --color-by kind --palette tol-bright {QUICK}",
    f"words circle text.txt --stopwords stops.txt -n 2 --color-by seen.png --add star {QUICK}",
    f"words circle text.txt --stopwords stops.txt --stopwords icons,fox {QUICK}",
    f"chart circle table.csv --size-by kg --mark icons/dot.svg --label-by what {QUICK}",
    f"chart none table.csv --by what --title T {QUICK}",
    f"photos square seen.png -n 2 --border 4% --shape rounded {QUICK}",
    f"photos circle seen.png --shape icons/dot.svg --add star {QUICK}",
    "pile square star -n 3 --size 20%",
    "pile square star icons -n 3 --size 20% --open top --emit curve.svg --release 1 --compact",
]


@pytest.mark.parametrize("line", VERBS)
def test_a_recipe_repeats_its_run_from_elsewhere(artwork, packwork, monkeypatch, line) -> None:
    monkeypatch.chdir(artwork)
    words = [part.strip() for part in line.split("'")]
    typed = words[0].split() + (words[1:2] + words[2].split() if len(words) > 1 else [])
    first = packwork("", *typed, "-q", "-o", "a.geojson", "--save-recipe", "../kept/r.toml")
    assert first.exit_code in {0, 1}, first.output
    away = artwork.parent / "away"
    away.mkdir()
    monkeypatch.chdir(away)
    # What has the names of the recipe's files here is none of them.
    (away / "icons").mkdir()
    (away / "curve.svg").write_text("no drawing", encoding="utf-8")
    again = packwork("run ../kept/r.toml -q -o b.geojson --save-recipe ../again.toml")
    assert again.exit_code == first.exit_code, again.output
    assert items_of(away / "b.geojson") == items_of(artwork / "a.geojson")
    moved = artwork.parent.rename(artwork.parent.with_name("moved"))
    monkeypatch.chdir(moved)
    after = packwork("run kept/r.toml -q -o b.geojson")
    assert after.exit_code == first.exit_code, after.output


def test_files_of_the_working_folder_are_not_taken_for_a_recipes_own(folder, packwork) -> None:
    (folder / "icons").mkdir()
    (folder / "icons" / "dot.svg").write_text(DOT, encoding="utf-8")
    (folder / "set").mkdir()
    recipe = folder / "set" / "r.toml"
    for asked in (
        'items = ["icons/dot.svg"]',
        'items = ["icons/*.svg"]',
        'filler = ["icons/dot.svg"]',
        'force = "towards icons/dot.svg"',
    ):
        recipe.write_text(f'container = "circle"\n{asked}\n', encoding="utf-8")
        result = packwork(f"run set/r.toml -q {QUICK}")
        assert result.exit_code == 2, asked
        assert "set/icons/" in result.stderr, result.stderr
    recipe.write_text('container = "circle"\nitems = ["icons"]\n', encoding="utf-8")
    assert packwork(f"run set/r.toml {QUICK} -o a.geojson --finish none").exit_code in {0, 1}
    assert len(items_of(folder / "a.geojson")) > 9


def test_options_of_a_recipe_are_changed_on_the_line(folder, packwork) -> None:
    (folder / "r.toml").write_text(
        'container = "circle"\nitems = ["star"]\ncount = 9\nepochs = 2\nlevels = "16"\n'
        'apart = true\nfinish = "none"\n',
        encoding="utf-8",
    )
    plain = packwork("run r.toml -q -o a.geojson")
    changed = packwork(
        "run r.toml -q -o b.geojson --seed 6 -n 4 --no-apart --sizes shared --save-recipe b.toml"
    )
    assert {plain.exit_code, changed.exit_code} <= {0, 1}, changed.output
    assert len(items_of(folder / "a.geojson")) == 9
    assert len(items_of(folder / "b.geojson")) == 4
    saved = (folder / "b.toml").read_text(encoding="utf-8")
    for line in ("seed = 6", "count = 4", "apart = false", 'sizes = "shared"', "epochs = 2"):
        assert line in saved


def test_words_of_a_recipe_are_changed_where_they_stand(folder, packwork) -> None:
    (folder / "w.csv").write_text("bear,3\nfox,2\nowl,1\n", encoding="utf-8")
    first = packwork(f"words circle w.csv -q {QUICK} -o a.geojson --save-recipe r.toml")
    assert first.exit_code == 0
    result = packwork("run r.toml -q -n 2 --palette red -o b.geojson")
    assert result.exit_code == 0, result.output
    colours = {item["properties"]["fill"] for item in items_of(folder / "b.geojson")}
    assert len(items_of(folder / "b.geojson")) == 2
    assert colours == {"#ff0000"}


def test_a_chart_of_a_recipe_keeps_its_sizes(folder, packwork) -> None:
    (folder / "t.csv").write_text("kg\n1\n2\n", encoding="utf-8")
    assert packwork(f"chart circle t.csv -q {QUICK} --save-recipe r.toml").exit_code == 0
    result = packwork("run r.toml --sizes free")
    assert result.exit_code == 2
    assert "is no option of a chart" in result.stderr


def test_a_recipe_runs_no_code_unless_that_is_said(folder, packwork) -> None:
    (folder / "mine.py").write_text(
        "from packwork.losses.term import Term\n"
        "from pathlib import Path\n"
        "Path('ran').touch()\n"
        "def calm(density, container):\n    return Term(0.0, 0 * density.image)\n",
        encoding="utf-8",
    )
    (folder / "r.toml").write_text(
        'container = "circle"\nitems = ["star"]\nepochs = 2\nlevels = "16"\nfinish = "none"\n'
        'losses = { "mine:calm" = 1 }\n',
        encoding="utf-8",
    )
    line = [sys.executable, "-m", "packwork", "run", "r.toml", "-q", "-o", "a.geojson"]
    refused = subprocess.run(line, capture_output=True, text=True, check=False, cwd=folder)
    assert refused.returncode == 2
    assert "only with --allow-code" in refused.stderr
    assert refused.stderr.count("\n") == 1
    assert not (folder / "ran").exists()
    trusted = packwork("run r.toml -q -o a.geojson --allow-code")
    assert (folder / "ran").exists(), trusted.output


def test_files_outside_a_recipes_folder_are_named_once(
    folder, packwork, tmp_path, monkeypatch
) -> None:
    (tmp_path / "secret.txt").write_text("bears and bees", encoding="utf-8")
    (folder / "r.toml").write_text(
        'container = "circle"\nitems = []\nlevels = "16"\nepochs = 2\n[words]\n'
        'source = "../secret.txt"\n',
        encoding="utf-8",
    )
    result = packwork("run r.toml -q -o a.geojson")
    assert "r.toml reads files outside its folder: ../secret.txt" in result.stderr
    assert result.stderr.count("secret.txt") == 1
    monkeypatch.chdir(tmp_path)
    assert packwork("run work/r.toml -q -o a.geojson").stderr.count("secret.txt") == 1


def test_modules_of_the_working_folder_are_left_alone(folder) -> None:
    for name in ("ezdxf", "pandas", "typer", "numba"):
        (folder / f"{name}.py").write_text("raise SystemExit('taken over')", encoding="utf-8")
    line = [sys.executable, "-m", "packwork", "fill", "--help"]
    done = subprocess.run(line, capture_output=True, text=True, check=False, cwd=folder)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    "text",
    [
        "levels = " + 500 * "[" + 500 * "]",
        ".".join(["a"] * 100_000) + " = 1",
        "[" + ".".join(["a"] * 100_000) + "]",
        "a = " + 200 * "{b = " + "1" + 200 * "}",
        f"count = {'9' * 5_000}",
        f"count = {'9' * 4_000}",
        f"count = 0x{'f' * 5_000}",
        f"film = {{seconds = [0x{'f' * 5_000}]}}",
        'title = """' + '\\"""' * 50_000,
        'items = ["'  + "[" * 90_000,
        "[chart]\ndata = [{kg = 1}]\npaper = \"x\"",
        "[[rules]]\nitems = \"star\"\npin = {x = \"1e308%\"}",
        "filler = [\"\"]",
        "items = [\"\"]",
    ],
)  # fmt: skip
def test_wild_recipes_are_one_line(folder, packwork, text: str) -> None:
    (folder / "r.toml").write_text(f'container = "circle"\n{text}\n', encoding="utf-8")
    result = packwork("run r.toml -q --effort draft")
    assert result.exit_code == 2
    assert result.stderr.count("\n") == 1
    assert len(result.stderr) < 600


def test_a_text_full_of_dots_and_brackets_is_no_nesting(tmp_path: Path) -> None:
    from packwork.readers.recipe import read_recipe

    file = tmp_path / "r.toml"
    source = "." * 500 + "[" * 500 + " it's \\\" so ... "
    row = ", ".join(["{kg = 0.5}"] * 200)
    file.write_text(
        f'container = "heart"  # {"[" * 99}\n[words]\nsource = "{source}"\n'
        f"[chart]\ndata = [{row}]\n",
        encoding="utf-8",
    )
    assert len(read_recipe(file)["chart"]["data"]) == 200


def test_a_container_with_a_hole_may_be_open(packwork) -> None:
    result = packwork("pile text:A star -n 2 --size 9% --open top -q -o a.geojson")
    assert result.exit_code in {0, 1}, result.output
