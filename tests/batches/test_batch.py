"""Batches: a run for each row, the same bytes however many workers, gone on with where they end."""

from __future__ import annotations

import json
import multiprocessing
from pathlib import Path
from typing import Any

import pytest

import packwork as pw
from packwork.batches.batch import (
    BatchPlan,
    BatchRequest,
    Template,
    batch_progress,
    plan_batch,
    run_batch,
)
from packwork.batches.task import RowOutcome
from packwork.errors import ReadError, RecipeError, WriteError

POSTER = {
    "container": "{shape}", "items": ["star", "{extra}"], "count": "{n}", "epochs": 20,
    "levels": "50", "effort": "draft",
}  # fmt: skip
ROWS = [
    {"name": "Ann", "shape": "heart", "extra": "moon", "n": 4},
    {"name": "Bärbel", "shape": "circle", "extra": "", "n": "5"},
    {"name": "Zoë", "shape": "text:Z", "extra": "leaf", "n": 6.0},
]


def contents(folder: Path) -> dict[str, bytes]:
    """Files of rows; a process that is killed while it writes leaves what it has written so far."""
    ours = (path for path in folder.iterdir() if path.suffix not in {".json", ".part"})
    return {path.name: path.read_bytes() for path in ours}


def plan_of(folder: Path, rows: list[dict[str, Any]] = ROWS) -> BatchPlan:
    return plan_batch(
        BatchRequest(
            templates=[Template("poster", POSTER, folder)],
            rows=rows,
            columns=tuple(rows[0]),
            outputs=[f"{folder}/{{name}}.svg"],
            drawing={},
        )
    )


def statuses(outcomes: Any) -> list[str]:
    return [one.status for one in outcomes]


def test_each_row_is_a_run_of_its_own(tmp_path: Path) -> None:
    made = pw.batch(POSTER, ROWS, [tmp_path / "{name}.svg", tmp_path / "x" / "{name}.geojson"])
    assert statuses(made) == ["made"] * 3
    assert made.is_well
    layouts = [pw.Layout.load(one.outputs[1]) for one in made]
    assert [len(layout) for layout in layouts] == [4, 5, 6]
    alone = pw.run({**POSTER, "container": "heart", "items": ["star", "moon"], "count": 4})
    assert (alone.poses.x == layouts[0].poses.x).all()
    record = json.loads((tmp_path / "Ann.batch.json").read_text(encoding="utf-8"))
    assert record["certified"]
    assert set(record["outputs"]) == {"Ann.svg", "x/Ann.geojson"}


def test_a_bad_row_is_named_and_all_others_are_made(tmp_path: Path) -> None:
    rows = [
        *ROWS,
        {"name": "Ann", "shape": "heart", "n": 3},
        {"name": "a/b", "shape": "heart", "n": 3},
        {"name": "Max", "shape": "heart", "n": "many"},
        {"name": "Li", "shape": "nonesuch.svg", "n": 3},
    ]
    made = pw.batch(POSTER, rows, str(tmp_path / "{name}.svg"))
    assert statuses(made) == ["made"] * 3 + ["failed"] * 4
    said = [one.said for one in made.failed]
    assert "row 1's too" in said[0]
    assert said[1].startswith("name: 'a/b' holds '/'")
    assert said[2].startswith("count: must be a whole number")
    assert "nonesuch.svg: there is no such file" in said[3]
    assert repr(made) == "<Batch: 7 rows, 3 made, 4 failed>"
    assert len(list(tmp_path.glob("*.svg"))) == 3


def test_what_is_made_is_kept_and_what_has_changed_is_made_anew(tmp_path: Path) -> None:
    drawing = tmp_path / "own.svg"
    drawing.write_text('<svg viewBox="0 0 9 9"><path d="M0 0h9v9z"/></svg>', encoding="utf-8")
    rows = [{**ROWS[0], "extra": str(drawing)}, ROWS[1], ROWS[2]]
    out = str(tmp_path / "{name}.svg")
    assert statuses(pw.batch(POSTER, rows, out)) == ["made"] * 3
    first = contents(tmp_path)
    again = pw.batch(POSTER, rows, out)
    assert statuses(again) == ["kept"] * 3
    assert again.outcomes[0].metrics["items"] == 4
    drawing.write_text('<svg viewBox="0 0 9 9"><path d="M0 0h9v5z"/></svg>', encoding="utf-8")
    (tmp_path / "Bärbel.svg").write_text("spoilt", encoding="utf-8")
    (tmp_path / "Zoë.batch.json").write_text("{", encoding="utf-8")
    assert statuses(pw.batch(POSTER, rows, out)) == ["made"] * 3
    now = contents(tmp_path)
    assert now["Bärbel.svg"] == first["Bärbel.svg"]
    assert now["Ann.svg"] != first["Ann.svg"]
    rows[2] = {**ROWS[2], "n": 7}
    assert statuses(pw.batch(POSTER, rows, out)) == ["kept", "kept", "made"]
    assert statuses(pw.batch(POSTER, rows, out, anew=True)) == ["made"] * 3


