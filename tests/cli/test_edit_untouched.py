"""An edit of a file of ours changes what it touches, and nothing else by a byte."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from typer.testing import CliRunner

import packwork as pw
from packwork.cli import app

COIN = """<svg viewBox="0 0 24 24" fill="none" stroke="currentColor" stroke-width="2">
<circle cx="12" cy="12" r="9"/><path d="M14.4 8c-1.5-1.3-5.4-.6-5.4 4s3.900 5.3 5.400 4M7 12h5"/>
</svg>"""
GIFT = """<svg viewBox="0 0 24 24"><defs><linearGradient id="g"><stop stop-color="#e63946"/>
<stop offset="1" stop-color="#ffb703"/></linearGradient></defs>
<rect x="3" y="7" width="18" height="14" fill="url(#g)"/><path d="M11 3h2v18h-2z" fill="#fff"/>
</svg>"""
QUICK = ("--effort", "draft", "-q", "--levels", "50")


def packwork(*arguments: object) -> tuple[int, str]:
    result = CliRunner().invoke(app, list(map(str, arguments)), catch_exceptions=False)
    return result.exit_code, " ".join(result.output.split())


@pytest.fixture(scope="module")
def sources(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("sources")
    (folder / "coin.svg").write_text(COIN, encoding="utf-8")
    (folder / "gift.svg").write_text(GIFT, encoding="utf-8")
    (folder / "photos").mkdir()
    for k, colour in enumerate(("teal", "tomato", "gold", "navy", "olive")):
        Image.new("RGB", (90, 60 + 10 * k), colour).save(folder / "photos" / f"p{k}.jpg")
    cut = Image.new("RGBA", (80, 80), (0, 0, 0, 0))
    cut.paste((200, 60, 30, 255), (10, 20, 70, 60))
    cut.save(folder / "blob.png")
    (folder / "marks.csv").write_text(
        "name,kg\nfig,4\nkiwi,2\nplum,5\npear,3\nlime,1\n", encoding="utf-8"
    )
    (folder / "words.csv").write_text(
        "alpha,9\nbeta,7\ngamma,6\ndelta,5\nomega,4\nsigma,3\n", encoding="utf-8"
    )
    return folder


def _fill(*more: object) -> Callable[[Path], Sequence[object]]:
    return lambda at: ["fill", "heart", at / "coin.svg", at / "gift.svg", *more, "-n", 6, *QUICK]


LAYOUTS: dict[str, Callable[[Path], Sequence[object]]] = {
    "drawings": _fill(),
    "palette": _fill("star", "--palette", "#264653,#e9c46a"),
    "on a ground": _fill("--background", "#fff8e7", "--show-container", "--rotate", "none"),
    "in full": _fill("star", "--flatten"),
    "pictures": lambda at: ["fill", "circle", at / "blob.png", "owl", "-n", 5, *QUICK],
    "photographs": lambda at: ["photos", "circle", at / "photos", *QUICK],
    "marks": lambda at: [
        "chart", "circle", at / "marks.csv", "--size-by", "kg", "--color-by", "name",
        "--label-by", "name", "--title", "Fruit", *QUICK,
    ],
    "words": lambda at: ["words", "circle", at / "words.csv", "--effort", "draft", "-q"],
}  # fmt: skip
"""Files of each kind, as a run writes them."""

VERBS: dict[str, Sequence[str]] = {
    "recolor": ("--recolor", "{0}=#ff006e"),
    "move": ("--move", "{0}=45%,55%"),
    "turn": ("--turn", "{0}=10"),
    "scale": ("--scale", "{0}=0.8"),
    "exchange": ("--exchange", "{0}={1}"),
    "hold": ("--hold", "{0}"),
    "add": ("--add", "hexagon"),
    "remove": ("--remove", "{0}"),
    "replace": ("--replace", "{0}=hexagon"),
    "padding": ("--padding", "0"),
}
"""Options of one edit, of the first two items."""

PAIRS = [
    (kind, verb)
    for row, kind in enumerate(LAYOUTS)
    for column, verb in enumerate(VERBS)
    if (row + column) % 3 == 0
]
"""Each verb with a third of the kinds, each kind with a third of the verbs."""


@pytest.fixture(scope="module")
def written(sources: Path) -> Callable[[str], Path]:
    """A file of a kind, made once."""

    def made(kind: str) -> Path:
        path = sources / f"{kind.replace(' ', '-')}.svg"
        if not path.exists():
            code, said = packwork(*LAYOUTS[kind](sources), "-o", path)
            assert path.exists(), (code, said)
        return path

    return made


def _items(text: str) -> list[tuple[str, str, str]]:
    """Each item: its name, its markup but for its number, its drawing."""
    drawings = dict(re.findall(r'<\w+ id="(shape-\d+)"(.*)', text.split('<g id="items"')[0]))
    body = text.split('<g id="items"')[1].split("\n</g>")[0].split("\n")[1:]
    found = []
    for line in body:
        used = re.search(r'xlink:href="#(shape-\d+)"', line)
        name = re.search(r'data-name="([^"]*)"', line)
        drawing = drawings[used[1]] if used else ""
        bare = re.sub(r' id="item-\d+"|xlink:href="#shape-\d+"', "", line)
        if not used:
            # Ids of a copy in full end in its number, as its own does.
            bare = re.sub(r"(p[0-9a-f]{10}-\d+)-\d+", r"\1", bare)
        found.append((name[1] if name else "", bare, drawing))
    return found


def _place(markup: str) -> str:
    """Where an item lies."""
    found = re.search(r'transform="([^"]*)"', markup)
    return found[1] if found else ""


@pytest.mark.parametrize("kind", LAYOUTS)
def test_an_edit_of_nothing_writes_the_same_file(
    written: Callable[[str], Path], tmp_path: Path, kind: str
) -> None:
    before, out = written(kind), tmp_path / "new.svg"
    name = _items(before.read_text(encoding="utf-8"))[0][0]
    code, said = packwork("edit", before, "--hold", f"{name}#1", "-q", "-o", out)
    assert code == 0, said
    assert out.read_text(encoding="utf-8") == before.read_text(encoding="utf-8")


@pytest.mark.parametrize(("kind", "verb"), PAIRS)
def test_what_lies_where_it_lay_is_the_same_to_the_byte(
    written: Callable[[str], Path], tmp_path: Path, kind: str, verb: str
) -> None:
    before, out = written(kind), tmp_path / "new.svg"
    items = _items(before.read_text(encoding="utf-8"))
    first, second = f"{items[0][0]}#1", f"{items[1][0]}#1"
    asked = [part.format(first, second) for part in VERBS[verb]]
    code, said = packwork("edit", before, *asked, "-q", "-o", out)
    if (kind, verb) == ("marks", "scale"):
        # A mark is as large as its number says.
        assert (code, out.exists()) == (2, False), said
        return
    assert out.exists(), (code, said)
    after = _items(out.read_text(encoding="utf-8"))
    assert len(after) == len(items) + (verb == "add") - (verb == "remove")
    known = {(name, _place(markup)): (markup, drawing) for name, markup, drawing in after}
    touched = {0} | ({1} if verb == "exchange" else set())
    drawn = {(name, drawing) for name, _, drawing in after}
    for k, (name, markup, drawing) in enumerate(items):
        if k in touched and verb not in {"hold", "padding", "add"}:
            continue
        there = known.get((name, _place(markup)))
        # What had to make room lies elsewhere, and is drawn as it was.
        assert there == (markup, drawing) if there else (name, drawing) in drawn
    if verb in {"recolor", "hold"}:
        assert all((name, _place(markup)) in known for name, markup, _ in items)


def test_what_cannot_be_kept_is_said(sources: Path, tmp_path: Path) -> None:
    words, out = tmp_path / "live.svg", tmp_path / "new.svg"
    arguments = ["words", "circle", sources / "words.csv", "--text", "live", "--effort", "draft"]
    packwork(*arguments, "-q", "-o", words)
    code, said = packwork("edit", words, "--recolor", "alpha=teal", "-q", "-o", out)
    assert code == 0, said
    assert "6 words that are text there are curves from now on" in said
    text = words.read_text(encoding="utf-8").replace("</svg>", '<rect width="9" height="9"/></svg>')
    words.write_text(text, encoding="utf-8")
    _, said = packwork("edit", words, "--recolor", "alpha=teal", "-q", "-o", out)
    assert "1 drawing beside its items is not kept" in said


@pytest.mark.parametrize("line", [("--cut", "silhouette"), ("--kiss-cut", "1", "--padding", "4")])
def test_lines_for_a_cutter_follow(sources: Path, tmp_path: Path, line: tuple[str, ...]) -> None:
    before, out = tmp_path / "cut.svg", tmp_path / "new.svg"
    packwork("fill", "circle", "star", "-n", 6, *QUICK, *line, "-o", before)
    code, said = packwork("edit", before, "--scale", "star#1=0.6", "-q", "-o", out)
    assert code == 0, said
    head = re.search(r'<g id="cut".*', before.read_text(encoding="utf-8"))
    assert head
    assert head[0] in out.read_text(encoding="utf-8")


def test_halos_come_back(tmp_path: Path) -> None:
    before, out = tmp_path / "halos.svg", tmp_path / "new.svg"
    packwork(
        "fill", "circle", "star", "-n", 6, *QUICK, "--halo", "all", "--background", "navy",
        "-o", before,
    )  # fmt: skip
    packwork("edit", before, "--remove", "star#1", "-q", "-o", out)
    rims = re.findall(r'<path fill="(#\w+)" stroke="\1"', out.read_text(encoding="utf-8"))
    assert len(rims) == 5
    assert '<rect id="background" width="100%" height="100%" fill="#000080"/>' in out.read_text(
        encoding="utf-8"
    )


@pytest.mark.parametrize("kind", ["drawings", "palette", "on a ground", "pictures", "photographs"])
def test_drawings_and_colours_of_a_geojson_are_those_of_its_files(
    sources: Path, tmp_path: Path, kind: str
) -> None:
    saved, svg, out = (tmp_path / name for name in ("a.geojson", "a.svg", "new.svg"))
    assert packwork(*LAYOUTS[kind](sources), "-o", saved, "-o", svg)[0] == 0
    name = _items(svg.read_text(encoding="utf-8"))[0][0]
    code, said = packwork("edit", saved, "--hold", f"{name}#1", "-q", "-o", out)
    assert code == 0, said
    assert "plain shapes" not in said
    assert "names drawings outside its folder, which are read" in said
    assert _items(out.read_text(encoding="utf-8")) == _items(svg.read_text(encoding="utf-8"))


def test_drawings_that_are_gone_are_said(tmp_path: Path) -> None:
    (tmp_path / "coin.svg").write_text(COIN, encoding="utf-8")
    saved, out = tmp_path / "a.geojson", tmp_path / "new.svg"
    packwork("fill", "circle", tmp_path / "coin.svg", "star", "-n", 4, *QUICK, "-o", saved)
    (tmp_path / "coin.svg").write_text(
        '<svg viewBox="0 0 9 9"><path d="M0 0h9v2h-9z"/></svg>', encoding="utf-8"
    )
    code, said = packwork("edit", saved, "--hold", "star#1", "-q", "-o", out)
    assert code == 0
    assert "2 of 4 items are plain shapes (coin): the files" in said


def test_drawings_that_are_given_take_the_colours_and_poses_of_the_file(
    sources: Path, tmp_path: Path
) -> None:
    saved, svg, out = (tmp_path / name for name in ("a.geojson", "a.svg", "new.svg"))
    packwork(*LAYOUTS["palette"](sources), "-o", saved, "-o", svg)
    for file in (saved, svg):
        asked = ["--items", sources / "coin.svg", "--hold", "coin#1"]
        code, said = packwork("edit", file, *asked, "-q", "-o", out)
        assert code == 0, said
        coins = [one for one in _items(svg.read_text(encoding="utf-8")) if one[0] == "coin"]
        assert [one for one in _items(out.read_text(encoding="utf-8")) if one[0] == "coin"] == coins


def test_round_items_keep_their_angles_when_a_run_goes_on(sources: Path, tmp_path: Path) -> None:
    before, report = tmp_path / "a.svg", tmp_path / "b.geojson"
    run = [*LAYOUTS["drawings"](sources)]
    packwork(*run, "-o", before)
    packwork(*run, "--start", before, "--stay", "-o", report)
    old, new = pw.Layout.load(before), pw.Layout.load(report)
    turned = np.abs(np.remainder(new.poses.angle - old.poses.angle + np.pi, 2 * np.pi) - np.pi)
    coins = np.array([item.name == "coin" for item in old.items])
    assert np.ptp(old.poses.angle[coins]) > 0.5
    assert np.degrees(turned[coins]).max() < 10


def test_words_of_an_svg_are_known_for_words(sources: Path, tmp_path: Path) -> None:
    before, other, out = (tmp_path / name for name in ("a.svg", "other.csv", "new.svg"))
    packwork(*LAYOUTS["words"](sources), "-o", before)
    other.write_text("alpha,9\nbeta,7\nzeta,6\n", encoding="utf-8")
    packwork("edit", before, "--words", other, "-q", "-o", out)
    assert sorted(name for name, _, _ in _items(out.read_text(encoding="utf-8"))) == [
        "alpha",
        "beta",
        "zeta",
    ]


def test_a_cut_sheet_is_said_to_hold_lines_alone(tmp_path: Path) -> None:
    before, out = tmp_path / "a.dxf", tmp_path / "new.dxf"
    packwork("fill", "circle", "star", "-n", 3, *QUICK, "-o", before)
    code, said = packwork("edit", before, "--scale", "star#1=0.8", "-q", "-o", out)
    assert code == 0, said
    assert "holds lines alone" in said
    _, said = packwork("edit", before, "--items", "star", "--hold", "star#1", "-q", "-o", out)
    assert "holds lines alone" not in said
