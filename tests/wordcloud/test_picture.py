"""Words on pixels."""

from __future__ import annotations

import io

import numpy as np
from PIL import Image

from packwork.wordcloud import WordCloud
from packwork.writers.bitmaps import png_bytes
from packwork.writers.svg import SvgOptions

WORDS = {"honey": 3.0, "bear": 2.0, "bees": 1.0, "Ägypten": 1.0}


def test_the_picture_is_that_of_the_drawing() -> None:
    cloud = WordCloud(width=200, height=100, scale=2, random_state=1, mode="RGBA")
    cloud.background_color = None
    cloud.generate_from_frequencies(WORDS)
    with Image.open(io.BytesIO(png_bytes(cloud.layout, 400, SvgOptions()))) as drawn:
        theirs = np.asarray(drawn.convert("RGBA"), dtype=np.float64)
    ours = np.asarray(cloud.to_image(), dtype=np.float64)
    assert abs(ours[..., 3] - theirs[..., 3]).mean() < 1
    assert abs(ours[..., 3] - theirs[..., 3]).max() < 64
    solid = (ours[..., 3] == 255) & (theirs[..., 3] == 255)
    assert solid.any()
    assert (ours[solid] == theirs[solid]).all()


def test_clear_colours_let_the_background_through() -> None:
    cloud = WordCloud(width=120, height=60, random_state=0, background_color="white")
    cloud.generate_from_frequencies(WORDS)
    cloud.recolor(color_func=lambda *_, **__: (0, 0, 0, 128))
    assert cloud.to_array().min() == 127
