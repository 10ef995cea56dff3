"""Mosaics and grounds of sessions: kept in files, replayed, and where items lie they show."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import packwork as pw
from packwork.errors import RecipeError
from packwork.live.commands.command import named_container
from packwork.live.commands.container import SetContainer
from packwork.live.face.exporting import film_of
from packwork.live.ground import MOSAIC_PX
from packwork.live.log import Log, read_entries
from packwork.live.owner import Owner
from packwork.live.relayout import poured_again
from packwork.live.session import Session
from packwork.readers.container import read_container
from packwork.readers.target import picture_colours
from packwork.scene.item import PhotoArt
from packwork.scene.recolour import one_colour
from packwork.scene.swatch import mean_lights


@pytest.fixture(autouse=True)
def _coarse(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pictures are painted with few pixels: most of the time went into many."""
    monkeypatch.setattr("packwork.readers.target.DECODED_PX", 400)


@pytest.fixture(scope="module")
def layout() -> pw.Layout:
    return pw.fill("circle", ["star", "heart", "bird"], count=24, effort="draft", levels="50,100")


@pytest.fixture(scope="module")
def ramp(tmp_path_factory: pytest.TempPathFactory) -> str:
    """A photograph, dark on the left and light on the right."""
    path = tmp_path_factory.mktemp("pictures") / "ramp.jpg"
    light = np.broadcast_to(np.linspace(20, 235, 400)[None, :, None], (300, 400, 3))
    Image.fromarray(light.astype(np.uint8)).save(path)
    return str(path)


def assert_alike(one: bytes, other: bytes) -> None:
    """Whether two pictures differ by 2 of 255 at most."""
    pair = [np.asarray(Image.open(io.BytesIO(data)).convert("RGB"), int) for data in (one, other)]
    assert np.abs(np.subtract(*pair)).max() <= 2


def lights(session: Session) -> np.ndarray:
    """``(n,)`` mean light of each item."""
    return mean_lights(session.document.items).mean(axis=1)


@pytest.mark.parametrize("number", [3, 11, 20])
def test_an_item_shows_the_picture_where_it_comes_to_lie(
    layout: pw.Layout, ramp: str, number: int
) -> None:
    session = layout.edit()
    session.picture(ramp)
    x = session.document.poses.x
    assert np.corrcoef(x, lights(session))[0, 1] > 0.8
    others = session.document.items
    aim = layout.container.width * (0.85 if x[number] < layout.container.width / 2 else 0.15)
    session.move(number, aim, session.document.poses.y[number])
    session.settle()
    after = session.document
    x = after.poses.x
    assert np.corrcoef(x, lights(session))[0, 1] > 0.8
    assert after.items[number] is not others[number]
    stays = (after.poses.x == layout.poses.x) & (after.poses.y == layout.poses.y)
    assert all(after.items[k] is others[k] for k in np.flatnonzero(stays))


def test_a_tint_leaves_as_much_of_the_own_colours(layout: pw.Layout, ramp: str) -> None:
    session = layout.edit()
    own = mean_lights(session.document.items)
    session.picture(ramp)
    away = [np.linalg.norm(mean_lights(session.document.items) - own)]
    for tint in ("60%", 0.2, 0):
        session.picture(tint=tint)
        away.append(np.linalg.norm(mean_lights(session.document.items) - own))
    assert away == sorted(away, reverse=True)
    assert away[-1] == pytest.approx(0.0, abs=1e-9)
    session.palette("ink")
    assert session.document.mosaic is None
    with pytest.raises(RecipeError, match="give it a picture"):
        session.picture(tint=0.5)


def test_a_file_and_a_log_give_the_same_bytes(layout: pw.Layout, ramp: str, tmp_path: Path) -> None:
    stream, begun = io.StringIO(), layout.edit().document
    session = pw.Session(begun, log=Log(stream))
    session.picture(ramp, tint=0.7)
    session.background("linear-gradient(45deg, #102040, rgb(200, 120, 10) )")
    session.move(20, "50%", "50%")
    session.finish()
    session.backdrop(ramp)
    session.save(tmp_path / "a.packwork")
    drawn = session.layout.to_svg()
    entries = read_entries(iter(stream.getvalue().splitlines()), "log")
    assert pw.Session.replay(begun, entries).layout.to_svg() == drawn
    again = pw.Session.open(tmp_path / "a.packwork")
    assert_alike(again.layout.to_png(pixels=200), session.layout.to_png(pixels=200))
    assert (again.document.mosaic.tint, again.document.mosaic.picture.name) == (0.7, "ramp")
    for one in (session, again):
        one.undo()
    assert_alike(again.layout.to_png(pixels=200), session.layout.to_png(pixels=200))
    assert "linearGradient" in again.layout.to_svg()


def test_a_kept_picture_is_bounded(layout: pw.Layout, tmp_path: Path) -> None:
    noise = np.random.default_rng(1).integers(0, 256, (1_500, 2_000, 3)).astype(np.uint8)
    Image.fromarray(noise).save(tmp_path / "large.png")
    session = layout.edit()
    session.picture(tmp_path / "large.png")
    art = session.document.mosaic.picture.art
    assert isinstance(art, PhotoArt)
    most = 4 * MOSAIC_PX**2
    assert len(art.preview.markup) + len(art.original.printed(9.0).markup) < most
    session.save(tmp_path / "a.packwork")
    assert (tmp_path / "a.packwork").stat().st_size < most


