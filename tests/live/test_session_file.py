"""Session files: everything comes back, whatever is in them; spoilt ones are refused in a line."""

from __future__ import annotations

import io
import json
import signal
import subprocess
import sys
import textwrap
import zipfile
from collections.abc import Callable
from dataclasses import fields
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

import packwork as pw
from packwork.arrays import FloatArray
from packwork.errors import PackworkError, ReadError, RecipeError, WriteError
from packwork.live.commands.container import SetContainer
from packwork.live.commands.gestures import Drop, Grab
from packwork.live.document import Document
from packwork.live.file.session_file import read_session, unpacked
from packwork.live.file.values import text_of
from packwork.live.log import Log, read_entries
from packwork.scene.item import PhotoArt
from packwork.scene.pose import Poses

QUICK = {"effort": "draft", "levels": "50", "epochs": 40}


@cache
def icons() -> pw.Layout:
    return pw.fill("circle", ["star", "builtin:icons"], count=9, **QUICK)


@cache
def words() -> pw.Layout:
    return pw.words("heart", {"Grüße": 3, "سلام": 2, "fill & <b>": 1}, **QUICK)


def marks(folder: Path) -> pw.Layout:
    table = folder / "t.csv"
    table.write_text("name,value,kind\na,1,x\nb,2,y\nc,3,x\n", encoding="utf-8")
    return pw.chart("circle", table, size_by="value", color_by="kind", **QUICK)


def photos(folder: Path) -> pw.Layout:
    noise = np.random.default_rng(1).integers(0, 255, (30, 40, 3), dtype=np.uint8)
    for name in ("a", "b", "c"):
        Image.fromarray(noise).save(folder / f"{name}.png")
    return pw.photos("square", [folder / f"{name}.png" for name in "abc"], **QUICK)


KINDS: dict[str, Callable[[Path], pw.Layout]] = {
    "icons": lambda folder: icons(),
    "words": lambda folder: words(),
    "marks": marks,
    "photos": photos,
}


def is_equal(one: Document, other: Document) -> bool:
    columns = [(one.poses, other.poses, field.name) for field in fields(Poses)]
    columns += [(one, other, n) for n in ("ids", "weights", "smallest", "largest", "held")]
    assert one.options == other.options
    assert one.next_id == other.next_id
    return all(getattr(a, n).tobytes() == getattr(b, n).tobytes() for a, b, n in columns)


def assert_alike(one: bytes, other: bytes) -> None:
    pixels = [np.asarray(Image.open(io.BytesIO(png)), dtype=float) for png in (one, other)]
    # A photograph is made smaller from another size.
    assert np.abs(pixels[0] - pixels[1]).mean() < 2


@pytest.mark.parametrize("kind", KINDS)
def test_everything_comes_back(tmp_path: Path, kind: str) -> None:
    file = tmp_path / "work.packwork"
    session = KINDS[kind](tmp_path).edit()
    session.hold(0, "angle")
    if kind != "marks":
        session.weigh(1, 2.0)
    else:
        with pytest.raises(pw.RecipeError, match="as large as their numbers say"):
            session.weigh(1, 2.0)
    session.move(2, "50%", "50%")
    session.settle()
    session.remove(1)
    session.undo()
    session.save(file)
    picture = session.layout.to_png(pixels=80)
    for used in tmp_path.glob("*.png"):
        used.unlink()
    again = pw.Session.open(file)
    assert is_equal(session.document, again.document)
    pairs = zip(session.history.past, again.history.past, strict=True)
    assert all(is_equal(one, other) for one, other in pairs)
    if kind == "photos":
        assert isinstance(again.layout.items[0].art, PhotoArt)
    else:
        assert again.layout.to_svg() == session.layout.to_svg()
    assert_alike(again.layout.to_png(pixels=80), picture)
    assert again.is_certified == session.is_certified
    again.save(tmp_path / "again.packwork")
    assert (tmp_path / "again.packwork").read_bytes() == file.read_bytes()
    again.redo()
    assert len(again.document) == len(session.document) - 1


