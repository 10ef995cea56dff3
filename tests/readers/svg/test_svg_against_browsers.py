"""What is read of small drawings, against where Chromium paints.

``readers/goldens/browser`` holds the drawings, and beside each its mask, 100 px wide and high, as
``tools/render_in_browser.py`` made it once. A pixel counts only if none of its neighbours agrees:
edges may lie a pixel apart.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import shapely
from PIL import Image
from scipy.ndimage import binary_dilation

from packwork.readers.svg.drawing import read_drawing
from packwork.readers.svg.item import item_of_svg

GOLDENS = Path(__file__).parent.parent / "goldens" / "browser"
NAMES = sorted(path.stem for path in GOLDENS.glob("*.svg"))
SIDE_PX = 100
EVERYWHERE = SIDE_PX**2
LETTERS_PX = 12
"""Pixels by which letters may differ: programs round their places in ways of their own."""

MAY_LOSE = {
    # What shows below half is no part of the outline, which is said (``--alpha-threshold``).
    "mask-grey": 2500,
    # Written out without its filter, which is said.
    "filter-offset": EVERYWHERE,
    # A marker at the start of a closed line: programs turn it differently.
    "marker-closed": 30,
    "text-length": LETTERS_PX,
}
MAY_ADD = {
    "filter-offset": EVERYWHERE,
    "marker-closed": 40,
    "text-length": LETTERS_PX,
    # A gradient counts as a whole, clear parts and all.
    "gradient-clear": 3200,
}


def painted_by_browser(name: str) -> np.ndarray:
    return np.asarray(Image.open(GOLDENS / f"{name}.png")) > 0


def painted_by_us(name: str) -> np.ndarray:
    data = (GOLDENS / f"{name}.svg").read_bytes()
    region = read_drawing(data, is_compared=True, is_on_paper=True).ink.whole
    shapely.prepare(region)
    rows, columns = np.mgrid[0:SIDE_PX, 0:SIDE_PX] + 0.5
    return shapely.contains_xy(region, columns, rows)


def near(mask: np.ndarray) -> np.ndarray:
    return binary_dilation(mask, np.ones((3, 3)))


@pytest.mark.parametrize("name", NAMES)
def test_ink_is_where_a_browser_paints(name):
    theirs, ours = painted_by_browser(name), painted_by_us(name)
    lost, added = int((theirs & ~near(ours)).sum()), int((ours & ~near(theirs)).sum())
    assert lost <= MAY_LOSE.get(name, 0)
    assert added <= MAY_ADD.get(name, 0)


@pytest.mark.xfail(strict=True, reason="proves that the comparison can fail")
def test_comparison_can_fail():
    assert not (painted_by_browser("caps") & ~near(painted_by_us("joins"))).any()


@pytest.mark.parametrize(
    "name", ["image-png-exif", "image-jpeg-exif", "image-gif-animated", "image-apng"]
)
def test_pictures_are_written_as_one_upright_frame(name):
    markup = item_of_svg((GOLDENS / f"{name}.svg").read_bytes(), name, name).art.markup
    assert "image/gif" not in markup
    assert b"Exif" not in markup.encode()
    source = (GOLDENS / f"{name}.svg").read_text(encoding="utf-8")
    assert source[source.index("base64,") :][:60] not in markup


@pytest.mark.parametrize(
    ("name", "absent"),
    [
        ("units-rem", "rem"),
        ("units-viewport", "v"),
        ("calc", "calc"),
        ("transform-box", "transform-"),
        ("vector-effect", "vector-effect"),
        ("dashes-path-length", "pathLength"),
        ("colour-functions", "oklch"),
    ],
)
def test_nothing_that_programs_read_differently_is_written(name, absent):
    markup = item_of_svg((GOLDENS / f"{name}.svg").read_bytes(), name, name).art.markup
    for attribute in markup.split('"')[1::2]:
        assert absent not in attribute
    assert f"{absent}=" not in markup
