"""``packwork edit``: saved layouts changed here and there."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from typer.testing import CliRunner

import packwork as pw
from packwork.cli import app


@pytest.fixture(scope="module")
def saved(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A layout of eight in a file, of which each item may be held where a padding of 1 is asked."""
    layout = pw.fill("circle", ["star", "heart"], count=8, epochs=80, levels="50,100", padding=1)
    path = tmp_path_factory.mktemp("edit") / "eight.geojson"
    layout.save(path)
    layout.save(path.with_suffix(".svg"))
    return path


def run(*arguments: object) -> tuple[int, str]:
    result = CliRunner().invoke(app, ["edit", *map(str, arguments)])
    return result.exit_code, " ".join(result.output.split())


@pytest.mark.parametrize("ending", [".geojson", ".svg"])
def test_a_layout_is_changed_and_certified_again(saved: Path, tmp_path: Path, ending: str) -> None:
    out, report = tmp_path / "new.geojson", tmp_path / "report.json"
    before = pw.Layout.load(saved)
    held = [item.name for item in before.items].index("heart")
    x = 300.0 + 0.5 * (300.0 - before.poses.x[held])
    y = 300.0 + 0.5 * (300.0 - before.poses.y[held])
    code, said = run(
        saved.with_suffix(ending), "--items", "star", "--items", "heart", "--hold", "heart#1",
        "--move", f"star#2={x},{y}", "--turn", "heart#3=90", "--scale", "heart#2=0.7",
        "--add", "hexagon", "--add", f"circle@{x},30%", "--remove", "star#1",
        "--replace", "star#4=square", "--recolor", "heart*=teal", "--padding", "1",
        "-o", out, "-o", tmp_path / "new.png", "--report", report,
    )  # fmt: skip
    # A place that is not had is said.
    assert code == ("there is no room for it" in said), said
    assert "certified: nothing overlaps" in said
    after = pw.Layout.load(out)
    assert len(after) == 9
    assert after.certified
    assert after.metrics["exact"]["min_gap"] >= 1
    names = [item.name for item in after.items]
    assert sorted(set(names)) == ["circle", "heart", "hexagon", "square", "star"]
    assert abs(after.poses.x[names.index("star")] - x) < 1e-3
    assert abs(after.poses.x[names.index("heart")] - before.poses.x[held]) < 1e-3
    assert json.loads(report.read_text(encoding="utf-8"))["certified"] is True


def test_what_cannot_be_certified_is_named_and_written_all_the_same(
    saved: Path, tmp_path: Path
) -> None:
    out = tmp_path / "new.svg"
    code, said = run(
        saved, "--move", "star#1=100,300", "--move", "star#2=102,300", "--hold", "star#1",
        "--hold", "star#2", "-o", out,
    )  # fmt: skip
    assert code == 1
    assert "star overlaps star by" in said
    assert out.exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--move", "owl=1,1"), "there is no item 'owl'; there are star, heart"),
        (("--move", "star=1,1"), "4 items are called star; say star#1 to star#4"),
        (("--move", "star#1"), "--move: must be ITEM=X,Y such as owl=50%,120, not 'star#1'"),
        (("--move", "star#1=5"), "must be ITEM=X,Y such as owl=50%,120, not '5'"),
        (("--move", "star#1=a,b"), "--move: use a length"),
        (("--move", "star#1=500%,1"), "--move: 500% is off the canvas, which is 600 px wide"),
        (("--move", "star#1=1,-3"), "--move: -3 is off the canvas, which is 600 px high"),
        (("--turn", "star#1=nan"), "turn: must be a number, not 'nan'"),
        (("--remove", "star#1=heart"), "remove: must be ITEM, not 'star#1=heart'"),
        (("--hold", "star#1="), "hold: must be ITEM or ITEM=place"),
        (("--turn", "star#1=up"), "turn: must be a number, not 'up'"),
        (("--scale", "star#1=0"), "--scale: "),
        (("--hold", "star#1=colour"), "--hold: "),
        (("--add", "no-such.svg"), "no-such.svg"),
        (("--remove", "*"), "nothing would be left"),
        (("--recolor", "star=mud"), "'mud' is no colour"),
        (("--padding", "-1"), "padding: "),
        (("--container", "no-such.svg"), "no-such.svg"),
        (("--arrange", "right by=size"), "--arrange: nothing is measured by 'size'"),
        (("--embeddings", "auto"), "--embeddings: auto is for words of a text"),
        (("--embeddings", "no-such.csv"), "no-such.csv"),
        (("--arrange", "hue", "--embeddings", "v.csv"), "--embeddings: and --arrange both say"),
        (("--anchors", "left=warm"), "--anchors: are of vectors"),
        (("--picture", "no-such.png"), "no-such.png"),
        (("--items", "no-such"), "no-such"),
        (("-o", "new.doc"), "new.doc"),
    ],
)
def test_what_has_no_meaning_is_one_line_and_nothing_is_written(
    saved: Path, arguments: tuple[str, ...], message: str
) -> None:
    code, said = run(saved, *arguments)
    assert code == 2
    assert message in said
    assert list(Path.cwd().iterdir()) == []