def test_workers_make_the_same_bytes_and_one_that_dies_takes_no_row_with_it(
    tmp_path: Path,
) -> None:
    alone, beside = tmp_path / "alone", tmp_path / "beside"
    rows = [{**ROWS[0], "name": f"row{k}", "n": 4 + k} for k in range(4)]
    plan = plan_of(alone, rows)
    assert statuses(run_batch(plan, batch_progress(plan), 1)) == ["made"] * 4
    plan, killed = plan_of(beside, rows), list[int]()

    def kill_one(_: RowOutcome) -> None:
        for worker in multiprocessing.active_children()[: not killed]:
            worker.kill()
            killed.append(worker.pid or 0)

    assert statuses(run_batch(plan, batch_progress(plan), 2, kill_one)) == ["made"] * 4
    assert len(killed) == 1
    assert contents(beside) == contents(alone)


def test_a_batch_that_is_stopped_is_gone_on_with(tmp_path: Path) -> None:
    plan, heard = plan_of(tmp_path), list[RowOutcome]()
    found = run_batch(plan, batch_progress(plan), 1, heard.append, lambda: len(heard) > 0)
    assert statuses(found) == ["made", "stopped", "stopped"]
    assert [path.name for path in tmp_path.glob("*.svg")] == ["Ann.svg"]
    found = run_batch(plan, batch_progress(plan), 1)
    assert statuses(found) == ["kept", "made", "made"]


def test_a_folder_of_recipes_is_run_each(tmp_path: Path) -> None:
    for name, shape in (("one", "heart"), ("two", "circle")):
        (tmp_path / f"{name}.toml").write_text(
            f'container = "{shape}"\nitems = ["star"]\ncount = 3\nepochs = 20\nlevels = "50"\n',
            encoding="utf-8",
        )
    made = pw.batch(tmp_path, output=tmp_path / "out" / "{recipe}.svg")
    assert sorted(path.name for one in made for path in one.outputs) == ["one.svg", "two.svg"]


@pytest.mark.parametrize(
    ("recipe", "rows", "output", "kind", "said"),
    [
        (POSTER, ROWS, "all.svg", RecipeError, "one file for 3 rows"),
        (POSTER, ROWS, "{nonesuch}.svg", RecipeError, "names the column 'nonesuch'; there are na"),
        ({**POSTER, "seed": "{x}"}, ROWS, "{row}.svg", RecipeError, "names the column 'x'"),
        (POSTER, ROWS, "{name}.docx", WriteError, "docx"),
        (POSTER, ROWS, [], RecipeError, "output is missing|output: is missing"),
        (POSTER, [], "{row}.svg", ReadError, "no rows|holds no"),
        (POSTER, 7, "{row}.svg", RecipeError, "table"),
        (7, ROWS, "{row}.svg", RecipeError, "recipe"),
        ("none.toml", ROWS, "{row}.svg", ReadError, "none.toml"),
    ],
)
def test_what_no_row_could_be_made_of_is_refused_at_once(
    tmp_path: Path, monkeypatch: Any, recipe: Any, rows: Any, output: Any, kind: type, said: str
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(kind, match=said) as caught:
        pw.batch(recipe, rows, output)
    assert "\n" not in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def test_no_cell_makes_code_of_a_recipe(tmp_path: Path) -> None:
    recipe = {**POSTER, "losses": {"{loss}": 1}}
    made = pw.batch(recipe, [{**ROWS[0], "loss": "antigravity:geohash"}], tmp_path / "{name}.svg")
    assert "is code" in made.failed[0].said


def test_no_row_is_written_over_what_it_reads(tmp_path: Path) -> None:
    drawing = tmp_path / "Ann.svg"
    drawing.write_text('<svg viewBox="0 0 9 9"><path d="M0 0h9v9z"/></svg>', encoding="utf-8")
    before = drawing.read_bytes()
    made = pw.batch(POSTER, [{**ROWS[0], "extra": str(drawing)}], tmp_path / "{name}.svg")
    assert statuses(made) == ["failed"]
    assert drawing.read_bytes() == before
