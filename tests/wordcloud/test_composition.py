"""How a cloud is composed: what a reader sees first, and what stays apart."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from PIL import Image

from packwork.readers.words.shaping import EM_PX, WORD_SPACE
from packwork.wordcloud import WordCloud
from packwork.wordcloud.engine import EDGE, UPRIGHT

WEIGHTS = {f"word{k}": 1 / (1 + k) for k in range(60)}


@pytest.fixture(scope="module", params=[0, 1, 2])
def cloud(request: pytest.FixtureRequest) -> WordCloud:
    return WordCloud(width=300, height=150, random_state=request.param).fit_words(WEIGHTS)


def test_the_largest_word_is_in_the_middle(cloud: WordCloud) -> None:
    left, top, right, bottom = cloud.layout.outlines[0].bounds
    assert (left + right) / 2 == pytest.approx(150, abs=50)
    assert (top + bottom) / 2 == pytest.approx(75, abs=30)


def test_the_first_words_are_upright(cloud: WordCloud) -> None:
    turned = [entry[3] is Image.Transpose.ROTATE_90 for entry in cloud.layout_]
    assert not any(turned[:UPRIGHT])
    upward = WordCloud(width=300, height=150, prefer_horizontal=0.0, random_state=0)
    assert any(entry[3] is not None for entry in upward.fit_words(WEIGHTS).layout_[:UPRIGHT])


def test_words_keep_from_larger_ones_by_their_size(cloud: WordCloud) -> None:
    outlines, sizes = cloud.layout.outlines, cloud.layout.poses.scale * EM_PX
    for one, other in combinations(range(8), 2):
        smaller = min(sizes[one], sizes[other])
        least = min(WORD_SPACE) / EM_PX * smaller
        # A pixel of the image on which words are placed.
        assert outlines[one].region.distance(outlines[other].region) > least - 1.0


def test_words_keep_from_the_edge_of_a_canvas(cloud: WordCloud) -> None:
    points = np.concatenate([outline.points for outline in cloud.layout.outlines])
    edge = max(2 / 2, EDGE * 150)
    assert points.min() >= edge
    assert (points <= np.array([300, 150]) - edge).all()
    tiny = WordCloud(width=8, height=8, min_font_size=1, random_state=0).fit_words({"o": 1})
    assert len(tiny.layout_) == 1
