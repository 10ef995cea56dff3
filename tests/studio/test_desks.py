"""Desks on disk: found again with all that undo leads to, also after a crash."""

from __future__ import annotations

import asyncio
import os
from pathlib import Path

import pytest

import packwork as pw
from packwork.errors import PackworkError
from packwork.live.commands.items import Rename
from packwork.live.document import Document
from packwork.live.face import opening
from packwork.live.face.opening import Opening, kept_in, opened
from packwork.live.session import Session
from packwork.studio import kept_workspaces
from packwork.studio.workspace import Workspace


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("PACKWORK_CACHE_DIR", str(tmp_path))
    return tmp_path / "studio"


def test_the_desk_left_alone_for_longest_is_written_over(folder: Path) -> None:
    with pytest.raises(PackworkError, match="nothing is kept to go on with"):
        kept_workspaces.last()
    for time in range(kept_workspaces.MOST_WORKSPACES):
        kept = kept_workspaces.new()
        assert kept is not None
        kept.file.write_bytes(b"")
        os.utime(kept.file, (1_000 + time, 1_000 + time))
    assert kept_workspaces.last().file.name == f"desk-{kept_workspaces.MOST_WORKSPACES}.packwork"
    again = kept_workspaces.new()
    assert again is not None
    assert again.file.name == "desk-1.packwork"


def test_a_desk_that_somebody_works_at_is_nobody_elses(folder: Path) -> None:
    first = kept_workspaces.new()
    assert first is not None
    session = Session(
        Document.from_layout(pw.fill("circle", "star", count=3, effort="draft", levels="50"))
    )
    keeper = kept_in(first.file, session)
    os.utime(first.file, (1_000, 1_000))
    os.utime(opening.lock_of(first.file), (1_000, 1_000))
    others = [kept_workspaces.new() for _ in range(kept_workspaces.MOST_WORKSPACES)]
    assert all(one is not None and one.file != first.file for one in others)
    assert first.file.exists()
    keeper.end(session)


def test_two_that_begin_at_once_have_a_desk_each(folder: Path) -> None:
    # Neither has written anything yet.
    first, second = kept_workspaces.new(), kept_workspaces.new()
    assert first is not None
    assert second is not None
    assert first.file != second.file


def read(file: Path) -> Session:
    """What a file holds, left as it is."""
    session, keeper = opened(file)
    keeper.end(session)
    return session


def test_a_place_is_remembered_for_its_user_alone() -> None:
    kept = kept_workspaces.of_file(Path("work.packwork"))
    assert kept.address == (0, "")
    kept.remember(8123, "a" * 64)
    assert kept.address == (8123, "a" * 64)
    assert kept.place is not None
    if os.name == "posix":
        assert kept.place.stat().st_mode & 0o077 == 0


@pytest.mark.parametrize("said", ["", "[]", "{}", '{"port": 1, "key": "short"}', '{"port": "x"}'])
def test_a_place_that_means_nothing_is_none(said: str) -> None:
    kept = kept_workspaces.of_file(Path("work.packwork"))
    assert kept.place is not None
    kept.place.write_text(said, encoding="utf-8")
    assert kept.address == (0, "")


def test_what_was_done_before_a_crash_is_there_again(dozen: pw.Layout, tmp_path: Path) -> None:
    file = tmp_path / "desk.packwork"
    session = Session(Document.from_layout(dozen))
    left = kept_in(file, session)
    for name in ("one", "two"):
        session.apply(Rename(item=0, name=name))
    # Nothing more is written: as a crash leaves it.
    left._disk.close(session)
    again, keeper = opened(file)
    assert again.document.items[0].name == "two"
    assert len(again.history) == 2
    keeper.end(again)
    assert read(file).document.items[0].name == "two"


def test_a_long_journal_is_written_into_the_file(
    dozen: pw.Layout, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(opening, "LONGEST_JOURNAL", 300)
    session = Session(Document.from_layout(dozen))
    keeper = kept_in(tmp_path / "desk.packwork", session)
    assert not keeper.is_long
    for number in range(9):
        session.apply(Rename(item=0, name=f"a long name {number}"))
    assert keeper.is_long
    keeper.tidy(session)
    assert not keeper.is_long
    keeper.end(session)
    assert len(read(tmp_path / "desk.packwork").history) == 9


def test_a_desk_that_is_closed_is_kept(opening: Opening, tmp_path: Path) -> None:
    file = tmp_path / "desk.packwork"

    async def work() -> None:
        desk = Workspace(Opening(document=opening.document, kept_in=file))
        await desk.begin()
        while desk.owner is None:
            await asyncio.sleep(0.01)
        desk.owner.post(Rename(item=0, name="kept"))
        await asyncio.to_thread(desk.close)

    asyncio.run(work())
    session = read(file)
    assert session.document.items[0].name == "kept"
    assert session.history.can_undo


def test_a_page_is_told_what_of_a_journal_could_not_be_done_again(
    dozen: pw.Layout, tmp_path: Path
) -> None:
    file = tmp_path / "desk.packwork"
    session = Session(Document.from_layout(dozen))
    left = kept_in(file, session)
    session.apply(Rename(item=0, name="one"))
    left._disk.close(session)
    with left._disk.journal.open("ab") as journal:
        journal.write(b'{"do": {"kind": "rename", "item": 99, "name": "x"}}\n')
    told = list[str]()

    async def work() -> None:
        desk = Workspace(Opening(file=file))
        desk.listen("a page", lambda news: told.append(getattr(news, "text", "")))
        await desk.begin()
        while desk.owner is None:
            await asyncio.sleep(0.01)
        await asyncio.to_thread(desk.close)
        assert desk.owner.frame.document.items[0].name == "one"

    asyncio.run(work())
    (line,) = filter(None, told)
    assert f"{file}.log: rename" in line
    assert line.endswith("all of it is kept in desk.packwork.log.spoilt")
