"""What people ask for: every command of the page runs, and what is said of it holds."""

from __future__ import annotations

import csv
import json
import re
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from shapely.geometry import shape
from typer.testing import Result

from clone_pages import ROOT, commands, prepare, run_all, sections
from packwork.readers.container import read_container
from packwork.readers.layouts.read import read_written

SECTIONS = sections("users.md")


def report(name: str) -> Any:
    return json.loads(Path(name).read_text(encoding="utf-8"))


def placed(name: str) -> list[Any]:
    return [f for f in report(name)["features"] if f["properties"]["role"] == "item"]


def nothing_dropped(results: list[Result]) -> None:
    told = report("words.json")
    assert told["unplaced"]
    assert told["items"] == told["placed"] + len(told["unplaced"]) == 60
    assert all("less than the 40 px" in one["reason"] for one in told["unplaced"])
    assert results[0].exit_code == 1
    assert results[0].stderr.count("not placed: ") == 2


def masks(results: list[Result]) -> None:
    with Image.open("examples/collage/bear.png") as picture:
        grey = np.asarray(picture.convert("L"), dtype=float)
    rng = np.random.default_rng(0)
    spoilt = 20 + grey / 255 * 227 + rng.normal(0, 3, grey.shape)
    Image.fromarray(np.clip(spoilt, 0, 255).astype(np.uint8)).save("spoilt.jpg", quality=60)
    clean, other = (read_container(f) for f in ("examples/collage/bear.png", "spoilt.jpg"))
    assert other.outline.area == pytest.approx(clean.outline.area, rel=0.01)


def no_overlap(results: list[Result]) -> None:
    assert results[1].exit_code == 0
    assert "certified: nothing overlaps, nothing sticks out" in results[1].stdout


def any_script(results: list[Result]) -> None:
    told = report("arabic.json")
    assert (told["placed"], told["unplaced"]) == (25, [])
    assert report("peace.json")["placed"] > 0
    assert len(read_written("peace.svg").container.outline.rings) > 1


def true_sizes(results: list[Result]) -> None:
    with (ROOT / "examples/chart-coffee/coffee.csv").open(encoding="utf-8") as file:
        grown = {r["country"]: float(r["kg of coffee, 2019/20"]) for r in csv.DictReader(file)}
    areas = {f["properties"]["item"]: shape(f["geometry"]).area for f in placed("coffee.geojson")}
    ratios = np.array([area / grown[name] for name, area in areas.items()])
    assert len(ratios) == sum(kg > 0 for kg in grown.values())
    assert np.ptp(ratios) < 1e-7 * ratios.mean()


def whole_shape(results: list[Result]) -> None:
    filling = report("cat.json")["filling"]
    assert filling["added"] > 0
    assert filling["covered"] >= 0.8


def small_edits(results: list[Result]) -> None:
    where = [
        {f["properties"]["item"]: (f["properties"]["x"], f["properties"]["y"]) for f in placed(n)}
        for n in ("before.geojson", "after.geojson")
    ]
    assert len(where[1]) == 32
    moved = [np.hypot(*np.subtract(where[1][word], at)) for word, at in where[0].items()]
    # Of a canvas of 600, on which two places are 270 apart on average.
    assert np.median(moved) < 60


def locked(results: list[Result]) -> None:
    (owl,) = (f for f in placed("hero.geojson") if f["properties"]["item"] == "owl")
    canvas = report("hero.geojson")["canvas"]
    middle = (owl["properties"]["x"] / canvas["width"], owl["properties"]["y"] / canvas["height"])
    assert middle == pytest.approx((0.5, 0.45), abs=1e-3)


def millimetres(results: list[Result]) -> None:
    assert 'width="200mm"' in Path("cut.svg").read_text(encoding="utf-8")
    board = read_written("cut.dxf").container
    assert (board.width, board.height, board.unit) == (200, 150, "mm")
    gap = re.search(r"smallest gap, mm +([\d.]+)", results[1].stdout)
    assert gap is not None
    assert float(gap[1]) >= 1.199


def vectors(results: list[Result]) -> None:
    drawn = Path("circle.svg").read_text(encoding="utf-8")
    assert "<path" in drawn
    assert "<image" not in drawn
    assert Path("circle.pdf").read_bytes().startswith(b"%PDF")


def in_time(results: list[Result]) -> None:
    assert Path("quick.svg").exists()
    assert report("quick.json")["ending"]


def scripted(results: list[Result]) -> None:
    assert [result.stdout for result in results] == ["", ""]
    assert Path("first.svg").read_bytes() == Path("again.svg").read_bytes()


def with_holes(results: list[Result]) -> None:
    found = read_written("ring.geojson")
    assert len(found.container.outline.rings) == 2
    assert "certified: nothing overlaps, nothing sticks out" in results[1].stdout


def linked(results: list[Result]) -> None:
    drawn = Path("linked.svg").read_text(encoding="utf-8")
    assert drawn.count('href="https://en.wikipedia.org/wiki/Owl"') == 4
    assert "<title>The owl, up all night</title>" in drawn


def no_compiler(results: list[Result]) -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    builders = {requirement.split(">")[0] for requirement in project["build-system"]["requires"]}
    assert builders == {"hatchling", "hatch-fancy-pypi-readme"}
    sources = {path.suffix for path in (ROOT / "src").rglob("*") if path.is_file()}
    assert not sources & {".c", ".cpp", ".pyx", ".rs", ".f90"}


CHECKS: list[Callable[[list[Result]], None]] = [
    nothing_dropped, masks, no_overlap, any_script, true_sizes, whole_shape, small_edits, locked,
    millimetres, vectors, in_time, scripted, with_holes, linked, no_compiler,
]  # fmt: skip


def test_there_are_fifteen_each_with_a_thread_and_a_command() -> None:
    assert [heading.split(".")[0] for heading in SECTIONS] == [str(k) for k in range(1, 16)]
    for text in SECTIONS.values():
        assert re.search(r"https://github\.com/[\w.-]+/[\w.-]+/issues/\d+", text)
        assert commands(text)


@pytest.mark.parametrize(
    ("heading", "check"), list(zip(SECTIONS, CHECKS, strict=True)), ids=[c.__name__ for c in CHECKS]
)
def test_what_is_said_holds(
    heading: str,
    check: Callable[[list[Result]], None],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")
    prepare(SECTIONS[heading], tmp_path)
    results = run_all(SECTIONS[heading])
    assert all(result.exit_code in {0, 1} for result in results), results[-1].stderr
    check(results)
