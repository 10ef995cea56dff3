"""Palettes and backgrounds of sessions: nothing moves, and each drawing is known as it was."""

from __future__ import annotations

import io
from dataclasses import replace
from pathlib import Path

import pytest

import packwork as pw
from packwork.errors import RecipeError
from packwork.live.document import halos_of
from packwork.live.face.exporting import check, layout_bytes
from packwork.live.ground import covering, gradient, gradient_text, sheet_box
from packwork.live.log import Log, read_entries
from packwork.live.session import Session
from packwork.readers.builtin import icon_names
from packwork.scene.recolour import one_colour
from packwork.steps.appearance import beside

QUICK = {"effort": "draft", "levels": "50", "epochs": 60}


@pytest.fixture(scope="module")
def drawn() -> pw.Layout:
    """Items of one colour, and a drawing of several."""
    return pw.fill("circle", ["star", "heart", f"builtin:{icon_names()[0]}"], count=12, **QUICK)


def arts(session: Session) -> list[object]:
    return [item.art for item in session.document.items]


def test_neighbours_get_unlike_colours_and_nothing_moves(drawn: pw.Layout) -> None:
    session = drawn.edit()
    session.palette("tol-bright")
    assert session.finish().certified
    after = session.layout
    assert after.poses.x.tobytes() == drawn.poses.x.tobytes()
    colours = [one_colour(item.art) for item in after.items]
    alike = [(a, b) for a, b in beside(after) if colours[a] and colours[a] == colours[b]]
    assert alike == []


@pytest.mark.parametrize("shades", ["tint", "nearest", "keep"])
def test_each_palette_is_put_on_drawings_as_they_were_first(drawn: pw.Layout, shades: str) -> None:
    once, again = drawn.edit(), drawn.edit()
    once.palette(["#aa3377", "teal"], shades)
    again.palette("viridis", "tint")
    again.recolor("*", "black")
    again.palette(["#aa3377", "teal"], shades)
    texts = [[getattr(art, "markup", art) for art in arts(one)] for one in (once, again)]
    assert texts[0] == texts[1]
    again.palette(None)
    assert arts(again) == [item.art for item in drawn.items]


def test_what_is_turned_over_has_its_own_colours_turned_over(drawn: pw.Layout) -> None:
    session, plain = drawn.edit(), drawn.edit()
    session.palette("ink", "nearest")
    for one in (session, plain):
        one.flip("*")
    session.palette(None)
    for got, expected in zip(session.document.items, plain.document.items, strict=True):
        assert repr(got.art) == repr(expected.art)


def test_a_file_and_a_log_keep_how_each_was_drawn(drawn: pw.Layout, tmp_path: Path) -> None:
    stream, begun = io.StringIO(), drawn.edit().document
    session = pw.Session(begun, log=Log(stream))
    session.palette("ink")
    session.background("radial-gradient(navy, rgb(255 0 0 / 50%), pink)")
    session.save(tmp_path / "b.packwork")
    behind = pw.Session.open(tmp_path / "b.packwork").document.behind
    assert gradient_text(behind) == "radial-gradient(#000080, #ff000080, #ffc0cb)"
    assert behind is not None
    assert gradient_text(replace(behind, source=f"{behind.source}, url(x)")) == ""
    for angle in ("-0.00001", "0.000001", "9999.5"):
        session.background(f"linear-gradient({angle}deg, navy, pink)")
        assert gradient_text(session.document.behind).startswith("linear-gradient(")
    session.background("ivory")
    session.save(tmp_path / "a.packwork")
    again = pw.Session.open(tmp_path / "a.packwork")
    assert again.document.palette == session.document.palette
    assert again.layout.ground == "#fffff0"
    again.palette(None)
    assert [one_colour(a) for a in arts(again)] == [one_colour(i.art) for i in begun.items]
    entries = read_entries(iter(stream.getvalue().splitlines()), "log")
    done = Session.replay(begun, entries)
    assert [one_colour(a) for a in arts(done)] == [one_colour(a) for a in arts(session)]
    for _ in range(2):
        session.undo()
    assert session.layout.ground == ""


def test_what_is_no_colour_is_refused(drawn: pw.Layout) -> None:
    session = drawn.edit()
    with pytest.raises(RecipeError, match="'mud' is no colour"):
        session.palette("mud")
    with pytest.raises(RecipeError, match="'mud' is no colour"):
        session.background("mud")
    session.background("none")
    assert session.layout.ground == ""