@pytest.mark.parametrize(
    ("text", "corners"),
    [
        ("linear-gradient(90deg, #ff0000, #0000ff)", ["#ff0000", "#0000ff"]),
        ("linear-gradient(#ff0000, #0000ff)", ["#ff0000", "#ff0000"]),
        ("radial-gradient(#ff0000, #00ff00, #0000ff)", ["#0000ff", "#0000ff"]),
    ],
)
def test_a_gradient_is_drawn_as_css_has_it(
    layout: pw.Layout, tmp_path: Path, text: str, corners: list[str]
) -> None:
    session = layout.edit()
    session.background(text)
    session.layout.save(tmp_path / "a.svg")
    for one in (session.layout, pw.Layout.load(tmp_path / "a.svg")):
        with Image.open(io.BytesIO(one.to_png(pixels=400))) as picture:
            shown = picture.convert("RGB")
            for x, colour in zip((0, 399), corners, strict=True):
                aim = [int(colour[k : k + 2], 16) for k in (1, 3, 5)]
                assert np.abs(np.subtract(shown.getpixel((x, 0)), aim)).max() < 6
    session.background("none")
    assert session.layout.to_svg() == layout.edit().layout.to_svg()


@pytest.mark.parametrize(
    "text", ["linear-gradient(red)", "linear-gradient(90deg, red, mud)", "radial-gradient()"]
)
def test_what_is_no_gradient_is_refused(layout: pw.Layout, text: str) -> None:
    session = layout.edit()
    with pytest.raises(RecipeError, match="background"):
        session.background(text)
    assert session.document.behind is None


def test_a_picture_behind_all_stays_where_the_container_is_another(
    layout: pw.Layout, ramp: str
) -> None:
    session = layout.edit()
    session.backdrop(ramp)
    session.set_container("heart")
    session.finish()
    assert session.is_certified
    with Image.open(io.BytesIO(session.layout.to_png(pixels=200))) as picture:
        row = [picture.convert("L").getpixel((x, 1)) for x in (1, picture.width - 2)]
    assert row[1] > row[0] + 80


def test_a_gradient_covers_the_frame_of_a_film(layout: pw.Layout) -> None:
    session = Session(layout.edit().document, record=True)
    session.do("background", colour="linear-gradient(90deg, red, blue)")
    session.do("move", item=0, x=300, y=300)
    session.settle()
    options = {"seconds": 1, "film_pixels": 160, "film_ratio": "16:9"}
    data = film_of(session.layout, "film.gif", options, session.document.behind)
    with Image.open(io.BytesIO(data)) as film:
        film.seek(film.n_frames - 1)
        assert film.width / film.height == pytest.approx(16 / 9, rel=0.02)
        shown = film.convert("RGB")
        left, right = (shown.getpixel((x, 1)) for x in (1, film.width - 2))
    assert left[0] > 200 > 60 > left[2]
    assert right[2] > 200 > 60 > right[0]


def test_colours_of_a_picture_are_its_own(tmp_path: Path) -> None:
    picture = Image.new("RGB", (30, 20), "#102a6e")
    picture.paste("#f2c14e", (20, 0, 30, 20))
    picture.save(tmp_path / "two.png")
    assert picture_colours(tmp_path / "two.png", 8) == ["#102a6e", "#f2c14e"]


def test_items_keep_their_colours_where_the_container_has_one_colour_of_the_picture(
    layout: pw.Layout, tmp_path: Path
) -> None:
    picture = np.full((400, 400, 3), 255, np.uint8)
    picture[:, :40] = picture[:, -40:] = 20
    Image.fromarray(picture).save(tmp_path / "edges.png")
    session = layout.edit()
    session.picture(tmp_path / "edges.png")
    before = lights(session)
    narrow = named_container(session.library, read_container("page", "60x600px"))
    owner = Owner(session)
    with owner:
        owner.post(SetContainer(asset=narrow))
    assert owner.failure is None
    assert lights(session).tolist() == before.tolist()
    session.apply(poured_again(session.document, 1))
    assert lights(session).tolist() == before.tolist()


def test_held_items_take_on_the_colours_of_a_container_that_is_moved(
    layout: pw.Layout, ramp: str
) -> None:
    session = layout.edit()
    session.picture(ramp)
    number = int(np.argmax(session.document.poses.x))
    session.hold(number)
    before = lights(session)[number]
    session.do("place_container", x=layout.container.width * 0.3, factor=1.6)
    session.settle()
    assert session.document.poses.x[number] == layout.poses.x[number]
    assert lights(session)[number] < before - 0.1


def test_words_that_come_into_a_mosaic_keep_none_of_its_colours(ramp: str) -> None:
    options = {"effort": "draft", "levels": "50,100", "palette": "black"}
    session = pw.words("circle", {"hope": 5, "joy": 3, "sea": 2}, **options).edit()
    own = {one_colour(item.art) for item in session.document.items}
    session.picture(ramp)
    session.words({"hope": 5, "joy": 3, "sea": 2, "moon": 4}, font_weight=300)
    session.settle()
    assert len(session.find("moon")) == 1
    assert {one_colour(item.art) for item in session.document.items} != own
    session.palette(None)
    assert {one_colour(item.art) for item in session.document.items} == own


def test_how_many_items_would_show_a_picture_is_told(layout: pw.Layout, tmp_path: Path) -> None:
    session = layout.edit()
    assert session.advice == ()
    stripes = np.arange(240)[:, None, None] // 30 % 2 * np.full((240, 240, 3), 255)
    Image.fromarray(stripes.astype(np.uint8)).save(tmp_path / "stripes.png")
    session.picture(tmp_path / "stripes.png")
    assert any("hard to recognise with 24 items; -n" in line for line in session.advice)
    session.palette(None)
    assert session.advice == ()