def test_what_is_saved_goes_on_as_what_is_opened(tmp_path: Path) -> None:
    session = icons().edit()
    session.move(2, "50%", "50%")
    session.flow(epochs=7)
    session.save(tmp_path / "a.packwork")
    again = pw.Session.open(tmp_path / "a.packwork")
    for one in (session, again):
        one.flow(epochs=9)
        one.move(3, "40%", "55%")
        one.finish()
    assert is_equal(session.document, again.document)


def test_a_name_that_no_file_can_hold_is_kept_as_well_as_can_be(tmp_path: Path) -> None:
    drawing = tmp_path / "a\x07b.svg"
    drawing.write_text('<svg viewBox="0 0 9 9"><path d="M0 0h9v9z"/></svg>', encoding="utf-8")
    session = pw.fill("circle", [str(drawing)], count=2, **QUICK).edit()
    session.save(tmp_path / "a.packwork")
    again = pw.Session.open(tmp_path / "a.packwork")
    assert again.document.items[0].name == "a\N{REPLACEMENT CHARACTER}b"


def test_a_save_while_items_flow_does_not_forget_where_they_lay(tmp_path: Path) -> None:
    ways = []
    layout = pw.fill("circle", "hexagon", count=60, **QUICK)
    for is_saved in (False, True):
        session = layout.edit()
        session.apply(Grab(items=(2,)))
        for share in (30, 40, 50, 60, 70):
            session.move(2, f"{share}%", "50%")
            session.flow(epochs=8)
        session.apply(Drop())
        if is_saved:
            session.save(tmp_path / "a.packwork")
        ways.append((session.settle().moved, session.marks.unpolished))
    assert ways[1] == ways[0]


def test_the_words_of_a_reopened_session_are_text(tmp_path: Path) -> None:
    session = words().edit()
    session.save(tmp_path / "a.packwork")
    again = pw.Session.open(tmp_path / "a.packwork")
    assert again.layout.to_svg(text="live") == session.layout.to_svg(text="live")


def test_words_that_were_left_out_come_back_with_the_file(tmp_path: Path) -> None:
    session = words().edit()
    session.words({"Grüße": 3, "سلام": 2})
    session.save(tmp_path / "a.packwork")
    assert pw.Session.open(tmp_path / "a.packwork").document.left_out == {"fill & <b>": 1}


