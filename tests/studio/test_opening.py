"""Documents that pages send: sessions, recipes and layouts take the desk."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import packwork as pw
from packwork.live.document import Document
from packwork.live.face.exporting import kept_bytes
from packwork.live.face.opening import Opening, opening_sent, read_once
from packwork.live.session import Session
from packwork.readers.layouts.read import SESSION
from packwork.studio.kept_workspaces import Shelf
from packwork.studio.tab import Tab
from packwork.studio.workspace import Workspace

RECIPE = 'container = "star"\nitems = ["heart"]\ncount = 4\nlevels = "50"\nepochs = 40\n'
SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path d="M0 0h9v4H5v5H0z"/></svg>'


@pytest.fixture(scope="module")
def five() -> pw.Layout:
    """Five hearts in a star."""
    return pw.fill("star", "heart", count=5, epochs=60, levels="50")


def sent(tab: Tab | None, *files: tuple[str, bytes]) -> str:
    """Name of files that a page has sent."""
    assert tab is not None
    uploads = tab.importer._uploads
    batch = uploads.new_batch()
    for name, data in files:
        uploads.add(batch, name, data)
    return f"file:{batch}"


def written(layout: pw.Layout, folder: Path, ending: str) -> bytes:
    """Bytes of a layout in a format."""
    if ending == SESSION:
        session = Session(Document.from_layout(layout))
        return kept_bytes(session.kept())
    layout.save(folder / f"five{ending}")
    return (folder / f"five{ending}").read_bytes()


@pytest.mark.parametrize("ending", [SESSION, ".svg", ".geojson", ".dxf"])
def test_what_the_program_writes_opens(play, five: pw.Layout, tmp_path: Path, ending: str) -> None:
    data = written(five, tmp_path, ending)

    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified)
        before = desk.owner
        page.tell(type="do", n=1, command={"kind": "hold", "items": [3]})
        page.tell(type="bring", sources=[sent(page.tab, (f"five{ending}", data))])
        await page.until(lambda: len(page.last("scene")["items"]) == 5 and page.is_certified)
        assert page.last("scene")["name"] == ("five" if ending == ".dxf" else "star")
        assert page.last("scene")["title"] == "five"
        assert desk.owner is not before
        # What the last session was told is answered once; commands go to this one.
        await page.until(lambda: page.done == 1)
        page.tell(type="do", n=2, command={"kind": "hold", "items": [0]})
        await page.until(lambda: page.done == 2 and any(page.last("scene")["items"][0]["held"]))

    play(scenario)


def test_a_recipe_runs_with_what_was_sent_with_it(play) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified)
        own = RECIPE.replace("heart", "tile.svg").encode()
        source = sent(page.tab, ("own.toml", own), ("tile.svg", SVG.encode()))
        page.tell(type="open", source=source)
        await page.until(lambda: len(page.last("scene")["items"]) == 4 and page.is_certified)
        assert page.last("scene")["items"][0]["name"] == "tile"
        assert page.last("scene")["title"] == "own"
        # All that are exported are called so.
        page.tell(type="open", source=sent(page.tab, ("recipe.toml", RECIPE.encode())))
        await page.until(lambda: page.last("scene")["title"] == "star")
        # A document that has a title keeps it, whatever its file is called.
        session = Session(desk.owner.frame.document)
        session.do("entitle", title="Für Ada")
        page.tell(type="open", source=sent(page.tab, ("a.packwork", kept_bytes(session.kept()))))
        await page.until(lambda: page.last("scene")["title"] == "Für Ada")

    play(scenario)


MAP = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 90 60">
<path id="be" d="M0 0h44v60H0z"><title>West</title></path><path id="bern" d="M46 0h44v60H46z"/>
<path id="nook" d="M44 29h2v2h-2z"/></svg>"""


