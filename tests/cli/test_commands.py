"""What each command does when all is well, and when a run falls short."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from typer.testing import Result

Command = Callable[..., Result]

QUICK = "--epochs 3 --levels 16,32 --effort draft"
TILE = '<svg viewBox="0 0 9 9"><rect width="4" height="4"/></svg>'


def item_count(file: Path) -> int:
    features = json.loads(file.read_text(encoding="utf-8"))["features"]
    return sum(feature["properties"]["role"] == "item" for feature in features)


@pytest.fixture
def icons(folder: Path) -> Path:
    """Folder of two drawings and something else."""
    place = folder / "icons"
    place.mkdir()
    (place / "a.svg").write_text(TILE, encoding="utf-8")
    (place / "b.svg").write_text(TILE.replace('height="4"', 'height="2"'), encoding="utf-8")
    (place / "notes.txt").write_text("not an item", encoding="utf-8")
    return place


@pytest.mark.usefixtures("icons")
@pytest.mark.parametrize(
    ("items", "count"),
    [
        ("star", 1),
        ("star circle heart", 3),
        ("star -n 5", 5),
        ("star circle -n 1", 1),
        ("icons/", 2),
        ("icons -n 7", 7),
        ("icons/a.svg", 1),
        ("icons/*.svg star", 3),
        ("icons/?.svg", 2),
        ("star star", 2),
    ],
)
def test_items_of_every_kind(items: str, count: int, folder: Path, packwork: Command) -> None:
    result = packwork(f"fill circle {items} {QUICK} -o out.geojson")
    assert result.exit_code in {0, 1}
    assert item_count(folder / "out.geojson") == count


def test_without_items_the_icons_that_come_with_it(folder: Path, packwork: Command) -> None:
    packwork(f"fill circle {QUICK} -o out.geojson")
    assert item_count(folder / "out.geojson") > 10


def test_without_output_a_drawing_in_the_working_folder(folder: Path, packwork: Command) -> None:
    result = packwork(f"fill circle star {QUICK}")
    assert [file.name for file in folder.iterdir()] == ["collage.svg"]
    assert "wrote collage.svg" in result.stdout


@pytest.mark.parametrize("flag", ["--film a.gif", "--report a.json", "--save-recipe a.toml"])
def test_where_any_file_is_named_no_other_is_written(
    flag: str, folder: Path, packwork: Command
) -> None:
    films = "--fps 2 --seconds 1 --film-pixels 40" if "film" in flag else ""
    result = packwork(f"fill circle star {QUICK} {flag} {films}")
    assert result.exit_code == 0, result.output
    assert [file.name for file in folder.iterdir()] == [flag.split()[1]]


@pytest.mark.parametrize("container", ["circle", "heart", "bear", "islands", "stripe:6"])
def test_containers_of_every_kind(container: str, folder: Path, packwork: Command) -> None:
    packwork(f"fill {container} star -n 3 {QUICK} -q -o out.svg")
    assert (folder / "out.svg").exists()


def test_a_mask_is_a_container(folder: Path, packwork: Command) -> None:
    mask = np.full((60, 80), 255, np.uint8)
    mask[10:50, 10:70] = 0
    Image.fromarray(mask).save(folder / "mask.png")
    packwork(f"fill mask.png star {QUICK} --canvas 160 -o out.geojson")
    canvas = json.loads((folder / "out.geojson").read_text(encoding="utf-8"))["canvas"]
    assert canvas == {"width": 160, "height": 120, "unit": "px"}


def test_a_sheet_in_mm_is_one_in_every_file(folder: Path, packwork: Command) -> None:
    files = "-o a.svg -o a.pdf -o a.dxf -o a.geojson --report r.json"
    result = packwork(f"fill circle star -n 3 {QUICK} --canvas 200x150mm --padding 1mm {files}")
    assert "smallest gap, mm" in result.stdout
    sheet = {"width": 200, "height": 150, "unit": "mm"}
    assert json.loads((folder / "a.geojson").read_text(encoding="utf-8"))["canvas"] == sheet
    assert json.loads((folder / "r.json").read_text(encoding="utf-8"))["canvas"] == sheet
    assert 'width="200mm" height="150mm"' in (folder / "a.svg").read_text(encoding="utf-8")
    page = (folder / "a.pdf").read_bytes()
    assert re.search(rb"/MediaBox ?\[ ?0 0 566.92914 425.19684 ?\]", page)
    assert (folder / "a.dxf").stat().st_size > 0
    assert "smallest gap, mm" in packwork("measure a.geojson").stdout
    again = packwork(f"fill a.svg star -n 3 {QUICK} -q -o b.geojson")
    assert again.exit_code in {0, 1}
    canvas = json.loads((folder / "b.geojson").read_text(encoding="utf-8"))["canvas"]
    assert (canvas.pop("unit"), sheet.pop("unit")) == ("mm", "mm")
    assert canvas == pytest.approx(sheet)


def test_several_outputs_in_new_folders(folder: Path, packwork: Command) -> None:
    result = packwork(
        f"fill circle star {QUICK} --pixels 90 -o a/out.svg -o a/out.png -o b/out.geojson"
    )
    assert result.exit_code == 0
    with Image.open(folder / "a" / "out.png") as picture:
        assert max(picture.size) == 90
    assert (folder / "a" / "out.svg").exists()
    assert (folder / "b" / "out.geojson").exists()


def test_drawing_options_reach_the_drawing(folder: Path, packwork: Command) -> None:
    packwork(f"fill circle star -n 2 {QUICK} -q -o plain.svg")
    drawing = "--background tomato --show-container --flatten"
    packwork(f"fill circle star -n 2 {QUICK} -q {drawing} -o all.svg")
    plain, drawn = (
        (folder / name).read_text(encoding="utf-8") for name in ("plain.svg", "all.svg")
    )
    assert "#ff6347" in drawn
    assert "#ff6347" not in plain
    assert "<use" in plain
    assert "<use" not in drawn
    assert 'display="none"' in plain
    assert 'display="none"' not in drawn


def test_all_as_asked_is_0_and_shows_the_measures(packwork: Command) -> None:
    result = packwork("fill circle star circle -n 6 --epochs 150 --levels 50,100 -o out.svg")
    assert result.exit_code == 0
    assert not result.stderr
    for word in ("LC", "OO", "EA", "L-nU", "6 of 6 items placed", "out.svg"):
        assert word in result.stdout


@pytest.mark.parametrize("outputs", ["-o out.svg", "-o out.svg --report r.json --diagnose d.png"])
def test_quiet_prints_nothing(outputs: str, packwork: Command) -> None:
    result = packwork(f"fill circle star {QUICK} --quiet {outputs}")
    assert (result.exit_code, result.output) == (0, "")


def test_an_item_without_a_place_is_1_and_named(folder: Path, packwork: Command) -> None:
    result = packwork(
        f"fill circle square --sizes fixed --canvas 50 -n 2 {QUICK} -q -o out.geojson"
    )
    assert result.exit_code == 1
    assert result.stderr.startswith("packwork: not placed: square (item 1): ")
    assert item_count(folder / "out.geojson") == 0


def test_an_unusable_file_among_many_is_left_out_and_named(
    folder: Path, icons: Path, packwork: Command
) -> None:
    (icons / "bad.svg").write_text("<svg", encoding="utf-8")
    result = packwork(f"fill circle icons/ {QUICK} -q -o out.geojson --report report.json")
    assert result.exit_code == 0
    assert result.stderr.startswith("packwork: left out icons/bad.svg: ")
    assert result.stderr.count("\n") == 1
    assert item_count(folder / "out.geojson") == 2
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    assert "icons/bad.svg" in report["skipped"][0]


def test_a_report_has_the_promised_keys(folder: Path, packwork: Command) -> None:
    packwork(f"fill circle star -n 3 --seed 11 {QUICK} -q -o out.svg --report report.json")
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    assert report["metrics"].keys() >= {"LC", "LC_ratio", "OO", "EA", "LnU"}
    assert report["metrics"]["exact"].keys() >= {"overlap_area", "outside_area", "min_gap"}
    seconds = report["seconds"]
    assert seconds.keys() >= {"start-up", "read", "start", "levels", "write", "check", "total"}
    assert seconds.pop("total") == pytest.approx(sum(seconds.values()))
    assert seconds["check"] > 0
    assert (report["items"], report["placed"], report["unplaced"]) == (3, 3, [])
    assert (report["certified"], report["seed"]) == (True, 11)


def test_a_diagnosis_is_a_picture(folder: Path, packwork: Command) -> None:
    packwork(f"fill circle star {QUICK} --pixels 120 -q -o out.svg --diagnose check.png")
    with Image.open(folder / "check.png") as picture:
        assert picture.format == "PNG"
        assert max(picture.size) == 120


def test_one_seed_is_one_file(folder: Path, packwork: Command) -> None:
    for name, seed in [("a", 1), ("b", 1), ("c", 2)]:
        packwork(f"fill heart star circle -n 5 --seed {seed} {QUICK} -q -o {name}.svg")
    first, again, other = ((folder / f"{name}.svg").read_bytes() for name in "abc")
    assert first == again != other


def test_measure_says_what_the_run_said(folder: Path, packwork: Command) -> None:
    packwork(f"fill circle star -n 3 {QUICK} -q -o out.geojson --report run.json")
    result = packwork("measure out.geojson --report measured.json --diagnose check.png")
    assert result.exit_code == 0
    run, measured = (
        json.loads((folder / name).read_text(encoding="utf-8"))
        for name in ("run.json", "measured.json")
    )
    for key in ("LC", "OO", "EA", "LnU"):
        assert measured["metrics"][key] == pytest.approx(run["metrics"][key], rel=1e-3, abs=1e-5)
    assert f"{100 * run['metrics']['LC']:.2f} %" in result.stdout
    assert (folder / "check.png").exists()
    assert not packwork("measure out.geojson -q").output


def test_start_continues_an_earlier_layout(folder: Path, packwork: Command) -> None:
    packwork("fill circle star heart -n 4 --levels 32 --epochs 90 -q -o first.geojson")
    result = packwork(
        "fill circle star heart -n 4 --levels 32 --epochs 90 -q --start first.geojson -o b.geojson"
    )
    assert result.exit_code == 0
    assert item_count(folder / "b.geojson") == 4


def test_files_hold_true_outlines_whatever_the_solver_saw(folder: Path, packwork: Command) -> None:
    packwork(f"fill circle star -n 3 {QUICK} -q --save-recipe r.toml -o out.geojson")
    recipe = (folder / "r.toml").read_text(encoding="utf-8")
    (folder / "r.toml").write_text(f'outline = "hull"\n{recipe}', encoding="utf-8")
    packwork("run r.toml -q -o out.geojson")
    features = json.loads((folder / "out.geojson").read_text(encoding="utf-8"))["features"]
    assert [len(f["geometry"]["coordinates"][0]) for f in features[1:]] == [11, 11, 11]


def test_stretched_items_are_written_and_read_as_such(folder: Path, packwork: Command) -> None:
    line = "fill circle square -n 5 --epochs 40 --levels 48 --stretch 2 --rotate none -q"
    assert packwork(f"{line} -o out.geojson -o out.svg --report run.json").exit_code == 0
    features = json.loads((folder / "out.geojson").read_text(encoding="utf-8"))["features"]
    stretches = [f["properties"]["stretch"] for f in features[1:]]
    assert 1.05 < max(max(s, 1 / s) for s in stretches) <= 2 * (1 + 1e-9)
    drawing = (folder / "out.svg").read_text(encoding="utf-8")
    assert re.search(r"scale\([\d.]+ [\d.]+\)", drawing)
    assert packwork("measure out.geojson -q --report measured.json").exit_code == 0
    run, measured = (
        json.loads((folder / name).read_text(encoding="utf-8"))["metrics"]["exact"]["LC"]
        for name in ("run.json", "measured.json")
    )
    assert measured == pytest.approx(run, rel=1e-6)


def test_demo_writes_three_files(
    folder: Path, packwork: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    from packwork.cli import demo

    small = {"items": ["star"], "count": 3, "epochs": 60, "levels": "32"}
    monkeypatch.setitem(demo.DEMOS, "heart", small)
    result = packwork("demo heart --folder pictures")
    assert result.exit_code == 0
    names = sorted(file.name for file in (folder / "pictures").iterdir())
    assert names == ["heart.geojson", "heart.png", "heart.svg"]


def test_every_demo_is_a_recipe() -> None:
    from packwork.cli.demo import DEMOS
    from packwork.pipeline.plan.plan import Plan
    from packwork.readers.builtin import builtin_container
    from packwork.recipe import make_recipe

    assert "bear" in DEMOS
    for name, options in DEMOS.items():
        recipe = make_recipe(container=name, **options)
        Plan.of(recipe, builtin_container("heart")).solve_options()


def test_bench_runs_a_script_of_the_checkout(folder: Path, packwork: Command) -> None:
    (folder / "src" / "packwork").mkdir(parents=True)
    (folder / "benchmarks" / "engine").mkdir(parents=True)
    script = (
        'import sys\n\nif __name__ == "__main__":\n    sys.stdout.write(" ".join(sys.argv[1:]))\n'
    )
    (folder / "benchmarks" / "engine" / "speed.py").write_text(script, encoding="utf-8")
    (folder / "benchmarks" / "engine" / "helper.py").write_text("x = 1\n", encoding="utf-8")
    assert packwork("bench speed fast twice").stdout == "fast twice"
    assert packwork("bench speed --fast twice").stdout == "--fast twice"
    unknown = packwork("bench unknown")
    assert unknown.exit_code == 2
    assert unknown.stderr == "packwork: unknown: no such benchmark; there are speed\n"


def test_a_shape_that_does_not_show_is_told_with_what_would_do(
    folder: Path, packwork: Command
) -> None:
    result = packwork(f"fill cat star -n 2 {QUICK} -o out.svg --report report.json")
    assert result.exit_code == 0
    told = [line for line in result.stdout.splitlines() if "lies far from any item" in line]
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    assert [f"but {sentence}" for sentence in report["advice"]] == told
    assert re.search(r"; -n \d+ would show it$", told[0])
    assert report["metrics"]["bare"] > 0.05


def test_the_number_of_items_may_be_found(folder: Path, packwork: Command) -> None:
    result = packwork(f"fill circle square -n auto {QUICK} -o out.geojson")
    assert item_count(folder / "out.geojson") == 20
    assert "auto chose 20 items" in result.stdout


def test_items_like_the_background_are_named_and_may_have_rims(
    folder: Path, packwork: Command
) -> None:
    (folder / "ghost.svg").write_text(
        '<svg viewBox="0 0 9 9"><circle cx="4" cy="4" r="4" fill="#f7f7f7"/></svg>',
        encoding="utf-8",
    )
    quick = "--epochs 3 --levels 16 -n 4"
    plain = packwork(f"fill circle ghost.svg {quick} -o out.svg")
    assert "4 items are hardly to be seen on white (ghost)" in plain.stdout
    rims = packwork(f"fill circle ghost.svg {quick} --halo faint -o rims.svg")
    assert "hardly to be seen" not in rims.stdout
    assert 'id="halos"' in (folder / "rims.svg").read_text(encoding="utf-8")
    assert "hardly" not in packwork(f"fill circle ghost.svg {quick} -o out.dxf").stdout


@pytest.mark.parametrize(
    ("files", "lack"),
    [
        ("-o a.svg -o a.dxf", "lines for a DXF"),
        ("-o a.svg --film a.gif", "film"),
        ("-o a.svg --cut outlines", "lines for a cutter"),
        ("-o a.svg --flatten", "items without <use>"),
    ],
)
def test_what_a_tile_cannot_be_is_refused_before_it_is_run(
    files: str, lack: str, folder: Path, packwork: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    def never(*_: object, **__: object) -> None:
        raise AssertionError("it was run")

    monkeypatch.setattr("packwork.cli.running.run_chosen", never)
    result = packwork(f"fill square star {QUICK} --tile square {files}")
    assert result.exit_code == 2
    assert f"a tile goes on over its edge: it has no {lack}" in " ".join(result.output.split())
    assert not list(folder.iterdir())
