"""The drawings that travel with the package: sound files, clear and distinct pictures."""

from __future__ import annotations

import io
import re
from collections import Counter
from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
import resvg_py
from defusedxml import ElementTree
from PIL import Image

import packwork.bundled
from each import for_each
from packwork.geometry.overlay import polygon_parts
from packwork.readers.container import read_container

ROOT = Path(packwork.bundled.__file__).parent
ICONS = sorted((ROOT / "icons").glob("*.svg"))
CONTAINERS = sorted((ROOT / "containers").glob("*.svg"))
SIDE_PX = 64
SMALLEST_MARGIN_PX = 1
LARGEST_LIKENESS = 0.93

PALETTE = {
    "teal": "#1f6f78",
    "coral": "#ee6c4d",
    "mustard": "#e9b341",
    "cream": "#f8e8cf",
    "navy": "#22304f",
    "sage": "#8fb48c",
    "blush": "#f5b7a4",
    "plum": "#7b3b5e",
}

any_picture = for_each(ICONS + CONTAINERS, name=lambda path: path.stem)


def view_box(path: Path) -> tuple[float, ...]:
    root = ElementTree.parse(path).getroot()
    return tuple(float(number) for number in root.attrib["viewBox"].split())


def alpha(path: Path, width_px: int = SIDE_PX) -> npt.NDArray[np.uint8]:
    drawn = resvg_py.svg_to_bytes(
        svg_string=path.read_text(encoding="utf-8"), width=width_px, skip_system_fonts=True
    )
    return np.asarray(Image.open(io.BytesIO(bytes(drawn))).convert("RGBA"))[:, :, 3]


def silhouette(path: Path) -> npt.NDArray[np.bool_]:
    """Fits the picture's bounding box to a square, so that likeness means shape, not place."""
    image = Image.fromarray(alpha(path))
    return np.asarray(image.crop(image.getbbox()).resize((SIDE_PX, SIDE_PX))) > 127


def likeness(a: npt.NDArray[np.bool_], b: npt.NDArray[np.bool_]) -> float:
    """Share of the two silhouettes' union that they have in common."""
    return float((a & b).sum() / (a | b).sum())


def local_name(element: Any) -> str:
    return str(element.tag).rsplit("}", 1)[-1]


def test_there_are_enough_pictures() -> None:
    assert len(ICONS) >= 40
    assert 8 <= len(CONTAINERS) <= 16


def test_icons_have_a_square_of_100_units() -> None:
    assert {view_box(path) for path in ICONS} == {(0.0, 0.0, 100.0, 100.0)}


@for_each(CONTAINERS, name=lambda path: path.stem)
def test_container_is_one_filled_path(path: Path) -> None:
    shapes = [e for e in ElementTree.parse(path).iter() if local_name(e) not in {"svg", "title"}]
    assert view_box(path)[:2] == (0.0, 0.0)
    assert [local_name(shape) for shape in shapes] == ["path"]
    assert "stroke" not in shapes[0].attrib


@any_picture
def test_picture_refers_to_nothing_outside_itself(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    references = re.findall(r'href="([^"]*)"|url\(([^)]*)\)', text)
    assert all((href or url).startswith("#") for href, url in references)
    assert not re.search(r"<(!DOCTYPE|!ENTITY|script|style|image|foreignObject)", text)


@any_picture
def test_picture_keeps_to_the_palette(path: Path) -> None:
    colours = re.findall(r"#[0-9a-f]{6}\b", path.read_text(encoding="utf-8"))
    assert set(colours) <= set(PALETTE.values())


def test_no_two_icons_share_an_id() -> None:
    ids = Counter(
        found for path in ICONS for found in re.findall(r'\bid="([^"]*)"', path.read_text("utf-8"))
    )
    assert [name for name, times in ids.items() if times > 1] == []


@any_picture
def test_picture_fills_its_box_and_stays_inside(path: Path) -> None:
    drawn = alpha(path, 256)
    rows, columns = np.nonzero(drawn)
    height, width = drawn.shape
    extent = max(np.ptp(rows) / height, np.ptp(columns) / width)
    assert extent > 0.85
    assert SMALLEST_MARGIN_PX <= rows.min() <= rows.max() < height - SMALLEST_MARGIN_PX
    assert SMALLEST_MARGIN_PX <= columns.min() <= columns.max() < width - SMALLEST_MARGIN_PX


@pytest.mark.parametrize("paths", [ICONS, CONTAINERS], ids=["icons", "containers"])
def test_silhouettes_are_distinct(paths: list[Path]) -> None:
    shapes = {path.stem: silhouette(path) for path in paths}
    alike = [
        (a, b)
        for a, b in combinations(shapes, 2)
        if likeness(shapes[a], shapes[b]) > LARGEST_LIKENESS
    ]
    assert alike == []


def test_likeness_tells_same_from_different() -> None:
    ring, fish = silhouette(ROOT / "containers/ring.svg"), silhouette(ROOT / "icons/fish.svg")
    assert likeness(ring, ring) == 1.0
    assert likeness(ring, fish) < LARGEST_LIKENESS


@pytest.mark.parametrize("name", ["icons/donut", "icons/key", "containers/ring"])
def test_holes_are_open(name: str) -> None:
    drawn = alpha(ROOT / f"{name}.svg", 200)
    row, column = (48, 151) if name == "icons/key" else (100, 100)
    assert drawn[row, column] == 0


MARKED = dict.fromkeys("ãñõáéíóúàèìòùńśźåůÃẼÑÁÉÍÓÚ", 1) | {"ő": 2, "ặ": 2}


@pytest.mark.parametrize("letter", MARKED)
def test_marks_over_letters_stand_free_of_them(letter: str) -> None:
    parts = polygon_parts(read_container(f"text:{letter}").outline.region)
    assert len(parts) == 1 + MARKED[letter]
