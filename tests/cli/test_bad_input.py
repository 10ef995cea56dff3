"""Whatever is wrong with the input: exit code 2, one clear line, nothing written."""

from __future__ import annotations

import socket
from collections.abc import Callable
from pathlib import Path

import pytest
from PIL import Image
from typer.testing import Result

Command = Callable[..., Result]

CONTAINERS = [
    ("missing.png", "there is no such file"),
    ("missing/mask.png", "there is no such file"),
    ("nothing", "is a folder"),
    ("no-such-shape", "no built-in container of that name"),
    ("hart", "did you mean heart"),
    ("note.txt", "unknown ending '.txt'"),
    ("text:", "holds no word; give one, as in text:HELLO"),
    ("text:\U0010fffe", "no font installed has"),
    ("text:A --font missing.ttf", "there is no such file"),
    ("text:A --font note.txt", "note.txt: is not a font; give a TTF"),
    ("heart --font note.txt", "font: sets a container of words, as in text:HELLO, not 'heart'"),
    ("light.png", "all light"),
    ("three.png", "3 x 1 pixels"),
    ("bomb.png", "scale it down"),
    ("broken.png", "not a picture"),
    ("empty.svg", "is empty"),
    ("blank.svg", "is empty"),
    ("cut.svg", "not well-formed"),
    ("html.svg", ""),
    ("shapeless.svg", "paints no area"),
    ("line.svg", "paints no area"),
    ("flat.svg", "paints no area"),
    ("nan.svg", "NaN"),
    ("nan-rect.svg", "NaN"),
    ("huge.svg", "1e+300"),
    ("entities.svg", "entities"),
    ("external-entity.svg", "entities"),
    ("nested.svg", "elements"),
    ("cycle.svg", ""),
]

ITEMS = [
    *[(name, problem) for name, problem in CONTAINERS if name.endswith(".svg")],
    ("missing.svg", "there is no such file"),
    ("nothing", "holds no file that could be an item"),
    ("no-items", "holds no file that could be an item"),
    ("all-bad", "its one file cannot be used"),
    ("some-bad --strict", "bad.svg"),
    ("no-such-shape", "no built-in item of that name"),
    ("note.txt", "unknown ending '.txt'"),
    ("*.gif", "holds no file"),
    ("clear.png", ""),
    ("bomb.png", "scale it down"),
    ("broken.png", "not a picture"),
]

