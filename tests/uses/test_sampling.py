"""Which items are taken where folders hold more than are needed."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

import packwork as pw
from packwork.readers import items as item_reader
from packwork.readers.folders import Sample
from packwork.readers.items import read_items

QUICK: dict[str, Any] = {"effort": "draft", "levels": "50"}


def drawing(side: float) -> str:
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 40">'
        f'<path d="M0 0H{side}V40H0z"/></svg>'
    )


@pytest.fixture
def icons(tmp_path: Path) -> Path:
    folder = tmp_path / "icons"
    folder.mkdir()
    for k in range(60):
        (folder / f"i{k:02}.svg").write_text(drawing(10 + k % 30), encoding="utf-8")
    return folder


def names(layout: pw.Layout) -> set[str]:
    return {item.name for item in layout.items}


def test_items_are_drawn_from_the_whole_folder_and_no_others_are_read(
    icons: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    read: list[str] = []
    reader = item_reader._ONE_EACH[".svg"]

    def counting(file: Any, *more: Any) -> Any:
        read.append(file)
        return reader(file, *more)

    monkeypatch.setitem(item_reader._ONE_EACH, ".svg", counting)
    seen: set[str] = set()
    for seed in range(6):
        read.clear()
        layout = pw.fill("square", icons, count=6, seed=seed, **QUICK)
        assert len(read) == 6
        seen |= names(layout)
    assert "6 of 60 are taken, drawn by the seed" in caplog.text
    assert max(seen) > "i40"
    assert names(pw.fill("square", icons, count=6, seed=5, **QUICK)) == names(layout)


def test_the_first_are_taken_where_that_is_asked(
    icons: Path, caplog: pytest.LogCaptureFixture
) -> None:
    layout = pw.fill("square", icons, count=3, items_from="first", **QUICK)
    assert names(layout) == {"i00", "i01", "i02"}
    assert "3 of 60 are taken, the first by name" in caplog.text


def test_what_is_named_is_among_those_that_are_drawn(icons: Path) -> None:
    with_star = pw.fill("square", [icons, "star"], count=4, **QUICK)
    assert "star" in names(with_star)
    assert "i07" in names(pw.fill("square", icons, count=4, hero="i07=40%", **QUICK))
    ruled = pw.fill("square", icons, count=4, rules=[{"items": "i5*", "color": "red"}], **QUICK)
    assert any(name.startswith("i5") for name in names(ruled))


@pytest.mark.parametrize("verb", [pw.fill, pw.photos])
@pytest.mark.parametrize(
    "asked", [{"hero": "bee"}, {"rules": [{"items": "bee", "color": "red"}]}], ids=list
)
def test_what_is_named_of_values_in_memory_is_taken(verb: Any, asked: dict[str, Any]) -> None:
    called = ("ant", "bee", "cat", "dog", "eel", "fox")
    images = {name: Image.new("RGB", (40, 30), "white") for name in called}
    for k, image in enumerate(images.values()):
        image.paste((40 * k, 90, 60), (5, 5, 35, 25))
    for seed in range(3):
        assert "bee" in names(verb("circle", images, count=2, seed=seed, **asked, **QUICK))


def test_files_that_are_no_items_make_room_for_others(icons: Path) -> None:
    for k in range(20):
        (icons / f"bad{k}.svg").write_text("<svg", encoding="utf-8")
    assert len(read_items(str(icons), sample=Sample(30, seed=1)).items) == 30


def test_weights_of_all_may_be_given(icons: Path) -> None:
    weights = {f"i{k:02}": 1.0 + k for k in range(60)}
    layout = pw.fill("square", icons, count=5, weights=weights, sizes="shared", **QUICK)
    assert len(names(layout)) == 5
    assert names(layout) != {f"i{k:02}" for k in range(5)}


def test_photos_are_drawn_likewise(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    for k in range(12):
        Image.new("RGB", (30, 20), (20 * k, 90, 60)).save(tmp_path / f"p{k:02}.jpg")
    drawn = pw.photos("square", str(tmp_path), count=3, seed=2, **QUICK)
    assert len(drawn.items) == 3
    assert names(drawn) != {"p00", "p01", "p02"}
    assert "3 of 12 are taken" in caplog.text
    first = pw.photos("square", str(tmp_path), count=3, items_from="first", **QUICK)
    assert names(first) == {"p00", "p01", "p02"}


def test_folders_of_folders_are_read(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    for name in ("a/b/one", "c/two", ".hidden/three"):
        file = tmp_path / f"{name}.svg"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(drawing(20), encoding="utf-8")
    assert [item.name for item in read_items(tmp_path).items] == ["one", "two"]
    with caplog.at_level(logging.WARNING):
        (tmp_path / "zero.svg").write_text(drawing(30), encoding="utf-8")
        assert [item.name for item in read_items(tmp_path).items] == ["zero"]
    assert "the folders in it (c) are not read" in caplog.text
    pattern = str(tmp_path / "**" / "*")
    assert {item.name for item in read_items(pattern).items} == {"zero", "one", "two"}
