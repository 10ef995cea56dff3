"""What is certified is so in every file: layouts of wild outlines, written and read back."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from packwork import writers
from packwork.errors import ReadError
from packwork.metrics.certificate import Promise, broken
from packwork.metrics.exact import exact_metrics
from packwork.readers.builtin import builtin_container
from packwork.readers.layouts.read import read_written
from packwork.readers.svg.item import item_of_svg
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses

SIDE = 100.0
_SEEDS = st.integers(0, 2**20)


def _spikes(rng: np.random.Generator) -> str:
    turns = np.sort(rng.uniform(0, 2 * np.pi, 24))
    radii = np.where(np.arange(24) % 2, 40.0, 10.0 ** rng.uniform(-6, 1.5, 24))
    return _path(np.column_stack([radii * np.cos(turns), radii * np.sin(turns)]))


def _near_touching_holes(rng: np.random.Generator) -> str:
    gap = 10.0 ** rng.uniform(-13, -1)
    across = (-9.0, 1.0 + gap)
    holes = "".join(f"M{x!r} -5h{8.0 - gap!r}v10h{-8.0 + gap!r}z" for x in across)
    return f"M-10 -10h20v20h-20z{holes}"


def _bow_tie(rng: np.random.Generator) -> str:
    return _path(rng.uniform(-20, 20, (int(rng.integers(4, 9)), 2)))


def _there_and_back(rng: np.random.Generator) -> str:
    there = rng.uniform(-20, 20, (5, 2))
    back = there[::-1] + rng.normal(0, 10.0 ** rng.uniform(-14, -2), (5, 2))
    return _path(np.concatenate([there, back, [[30, 30], [-30, 30]]]))


def _sliver(rng: np.random.Generator) -> str:
    high = 10.0 ** rng.uniform(-5, 0)
    return _path(np.array([[-30, 0], [30, high * rng.uniform()], [30, high], [0, high * 1.5]]))


def _ring_with_a_slit(rng: np.random.Generator) -> str:
    slit = 10.0 ** rng.uniform(-12, 0)
    return f"M-10 -10H{-slit!r}V-6H-6V6H6V-6H{slit!r}V-10H10V10H-10z"


def _tiny_rings(rng: np.random.Generator) -> str:
    specks = "".join(
        f"M{x!r} {y!r}h{s!r}v{s!r}z"
        for x, y, s in zip(
            *rng.uniform(12, 30, (2, 4)), 10.0 ** rng.uniform(-4, -1, 4), strict=True
        )
    )
    return f"M-10 -10h20v20h-20z{specks}"


_KINDS = (
    _spikes, _near_touching_holes, _bow_tie, _there_and_back, _sliver, _ring_with_a_slit,
    _tiny_rings,
)  # fmt: skip


def _path(points: np.ndarray) -> str:
    return "M" + "L".join(f"{x!r} {y!r}" for x, y in points.tolist()) + "z"


def _item(path: str, size: float, rule: str) -> Item | None:
    shape = f'<path transform="scale({size!r})" fill-rule="{rule}" d="{path}"/>'
    markup = f'<svg xmlns="http://www.w3.org/2000/svg">{shape}</svg>'
    try:
        return item_of_svg(markup.encode(), "wild", "wild.svg", is_compared=True)
    except ReadError:
        # Too thin or too small to be placed, and said so.
        return None


def _measured(layout: Layout, file: Path) -> tuple[str, ...]:
    writers.write(layout, file)
    found = read_written(file)
    promise = Promise.of(found.manifest)
    assert promise is not None
    return broken(promise, found, exact_metrics(found.outlines, found.container.outline))


@given(_SEEDS, st.sampled_from(_KINDS), st.sampled_from([1e-3, 1.0, 1e4]), st.booleans())
@settings(deadline=None, max_examples=40)
def test_what_is_certified_is_so_in_every_file(
    tmp_path_factory: pytest.TempPathFactory, seed: int, kind: object, size: float, fills: bool
) -> None:
    assert callable(kind)
    rng = np.random.default_rng(seed)
    item = _item(kind(rng), size, "nonzero" if fills else "evenodd")
    if item is None:
        return
    scale, angle = 20.0 / item.outline.extent, float(rng.uniform(0, 6.28))
    poses = Poses(np.array([30.0, 70.0]), np.full(2, 50.0), np.full(2, angle), np.full(2, scale))
    container = builtin_container("square", SIDE)
    said = {"promised": {"gap": 0.0, "areas_in_shares": False}}
    layout = Layout(container, (item, item), poses, np.ones(2), said)
    assert not broken(Promise(), layout, exact_metrics(layout.outlines, container.outline))
    folder = tmp_path_factory.mktemp("read-back")
    for ending in ("geojson", "svg", "dxf"):
        assert _measured(layout, folder / f"one.{ending}") == (), ending


@given(_SEEDS, st.sampled_from(_KINDS))
@settings(deadline=None, max_examples=20)
def test_what_a_file_shows_lies_in_what_was_placed(
    tmp_path_factory: pytest.TempPathFactory, seed: int, kind: object
) -> None:
    assert callable(kind)
    rng = np.random.default_rng(seed)
    item = _item(kind(rng), 1.0, "evenodd")
    if item is None:
        return
    scale = 20.0 / item.outline.extent
    poses = Poses(*(np.full(1, v) for v in (50.0, 50.0, float(rng.uniform(0, 6)), scale)))
    layout = Layout(builtin_container("square", SIDE), (item,), poses, np.ones(1))
    file = tmp_path_factory.mktemp("shown") / "one.svg"
    writers.write(layout, file)
    shown = read_written(file).outlines[0].region
    placed = item.outline.mapped(poses.matrix(0))
    assert placed.region.buffer(1e-5 * SIDE).covers(shown)
