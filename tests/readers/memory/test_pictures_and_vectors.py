"""Pictures to be shown and vectors of items, given as values of Python."""

from __future__ import annotations

from io import BytesIO
from typing import Any

import numpy as np
import pytest
from PIL import Image

import packwork as pw
from packwork.errors import PackworkError

QUICK = {"levels": "50", "epochs": 30, "effort": "draft", "seed": 0}
HALVES = np.zeros((20, 20, 3))
HALVES[:, 10:] = (1.0, 0.5, 0.0)


def in_bytes() -> bytes:
    stream = BytesIO()
    Image.fromarray(np.round(255 * HALVES).astype(np.uint8)).save(stream, "png")
    return stream.getvalue()


@pytest.fixture(scope="module")
def of_file(tmp_path_factory: pytest.TempPathFactory) -> pw.Layout:
    picture = tmp_path_factory.mktemp("picture") / "halves.png"
    picture.write_bytes(in_bytes())
    return pw.fill("square", "star", count=12, picture=picture, **QUICK)


@pytest.mark.parametrize(
    "picture",
    [
        HALVES,
        np.round(255 * HALVES).astype(np.uint8),
        Image.fromarray(np.round(255 * HALVES).astype(np.uint8)),
        in_bytes(),
    ],
    ids=["shares", "bytes of colours", "picture", "file"],
)
def test_a_picture_in_memory_is_shown_as_its_file_is(picture: Any, of_file: pw.Layout) -> None:
    of_memory = pw.fill("square", "star", count=12, picture=picture, **QUICK)
    assert np.array_equal(of_file.poses.x, of_memory.poses.x)
    assert list(of_file.to_dataframe()["color"]) == list(of_memory.to_dataframe()["color"])


def test_light_of_an_array_is_light() -> None:
    dark = np.zeros((20, 20))
    dark[:, 10:] = 1.0
    layout = pw.fill("square", "circle", count=16, picture=dark, ground="#808080", **QUICK)
    frame = layout.to_dataframe()
    reds = np.array([int(colour[1:3], 16) for colour in frame["color"]])
    right = layout.poses.x > layout.container.width / 2
    assert reds[right].mean() > reds[~right].mean() + 100


NAMES = ("star", "moon", "heart", "owl")
ROWS = np.array([[1.0, 0], [1, 0.1], [0, 1], [0.1, 1]])


def test_vectors_are_given_as_arrays_dicts_and_frames() -> None:
    pandas = pytest.importorskip("pandas")
    given = [
        ROWS,
        dict(zip(NAMES, ROWS, strict=True)),
        pandas.DataFrame(ROWS, index=list(NAMES), columns=["warm", "cold"]),
        pandas.DataFrame([(n, *r) for n, r in zip(NAMES, ROWS, strict=True)][::-1]),
    ]
    layouts = [pw.fill("circle", list(NAMES), count=16, embeddings=one, **QUICK) for one in given]
    assert all(np.array_equal(layouts[0].poses.x, one.poses.x) for one in layouts[1:])
    drawn = pw.fill(
        "circle", list(NAMES), count=16, embeddings=given[2], anchors="left=warm", **QUICK
    )
    warm = np.array([item.name in NAMES[:2] for item in drawn.items])
    assert drawn.poses.x[warm].mean() < drawn.poses.x[~warm].mean() - 100


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"picture": np.zeros((4, 4, 7))}, r"is an array of shape \(4, 4, 7\)"),
        ({"picture": 300 * np.ones((4, 4))}, "has numbers from 300 to 300"),
        ({"picture": object()}, "picture: is object, which cannot be read"),
        ({"embeddings": ["a", "b"]}, "is no array of numbers"),
        ({"embeddings": np.ones(4)}, r"has the shape \(4,\)"),
        ({"embeddings": np.full((2, 3), np.nan)}, "number 1 is none"),
    ],
)
def test_what_is_neither_is_one_line(options: dict[str, Any], said: str) -> None:
    with pytest.raises(PackworkError, match=said) as caught:
        pw.fill("circle", ["star", "moon"], count=4, **options, **QUICK)
    assert "\n" not in str(caught.value)
