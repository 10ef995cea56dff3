"""The command line in process, in a folder of its own, with files to misuse."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Callable
from pathlib import Path

import pytest
from PIL import Image
from typer.testing import CliRunner, Result

from packwork.cli import app

Command = Callable[..., Result]

TILE = '<svg viewBox="0 0 9 9"><rect width="4" height="4"/></svg>'


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Empty working folder."""
    home = tmp_path / "work"
    home.mkdir()
    monkeypatch.chdir(home)
    monkeypatch.setenv("TERM", "dumb")
    monkeypatch.setenv("COLUMNS", "200")
    return home


@pytest.fixture
def packwork() -> Command:
    """Run a command line; an exception other than an exit fails the test."""

    def run(line: str, *more: str) -> Result:
        result = CliRunner().invoke(app, [*line.split(), *more])
        if result.exception is not None and not isinstance(result.exception, SystemExit):
            raise result.exception
        return result

    return run


def svg(inside: str, root: str = 'viewBox="0 0 9 9"') -> str:
    links = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
    return f"<svg {links} {root}>{inside}</svg>"


def nested_use(depth: int) -> str:
    """Ten times as many nodes a level: ten to the ``depth`` in all."""
    steps = (
        f'<g id="g{k}">' + f'<use xlink:href="#g{k - 1}"/>' * 10 + "</g>"
        for k in range(1, depth + 1)
    )
    first = '<rect id="g0" width="1" height="1"/>'
    return svg(f'<defs>{first}{"".join(steps)}</defs><use xlink:href="#g{depth}"/>')


def bomb(width: int, height: int) -> bytes:
    """PNG of a few bytes whose header claims a huge picture."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))

    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", header)
        + chunk(b"IDAT", zlib.compress(bytes(1000)))
        + chunk(b"IEND", b"")
    )


ENTITIES = '<!DOCTYPE svg [<!ENTITY a "0123456789"><!ENTITY b "&a;&a;&a;&a;&a;">]>' + svg(
    "<text>&b;</text>"
)
EXTERNAL_ENTITY = '<!DOCTYPE svg [<!ENTITY a SYSTEM "file:///etc/hostname">]>' + svg(
    "<text>&a;</text>"
)

TEXTS = {
    "empty.svg": "",
    "blank.svg": " \n",
    "cut.svg": '<svg viewBox="0 0 9 9"><path d="M0 0',
    "html.svg": "<html><body>404</body></html>",
    "shapeless.svg": svg(""),
    "line.svg": svg('<path fill="none" d="M0 0L9 9"/>'),
    "flat.svg": svg('<path d="M0 0L9 9L0 0z"/>'),
    "nan.svg": svg('<path d="M0 0L9 NaN L0 9z"/>'),
    "nan-rect.svg": svg('<rect width="NaN" height="4"/>'),
    "huge.svg": svg('<path d="M0 0L1e300 0L0 1e300z"/>'),
    "entities.svg": ENTITIES,
    "external-entity.svg": EXTERNAL_ENTITY,
    "nested.svg": nested_use(9),
    "cycle.svg": svg('<g id="a"><use xlink:href="#a"/></g>'),
    "words.csv": "name,weight\nstar,heavy\n",
    "broken.png": "no picture",
    "broken.geojson": "{",
    "note.txt": "hello",
}


@pytest.fixture
def misfits(folder: Path) -> Path:
    """One file of every kind that cannot be used."""
    for name, text in TEXTS.items():
        (folder / name).write_text(text, encoding="utf-8")
    (folder / "nothing").mkdir()
    (folder / "no-items").mkdir()
    (folder / "no-items" / "note.txt").write_text("hello", encoding="utf-8")
    (folder / "all-bad").mkdir()
    (folder / "all-bad" / "bad.svg").write_text("<svg", encoding="utf-8")
    (folder / "some-bad").mkdir()
    (folder / "some-bad" / "bad.svg").write_text("<svg", encoding="utf-8")
    (folder / "some-bad" / "good.svg").write_text(TILE, encoding="utf-8")
    (folder / "bomb.png").write_bytes(bomb(60_000, 60_000))
    Image.new("L", (40, 40), 255).save(folder / "light.png")
    Image.new("L", (3, 1), 0).save(folder / "three.png")
    Image.new("RGBA", (40, 40), (0, 0, 0, 0)).save(folder / "clear.png")
    return folder
