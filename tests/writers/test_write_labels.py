"""Names, links and tooltips in files: unique, escaped, drawn all the same, and read back."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import Element

import numpy as np
import pytest
from defusedxml.ElementTree import fromstring
from hypothesis import given
from hypothesis import strategies as st

import packwork as pw
from packwork.errors import ReadError
from packwork.scene.item import Item, Label
from packwork.scene.layout import Layout
from packwork.writers import geojson_text, svg_text
from packwork.writers.bitmaps import png_bytes
from packwork.writers.svg import SvgOptions
from packwork.writers.svg_symbols import item_ids
from scenes import disc, flat_item

LayoutMaker = Callable[..., Layout]
SVG = "{http://www.w3.org/2000/svg}"
LABEL = Label(name='R&D "A" <b>', link="https://a.example/?x=1&y='2'", title="1 < 2 & 3 > 2")


def elements(text: str, tag: str) -> list[Element]:
    return list(fromstring(text).iter(SVG + tag))


@pytest.fixture
def labelled(three: Layout) -> Layout:
    """The three kinds of art, the second with a label, the third with a tooltip alone."""
    plain, second, third = three.items
    items = (plain, replace(second, label=LABEL), replace(third, label=Label(title="tip")))
    return replace(three, items=items)


@pytest.mark.parametrize("flatten", [False, True])
def test_links_and_tooltips_stand_where_browsers_look(labelled: Layout, flatten: bool) -> None:
    text = svg_text(labelled, SvgOptions(flatten=flatten))
    (link,) = elements(text, "a")
    assert link.get("href") == LABEL.link
    assert link[0].tag == SVG + "title"
    assert [title.text for title in elements(text, "title")] == ["room", LABEL.title, "tip"]
    assert link[1].get("data-name") == LABEL.name
    assert link[1].get("id") == "R-D-A-b"


def test_a_layout_without_labels_is_written_as_ever(three: Layout) -> None:
    text = svg_text(three)
    assert not elements(text, "a")
    assert len(elements(text, "title")) == 1


def test_what_is_linked_is_drawn_as_ever(
    three: Layout, labelled: Layout, read_picture: Callable[[bytes], np.ndarray]
) -> None:
    plain, linked = (read_picture(png_bytes(layout, 80)) for layout in (three, labelled))
    np.testing.assert_array_equal(plain, linked)


def item(name: str) -> Item:
    return replace(flat_item("star", disc()), label=Label(name=name))


@pytest.mark.parametrize(
    ("names", "ids"),
    [
        (["", "", ""], ["item-1", "item-2", "item-3"]),
        (["A", "A", "A-2"], ["A", "A-2", "A-2-2"]),
        (["item-3", "", ""], ["item-named-item-3", "item-2", "item-3"]),
        (["items", "shape-1", "9 lives"],
         ["item-named-items", "item-named-shape-1", "item-named-9-lives"]),
        (["<>&", "päckchen", "a\x00b"], ["item-1", "päckchen", "a-b"]),
        (["p0123456789-0", "container"], ["item-named-p0123456789-0", "item-named-container"]),
    ],
)  # fmt: skip
def test_ids(names: list[str], ids: list[str]) -> None:
    assert item_ids([item(name) for name in names]) == ids


@given(names=st.lists(st.text(max_size=8) | st.sampled_from(["a", "item-1", "a-2"]), max_size=8))
def test_ids_are_unique_whatever_the_names(names: list[str]) -> None:
    ids = item_ids([item(name) for name in names])
    assert len(set(ids)) == len(ids)
    assert all(one and one[0].isalpha() and not set(one) & set(" \"'<>&") for one in ids)


def test_labels_are_in_the_geojson_and_come_back(labelled: Layout, tmp_path: Path) -> None:
    features = json.loads(geojson_text(labelled))["features"][1:]
    assert "link" not in features[0]["properties"]
    assert features[1]["properties"]["link"] == LABEL.link
    assert features[1]["properties"]["item"] == "star"
    (tmp_path / "a.geojson").write_text(geojson_text(labelled), encoding="utf-8")
    layout = pw.Layout.load(tmp_path / "a.geojson")
    assert [one.label for one in layout.items] == [Label(), LABEL, Label(title="tip")]
    layout.save(tmp_path / "b.svg")
    assert elements((tmp_path / "b.svg").read_text(encoding="utf-8"), "a")


@pytest.mark.parametrize(
    ("key", "value", "problem"),
    [
        ("link", "javascript:alert(1)", r"features\[1\]\.link: must begin with http:"),
        ("link", 3, r"features\[1\]\.link: must be text, not 3"),
        ("title", ["a"], r"features\[1\]\.title: must be text"),
    ],
)
def test_a_label_that_is_none_is_refused(
    key: str, value: Any, problem: str, three: Layout, tmp_path: Path
) -> None:
    collection = json.loads(geojson_text(three))
    collection["features"][1]["properties"][key] = value
    (tmp_path / "a.geojson").write_text(json.dumps(collection), encoding="utf-8")
    with pytest.raises(ReadError, match=problem):
        pw.Layout.load(tmp_path / "a.geojson")