OPTIONS = [
    ("--count 0", "--count: must be at least 1, not 0"),
    ("--count -4", "not -4"),
    ("--canvas nan", "canvas: "),
    ("--canvas -1", "canvas: "),
    ("--canvas 0x5mm", "canvas: a side is 0.000265 to 2.65e+05 mm long, not 0 mm"),
    ("--canvas 5parsec", "canvas: use a length such as 600, 8in or 200mm"),
    ("--canvas=-3in", "long, not -3 in"),
    ("--canvas 1e99mm", "canvas: "),
    ("--padding 1e308in", "padding: use a length of 1e-09 to 1e+09, or 0"),
    ("--seed -1", "seed: "),
    ("--size-ratio 0.5", "--size-ratio: "),
    ("--stretch 0.5", "--stretch: must be at least 1, not 0.5"),
    ("--stretch nan", "--stretch: "),
    ("--stretch inf", "--stretch: "),
    ("--rotate twist", "rotate: use free, upright, none, 30"),
    ("--rotate 22,5", "--rotate: 22,5 may be 22.5 degrees or two angles; write 22.5, or 22,5,"),
    ("--rotate 11,25", "11,25 may be 11.25 degrees"),
    ("--levels fine", "levels: use resolutions like 50,200,600"),
    ("--levels 3", "levels: a level has"),
    ("--epochs 0", "epochs: "),
    ("--start sideways", "start: "),
    ("--start missing.geojson", "there is no such file"),
    ("--start broken.geojson", "is not JSON"),
    ("--weights missing.csv", "there is no such file"),
    ("--weights words.csv", "must be a positive number"),
    ("--loss charm", "loss: no loss is called 'charm'"),
    ("--loss overlap=much", "loss: use NAME=WEIGHT"),
    ("--loss overlap=nan", "--loss: the weight of overlap"),
    ("--loss no_such_module:loss", "cannot be imported"),
    ("--loss :", "loss: "),
    ("--hero @", "--hero: use NAME, NAME@X,Y or NAME@X,Y=SIZE, not '@'"),
    ("--hero star=wide", "--hero: use lengths such as 50%,40%=30%"),
    ("--hero sta", "--hero: no item is called 'sta'; did you mean star?"),
    ("--hero star@1%,1%", "--hero: pins star at 6, 5.52, outside"),
    ("--hero star@50%,40%=90%", "% of it lies outside the container; make it smaller or move it"),
    ("--palette puce", "--palette: 'puce' is no colour; palettes are okabe-ito"),
    ("--palette #123;#456", "put commas between colours: #123,#456"),
    ("--hero moon", "no item is called 'moon'; there are star: add it to the items"),
    ("--palette red,", "--palette: '' is no colour"),
    ("--target-coverage 94", "--target-coverage: "),
    ("--target-coverage 0", "--target-coverage: "),
    ("--max-items 0", "--max-items: "),
    ("--smallest 0", "--smallest: must be more than nothing, not 0"),
    ("--smallest wide", "--smallest: "),
    ("--max-items 9 --finish none", "--finish: none leaves overlaps; voids are filled after"),
    ("--max-items 9 --sizes shared", "--max-items: adds smaller copies"),
    (
        "--target-coverage 0.85 --sizes shared",
        "--target-coverage: adds smaller copies, though sizes are shared",
    ),
    ("--filler no_such_thing", "no_such_thing"),
    ("--background puce", "background: 'puce' is no colour"),
    ("--pixels 0", "pixels: a picture's longer side must be"),
    ("--pixels 99999999", "pixels: "),
    ("-o note.txt/out.svg", "a part of its path is a file"),
    ("-o out.tga", "'.tga' is not known; use one of .svg"),
    ("-o out.pgn", "'.pgn' is not known; did you mean .png? use one of .svg"),
    ("-o out.tga", ".geojson, .json, .packwork"),
    ("-o out", "the name has no ending"),
    ("-o nothing.svg -o out.tga", "'.tga' is not known"),
    ("--report note.txt/report.json", "a part of its path is a file"),
    ("--diagnose note.txt/picture.png", "a part of its path is a file"),
]

OTHERS = [
    ("measure missing.geojson", "there is no such file"),
    ("measure broken.geojson", "is not JSON"),
    ("measure light.png", "has no outlines to measure; give a .geojson, .svg, .dxf or .packwork"),
    ("measure missing.dxf", "there is no such file"),
    ("measure cut.svg", "not well-formed"),
    ("measure entities.svg", "entities"),
    ("measure shapeless.svg", "has no group named items at its top, as packwork writes it"),
    ("measure any.pdf --report x.json", "--report: is of a layout"),
    ("measure any.pdf --painted", "--painted: is of a layout"),
    ("measure cut.svg --preflight --diagnose x.png", "--diagnose: is of a layout"),
    ("measure missing.geojson --report note.txt/x.json", "a part of its path is a file"),
    ("chart heart words.csv --background puce", "--background: 'puce' is no colour"),
    ("demo unknown", "no built-in container of that name"),
    ("demo --folder note.txt", "a part of its path is a file"),
    ("bench unknown", "benchmarks live in a checkout"),
]

LINES = [
    *[(f"fill {name} star", problem) for name, problem in CONTAINERS],
    *[(f"fill heart {name}", problem) for name, problem in ITEMS],
    *[(f"fill heart star circle {name}", problem) for name, problem in ITEMS],
    *[(f"fill heart star {option}", problem) for option, problem in OPTIONS],
    *OTHERS,
]