KILLED = """
import os, signal, sys
import packwork as pw
session = pw.Session.open(sys.argv[1], journal=True)
session.add("star", 200, 200)
session.settle()
session.move(1, 310, 300)
print(session.document.poses.x.tobytes().hex(), flush=True)
os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="needs a signal that kills")
def test_what_was_done_before_a_crash_is_done_again(tmp_path: Path) -> None:
    file = tmp_path / "work.packwork"
    icons().edit().save(file)
    command = [sys.executable, "-c", textwrap.dedent(KILLED), str(file)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == -signal.SIGKILL, done.stderr
    session = pw.Session.open(file, journal=True)
    assert session.document.poses.x.tobytes().hex() == done.stdout.strip()
    assert len(session.document) == 10
    session.close()
    # It is in the file now, so it is not done twice.
    assert len(pw.Session.open(file).document) == 10
    session.undo()
    session.undo()
    assert len(session.document) == 9
    assert len(pw.Session.open(file).document) == 10


@pytest.mark.parametrize("kind", ["undo", "redo", "settle"])
def test_what_is_no_gesture_is_in_the_file_once_the_journal_has_been_read(
    tmp_path: Path, kind: str
) -> None:
    file = tmp_path / "work.packwork"
    session = icons().edit()
    session.move(0, 300, 300)
    if kind == "redo":
        session.undo()
    session.save(file, journal=True)
    getattr(session, kind)()
    session.close()
    with pw.Session.open(file, journal=True) as again:
        assert is_equal(again.document, session.document)
    assert is_equal(pw.Session.open(file).document, again.document)
    session = pw.Session.open(file, journal=True)
    # What follows goes on from there.
    session.move(1, 310, 310)
    session.close()
    assert is_equal(pw.Session.open(file).document, session.document)


def test_a_crash_between_the_file_and_its_journal_does_nothing_twice(tmp_path: Path) -> None:
    file, journal = tmp_path / "work.packwork", tmp_path / "work.packwork.log"
    icons().edit().save(file)
    with pw.Session.open(file, journal=True) as session:
        session.duplicate(1)
        older = journal.read_bytes()
        session.save()
    journal.write_bytes(older)
    assert len(pw.Session.open(file).document) == 10


def test_a_journal_of_another_file_is_refused(tmp_path: Path) -> None:
    file, journal = tmp_path / "work.packwork", tmp_path / "work.packwork.log"
    session = icons().edit()
    session.save(file)
    journal.write_text('{"follows": "' + "0" * 64 + '"}\n{"settle": null}\n', encoding="utf-8")
    with pytest.raises(ReadError, match=r"is no journal of work\.packwork as it is now"):
        pw.Session.open(file)


def test_a_gesture_that_was_not_ended_is_not_done_again(tmp_path: Path) -> None:
    file = tmp_path / "work.packwork"
    session = icons().edit()
    session.save(file, journal=True)
    session.move(1, 300, 280)
    session.close()
    with (tmp_path / "work.packwork.log").open("a", encoding="utf-8") as journal:
        journal.write('{"do": {"kind": "grab", "items": [0]}}\n{"do": {"kind": "move", "item": 0, ')
    again = pw.Session.open(file)
    assert not again.is_grabbed
    assert is_equal(again.document, session.document)


def test_only_one_session_writes_a_file(tmp_path: Path) -> None:
    file = tmp_path / "work.packwork"
    with icons().edit() as first:
        first.save(file, journal=True)
        first.duplicate(0)
        with pytest.raises(WriteError, match="is open in another session"):
            pw.Session.open(file, journal=True)
        second = pw.Session.open(file)
        with pytest.raises(WriteError, match="is open in another session"):
            second.save()
        first.duplicate(0)
    assert len(pw.Session.open(file).document) == 11
    with pw.Session.open(file, journal=True) as third:
        assert len(third.document) == 11


def test_a_file_that_others_have_changed_is_not_overwritten(tmp_path: Path) -> None:
    file = tmp_path / "work.packwork"
    icons().edit().save(file)
    one, other = pw.Session.open(file), pw.Session.open(file)
    one.duplicate(0)
    one.save()
    other.remove(0)
    with pytest.raises(WriteError, match="was changed by others"):
        other.save()
    other.save(tmp_path / "elsewhere.packwork")
    assert len(pw.Session.open(file).document) == 10


def test_a_save_that_fails_leaves_the_journal_going(tmp_path: Path) -> None:
    file, folder = tmp_path / "work.packwork", tmp_path / "folder.packwork"
    folder.mkdir()
    session = icons().edit()
    session.save(file, journal=True)
    session.move(0, "50%", "50%")
    session.flow(epochs=3)
    with pytest.raises(WriteError):
        session.save(folder)
    session.apply(Grab(items=(0,)))
    with pytest.raises(RecipeError, match="held by the hand"):
        session.save(tmp_path / "elsewhere.packwork")
    session.apply(Drop())
    session.flow(epochs=20)
    session.settle()
    session.close()
    again = pw.Session.open(file)
    for axis in fields(Poses):
        done = getattr(again.document.poses, axis.name)
        assert np.array_equal(done, getattr(session.document.poses, axis.name))


def test_a_session_saved_elsewhere_goes_on_there(tmp_path: Path) -> None:
    first, second = tmp_path / "first.packwork", tmp_path / "second.packwork"
    session = icons().edit()
    session.save(first, journal=True)
    session.duplicate(0)
    session.save(second)
    session.duplicate(0)
    session.save()
    assert len(pw.Session.open(first).document) == 10
    assert len(pw.Session.open(second).document) == 11


def test_nothing_is_saved_while_something_is_held_by_the_hand(tmp_path: Path) -> None:
    from packwork.live.commands.gestures import Grab

    session = icons().edit()
    session.apply(Grab(items=(0,)))
    with pytest.raises(PackworkError, match="drop it first"):
        session.save(tmp_path / "a.packwork")
    with pytest.raises(PackworkError, match="has no file yet"):
        icons().edit().save()
    assert not list(tmp_path.iterdir())


@pytest.fixture(scope="module")
def good() -> bytes:
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        session = words().edit()
        session.move(1, "50%", "52%")
        session.save(Path(folder, "a.packwork"))
        return Path(folder, "a.packwork").read_bytes()


def refused(data: bytes) -> str:
    try:
        read_session(data, "a.packwork")
    except ReadError as error:
        said = str(error)
    else:
        return ""
    assert "\n" not in said
    assert said.startswith("a.packwork: ")
    return said


@settings(max_examples=60, deadline=None, derandomize=True)
@given(data=st.data())
def test_spoilt_files_are_refused_in_one_line(good: bytes, data: st.DataObject) -> None:
    spoilt = bytearray(good)
    for _ in range(data.draw(st.integers(1, 4))):
        spoilt[data.draw(st.integers(0, len(spoilt) - 1))] = data.draw(st.integers(0, 255))
    refused(bytes(spoilt))
    assert refused(good[: data.draw(st.integers(0, len(good) - 1))])


def stored(parts: dict[str, bytes]) -> bytes:
    """File of parts that takes no time to pack."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        for name, data in parts.items():
            archive.writestr(name, data)
    return file.getvalue()