def test_an_empty_option_of_all_leaves_the_layout_as_it_is(saved: Path, tmp_path: Path) -> None:
    out = tmp_path / "new.geojson"
    code, said = run(saved, "--padding", "", "--sizes", "", "--rotate", "", "-o", out)
    assert code == 0, said
    before, after = (pw.Layout.load(path) for path in (saved, out))
    np.testing.assert_allclose(after.poses.x, before.poses.x)
    np.testing.assert_allclose(after.poses.scale, before.poses.scale)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--force", ""), "--force: is empty"),
        (("--words", ""), "source: is empty"),
        (("--container", ""), "the container comes first"),
        (("--count", "0"), "must be at least 1"),
        (("--cover", ""), "--cover: must be a share such as 70%, not ''"),
        (("--turn", "star#1=x"), "--turn: must be a number, not 'x'"),
        (("--turn", "star#1="), "--turn: must be ITEM=DEGREES, not 'star#1='"),
        (("--turn", "star"), "--turn: must be ITEM=DEGREES, not 'star'"),
    ],
)
def test_an_edit_that_is_not_whole_is_one_line(
    saved: Path, arguments: tuple[str, ...], message: str
) -> None:
    test_what_has_no_meaning_is_one_line_and_nothing_is_written(saved, arguments, message)


def test_the_layout_that_is_read_is_not_written_over(saved: Path) -> None:
    before = saved.read_bytes()
    code, said = run(saved, "-o", saved)
    assert code == 2
    assert saved.name in said
    assert saved.read_bytes() == before


def test_a_size_that_is_not_had_is_one_line_and_exit_1(saved: Path, tmp_path: Path) -> None:
    out, report = tmp_path / "new.geojson", tmp_path / "report.json"
    holds = [f"--hold={name}#{k}" for name in ("star", "heart") for k in range(1, 5)][1:]
    code, said = run(saved, *holds, "--scale", "star#1=2.5", "-o", out, "--report", report)
    assert code == 1
    (told,) = json.loads(report.read_text(encoding="utf-8"))["unmet"]
    assert told in said
    assert "not 2.5 times: there is no room for more" in told
    assert json.loads(report.read_text(encoding="utf-8"))["certified"] is True


def test_a_session_is_edited_where_it_lies(saved: Path, tmp_path: Path) -> None:
    work, picture = tmp_path / "work.packwork", tmp_path / "new.png"
    code, said = run(saved, "--items", "star", "--items", "heart", "--hold", "star#1", "-o", work)
    assert code == 0, said
    code, said = run(work, "-n", 11, "--cover", "30%", "--rotate", "none", "-o", work)
    assert code == 0, said
    session = pw.Session.open(work)
    assert len(session.document) == 11
    assert session.document.held[session.find("star#1")[0]].all()
    code, said = run(work, "--force", "down", "--sizes", "fixed", "-o", work, "-o", picture)
    assert code == 0, said
    assert picture.exists()
    assert pw.Session.open(work).document.options.force == ("down",)


