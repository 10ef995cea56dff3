"""Sources of items: files, folders, patterns, built-in names."""

from __future__ import annotations

import logging

import numpy as np
import pytest
from PIL import Image

from each import for_each
from packwork.errors import ReadError
from packwork.readers import builtin
from packwork.readers.items import read_items
from packwork.scene.item import FlatArt, VectorArt

TILE = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><rect width="{}" height="2"/></svg>'
)


@pytest.fixture
def folder(tmp_path):
    for k, name in enumerate(("b.svg", "a.svg", "c.SVG")):
        (tmp_path / name).write_text(TILE.format(k + 2), encoding="utf-8")
    Image.new("RGB", (30, 20), "red").save(tmp_path / "d.tiff")
    (tmp_path / ".hidden.svg").write_text("broken", encoding="utf-8")
    (tmp_path / "notes.txt").write_text("none of ours", encoding="utf-8")
    (tmp_path / "inner").mkdir()
    (tmp_path / "inner" / "e.svg").write_text(TILE.format(1), encoding="utf-8")
    (tmp_path / "d.tiff").unlink()
    return tmp_path


def names(*sources, **options) -> list[str]:
    return [item.name for item in read_items(*sources, **options).items]


def test_folder_in_order(folder):
    read = read_items(folder)
    assert [item.name for item in read.items] == ["a", "b", "c"]
    assert read.skipped == ()
    assert read.items[0].source == str(folder / "a.svg")


def test_pattern(folder):
    assert names(str(folder / "[ab]*")) == ["a", "b"]
    assert names(str(folder / "*.svg")) == ["a", "b"]


def test_several_sources_keep_their_order(folder):
    assert names([folder / "b.svg", "star", str(folder / "a.svg")]) == ["b", "star", "a"]


def test_existing_path_wins_over_a_name(folder, monkeypatch):
    (folder / "circle").mkdir()
    (folder / "circle" / "mine.svg").write_text(TILE.format(3), encoding="utf-8")
    monkeypatch.chdir(folder)
    assert names("circle") == ["mine"]


def test_brackets_in_a_file_name(folder):
    (folder / "x[1].svg").write_text(TILE.format(3), encoding="utf-8")
    assert names(folder / "x[1].svg") == ["x[1]"]


def test_unusable_file_among_many_is_skipped(folder, caplog):
    (folder / "bad.svg").write_text("<svg>", encoding="utf-8")
    with caplog.at_level(logging.WARNING, logger="packwork"):
        read = read_items(folder)
    assert [item.name for item in read.items] == ["a", "b", "c"]
    assert [error.file for error in read.skipped] == [str(folder / "bad.svg")]
    assert "bad.svg" in caplog.text


def test_unusable_file_is_an_error_where_strict_or_named(folder):
    (folder / "bad.svg").write_text("<svg>", encoding="utf-8")
    with pytest.raises(ReadError, match=r"bad\.svg"):
        read_items(folder, strict=True)
    with pytest.raises(ReadError, match=r"bad\.svg"):
        read_items([folder / "a.svg", folder / "bad.svg"])


@pytest.mark.parametrize(
    ("source", "problem"),
    [
        ("nowhere.svg", "no such file"),
        ("no/where", "no such file"),
        ("nowhere*.svg", "no file that could be an item"),
        ("hart", "did you mean heart"),
        ("zzzz", "built in are "),
        ("stripe:x", "stripe:6"),
        ("stripe:1e9", "stripe:6"),
        ("\0", "no built-in item"),
        ("", "stands for nothing"),
    ],
)
def test_unknown_sources(source, problem, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ReadError, match=problem):
        read_items(source)


def test_empty_folder(tmp_path):
    with pytest.raises(ReadError, match="holds no file that could be an item"):
        read_items(tmp_path)


def test_folder_of_unusable_files(tmp_path):
    (tmp_path / "bad.svg").write_text("", encoding="utf-8")
    with pytest.raises(ReadError, match="its one file cannot be used"):
        read_items(tmp_path)


def test_unknown_ending(folder):
    with pytest.raises(ReadError, match=r"unknown ending '\.txt'"):
        read_items(folder / "notes.txt")


def test_no_sources():
    with pytest.raises(ReadError, match="none were given"):
        read_items([])


def test_text_renamed_to_a_picture(tmp_path):
    (tmp_path / "a.png").write_text("not a picture", encoding="utf-8")
    with pytest.raises(ReadError, match="not a picture"):
        read_items(tmp_path / "a.png")


def test_icons_stands_for_all():
    assert names("icons") == builtin.icon_names()


def test_icons_are_drawn_by_curves():
    assert all(isinstance(item.art, VectorArt) for item in read_items("icons").items)


@for_each(builtin.item_names())
def test_builtin_items_are_usable(name):
    item = builtin.builtin_item(name)
    assert item.name == name
    assert item.outline.region.is_valid
    assert np.hypot(*item.outline.centroid) < 1e-6 * item.outline.extent


@for_each(builtin.icon_names())
def test_bundled_icons_look_like_their_ink(name, art_iou):
    assert art_iou(builtin.builtin_item(name)) > 0.98


def test_plain_shapes_have_the_area_of_their_formula():
    area = {name: builtin.builtin_item(name).outline.area for name in ("circle", "hexagon", "ring")}
    assert area["circle"] == pytest.approx(np.pi * 2500, rel=1e-4)
    assert area["hexagon"] == pytest.approx(1.5 * np.sqrt(3) * 2500)
    ring = builtin.builtin_item("ring", "keep")
    assert ring.outline.area == pytest.approx(np.pi * 1600, rel=1e-4)
    assert isinstance(ring.art, FlatArt)
