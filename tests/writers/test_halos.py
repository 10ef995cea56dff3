"""Items like the background: who is named, what would do, and the rims that are drawn."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from packwork.scene.item import FlatArt, Item, LiveText, VectorArt
from packwork.scene.layout import Layout
from packwork.scene.swatch import small_png
from packwork.writers import halos
from packwork.writers.halos import faint_items, faint_message, haloed
from packwork.writers.registry import encoded, write_options
from scenes import box

LayoutMaker = Callable[..., Layout]
Reader = Callable[[bytes], np.ndarray]


def flat(name: str, colour: str) -> Item:
    return Item(name, name, box(-2, -2, 2, 2), box(-2, -2, 2, 2), FlatArt(colour))


def drawn(name: str, inside: str, rim: str) -> Item:
    markup = (
        f'<path fill="{rim}" d="M-2-2h4v4h-4z"/><path fill="{inside}" d="M-1.6-1.6h3.2v3.2h-3.2z"/>'
    )
    return replace(flat(name, inside), art=VectorArt(markup, np.eye(2, 3)))


@pytest.fixture
def layout(make_layout: LayoutMaker) -> Layout:
    items = [flat("ghost", "#f6f6f2"), flat("bat", "#15181c"), flat("apple", "#d33")]
    return make_layout(items, [20.0, 40.0, 60.0], [30.0, 30.0, 30.0], scale=[4.0] * 3)


def names(items: tuple[Item, ...]) -> list[str]:
    return [item.name for item in items]


def test_pale_ones_are_faint_on_paper_and_dark_ones_on_dark(layout: Layout) -> None:
    assert names(faint_items(layout, None)) == ["ghost"]
    assert names(faint_items(layout, "#0b0e12")) == ["bat"]
    assert names(faint_items(layout, "teal")) == []


def test_it_is_the_edge_that_tells(make_layout: LayoutMaker) -> None:
    items = [drawn("egg", "white", "#d33"), drawn("eye", "black", "white")]
    layout = make_layout(items, [20.0, 50.0], [30.0, 30.0], scale=[4.0, 4.0])
    assert names(faint_items(layout, None)) == ["eye"]


def test_words_and_what_has_a_halo_are_not_looked_at(layout: Layout) -> None:
    ghost = layout.items[0]
    for safe in (replace(ghost, halo="black"), replace(ghost, text=LiveText((), "", ""))):
        assert not faint_items(replace(layout, items=(safe, *layout.items[1:])), None)


def test_what_is_said_names_them_and_what_would_do(layout: Layout) -> None:
    told = faint_message(layout, None)
    assert told.startswith("1 item is hardly to be seen on white (ghost); --background '#")
    assert told.endswith("or --halo faint would show them")
    proposed = told.split("'")[1]
    assert not faint_items(layout, proposed)
    assert faint_message(layout, "teal") == ""


@pytest.mark.parametrize("dark", ["#000", "#111", "#12181f"])
def test_black_on_a_dark_ground_is_faint_and_sent_to_one_that_shows_it(
    make_layout: LayoutMaker, dark: str
) -> None:
    items = [flat("coal", "#000"), flat("navy", "#000022")]
    layout = make_layout(items, [20.0, 50.0], [30.0, 30.0], scale=[4.0, 4.0])
    assert names(faint_items(layout, dark)) == ["coal", "navy"]
    assert faint_message(layout, dark).split("'")[1] == "#2f3e55"
    assert all(item.halo for item in haloed(layout, "faint", dark).items)


def test_a_ground_on_which_others_are_faint_is_not_proposed(make_layout: LayoutMaker) -> None:
    items = [flat(ground, ground) for ground in halos.GROUNDS]
    xs = [10.0 * k for k in range(len(items))]
    layout = make_layout(items, xs, [30.0] * len(items))
    assert "; --halo faint would show them" in faint_message(layout, None)


@pytest.mark.parametrize(
    "ground", ["#fff", "#bbb", "#999", "#818181", "#5f6b7a", "#f4f1ea", "#000"]
)
def test_a_rim_can_be_told_from_every_ground(layout: Layout, ground: str) -> None:
    rims = {item.halo for item in haloed(layout, "all", ground).items}
    rim = replace(layout, items=tuple(flat("rim", str(halo)) for halo in rims for _ in range(3)))
    assert not faint_items(rim, ground)


def test_rims_are_drawn_round_whom_they_are_asked_for(layout: Layout) -> None:
    halos = [
        [bool(item.halo) for item in haloed(layout, choice, None).items]
        for choice in ("none", "faint", "all")
    ]
    assert halos == [[False] * 3, [True, False, False], [True] * 3]
    assert haloed(layout, "all", None).items[1].halo != haloed(layout, "all", "#111").items[1].halo


@pytest.mark.parametrize("ending", ["svg", "png", "jpg", "pdf"])
def test_every_picture_has_them(layout: Layout, ending: str) -> None:
    without, with_rims = (
        encoded(layout, f"out.{ending}", write_options(pixels=100, halo=choice))
        for choice in ("none", "faint")
    )
    assert without != with_rims


def test_a_rim_changes_only_what_lies_round_the_item(layout: Layout, read_picture: Reader) -> None:
    before, after = (
        read_picture(encoded(layout, "out.png", write_options(pixels=400, halo=choice)))
        for choice in ("none", "faint")
    )
    changed = np.argwhere((before != after).any(axis=2))
    assert len(changed) > 100
    px = 400 / layout.container.side
    left, right = (20 - 8) * px, (20 + 8) * px
    assert left - 4 <= changed[:, 1].min()
    assert changed[:, 1].max() <= right + 4


def test_a_drawing_is_looked_at_once(
    make_layout: LayoutMaker, monkeypatch: pytest.MonkeyPatch
) -> None:
    looked: list[str] = []

    def small(item: Item) -> bytes | None:
        looked.append(item.name)
        return small_png(item)

    monkeypatch.setattr(halos, "small_png", small)
    monkeypatch.setattr(halos, "FORM", 0)
    layout = make_layout([drawn("pale", "#123456", "#fefdfc")], [20.0], [30.0], scale=[4.0])
    first, second = faint_items(layout, None), faint_items(layout, None)
    assert names(first) == names(second) == ["pale"]
    assert looked in (["pale"], [])
