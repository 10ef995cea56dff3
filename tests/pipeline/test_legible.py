"""Items over a picture: each can be told from what lies under it."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import packwork as pw
from packwork.scene.contrast import contrast, contrast_over, readable_over
from packwork.scene.swatch import representative_colour
from packwork.steps.appearance import TEXT, ground_luminance, luminances_under
from packwork.writers.svg import svg_text

QUICK = {"effort": "draft", "levels": "50", "seed": 0}
WORDS = {"sky": 3, "wind": 2, "cloud": 2, "air": 1}


@pytest.fixture(params=["dark", "bright", "striped"])
def scene(request: pytest.FixtureRequest, tmp_path: Path) -> str:
    rng = np.random.default_rng(0)
    level = {"dark": 20, "bright": 235, "striped": 128}[request.param]
    pixels = rng.normal(level, 2, (120, 200, 3))
    if request.param == "striped":
        pixels[:, ::4] = 250
        pixels[:, 1::4] = 250
        pixels[:, 2::4] = 5
        pixels[:, 3::4] = 5
    pixels[60:90, 20:60] = rng.integers(0, 256, (30, 40, 3))
    file = tmp_path / "scene.png"
    Image.fromarray(np.clip(pixels, 0, 255).astype(np.uint8)).save(file)
    return f"around:{file}"


def test_every_word_can_be_read_on_what_lies_under_it_or_on_its_halo(scene: str) -> None:
    layout = pw.words(scene, WORDS, **QUICK)
    behind = layout.container.backdrop
    assert behind is not None
    ground = ground_luminance(layout.container, behind)
    for item, under in zip(layout.items, luminances_under(layout, ground), strict=True):
        colour = representative_colour(item)
        seen = contrast(colour, item.halo) if item.halo else contrast_over(colour, *under)
        # Soft edges pale the sample a little.
        assert seen > TEXT - 0.15


def test_halos_are_drawn_under_all_items_and_are_no_part_of_them(
    scene: str, tmp_path: Path
) -> None:
    layout = pw.fill(scene, ["owl", "rocket", "star"], count=6, **QUICK)
    text = svg_text(layout)
    assert ('id="halos"' in text) == any(item.halo for item in layout.items)
    if 'id="halos"' in text:
        assert text.index('id="backdrop"') < text.index('id="halos"') < text.index('id="items"')


def test_the_picture_is_seen_where_no_item_is(tmp_path: Path) -> None:
    pixels = np.random.default_rng(0).integers(0, 256, (80, 120, 3), dtype=np.uint8)
    pixels[:, :70] = (10, 60, 10)
    file = tmp_path / "scene.png"
    Image.fromarray(pixels).save(file)
    layout = pw.fill(f"around:{file}", "circle", count=3, keep_clear="0%,0%,10%,100%", **QUICK)
    layout.save(tmp_path / "out.png", pixels=240)
    with Image.open(io.BytesIO((tmp_path / "out.png").read_bytes())) as image:
        assert np.abs(np.subtract(image.convert("RGB").getpixel((8, 80)), (10, 60, 10))).max() <= 2


@pytest.mark.parametrize("ground", [(0.0, 0.1), (0.6, 1.0), (0.15, 0.2)])
def test_colours_are_found_where_there_are_any(ground: tuple[float, float]) -> None:
    for colour in ("#ff0000", "#0000ff", "#777777"):
        found = readable_over(colour, *ground, 4.5)
        if found is None:
            assert max(contrast_over(end, *ground) for end in ("black", "white")) < 4.5
        else:
            assert contrast_over(found, *ground) >= 4.5