JUNK = st.one_of(
    st.none(), st.booleans(), st.integers(-3, 2**70), st.floats(), st.text(max_size=5),
    st.just([]), st.just({}), st.just([1, 2]), st.just("A" * 16), st.just(1e300),
)  # fmt: skip


@settings(max_examples=60, deadline=None, derandomize=True)
@given(data=st.data())
def test_values_of_any_kind_are_refused_in_one_line(good: bytes, data: st.DataObject) -> None:
    parts = dict(unpacked(good))
    name = data.draw(st.sampled_from(sorted(p for p in parts if p.endswith(".json"))))
    found = json.loads(parts[name])
    within, keys = found, list(found)
    while True:
        key = data.draw(st.sampled_from(keys))
        deeper = within[key]
        is_leaf = not isinstance(deeper, dict | list) or not deeper or data.draw(st.booleans())
        if is_leaf:
            within[key] = data.draw(JUNK)
            break
        within = deeper
        keys = list(deeper) if isinstance(deeper, dict) else list(range(len(deeper)))
    parts[name] = json.dumps(found).encode()
    refused(stored(parts))


DRAWN = """<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="30mm" viewBox="0 0 40 30">
<path d="M2 2h20c9 3 9 16 0 20H2z"/></svg>"""


@pytest.fixture(scope="module")
def cut(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    folder = tmp_path_factory.mktemp("cut")
    (folder / "a.svg").write_text(DRAWN, encoding="utf-8")
    session = pw.nest("100x80mm", [str(folder / "a.svg")], passes=1).layouts[0].edit()
    session.save(folder / "a.packwork")
    return (folder / "a.packwork").read_bytes()


def with_path(cut: bytes, path: str) -> bytes:
    def spoil(parts: dict[str, bytes]) -> None:
        (name,) = (one for one in parts if one.startswith("items/"))
        item = json.loads(parts[name])
        assert "C" in item["art"]["path"]
        item["art"]["path"] = path
        parts[name] = json.dumps(item).encode()

    return changed(cut, spoil)


@pytest.mark.parametrize(
    ("path", "said"),
    [
        ("M9 9Z", "that leave their part"),
        ("M9 9", "that leave their part"),
        ("M9 9L12 12ZM13 13Z", ""),
        ("M13 13ZM9 9L12 12Z", ""),
        ("M9 9L12 12ZM13 13H900Z", "that leave their part"),
    ],
)
def test_paths_with_pieces_that_draw_nothing_are_read(cut: bytes, path: str, said: str) -> None:
    assert said in refused(with_path(cut, path))
    assert bool(said) == bool(refused(with_path(cut, path)))


PIECES = [
    *"MmZzLlHhVvCcSsQqTtAa", "M9 9", "M9 9Z", "M12 12Z", "M12 12L13 9", "L13 9Z", "11 12 ", "3 ",
    "-", ".", "e", ",", "1e99", "2 2 0 0 1 13 13",
]  # fmt: skip


@settings(max_examples=60, deadline=None, derandomize=True)
@given(pieces=st.lists(st.sampled_from(PIECES), max_size=12))
def test_paths_of_any_kind_are_read_or_refused(cut: bytes, pieces: list[str]) -> None:
    refused(with_path(cut, "M9 9" + "".join(pieces)))


def changed(good: bytes, change: Callable[[dict[str, bytes]], None]) -> bytes:
    parts = dict(unpacked(good))
    change(parts)
    return stored(parts)


def test_a_font_that_is_none_is_refused(good: bytes) -> None:
    def spoil(parts: dict[str, bytes]) -> None:
        for name in parts:
            if name.startswith("fonts/"):
                parts[name] = b"no font"

    assert "is not a font" in refused(changed(good, spoil))


def test_a_part_that_is_missing_is_named(good: bytes) -> None:
    def spoil(parts: dict[str, bytes]) -> None:
        for name in [one for one in parts if one.startswith("items/")]:
            del parts[name]

    assert "lacks its part items/" in refused(changed(good, spoil))


def test_drawings_go_through_the_gate(good: bytes) -> None:
    bad = '<script>alert(1)</script><image xlink:href="file:///etc/passwd"/><path d="M0 0h9v9z"/>'

    def spoil(parts: dict[str, bytes]) -> None:
        for name in [one for one in parts if one.startswith("items/")]:
            item = json.loads(parts[name])
            item["art"] = {"kind": "vector", "markup": bad, "matrix": [1, 0, 0, 0, 1, 0]}
            parts[name] = json.dumps(item).encode()

    kept, _ = read_session(changed(good, spoil), "a.packwork")
    markup = kept.document.items[0].art.markup  # type: ignore[union-attr]
    assert "script" not in markup
    assert "passwd" not in markup
    assert "M0 0h9v9z" in markup


SCRIBBLE = np.random.default_rng(0).uniform(-50, 50, (3_000, 2))
NESTED = np.linspace(1.0, 0.1, 3_000)[:, None, None] * np.array([[-3, -3], [6, -3], [-3, 6.0]])
ONE_IN_ANOTHER = NESTED.reshape(-1, 2)


@pytest.mark.parametrize("part", ["items/", "containers/"])
@pytest.mark.parametrize(
    ("points", "starts", "said"),
    [
        (SCRIBBLE, [0, len(SCRIBBLE)], "crosses itself about"),
        (ONE_IN_ANOTHER, list(range(0, len(ONE_IN_ANOTHER) + 1, 3)), "pairs of rings in each"),
    ],
)
def test_outlines_that_would_take_minutes_are_refused(
    good: bytes, part: str, points: FloatArray, starts: list[int], said: str
) -> None:
    def spoil(parts: dict[str, bytes]) -> None:
        for name in [one for one in parts if one.startswith(part)]:
            thing = json.loads(parts[name])
            thing["outline"] = {"points": text_of(points), "starts": starts}
            parts[name] = json.dumps(thing).encode()

    assert said in refused(changed(good, spoil))


def zip_of(**parts: bytes) -> bytes:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in parts.items():
            archive.writestr(name.replace("__", "/"), data)
    return file.getvalue()


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (lambda: b"", "is no session file"),
        (lambda: b"PK\x03\x04nonsense", "is no session file"),
        (lambda: zip_of(a=b""), "'a', which is no part"),
        (lambda: zip_of(**{"..__..__etc__passwd": b""}), "which is no part"),
        (lambda: zip_of(**{"session.json": b"{"}), "cannot be read"),
        (lambda: zip_of(**{"session.json": b'{"format": 2}'}), "cannot be read"),
        (lambda: zip_of(**{"session.json": bytes(100_000_001)}), "unpacks to more than 100 MB"),
    ],
)
def test_what_is_no_session_is_refused(data: Callable[[], bytes], said: str) -> None:
    # Made here, for each process collects all tests.
    assert said in refused(data())


