"""No output is written over a file that the run reads, whatever it was named by."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from PIL import Image

from packwork.sources import input_at, note_input, noting_inputs
from packwork.writers import described

QUICK = "--levels 16 --epochs 2 --finish none -q"
DOT = '<svg viewBox="0 0 9 9"><circle cx="4" cy="4" r="3"/></svg>'


@pytest.fixture
def artwork(folder: Path) -> Path:
    """Files of every kind that a run reads."""
    for name in ("icons/star.svg", "more/dot.svg", "wall.svg", "curve.svg"):
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(DOT, encoding="utf-8")
    (folder / "weights.csv").write_text("star,2\n", encoding="utf-8")
    (folder / "words.csv").write_text("bear,2\nfox,1\n", encoding="utf-8")
    (folder / "stops.txt").write_text("fox\n", encoding="utf-8")
    (folder / "table.csv").write_text("kg,what\n1,a\n2,b\n", encoding="utf-8")
    seen = Image.new("RGB", (64, 64), "white")
    seen.paste(Image.effect_noise((32, 64), 90), (0, 0))
    seen.save(folder / "seen.png")
    seen.crop((0, 0, 9, 9)).save(folder / "clear.png")
    return folder


LINES = [
    (f"fill heart icons/ {QUICK} -o icons/star.svg", "icons/star.svg"),
    (f"fill heart icons/*.svg {QUICK} -o out.svg --report icons/star.svg", "icons/star.svg"),
    (f"fill circle star {QUICK} -o more/dot.svg --filler more/ --finish exact", "more/dot.svg"),
    (f"fill heart icons/ {QUICK} --weights weights.csv --report weights.csv", "weights.csv"),
    (f"fill wall.svg star {QUICK} -o wall.svg", "wall.svg"),
    (f"fill around:seen.png star {QUICK} --diagnose seen.png", "seen.png"),
    (f"fill around:seen.png star {QUICK} --show-saliency seen.png", "seen.png"),
    (f"fill around:seen.png star {QUICK} --keep-clear clear.png -o clear.png", "clear.png"),
    (f"words circle words.csv {QUICK} --report words.csv", "words.csv"),
    (f"words circle words.csv {QUICK} --stopwords stops.txt --report stops.txt", "stops.txt"),
    (f"words circle words.csv {QUICK} --color-by seen.png -o seen.png", "seen.png"),
    (f"chart circle table.csv {QUICK} --report table.csv", "table.csv"),
    (f"chart circle table.csv {QUICK} --mark more/dot.svg -o more/dot.svg", "more/dot.svg"),
    (f"photos circle seen.png {QUICK} -o seen.png", "seen.png"),
    ("pile square star --size 20% -q --emit curve.svg -o curve.svg", "curve.svg"),
]  # fmt: skip


@pytest.mark.parametrize(("line", "kept"), LINES)
def test_an_input_is_never_written_over(artwork, packwork, line: str, kept: str) -> None:
    before = (artwork / kept).read_bytes()
    result = packwork(line)
    assert result.exit_code == 2, result.output
    assert "is read by this run too" in result.stderr
    assert (artwork / kept).read_bytes() == before
    assert not (artwork / "out.svg").exists()


@pytest.mark.parametrize("link", ["symbolic", "hard"])
def test_links_are_seen_through(artwork: Path, packwork, link: str) -> None:
    make = os.symlink if link == "symbolic" else os.link
    make(artwork / "icons" / "star.svg", artwork / "other.svg")
    result = packwork(f"fill heart icons {QUICK} -o other.svg")
    assert result.exit_code == 2
    assert "other.svg: is read by this run too (as icons/star.svg)" in result.stderr


def test_a_recipe_and_what_it_names_are_kept(artwork, packwork) -> None:
    recipe = artwork / "r.toml"
    recipe.write_text('container = "wall.svg"\nitems = ["icons"]\n', encoding="utf-8")
    for output in ("--report r.toml", "--save-recipe r.toml", "-o wall.svg", "-o icons/star.svg"):
        result = packwork(f"run r.toml {QUICK} {output}")
        assert result.exit_code == 2, output
        assert "is read by this run too" in result.stderr


def test_a_measured_layout_is_kept(artwork, packwork) -> None:
    assert packwork(f"fill circle star {QUICK} -o a.geojson").exit_code in {0, 1}
    for line in ("--report a.geojson", "--diagnose a.geojson"):
        result = packwork(f"measure a.geojson -q {line}")
        assert result.exit_code == 2
        assert "is read by this run too" in result.stderr
    started = packwork(f"fill circle star {QUICK} --start a.geojson -o a.geojson")
    assert started.exit_code == 2


def test_notes_end_with_whoever_keeps_them(artwork: Path) -> None:
    with noting_inputs(), noting_inputs():
        note_input("wall.svg")
        assert input_at(artwork / "wall.svg") == "wall.svg"
        assert input_at("not there.svg") is None
    assert input_at("wall.svg") is None


def test_folders_that_are_made_are_told_once(tmp_path: Path) -> None:
    (tmp_path / "here").mkdir()
    new = tmp_path / "new"
    paths = [tmp_path / "here/a.svg", new / "b/c.svg", new / "d.svg"]
    assert described(paths) == [str(paths[0]), f"{paths[1]} (folder {new} made)", str(paths[2])]


def test_files_that_are_there_are_named_or_kept(folder, packwork) -> None:
    line = "fill circle star --levels 16 --epochs 2 --finish none -o a.svg -o b.webp"
    assert "replaced" not in packwork(line).stdout
    assert "wrote a.svg (replaced), b.webp (replaced)" in packwork(line).stdout
    kept = packwork(f"{line} -o c.svg --no-clobber")
    assert kept.exit_code == 2
    assert "a.svg: is there already, and --no-clobber keeps it" in kept.stderr
    assert not (folder / "c.svg").exists()
    assert packwork("measure a.svg --report b.webp --no-clobber").exit_code == 2


@pytest.mark.parametrize("ending", [".webp", ".tif", ".tiff"])
def test_stills_are_pictures_of_their_size(folder, packwork, ending: str) -> None:
    result = packwork(
        f"fill circle star --canvas 2in --pixels 120 {QUICK} --background none -o a{ending}"
    )
    assert result.exit_code in {0, 1}, result.output
    with Image.open(folder / f"a{ending}") as picture:
        assert (picture.size, picture.mode) == ((120, 120), "RGBA")
        assert ending == ".webp" or picture.info["dpi"] == (60.0, 60.0)


@pytest.mark.parametrize("size", ["-o a.png --pixels 13000", "-o a.webp --pixels 17000"])
def test_too_many_pixels_are_refused_before_the_run(folder, packwork, size: str) -> None:
    result = packwork(f"fill square star -n 3 --effort best {size}")
    assert result.exit_code == 2
    assert "--pixels" in result.stderr
    assert not list(folder.iterdir())


def test_a_format_that_fails_takes_none_of_the_others(folder, packwork, monkeypatch) -> None:
    from packwork import writers
    from packwork.errors import WriteError
    from packwork.writers import registry

    def refuse(*_: object) -> bytes:
        raise WriteError("PDF", "an item's drawing cannot be rendered")

    monkeypatch.setattr(registry, "WRITERS", {**writers.WRITERS, ".png": refuse})
    result = packwork(f"fill circle star {QUICK} -o a.svg -o a.png --save-recipe r.toml")
    assert result.exit_code == 1
    assert "not written: PDF" in result.stderr
    assert {file.name for file in folder.iterdir()} == {"a.svg", "r.toml"}
