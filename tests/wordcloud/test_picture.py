"""Words on pixels."""

from __future__ import annotations

import io

import numpy as np
from PIL import Image

from packwork.readers.fonts.fallback import open_fonts
from packwork.readers.words.shaping import shaped_word
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


def test_outlines_are_a_twentieth_of_a_pixel_off_their_curves_at_most() -> None:
    cloud = WordCloud(random_state=1).generate_from_frequencies(WORDS)
    words, poses = cloud._placed.words, cloud._placed.poses
    for word, scale in zip(words, poses.scale.tolist(), strict=True):
        fine = shaped_word(word.word, open_fonts([]), "keep").outline
        off = word.outline.region.boundary.hausdorff_distance(fine.region.boundary)
        assert off * scale < 1 / 20
        assert len(word.outline.points) < len(fine.points)
