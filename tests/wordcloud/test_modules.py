"""Modules that programs written for the other package import from by name."""

from __future__ import annotations

from importlib import import_module
from random import Random

import numpy as np
import pytest

from packwork import wordcloud
from packwork.wordcloud.query_integral_image import query_integral_image
from packwork.wordcloud.tokenization import process_tokens, score, unigrams_and_bigrams


@pytest.mark.parametrize(
    ("module", "name"),
    [
        ("wordcloud", "WordCloud"),
        ("wordcloud", "STOPWORDS"),
        ("color_from_image", "ImageColorGenerator"),
        ("tokenization", "unigrams_and_bigrams"),
        ("tokenization", "process_tokens"),
        ("tokenization", "score"),
        ("query_integral_image", "query_integral_image"),
        ("wordcloud_cli", "main"),
    ],
)
def test_names_stand_in_the_modules_of_the_other_package(module: str, name: str) -> None:
    found = getattr(import_module(f"packwork.wordcloud.{module}"), name)
    assert callable(found) or found is wordcloud.STOPWORDS
    assert name not in wordcloud.__all__ or found is getattr(wordcloud, name)


def test_process_tokens_keeps_plurals_if_asked() -> None:
    assert process_tokens(["bees", "bee", "Bee", "Bee"], normalize_plurals=False) == (
        {"bees": 1, "Bee": 3},
        {"bees": "bees", "bee": "Bee"},
    )


def test_pairs_below_the_threshold_are_single_words() -> None:
    words = ["white", "rabbit", "white", "rabbit"]
    assert unigrams_and_bigrams(words, set(), True, 1000) == {"white": 2, "rabbit": 2}


def test_the_score_of_the_only_word_is_nothing() -> None:
    assert score(2, 3, 1, 3) == 0


@pytest.mark.parametrize("seed", range(5))
def test_a_box_that_is_drawn_covers_nothing(seed: int) -> None:
    image = np.random.default_rng(seed).random((20, 30)) < 0.05
    sums = np.cumsum(np.cumsum(image, axis=0), axis=1).astype(np.uint32)
    place = query_integral_image(sums, 3, 4, Random(seed))
    assert place is not None
    row, column = place
    assert not image[row + 1 : row + 4, column + 1 : column + 5].any()


def test_a_box_larger_than_the_image_has_no_place() -> None:
    assert query_integral_image(np.zeros((4, 4), dtype=np.uint32), 9, 9, Random(0)) is None