def test_a_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(ReadError, match="nothing"):
        pw.Session.open(tmp_path / "nothing.packwork")


def test_a_map_is_kept_once_however_large_it_is_and_however_many_sheets_it_was_on(
    tmp_path: Path,
) -> None:
    file, begun = tmp_path / "a.packwork", icons().edit().document
    stream, land = io.StringIO(), b'{"type": "FeatureCollection"}' + b" " * 21_000_000
    session = pw.Session(begun, log=Log(stream))
    for name, side in (("a", 500.0), ("b", 400.0)):
        room = pw.Container(name, f"{name}.json", [(0, 0), (side, 0), (side, side)], file=land)
        session.library.containers[name] = room
        session.apply(SetContainer(asset=name))
    session.save(file)
    with zipfile.ZipFile(file) as archive:
        assert sum(info.file_size for info in archive.infolist()) < 2 * len(land)
    again = pw.Session.open(file)
    assert again.layout.container.file == land
    assert again.history.past[-1].container.file is again.layout.container.file
    # The journal of the session, too.
    session.log.flush()
    assert len(stream.getvalue()) < 2 * len(land)
    lines = iter(stream.getvalue().splitlines())
    brought = [value for kind, value in read_entries(lines, "log") if kind == "container"]
    assert [(name, room.file == land) for name, room in brought] == [("a", True), ("b", True)]
    assert brought[0][1].file is brought[1][1].file


