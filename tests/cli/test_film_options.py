"""Films from the command line: from each command, by recipe, and what is refused."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from PIL import Image
from typer.testing import Result

Command = Callable[..., Result]

QUICK = "--epochs 6 --levels 16,32 --effort draft -q"
SHORT = "--fps 10 --seconds 0.6 --hold 0.2 --film-pixels 64"


@pytest.mark.parametrize(
    "line", ["fill circle star -n 3", "words circle words.csv", "run recipe.toml"]
)
def test_every_command_makes_films(line: str, folder: Path, packwork: Command) -> None:
    (folder / "words.csv").write_text("bear,3\nfox,2\n", encoding="utf-8")
    (folder / "recipe.toml").write_text(
        'container = "circle"\nitems = ["star"]\ncount = 3\nlevels = [16]\nepochs = 6\n',
        encoding="utf-8",
    )
    quick = "-q" if line.startswith("run") else QUICK
    result = packwork(f"{line} {quick} {SHORT} --film a.gif --film a.svg -o a.png --pixels 32")
    assert result.exit_code == 0, result.output
    with Image.open(folder / "a.gif") as film:
        assert film.n_frames == 6
        assert max(film.size) == 64
    assert "@keyframes" in (folder / "a.svg").read_text(encoding="utf-8")


def test_films_are_among_what_was_written(folder: Path, packwork: Command) -> None:
    quick = QUICK.replace("-q", "")
    result = packwork(f"fill circle star -n 3 {quick} {SHORT} --film a.gif -o a.svg")
    assert "wrote a.svg, a.gif" in result.output


def test_a_recipe_says_how_its_film_is_made(folder: Path, packwork: Command) -> None:
    line = f"fill circle star -n 3 {QUICK} -o a.svg --save-recipe r.toml"
    assert packwork(f"{line} --fps 8 --seconds 0.5 --film-pixels 48").exit_code == 0
    assert packwork("run r.toml -q --film b.gif --film-pixels 40 -o b.svg").exit_code == 0
    with Image.open(folder / "b.gif") as film:
        assert film.n_frames == 4
        assert max(film.size) == 40


@pytest.mark.parametrize(
    ("flags", "message"),
    [
        ("--film a.gfi", "none of a film; did you mean .gif? use one of .svg"),
        ("--film a.png", "the ending '.png' is none of a film; use one of .svg, .gif"),
        ("--film a", "the name has no ending; use one of .svg"),
        ("--film a.gif --film-pixels 0", "--film-pixels: must be at least 16, not 0"),
        ("--film a.gif --fps 0", "--fps: must be at least 1, not 0"),
        ("--film a.gif -o a.gif", "a.gif: is a film; give it to --film"),
        ("-o a.mp4", "a.mp4: is a film; give it to --film"),
        ("--film a.svg -o a.svg", "a.svg"),
    ],
)
def test_a_bad_film_is_refused_before_the_run(
    flags: str, message: str, folder: Path, packwork: Command
) -> None:
    result = packwork(f"fill circle star -n 3 {QUICK} {flags}")
    assert result.exit_code == 2
    assert message in result.output
    assert result.output.count("\n") == 1
    assert not list(folder.iterdir())


def test_a_recipe_with_a_bad_film_is_refused(folder: Path, packwork: Command) -> None:
    (folder / "r.toml").write_text('container = "circle"\n[film]\nfps = "fast"\n', encoding="utf-8")
    result = packwork("run r.toml --film a.gif -q")
    assert result.exit_code == 2
    assert "film: fps: must be a number" in result.output


def test_ctrl_c_while_a_film_is_made_leaves_the_layout_and_no_half_film(
    folder: Path, packwork: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(film: object, path: Path, tell: Callable[[float], None]) -> bytes:
        tell(0.1)
        raise KeyboardInterrupt

    monkeypatch.setattr("packwork.writers.film.registry.film_bytes", interrupted)
    result = packwork(f"fill circle star -n 3 {QUICK} --film a.gif -o a.svg --report r.json")
    assert result.exit_code == 130
    assert "stopped by Ctrl-C: no film was written" in result.output
    assert "still rough" not in result.output
    assert sorted(path.name for path in folder.iterdir()) == ["a.svg", "r.json"]
    assert json.loads((folder / "r.json").read_text(encoding="utf-8"))["certified"]


def test_a_run_without_a_film_is_not_recorded(packwork: Command, monkeypatch) -> None:
    from packwork import pipeline

    seen: list[object] = []
    inner = pipeline.run

    def spied(job: object, *more: object) -> object:
        seen.append(more[-1])
        return inner(job, *more)  # type: ignore[arg-type]

    monkeypatch.setattr(pipeline, "run", spied)
    packwork(f"fill circle star -n 2 {QUICK} -o a.svg")
    packwork(f"fill circle star -n 2 {QUICK} {SHORT} -o b.svg --film b.gif")
    assert seen == [False, True]
