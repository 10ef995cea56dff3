"""White paint in containers: a hole over dark paint, a shape of its own on nothing."""

from __future__ import annotations

from io import BytesIO

import numpy as np
import pytest
import resvg_py
from PIL import Image

from packwork.errors import ReadError
from packwork.readers.container import read_container
from packwork.readers.options import AS_DRAWN

DISC = '<circle cx="50" cy="50" r="40"/>'
STAR = '<path fill="{}" d="M50 20L65 70L25 40H75L35 70z"/>'
DISC_AREA, SQUARE = np.pi * 40**2, 900.0
HOLE = '<path fill="{}" d="M35 35h30v30h-30z"/>'


@pytest.fixture
def area(tmp_path):
    """Area of a drawing's container, as SVG, as PNG on paper and as PNG on clear ground."""

    def areas(body: str) -> dict[str, float]:
        text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{body}</svg>'
        (tmp_path / "a.svg").write_text(text, encoding="utf-8")
        data = bytes(resvg_py.svg_to_bytes(svg_string=text, width=400))
        clear = Image.open(BytesIO(data)).convert("RGBA")
        clear.save(tmp_path / "clear.png")
        paper = Image.new("RGBA", clear.size, "white")
        paper.alpha_composite(clear)
        paper.convert("RGB").save(tmp_path / "paper.png")
        found = {}
        for name in ("a.svg", "clear.png", "paper.png"):
            try:
                found[name] = read_container(
                    str(tmp_path / name), 100.0, reading=AS_DRAWN
                ).outline.area
            except ReadError:
                found[name] = 0.0
        return found

    return areas


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        (DISC + HOLE.format("white"), DISC_AREA - SQUARE),
        (DISC + HOLE.format("#fcfcfa"), DISC_AREA - SQUARE),
        (f'<g fill="#fff">{HOLE.format("red")}{HOLE.format("currentColor")}</g>', SQUARE),
        (DISC + HOLE.format("white") + HOLE.format("navy"), DISC_AREA),
        (DISC + '<path d="M30 50H70" stroke="white" stroke-width="10"/>', DISC_AREA - 400),
        (DISC + HOLE.format("white").replace("<path", '<path opacity=".2"'), DISC_AREA),
    ],
    ids=["hole", "off-white", "no white", "covered", "line", "gloss"],
)
def test_white_over_dark_is_a_hole_however_it_is_stored(area, body, expected):
    assert list(area(body).values()) == pytest.approx([expected] * 3, rel=0.01)


def test_large_white_holes_are_told(area, caplog):
    area(DISC + HOLE.format("white"))
    (told,) = [message for message in caplog.messages if "white paint" in message]
    assert "white paint over darker counts as holes, 18% of it; a tint below #f0f0f0" in told


def test_white_that_lies_on_nothing_counts(area):
    face = HOLE.format("white") + '<path d="M35 35h30v10h-30z"/>'
    found = area(face)
    assert found["a.svg"] == pytest.approx(SQUARE, rel=0.01)
    assert found["clear.png"] == pytest.approx(SQUARE, rel=0.01)
    # On paper nobody can tell it from the paper.
    assert found["paper.png"] == pytest.approx(300, rel=0.03)


def test_a_drawing_in_white_alone_counts(area):
    found = area(HOLE.format("white"))
    assert found["a.svg"] == pytest.approx(SQUARE, rel=0.01)
    assert found["clear.png"] == pytest.approx(SQUARE, rel=0.01)
    assert found["paper.png"] == 0


def test_other_light_colours_count(area):
    found = area(DISC + HOLE.format("#ffd93b"))
    assert found["a.svg"] == pytest.approx(DISC_AREA, rel=0.01)
    assert found["clear.png"] == pytest.approx(DISC_AREA, rel=0.01)


def test_a_drawing_in_outlines_keeps_its_white_body(area):
    ring = '<circle cx="50" cy="50" r="40" fill="white" stroke="black" stroke-width="4"/>'
    arm = '<path fill="white" stroke="black" stroke-width="4" d="M40 50h55v12h-55z"/>'
    found = area(ring + arm)
    assert found["a.svg"] > DISC_AREA
    assert found["clear.png"] > DISC_AREA


def test_letters_and_masks_are_drawn_to_see_their_white(area):
    half = '<mask id="m"><path fill="#fff" d="M0 0h100v50h-100z"/></mask>'
    found = area(f'{half}<g mask="url(#m)">{DISC}</g>{HOLE.format("white")}')
    assert found["a.svg"] == pytest.approx(found["clear.png"], rel=0.02)