def test_a_layout_is_put_in_order_and_shows_a_picture(saved: Path, tmp_path: Path) -> None:
    out, vectors, photo = tmp_path / "new.geojson", tmp_path / "v.csv", tmp_path / "p.png"
    vectors.write_text("star,1,0\nheart,0,1\n", encoding="utf-8")
    Image.linear_gradient("L").save(photo)
    for asked in (
        ["--arrange", "down by=name"],
        ["--embeddings", vectors, "--anchors", "up=heart"],
    ):
        code, said = run(saved, *asked, "--picture", photo, "-o", out)
        assert code == 0, said
        after = pw.Layout.load(out)
        names = np.array([item.name for item in after.items])
        assert after.poses.y[names == "heart"].mean() < after.poses.y[names == "star"].mean()
        assert len({item.art.fill for item in after.items}) > 4


def test_the_words_of_a_session_are_changed(tmp_path: Path) -> None:
    work = tmp_path / "work.packwork"
    layout = pw.words("heart", {"bear": 2, "fox": 1}, epochs=40, levels="50")
    layout.edit().save(work)
    table = tmp_path / "new.csv"
    table.write_text("word,weight\nbear,1\nwhale,2\n", encoding="utf-8")
    code, said = run(work, "--words", table, "-o", work)
    assert code == 0, said
    assert [item.name for item in pw.Session.open(work).document.items] == ["bear", "whale"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--cover", "170"], "--cover: must be a share such as 70%"),
        (["--force", "towards curve.svg"], "--force: takes no file in a session"),
        (["--sizes", "large"], "--sizes: "),
        (["--items", "star"], "items: are in a session file already"),
        (["--words", "nothing.csv"], "nothing.csv"),
    ],
)
def test_what_has_no_meaning_in_a_session(
    saved: Path, tmp_path: Path, arguments: list[str], message: str
) -> None:
    work = tmp_path / "work.packwork"
    pw.Layout.load(saved).edit().save(work)
    before = work.read_bytes()
    code, said = run(work, *arguments, "-o", work)
    assert code == 2
    assert message in said
    assert work.read_bytes() == before


def test_a_session_is_changed_where_it_is_with_what_its_journal_holds(
    saved: Path, tmp_path: Path
) -> None:
    work = tmp_path / "work.packwork"
    session = pw.Layout.load(saved).edit()
    session.save(work, journal=True)
    session.duplicate(0)
    code, said = run(work, "-n", "7", "-o", work)
    assert code == 2
    assert "is open in another session" in said
    session.close()
    assert run(work, "-n", "7", "-o", work)[0] == 0
    with pw.Session.open(work, journal=True) as again:
        assert len(again.document) == 7
        again.undo()
        assert len(again.document) == 9
    assert sorted(tmp_path.glob("work.*")) == [work, tmp_path / "work.packwork.log"]


def test_names_may_hold_the_sign_of_an_option(saved: Path, tmp_path: Path) -> None:
    session = pw.Layout.load(saved).edit()
    session.rename(0, "a=b")
    session.save(tmp_path / "a.packwork")
    line = (tmp_path / "a.packwork", "--recolor", "a=b=red", "--turn", "a=b=10")
    code, said = run(*line, "-o", tmp_path / "new.packwork")
    assert code == 0, said
    again = pw.Session.open(tmp_path / "new.packwork")
    assert again.document.items[0].name == "a=b"
    assert len(again.history) == 3


def test_all_of_a_name_are_one_step_to_undo(saved: Path, tmp_path: Path) -> None:
    code, _ = run(saved, "--recolor", "*=red", "-o", tmp_path / "new.packwork")
    assert code == 0
    assert len(pw.Session.open(tmp_path / "new.packwork").history) == 1


def test_less_covered_than_asked_for_is_told(saved: Path, tmp_path: Path) -> None:
    code, said = run(saved, "--cover", "99.9%", "-o", tmp_path / "new.svg")
    assert code == 1
    assert "is covered, not 99.9 %" in said


def test_a_palette_and_a_background_are_put_on_a_file(saved: Path, tmp_path: Path) -> None:
    made = tmp_path / "new.svg"
    line = (saved, "--items", "star", "--items", "heart", "--palette", "#aa3377,#228833")
    code, _ = run(*line, "--background", "ivory", "-o", made)
    assert code == 0
    text = made.read_text(encoding="utf-8")
    assert all(colour in text for colour in ("#aa3377", "#228833", "#fffff0"))