def test_a_file_with_a_free_edge_holds_the_same_layout(drawn: pw.Layout, tmp_path: Path) -> None:
    side = drawn.container.side
    (tmp_path / "a.svg").write_bytes(layout_bytes(drawn, "svg", {"margin": "5%"}))
    found = pw.Layout.load(tmp_path / "a.svg")
    assert found.container.width == pytest.approx(drawn.container.width + 0.1 * side)
    assert found.poses.x == pytest.approx(drawn.poses.x + 0.05 * side, abs=1e-3)
    assert found.edit().settle().certified
    for wrong in ("wide", "-1%", 7, True):
        with pytest.raises(RecipeError, match="margin"):
            check("png", {"margin": wrong})
    check("film.gif", {"loop": "once"})


def test_the_same_background_twice_is_one_step(drawn: pw.Layout) -> None:
    session = drawn.edit()
    before = session.document.manifest
    session.background("black")
    session.background("black")
    session.undo()
    assert session.document.manifest == before


def test_groups_of_a_chart_keep_the_colours_of_its_keys() -> None:
    rows = [{"name": "a", "size": 3, "kind": "x"}, {"name": "b", "size": 2, "kind": "y"}]
    chart = pw.chart("circle", rows, size_by="size", color_by="kind", label_by="name")
    with pytest.raises(RecipeError, match="as its keys say"):
        chart.edit().palette("viridis")


def test_halos_follow_the_background_and_are_in_files(drawn: pw.Layout) -> None:
    session = drawn.edit()
    session.recolor("star", "white")
    session.recolor("heart", "#101010")

    def rims() -> dict[str, set[str]]:
        items = session.document.items
        return {name: {one.halo for one in items if one.name == name} for name in ("star", "heart")}

    session.background("white")
    session.do("halos", choice="faint")
    assert rims()["heart"] == {""}
    assert len(rims()["star"] - {""}) == 1
    assert '<g id="halos"' in layout_bytes(session.layout, "svg", {}).decode()
    session.background("black")
    assert rims()["star"] == {""}
    assert len(rims()["heart"] - {""}) == 1
    # On a gradient, whose lightness is not everywhere the same, all of them.
    session.background("linear-gradient(90deg, black, white)")
    assert all("" not in found for found in rims().values())
    before = session.document.poses
    session.do("halos", choice="none")
    assert rims() == {"star": {""}, "heart": {""}}
    session.undo()
    assert "" not in rims()["star"]
    assert session.document.poses is before
    with pytest.raises(RecipeError, match="choice"):
        session.do("halos", choice="most")


def test_items_that_come_later_or_change_their_colours_have_halos_too(drawn: pw.Layout) -> None:
    session = drawn.edit()
    session.do("halos", choice="all")
    session.add("moon", x=10.0, y=10.0)
    assert "" not in {item.halo for item in session.document.items}
    session.do("halos", choice="faint")
    session.background("white")
    session.recolor("star", "white")
    stars = [item for item in session.document.items if item.name == "star"]
    assert "" not in {item.halo for item in stars}
    session.undo()
    assert {item.halo for item in session.document.items if item.name == "star"} == {""}


def test_halos_of_a_file_are_those_that_were_asked_for(drawn: pw.Layout, tmp_path: Path) -> None:
    drawn.save(tmp_path / "a.svg", halo="all", background="#171717")
    session = pw.Layout.load(tmp_path / "a.svg").edit()
    assert session.document.halos == "all"
    session.add("moon", x=10.0, y=10.0)
    assert "" not in {item.halo for item in session.document.items}
    # Those by which a run has let some stand out from its picture stay as they are.
    colours = gradient("linear-gradient(black, white)", drawn.container)
    assert colours is not None
    ground = covering(colours, sheet_box(drawn.container))
    items = tuple(replace(item, halo="#fff" * (item.name == "star")) for item in drawn.items)
    on_picture = replace(drawn, container=replace(drawn.container, backdrop=ground), items=items)
    session = on_picture.edit()
    session.recolor("heart", "teal")
    assert {i.name for i in session.document.items if i.halo} == {"star"}
    assert halos_of(session.document.items) == "faint"
    for choice, count in (("all", len(drawn.items)), ("none", 0)):
        session.do("halos", choice=choice)
        assert sum(bool(item.halo) for item in session.document.items) == count


def test_a_gradient_without_end_is_refused_before_it_is_parted() -> None:
    # By the square of its commas this would take minutes.
    container = pw.fill("circle", "star", count=1, **QUICK).container
    with pytest.raises(RecipeError, match="a gradient takes 20,000 characters at most"):
        gradient(f"linear-gradient({'red,' * 250_000}red)", container)
    with pytest.raises(RecipeError, match="not 26,9"):
        gradient(f"linear-gradient({'red,' * 2_990}red)", container)