def test_a_map_that_is_too_large_is_left_out_in_a_line(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    session = icons().edit()
    room = pw.Container("land", "land.json", [(0, 0), (9, 0), (9, 9)], file=b"{}" * 500_001)
    session.library.containers["land"] = room
    session.apply(SetContainer(asset="land"))
    session.save(tmp_path / "a.packwork")
    monkeypatch.setattr("packwork.live.file.things.MAX_MAP_BYTES", 1_000_000)
    with pytest.raises(ReadError, match="a map of more than 1 MB"):
        pw.Session.open(tmp_path / "a.packwork")
    session.save(tmp_path / "b.packwork")
    assert "the map of land is not kept: it has more than 1 MB" in caplog.text
    assert pw.Session.open(tmp_path / "b.packwork").layout.container.file is None


def on_land(file: bytes, *sides: float) -> pw.Session:
    session = icons().edit()
    for k, side in enumerate(sides):
        room = pw.Container("land", "", [(0, 0), (side, 0), (side, side)], file=file + b" " * k)
        session.library.containers[f"land{k}"] = room
        session.apply(SetContainer(asset=f"land{k}"))
    return session


def test_a_map_of_blanks_can_be_opened_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("packwork.live.file.session_file.EASILY_UNPACKED", 1_000_000)
    session = on_land(b"{}" + b" " * 3_000_000, 500.0)
    session.save(tmp_path / "a.packwork")
    assert pw.Session.open(tmp_path / "a.packwork").layout.container.file == (
        session.layout.container.file
    )
    assert (tmp_path / "a.packwork").stat().st_size < 500_000
    with zipfile.ZipFile(tmp_path / "a.packwork") as archive:
        assert archive.testzip() is None


def test_no_file_is_written_that_is_too_large_to_be_opened(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    session, file = on_land(bytes(1_000_000), 500.0, 450.0, 400.0), tmp_path / "a.packwork"
    monkeypatch.setattr("packwork.live.file.session_file.MOST_BYTES", 2_500_000)
    session.save(file)
    assert "too large; it is kept without 2 steps of undo" in caplog.text
    again = pw.Session.open(file)
    assert again.layout.container.file == session.layout.container.file
    assert len(again.history.past) == 1
    kept = file.read_bytes()
    monkeypatch.setattr("packwork.live.file.session_file.MOST_PART_BYTES", 900_000)
    with pytest.raises(WriteError, match="could not be opened again: it takes 1 MB"):
        session.save(file)
    assert file.read_bytes() == kept


def test_nothing_is_packed_twice(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    session = on_land(b"{}", 500.0)
    session.save(tmp_path / "a.packwork")
    monkeypatch.delattr("packwork.live.file.things.part_of")
    session.save()
    assert pw.Session.open(tmp_path / "a.packwork").layout.container.file == b"{}"


def test_a_full_disk_leaves_no_half_line_in_the_journal(tmp_path: Path) -> None:
    resource = pytest.importorskip("resource")
    file = tmp_path / "a.packwork"
    session = icons().edit()
    session.save(file, journal=True)
    session.move(0, 300, 300)
    room = pw.Container("land", "", [(0, 0), (500, 0), (500, 500)], file=bytes(1_000_000))
    session.library.containers["land"] = room
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (500_000, before[1]))
    try:
        with pytest.raises(WriteError, match="make room"):
            session.apply(SetContainer(asset="land"))
        assert pw.Session.open(file).document.poses.x[0] == 300
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    session.move(1, 200, 200)
    session.close()
    again = pw.Session.open(file)
    assert is_equal(again.document, session.document)
    assert again.layout.container.file == room.file


@pytest.mark.parametrize(
    ("line", "told"),
    [(b'{"do": {"kind": "mo\n', "line 2 is no entry of a log"),
     (b'{"do": {"kind": "move", "item": 99, "x": 1, "y": 1}}\n', "move: there is no item")],
)  # fmt: skip
def test_a_journal_is_done_again_as_far_as_it_can_be(
    line: bytes, told: str, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    file, journal = tmp_path / "a.packwork", tmp_path / "a.packwork.log"
    session = icons().edit()
    session.save(file, journal=True)
    for k, copy in enumerate((".spoilt", ".spoilt1")):
        for item in range(3):
            session.move(item, 300 + k, 300)
        session.close()
        lines = journal.read_bytes().splitlines(keepends=True)
        spoilt = b"".join([*lines[:2], line, *lines[3:]])
        journal.write_bytes(spoilt)
        session = pw.Session.open(file, journal=True)
        moved = session.document.poses.x[:3] == 300 + k
        assert moved.tolist() == [True, False, False]
        assert told in caplog.text
        assert f"kept in a.packwork.log{copy}" in caplog.text
        assert (tmp_path / f"a.packwork.log{copy}").read_bytes() == spoilt
    session.close()


def test_a_journal_does_not_grow_beyond_what_is_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file, journal = tmp_path / "a.packwork", tmp_path / "a.packwork.log"
    session = icons().edit()
    session.save(file, journal=True)
    session.move(0, 300, 300)
    monkeypatch.setattr("packwork.live.file.disk.MOST_BYTES", journal.stat().st_size + 9)
    with pytest.raises(WriteError, match="is full; save the session"):
        session.move(1, 200, 200)
    assert journal.stat().st_size < 300
    monkeypatch.undo()
    session.save()
    session.move(2, 250, 250)
    session.close()
    assert is_equal(pw.Session.open(file).document, session.document)
