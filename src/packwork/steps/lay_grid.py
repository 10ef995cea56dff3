"""Photographs as tiles of a grid, each where its colours and its structure show a picture."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import final

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.assignment.tiles import choose_tiles
from packwork.errors import RecipeError
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import buffered, prepared
from packwork.metrics.certificate import HAIR
from packwork.phrasing import number_of
from packwork.pipeline.findings import Finding, Sentence
from packwork.pipeline.job import Job
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.scene.contrast import oklabs_of_light
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.scene.swatch import patch_of
from packwork.scene.target import TargetPicture, blurred
from packwork.steps.mosaic import MORE_PHOTOS, too_fine, unrecognised

TILES = 1_500
"""Tiles where no number is asked for: at so many a face is recognised. Measured: decision 0053."""

PARTS = 4
"""Parts of a tile along each side whose colours are compared. More see finer structure, and take
longer. Tried."""

STRUCTURE = 2.0
"""What the differences of parts from their mean weigh beside that of the means. Larger keeps lines
of the picture, smaller its tones. Tried."""

LIGHTNESS = 1.5
"""What differences of lightness weigh beside those along Oklab's other axes: lines are seen by
light. Tried."""

APART = 3
"""Rows and columns within which no photo comes twice, where there are enough. Chosen by eye."""

SPARE = 2
"""Times as often as it takes that a photo may repeat, where nothing is asked. Larger shows more of
the picture and the same photos. Chosen."""

_CLEARANCE = 2 * HAIR
_WIDTHS = np.linspace(0.8, 1.25, 91)


@dataclass(frozen=True)
class Grid:
    """Cells of one size that lie in a container.

    ``cells``: ``(n, 2)`` row and column.
    ``centres``: ``(n, 2)``.
    ``side``: of a cell.
    """

    cells: IntArray
    centres: FloatArray
    side: float


def grid_in(outline: Outline, most: int) -> Grid:
    """Square cells inside an outline: as many as can be, but no more than ``most``.

    Examples
    --------
    >>> grid = grid_in(Outline.box(0, 0, 6, 4), 24)
    >>> len(grid.cells), grid.side
    (24, 1.0)
    """
    if (found := _largest(outline, most)) is not None:
        return found
    enough = next((n for k in range(1, 10) if _largest(outline, n := most << k)), "a wider one")
    tiles = number_of(most, "tile is", "tiles are")
    raise RecipeError("count", f"{tiles} too large to lie in this container; use {enough}")


def _largest(outline: Outline, most: int) -> Grid | None:
    left, top, right, bottom = outline.bounds
    whole = prepared(outline.region)
    best: Grid | None = None
    typical = (right - left) / np.sqrt(outline.area / most)
    for columns in np.unique(np.maximum(np.rint(typical * _WIDTHS), 1)).astype(int).tolist():
        side = (right - left) / columns
        rows = int((bottom - top) / side * (1 + HAIR))
        x = left + side * np.arange(columns)
        y = (top + bottom - rows * side) / 2 + side * np.arange(rows)
        row, column = (one.ravel() for one in np.indices((rows, columns)))
        inset = 1e-9 * side
        boxes = shapely.box(
            x[column] + inset, y[row] + inset, x[column] + side - inset, y[row] + side - inset
        )
        inside = np.flatnonzero(shapely.covers(whole, boxes))
        if (0 if best is None else len(best.cells)) < len(inside) <= most:
            centres = np.column_stack([x[column], y[row]])[inside] + side / 2
            best = Grid(np.column_stack([row, column])[inside], centres, side)
    return best


@final
class LayGrid(RunStep):
    """Items chosen for the cells of a grid; each may come several times."""

    def __init__(self, target: TargetPicture, most: int, repeats: int | None) -> None:
        self._target, self._most, self._repeats = target, most, repeats

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State of the tiles in their places."""
        job = state.job
        with job.clock.time("start"):
            gap = job.plan.gap
            room = job.container.outline
            if gap:
                inner = buffered(room.region, -gap / 2, join_style="mitre")
                if inner.is_empty:
                    raise RecipeError(
                        "padding", "leaves nothing of the container; use a smaller one"
                    )
                room = Outline.from_region(inner)
            grid = grid_in(room, self._most)
            count = len(grid.cells)
            repeats = self._repeats or -(-SPARE * count // len(job.items))
            if repeats * len(job.items) < count:
                raise RecipeError(
                    "repeats",
                    f"{number_of(len(job.items), 'photo makes', 'photos make')} "
                    f"{number_of(repeats * len(job.items), 'tile')} at most, not {count:,}; "
                    f"use {-(-count // len(job.items))} or more",
                )
            chosen = self._chosen(job.items, grid, repeats, job.plan.seed)
        tiles = job.subset(chosen)
        side = grid.side - gap - 2 * _CLEARANCE * job.container.side
        if side <= 0:
            raise RecipeError("padding", "leaves nothing of the tiles; use a smaller one")
        poses = _poses(tiles.items, grid, side)
        findings = state.findings
        if count < self._most and job.recipe.count is not None:
            values = {"many": number_of(count, "tile"), "asked": f"{self._most:,}"}
            findings = (*findings, Finding(Sentence.ROWS, values))
        return replace(
            RunState.of(tiles), poses=poses, nominal=poses.scale, method="grid", is_tight=True,
            recorder=state.recorder, findings=findings,
        )  # fmt: skip

    def _chosen(self, items: Sequence[Item], grid: Grid, repeats: int, seed: int) -> IntArray:
        wanted = self._wanted(grid)
        own = oklabs_of_light(np.array([patch_of(one, PARTS) for one in items]).reshape(-1, 3))
        first, second = (_features(one.reshape(-1, PARTS**2, 3)) for one in (wanted, own))
        prices = first @ (-2 * second.T)
        prices += (first**2).sum(axis=1)[:, None]
        prices += (second**2).sum(axis=1)
        detail = (first[:, 3:] ** 2).sum(axis=1)
        rng = np.random.default_rng(seed)
        return choose_tiles(prices, grid.cells, detail, repeats, APART, rng)

    def _wanted(self, grid: Grid) -> FloatArray:
        """``(n * PARTS ** 2, 3)`` colours of the picture in the parts of the cells, Oklab."""
        target = self._target
        shape = np.array(target.light.shape[:2])
        part = grid.side / PARTS * target.px_per_cu
        light = blurred(target.light, 1.0, max(int(shape.prod() / part**2), 1))
        steps = (np.arange(PARTS) + 0.5) / PARTS - 0.5
        down, across = (one.ravel() for one in np.meshgrid(steps, steps, indexing="ij"))
        at = grid.centres[:, None] + grid.side * np.column_stack([across, down])
        x, y = (
            np.clip((at * target.px_per_cu).astype(np.int64), 0, shape[::-1] - 1).reshape(-1, 2).T
        )
        return oklabs_of_light(light[y, x])


def hardly_shown(job: Job, target: TargetPicture, layout: Layout) -> Finding | None:
    """Finding of a picture that is finer than the tiles, or that these photos do not show."""
    fine = too_fine(target, layout.container, len(layout.items), "tile")
    hidden = unrecognised(job, target, layout)
    if fine is None or hidden is None or job.tints.mean() >= 0.5:
        return fine or hidden
    # Smaller tiles alone would not do: of these photographs they do not show it either.
    remedy = f"{fine.values['remedy']} with {MORE_PHOTOS}"
    return replace(fine, values={**fine.values, "remedy": remedy})


def _features(colours: FloatArray) -> FloatArray:
    """``(n, 3 + 3 * PARTS ** 2)`` such that squared distances are prices."""
    colours = colours * [LIGHTNESS, 1.0, 1.0]
    mean = colours.mean(axis=1)
    rest = (colours - mean[:, None]) * np.sqrt(STRUCTURE / PARTS**2)
    return np.hstack([mean, rest.reshape(len(colours), -1)]).astype(np.float32)


def _poses(items: Sequence[Item], grid: Grid, side: float) -> Poses:
    boxes = np.array([one.outline.bounds for one in items])
    scale = side / (boxes[:, 2:] - boxes[:, :2]).max(axis=1)
    at = grid.centres - scale[:, None] * (boxes[:, :2] + boxes[:, 2:]) / 2
    return Poses(at[:, 0], at[:, 1], np.zeros(len(items)), scale)
