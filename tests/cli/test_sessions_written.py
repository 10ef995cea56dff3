"""Every verb writes session files, and what reads layouts reads them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest
from PIL import Image
from typer.testing import CliRunner

import packwork as pw
from packwork.cli import app

QUICK = ("--effort", "draft", "-q")


def packwork(*arguments: object) -> tuple[int, str]:
    result = CliRunner().invoke(app, list(map(str, arguments)), catch_exceptions=False)
    return result.exit_code, " ".join(result.output.split())


VERBS: dict[str, Sequence[str]] = {
    "fill": ("circle", "star", "owl", "-n", "6", "--levels", "50", *QUICK),
    "words": ("circle", "words.csv", *QUICK),
    "photos": ("circle", "photos", *QUICK),
    "chart": ("circle", "marks.csv", "--size-by", "kg", "--label-by", "name", *QUICK),
    "pile": ("square", "star", "-n", "5", "--size", "20%", "-q"),
    "run": ("recipe.toml", "-q"),
}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("words.csv").write_text("alpha,9\nbeta,7\ngamma,6\n", encoding="utf-8")
    Path("marks.csv").write_text("name,kg\nfig,4\nkiwi,2\nplum,5\n", encoding="utf-8")
    Path("photos").mkdir()
    for k, colour in enumerate(("teal", "tomato", "gold")):
        Image.new("RGB", (60, 40 + 5 * k), colour).save(f"photos/p{k}.jpg")
    recipe = 'container = "circle"\nitems = ["star"]\ncount = 4\neffort = "draft"\n'
    Path("recipe.toml").write_text(recipe, encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize("verb", VERBS)
def test_a_verb_writes_a_session_and_all_read_it(folder: Path, verb: str) -> None:
    code, said = packwork(verb, *VERBS[verb], "-o", "a.packwork", "-o", "a.svg", "-o", "a.geojson")
    assert code == 0, said
    layout = pw.Layout.load("a.packwork")
    drawn = pw.Layout.load("a.geojson")
    assert layout.poses.x.tolist() == drawn.poses.x.tolist()
    assert layout.to_svg() == Path("a.svg").read_text(encoding="utf-8")
    assert packwork("measure", "a.packwork", "-q")[0] == 0
    assert pw.measure("a.packwork")["LC"] == pytest.approx(layout.metrics["LC"])
    name = layout.items[0].name
    code, said = packwork("edit", "a.packwork", "--recolor", f"{name}#1=teal", "-q", "-o", "b.svg")
    assert code == 0, said
    code, said = packwork("run", "a.packwork", *QUICK, "-o", "c.svg", "-o", "c.packwork")
    assert code == 0, said
    assert len(pw.Layout.load("c.packwork")) == len(layout)


def test_ways_of_drawing_go_with_a_session(folder: Path) -> None:
    given = (*VERBS["fill"], "--background", "navy", "--show-container", "--flatten")
    assert packwork("fill", *given, "-o", "a.packwork", "-o", "a.geojson", "-o", "a.svg")[0] == 0
    assert packwork("edit", "a.packwork", "--hold", "owl#1", "-q", "-o", "b.svg")[0] == 0
    assert Path("b.svg").read_text(encoding="utf-8") == Path("a.svg").read_text(encoding="utf-8")
    assert packwork("edit", "a.geojson", "--hold", "owl#1", "-q", "-o", "c.svg")[0] == 0
    assert '<rect id="background" width="100%" height="100%" fill="#000080"' in (
        Path("c.svg").read_text(encoding="utf-8")
    )


def test_layouts_save_and_go_on_in_python(folder: Path) -> None:
    layout = pw.fill("circle", "star", count=4, effort="draft", levels="50")
    layout.save("a.packwork")
    assert pw.Layout.load("a.packwork").to_svg() == layout.to_svg()
    assert len(pw.run("a.packwork", effort="draft")) == 4
    with pytest.raises(pw.PackworkError, match="is no drawing; leave out pixels"):
        layout.save("b.packwork", pixels=80)


def test_what_is_no_session_is_one_line(folder: Path) -> None:
    Path("bad.packwork").write_text("no zip", encoding="utf-8")
    for verb in ("measure", "run"):
        code, said = packwork(verb, "bad.packwork")
        assert code == 2
        assert "bad.packwork" in said
    packwork("fill", *VERBS["fill"], "-o", "a.packwork")
    code, said = packwork("run", "a.packwork", "--save-recipe", "r.toml", "-q")
    assert code == 2
    assert "a session holds its drawings itself" in said


def test_a_run_begins_with_a_session_as_with_any_layout(folder: Path) -> None:
    items = ("circle", "star", "owl", "-n", "6", "--levels", "50", *QUICK)
    assert packwork("fill", *items, "-o", "a.packwork", "-o", "a.geojson")[0] == 0
    for ending in ("packwork", "geojson"):
        out = f"from-{ending}.geojson"
        code, said = packwork("fill", *items, "--start", f"a.{ending}", "--stay", "-o", out)
        assert code == 0, said
    one, other = (pw.Layout.load(f"from-{end}.geojson").poses for end in ("packwork", "geojson"))
    assert one.x == pytest.approx(other.x, abs=0.01)
    recipe = (
        'container = "circle"\nitems = ["star"]\ncount = 3\neffort = "draft"\nstart = "{from}"\n'
    )
    Path("on.toml").write_text(recipe, encoding="utf-8")
    Path("rows.csv").write_text("from\nsmall.packwork\n", encoding="utf-8")
    pw.fill("circle", "star", count=3, effort="draft", levels="50").save("small.packwork")
    code, said = packwork("batch", "on.toml", "--table", "rows.csv", "-o", "{row}.svg", "-q")
    assert code == 0, said


def test_a_series_writes_a_session_of_each_step_and_a_batch_says_what_would_do(
    folder: Path,
) -> None:
    Path("talks.csv").write_text("year,word,n\n1,bear,3\n1,fox,2\n2,bear,2\n2,owl,3\n", "utf-8")
    asked = ("words", "circle", "--series", "talks.csv:year", *QUICK)
    code, said = packwork(*asked, "-o", "{year}.packwork", "-o", "{year}.geojson")
    assert code == 0, said
    for year in ("1", "2"):
        one, other = (pw.Layout.load(f"{year}.{end}") for end in ("packwork", "geojson"))
        assert one.poses.x.tolist() == other.poses.x.tolist()
    code, said = packwork("batch", "recipe.toml", "-o", "{recipe}.packwork", "-q")
    assert code != 0
    assert "a batch writes no sessions; write .geojson" in said
