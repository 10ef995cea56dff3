"""Pages, slits and faint paint: what files do not say of themselves."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image, ImageDraw

from packwork import uses
from packwork.errors import RecipeError
from packwork.geometry.outline import Outline
from packwork.geometry.polygon import polygon_parts
from packwork.readers.container import closed_slits, read_container
from packwork.readers.items import read_items
from packwork.readers.layouts.read import read_written
from packwork.readers.options import ReadOptions
from packwork.readers.svg.curve import walled_container
from packwork.recipe import make_recipe
from packwork.recipe.reading import ReadingOptions
from packwork.recipe.refusals import validated
from packwork.scene.container import Container
from packwork.writers.svg import svg_text

SVG = '<svg xmlns="http://www.w3.org/2000/svg" {}>{}</svg>'
SMALL = '<path d="M40 50h10v5h-10z"/>'
BLUE = '<path fill="blue" d="M0 0h10v20H0z"/>'
RED = '<path fill="red" d="M20 0h10v20H20z"/>'
SHEET = '<path fill="#fff" d="M0 0h30v20H0z"/>'
SUN = '<circle cx="15" cy="10" r="6" fill="#b00"/>'


@pytest.fixture
def drawn(tmp_path):
    def draw(body: str, name: str = "a.svg", page: str = 'viewBox="0 0 200 100"') -> str:
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(SVG.format(page, body), encoding="utf-8")
        return str(path)

    return draw


@pytest.fixture
def painted(tmp_path):
    def paint(pixels: np.ndarray | Image.Image, name: str = "a.png") -> str:
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        (pixels if isinstance(pixels, Image.Image) else Image.fromarray(pixels)).save(path)
        return str(path)

    return paint


def mask(left: int, top: int, right: int, bottom: int) -> np.ndarray:
    pixels = np.full((100, 200), 255, np.uint8)
    pixels[top:bottom, left:right] = 0
    return pixels


# Small drawings on large pages


def test_a_small_drawing_fills_the_canvas_which_is_said(drawn, caplog):
    container = read_container(drawn(SMALL))
    assert (container.width, container.height) == (600, 300)
    assert container.outline.bounds == pytest.approx((0, 0, 600, 300))
    assert caplog.messages[0].endswith(
        "takes 5% of its page, which is left out; --no-trim keeps it"
    )
    assert len(caplog.messages) == 1


def test_a_small_mask_does_so_too(painted, caplog):
    container = read_container(painted(mask(40, 50, 60, 60)))
    assert container.outline.bounds == pytest.approx((0, 0, 600, 300), abs=1e-6)
    assert "takes 10% of its page" in caplog.text


def test_no_trim_keeps_the_page(drawn, painted, caplog):
    for file in (drawn(SMALL), painted(mask(40, 50, 60, 60))):
        container = read_container(file, reading=ReadOptions(trim=False))
        assert container.outline.bounds[:2] == pytest.approx((120, 150))
    assert not caplog.messages


def test_trim_leaves_any_page_out(drawn, painted):
    for file in (drawn('<path d="M20 10h100v50H20z"/>'), painted(mask(20, 10, 120, 60))):
        assert read_container(file).outline.bounds == pytest.approx((60, 30, 360, 180))
        trimmed = read_container(file, reading=ReadOptions(trim=True))
        assert trimmed.outline.bounds == pytest.approx((0, 0, 600, 300), abs=1e-6)


def test_a_banner_is_as_large_as_can_be(drawn, caplog):
    banner = read_container(drawn('<path d="M0 50h199v2H0z"/>'))
    assert (banner.width, banner.height) == (600, 300)
    assert not caplog.messages


def test_a_sheet_in_real_units_stays_and_the_part_keeps_its_size(drawn, caplog):
    file = drawn(SMALL, page='width="200mm" height="100mm" viewBox="0 0 200 100"')
    sheet = read_container(file)
    assert sheet.canvas == {"width": 200, "height": 100, "unit": "mm"}
    assert "takes 5% of its page of 200 x 100 mm, which is kept; --trim" in caplog.text
    part = read_container(file, reading=ReadOptions(trim=True))
    assert part.canvas == {"width": pytest.approx(10), "height": pytest.approx(5), "unit": "mm"}
    assert part.outline.area == pytest.approx(sheet.outline.area) == pytest.approx(50)
    # A canvas that is asked for scales it in any case.
    asked = read_container(file, "100mm")
    assert asked.outline.bounds == pytest.approx((0, 0, 100, 50))


def test_a_small_jar_is_trimmed_with_its_mouth(drawn):
    file = drawn('<path fill="none" stroke="#000" d="M40 40v10h10v-10"/>')
    jar, mouths = walled_container(file, None, ReadOptions())
    assert jar.outline.bounds == pytest.approx((0, 0, 600, 600))
    assert sorted(mouths[0].tolist()) == [pytest.approx([0, 0]), pytest.approx([600, 0])]


# The whole sheet


@pytest.mark.parametrize("name", ["page", "none"])
def test_the_sheet_is_a_container(name):
    sheet = read_container(name, "A4")
    assert sheet.outline.bounds == (0, 0, 210, 297)
    assert sheet.canvas == {"width": 210, "height": 297, "unit": "mm"}
    assert read_container(name).outline.bounds == (0, 0, 600, 600)


# Slits


LAND = 'viewBox="0 -20 200 140"'


def states(gap: float) -> str:
    """Two states with a crooked border and an island off the coast."""
    west = "M0 0H60L66 20L58 40L64 60L60 100H0z"
    east = f"M200 0H{60 + gap}L{66 + gap} 20L{58 + gap} 40L{64 + gap} 60L{60 + gap} 100H200z"
    return f'<path d="{west}"/><path d="{east}"/>'


def test_slits_between_states_are_closed_and_told_once(drawn, caplog):
    apart = read_container(drawn(states(0.2), page=LAND), reading=ReadOptions(close_gaps="none"))
    assert len(polygon_parts(apart.outline.region)) == 2
    assert not caplog.messages
    whole = read_container(drawn(states(0.2), page=LAND))
    assert len(polygon_parts(whole.outline.region)) == 1
    assert whole.outline.area - apart.outline.area == pytest.approx(0.2 * 100 * 9, rel=0.02)
    assert whole.outline.bounds == pytest.approx(apart.outline.bounds, abs=1e-6)
    (told,) = caplog.messages
    assert "slits of up to 1.2 px were closed (0.10% of its area); --close-gaps none" in told


def test_wide_gaps_stay_unless_their_width_is_given(drawn):
    file = drawn(states(3.0), page=LAND)
    assert len(polygon_parts(read_container(file).outline.region)) == 2
    closed = read_container(file, reading=ReadOptions(close_gaps="10"))
    assert len(polygon_parts(closed.outline.region)) == 1
    assert len(polygon_parts(read_container(file, "100mm", reading=ReadOptions(
        close_gaps="2mm")).outline.region)) == 1  # fmt: skip


def test_slits_are_not_looked_for_among_hairs(caplog):
    hairs = [[[0, y], [9, y], [9, y + 1e-4], [0, y + 1e-4]] for y in np.linspace(0, 9, 600)]
    outline = Outline.from_rings([np.array(hair) for hair in hairs])
    container = Container("hairs", "hairs", outline, 9.0, 9.0)
    assert closed_slits(container, "auto") is container
    assert "is all edges" in caplog.text


def test_slits_are_not_looked_for_among_steps_far_finer_than_they_would_be(caplog):
    steps = np.repeat(np.arange(9_000.0), 2)
    stair = np.vstack([np.column_stack([steps[1:], steps[:-1]]), [[0, 8_999]]])
    container = Container("stair", "stair", Outline.from_rings([stair]), 9e3, 9e3)
    assert closed_slits(container, "auto") is container
    assert "far more finely" in caplog.text


def test_a_slit_that_parts_nothing_is_closed_too(drawn):
    comb = '<path d="M0 0H99.9V80H100.1V0H200V100H0z"/>'
    slit = read_container(
        drawn(comb, page=LAND), reading=ReadOptions(close_gaps="none")
    ).outline.area
    assert read_container(drawn(comb, page=LAND)).outline.area > slit


def test_notches_and_lone_shapes_stay_as_they_are(drawn, caplog):
    star = '<path d="M100 0L130 90L40 30H160L70 90z"/><circle cx="20" cy="80" r="9"/>'
    kept = read_container(drawn(star), reading=ReadOptions(close_gaps="none"))
    assert read_container(drawn(star)).outline.area == kept.outline.area
    assert not caplog.messages


def test_seams_of_a_mask_are_closed(painted):
    pixels = mask(0, 0, 200, 100).repeat(8, 0).repeat(8, 1)
    pixels[:, 801] = 255
    file = painted(pixels)
    closed = read_container(file)
    assert len(polygon_parts(closed.outline.region)) == 1
    assert len(closed.outline.rings) == 1


@pytest.mark.parametrize("text", ["wide", "-1", ""])
def test_widths_that_are_none(text):
    with pytest.raises(RecipeError, match=r"close_gaps"):
        validated(ReadingOptions, {"close_gaps": text})


# Pages behind items


@pytest.fixture
def flags(drawn):
    """A folder of flags: most paint all of their page, one looks like a drawing on paper."""
    page = 'viewBox="0 0 30 20"'
    green = '<path fill="green" d="M0 0h30v20H0z"/>'
    for name, body in {
        "fr": SHEET + BLUE + RED,
        "jp": SHEET + SUN,
        "it": BLUE + RED + '<path fill="green" d="M10 0h10v20H10z"/>',
        "bd": green + SUN,
        "li": green + RED,
    }.items():
        drawn(body, f"flags/{name}.svg", page)
    return drawn(SHEET + SUN, "flags/jp.svg", page).removesuffix("/jp.svg")


def test_flags_keep_their_white(flags, caplog):
    items = {item.name: item for item in read_items(flags).items}
    assert {name: item.outline.area for name, item in items.items()} == pytest.approx(
        dict.fromkeys(["bd", "fr", "it", "jp", "li"], 600.0)
    )
    (told,) = caplog.messages
    assert "the page behind jp.svg is part of the drawing" in told
    assert "--drop-page" in told


def test_stripes_that_touch_the_edge_are_no_drawing_on_paper(flags, caplog):
    (france,) = read_items(f"{flags}/fr.svg").items
    assert france.outline.area == pytest.approx(600)
    assert "its white page is part of it" in caplog.text


def test_one_drawing_on_white_is_taken_off_its_page(flags, caplog):
    (sun,) = read_items(f"{flags}/jp.svg").items
    assert sun.outline.area == pytest.approx(np.pi * 36, rel=1e-3)
    assert "its white page was left out; --keep-page keeps it" in caplog.text


def test_pages_are_kept_or_dropped_where_that_is_asked(flags, caplog):
    kept = read_items(f"{flags}/jp.svg", reading=ReadOptions(keep_page=True)).items[0]
    assert kept.outline.area == pytest.approx(600)
    dropped = read_items(f"{flags}/fr.svg", reading=ReadOptions(keep_page=False)).items[0]
    assert dropped.ink.area == pytest.approx(400)
    assert not caplog.messages


def test_handles_beyond_the_edge_do_not_touch_it(drawn):
    leaf = '<path d="M15 4C33 8 33 12 15 16C-3 12 -3 8 15 4z"/>'
    (item,) = read_items(drawn(SHEET + leaf, page='viewBox="0 0 30 20"')).items
    assert item.outline.area < 500


def test_many_pages_are_told_in_one_line(drawn, caplog):
    for name in "abcde":
        file = drawn(SHEET + SUN, f"icons/{name}.svg", 'viewBox="0 0 30 20"')
    assert len(read_items(file.removesuffix("/e.svg")).items) == 5
    (told,) = caplog.messages
    assert "behind a.svg, b.svg, c.svg and 2 more were left out; --keep-page" in told


def test_flags_that_are_pictures_keep_their_ground_too(painted, caplog):
    for name, bars in {"a": "brg", "b": "gwb", "c": "rwb"}.items():
        image = Image.new("RGB", (30, 20))
        for k, bar in enumerate(bars):
            colour = {"b": "blue", "r": "red", "g": "green", "w": "white"}[bar]
            image.paste(colour, (10 * k, 0, 10 * k + 10, 20))
        painted(image, f"flags/{name}.png")
    vietnam = Image.new("RGB", (30, 20), "red")
    ImageDraw.Draw(vietnam).ellipse([10, 5, 20, 15], fill="yellow")
    file = painted(vietnam, "flags/v.png")
    assert read_items(file).items[0].outline.area < 100
    items = read_items(file.removesuffix("/v.png")).items
    assert [item.outline.area for item in items] == [600.0] * 4
    assert "the page behind v.png is part" in caplog.text
    kept = read_items(file, reading=ReadOptions(keep_page=True)).items[0]
    assert kept.outline.area == 600.0


# Faint paint


@pytest.fixture
def shadowed(painted):
    """A square of 40 and the shadow of opacity 0.3 that it throws to the right."""
    pixels = np.zeros((60, 100, 4), np.uint8)
    pixels[10:50, 10:80, 3] = 76
    pixels[10:50, 10:50] = (200, 0, 0, 255)
    return painted(pixels)


def test_a_shadow_is_outside_which_is_said(shadowed, caplog):
    assert read_items(shadowed).items[0].outline.area == pytest.approx(1600, rel=0.02)
    assert read_container(shadowed, reading=ReadOptions(trim=False)).outline.area > 0
    assert len(caplog.messages) == 2
    assert all("paints 6" in told and "fainter than 0.5" in told for told in caplog.messages)


def test_a_smaller_threshold_takes_the_shadow_in(shadowed, caplog):
    how = ReadOptions(alpha_threshold=0.1, trim=False)
    assert read_items(shadowed, reading=how).items[0].outline.area == pytest.approx(2800, rel=0.02)
    container = read_container(shadowed, reading=how)
    assert container.outline.area / 36 == pytest.approx(2800, rel=0.02)
    assert not caplog.messages


def test_a_faint_mask_of_an_svg_is_said_and_taken_in_too(drawn, caplog):
    veil = (
        '<mask id="m"><path fill="#fff" d="M0 0h50v90H0z"/><path fill="#444" d="M50 0h50v90H50z"/>'
    )
    body = veil + '</mask><path mask="url(#m)" d="M10 10h80v40h-80z"/>'
    file = drawn(body, page='viewBox="0 0 100 100"')
    assert read_items(file).items[0].outline.area == pytest.approx(1600, rel=0.02)
    assert "fainter than 0.5" in caplog.messages[-1]
    how = ReadOptions(alpha_threshold=0.05)
    (item,) = read_items(file, reading=how).items
    assert item.outline.area == pytest.approx(3200, rel=0.02)
    assert read_container(file, 100.0, reading=how).outline.area == pytest.approx(3200, rel=0.02)


def test_what_was_taken_in_is_measured(shadowed, tmp_path):
    recipe = make_recipe(
        container="square", items=[shadowed], alpha_threshold=0.1, effort="draft", levels="50",
        canvas=100,
    )  # fmt: skip
    run = uses.fill(recipe)
    assert run.certified
    (tmp_path / "out.svg").write_text(svg_text(run.layout), encoding="utf-8")
    (measured,) = read_written(tmp_path / "out.svg").outlines
    assert measured.area == pytest.approx(run.layout.outlines[0].area, rel=1e-4)


def test_soft_edges_are_no_shadows(painted, caplog):
    image = Image.new("RGBA", (400, 400))
    ImageDraw.Draw(image).ellipse([40, 40, 360, 360], fill="black")
    read_items(painted(image.resize((40, 40), Image.Resampling.BOX)))
    assert not caplog.messages