def contents(folder: Path) -> dict[str, float]:
    return {str(f): f.stat().st_mtime_ns for f in sorted(folder.rglob("*"))}


def quick(line: str) -> str:
    """The same, with a short run should the input be taken after all."""
    is_short = "--epochs" in line or "--levels" in line or not line.startswith("fill")
    return line if is_short else f"{line} --epochs 2 --levels 16"


@pytest.mark.parametrize(("line", "problem"), LINES, ids=[line for line, _ in LINES])
def test_one_line_exit_2_nothing_written(
    line: str, problem: str, misfits: Path, packwork: Command
) -> None:
    before = contents(misfits)
    result = packwork(quick(line))
    assert result.exit_code == 2
    assert result.stderr.startswith("packwork: ")
    assert result.stderr.count("\n") == 1
    assert problem in result.stderr
    assert len(result.stderr) < 1_200
    assert not result.stdout
    assert contents(misfits) == before


@pytest.mark.parametrize(
    "line",
    ["fill", "fill heart --sizes huge", "fill heart --count many", "fill heart --colour red",
     "fill heart -o", "fill heart --effort lazy", "measure", "dance", "fill heart --holes drill"],
)  # fmt: skip
def test_a_command_line_that_cannot_be_parsed(line: str, folder: Path, packwork: Command) -> None:
    result = packwork(line)
    assert result.exit_code == 2
    assert "Traceback" not in result.output
    assert result.stderr.startswith("packwork: ")
    assert result.stderr.count("\n") == 1
    assert not list(folder.iterdir())


def test_a_picture_too_large_for_its_canvas_leaves_nothing(folder: Path, packwork: Command) -> None:
    result = packwork("fill square star --epochs 2 --levels 16 --pixels 20000 -o a.svg -o a.png")
    assert result.exit_code == 2
    assert "too many" in result.stderr
    assert not list(folder.iterdir())


@pytest.mark.parametrize("element", ["image", "use"])
@pytest.mark.parametrize("attribute", ["href", "xlink:href"])
def test_references_to_files_are_never_read(
    element: str, attribute: str, folder: Path, packwork: Command
) -> None:
    Image.new("L", (90, 90), 0).save(folder / "secret.png")
    drawing = (
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
        ' viewBox="0 0 99 99"><rect width="20" height="10"/>'
        f'<{element} width="90" height="90" {attribute}="%s"/></svg>'
    )
    shapes = []
    for target in ("secret.png", (folder / "secret.png").as_uri(), "../work/secret.png", "#none"):
        (folder / "item.svg").write_text(drawing % target, encoding="utf-8")
        packwork(
            "fill square item.svg -n 1 --seed 0 --epochs 2 --levels 16 -q -o a.svg -o a.geojson"
        )
        assert "secret" not in (folder / "a.svg").read_text(encoding="utf-8")
        shapes.append((folder / "a.geojson").read_text(encoding="utf-8").split('"features"')[1])
    assert len(set(shapes)) == 1


def test_references_to_the_network_are_never_fetched(folder: Path, packwork: Command) -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.setblocking(False)
        address = f"http://127.0.0.1:{server.getsockname()[1]}"
        (folder / "item.svg").write_text(
            '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
            f' viewBox="0 0 9 9"><style>@import url({address}/a.css); .a {{ fill:'
            f" url({address}/b.svg#p) }}</style><rect class='a' width='4' height='4'"
            f" stroke='url({address}/c.svg#q)'/><rect width='3' height='9'/>"
            f"<image xlink:href='{address}/d.png' width='9' height='9'/>"
            f"<use href='{address}/e.svg#x'/><text font-family='url({address}/f)'>A</text></svg>",
            encoding="utf-8",
        )
        packwork("fill square item.svg -n 2 --epochs 2 --levels 16 -q -o a.svg -o a.png")
        with pytest.raises(BlockingIOError):
            server.accept()
    assert "127.0.0.1" not in (folder / "a.svg").read_text(encoding="utf-8")