def test_parts_of_a_map_that_was_sent_have_their_names(play) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified)

        async def poured(text: str, names: bool) -> dict[str, dict]:
            source = sent(page.tab, ("map.svg", text.encode()))
            before = page.last("scene")["version"]
            page.tell(type="room", source=source, names=names)
            await page.until(lambda: page.last("scene")["version"] > before and page.is_certified)
            return {one["name"]: one for one in page.last("scene")["items"]}

        items = await poured(MAP, names=True)
        assert items["West"]["held"] == items["bern"]["held"] == [True, True, True]
        assert "nook: has no room for its name" in page.last("line")["text"]
        x = desk.owner.frame.document.poses.x[-2:]
        side = desk.owner.frame.document.container.width
        assert x[0] < 0.49 * side < 0.51 * side < x[1]
        # Names of the map before go with it; a file of any name that a session knows is not read.
        assert len(await poured(MAP, names=False)) == len(items) - 2
        await poured(SVG, names=True)
        assert page.last("line")["text"].startswith("map names no parts")

    play(scenario)


@pytest.mark.parametrize(
    "name", ["/etc/hosts", "../../secret.svg", "/no/*.svg", "near.svg", "[n]ear*", "a secret"]
)
def test_a_recipe_that_names_what_was_not_sent_is_refused(
    play, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    # What lies where the studio was started is not read either.
    monkeypatch.chdir(tmp_path)
    for one in ("near.svg", "a secret"):
        (tmp_path / one).write_text(SVG, encoding="utf-8")

    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified)
        data = RECIPE.replace("heart", name).encode()
        page.tell(type="open", source=sent(page.tab, ("own.toml", data)))
        await page.until(lambda: page.said("line"))
        said = page.last("line")["text"]
        assert "which was not sent with it" in said or "near.svg" in said
        assert str(tmp_path) not in said
        assert len(page.last("scene")["items"]) == 12

    play(scenario)


@pytest.mark.parametrize(
    ("files", "said"),
    [
        ([("a.packwork", b"PK\x03\x04nothing")], "a.packwork"),
        ([("a.geojson", b"{")], "a.geojson"),
        ([("a.toml", b'losses = {"os:system" = 1}')], "is code"),
        ([("a.geojson", b"{}"), ("b.packwork", b"")], "open it alone"),
        ([("letter.doc", b"\xd0\xcf")], "what was sent"),
    ],
)
def test_what_cannot_be_opened_is_a_line_and_the_desk_stays(
    play, files: list[tuple[str, bytes]], said: str
) -> None:
    async def scenario(desk: Workspace, open_page: Callable) -> None:
        page = open_page()
        await page.until(lambda: page.is_certified)
        before = desk.owner
        page.tell(type="bring", sources=[sent(page.tab, *files)])
        await page.until(lambda: page.said("line"))
        text = page.last("line")["text"]
        assert said in text
        assert not text.startswith(":")
        assert desk.owner is before
        await page.until(lambda: page.is_certified)

    play(scenario)


class OneFile(Shelf):
    """Always the same file."""

    def __init__(self, file: Path) -> None:
        self._file = file

    def new_file(self) -> Path:
        return self._file


def test_drawings_are_no_documents(tmp_path: Path) -> None:
    (tmp_path / "tile.svg").write_text(SVG, encoding="utf-8")
    assert opening_sent(tmp_path) is None


def test_what_is_opened_is_kept_apart_from_what_was_there(
    opening: Opening, five: pw.Layout, tmp_path: Path
) -> None:
    first, second = tmp_path / "first.packwork", tmp_path / "second.packwork"

    async def work() -> None:
        desk = Workspace(Opening(document=opening.document, kept_in=first), OneFile(second))
        await desk.begin()
        while desk.owner is None:
            await asyncio.sleep(0.01)
        five.save(tmp_path / "five.geojson")
        found = Opening(document=Document.from_layout(five))
        await asyncio.to_thread(desk.open_another, found)
        await asyncio.to_thread(desk.close)

    asyncio.run(work())
    kept = [read_once(file).document for file in (first, second)]
    assert [len(one) for one in kept] == [12, 5]
    assert np.array_equal(kept[1].poses.x, five.poses.x)
