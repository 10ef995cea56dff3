"""Poses of a step from those of the step beside it: what stays stays, what is new finds a hole.

Sizes are given, so what may give way is places alone. First nothing moves but what is in conflict
once words have their new sizes; then words are put anew one by one, the largest first, each as near
to its place as there is room. Either is made exact by the finish: words in conflict shrink, and
grow back while their neighbours give way (separation and compaction, see ``packwork.compaction``).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.options import HAIR
from packwork.finish.finish import Finished, finish
from packwork.finish.options import FinishOptions
from packwork.geometry.affine import similarity
from packwork.geometry.outline import Outline
from packwork.progress import Stop, never
from packwork.raster.coverage import TOUCHED
from packwork.scene.container import Container
from packwork.scene.pose import Poses
from packwork.start.first_fit.occupancy import NOISE, REACH, Occupancy, covered, cut
from packwork.start.first_poses import container_image
from packwork.steps.finish import gap_with_bulge
from packwork.timeline.step import SeriesStep
from packwork.uses.words.graded import angles_of

TRIES = 3
"""Times that words which keep others from their sizes are put elsewhere. More find more and take
longer. Tried."""

Places = Mapping[str, tuple[float, float, float]]
"""Last known x, y and angle of words, by name."""


def followed(
    step: SeriesStep,
    size: float,
    beside: Poses | None,
    names: Sequence[str],
    known: Places,
    stop: Stop = never,
) -> Poses | None:
    """Exact poses of a step at its true sizes; None if none are found.

    ``size``: scale of all steps: items have so many times their true scales.
    ``beside``: poses of the step beside it, None if there is none; ``names`` of its items.
    ``known``: places of all words that any step has had so far.
    """
    target = size * step.true
    if beside is not None:
        found = _settled(step, _kept(step, target, beside, names, known), target, stop)
        if found is not None:
            return found
    # All words put again, the largest first, each near the place that it had.
    count = len(target)
    poses = Poses(np.zeros(count), np.zeros(count), np.zeros(count), target.copy())
    return _settled(step, _put(step, _board(step), poses, np.arange(count), known), target, stop)


def _settled(step: SeriesStep, poses: Poses, target: FloatArray, stop: Stop) -> Poses | None:
    """Exact poses at true sizes near these; None if none are found."""
    for _ in range(TRIES):
        found = _finished(step, poses, target, stop)
        if found.clean or stop():
            return found.poses if found.clean else None
        poses = _reinserted(step, found)
    return None


def _reinserted(step: SeriesStep, found: Finished) -> Poses:
    """Poses in which the smaller one of each pair in conflict is put where there is room.

    So that one which is too large now for its place keeps that, and few words move: an ejection,
    as local search of nestings has it.
    """
    outlines, poses = step.job.solid_outlines, found.poses
    areas = np.array([outline.area for outline in outlines]) * poses.scale**2
    pairs = [(one.item, one.item if one.other is None else one.other) for one in found.conflicts]
    ejected = np.unique([min(pair, key=lambda k: float(areas[k])) for pair in pairs]).astype(int)
    board = _board(step)
    for k in np.setdiff1d(np.arange(len(poses)), ejected):
        board.lay(outlines[k].mapped(poses.matrix(int(k))))
    return _put(step, board, poses, ejected, places_of(step, poses))


def _kept(
    step: SeriesStep, target: FloatArray, beside: Poses, names: Sequence[str], known: Places
) -> Poses:
    """Words where they are, no larger than before; new ones in holes, as large as these are."""
    rows = {name: row for row, name in enumerate(names)}
    found = np.array([rows.get(name, -1) for name in step.names])
    stays = np.flatnonzero(found >= 0)
    count = len(target)
    poses = Poses(np.zeros(count), np.zeros(count), np.zeros(count), target.copy())
    some = beside.subset(found[stays])
    smaller = replace(some, scale=np.minimum(some.scale, target[stays]))
    poses = poses.with_some(stays, smaller)
    board, outlines = _board(step), step.job.solid_outlines
    for k in stays:
        board.lay(outlines[k].mapped(poses.matrix(int(k))))
    return _put(step, board, poses, np.flatnonzero(found < 0), known)


def _board(step: SeriesStep) -> WordBoard:
    job = step.job
    return WordBoard(
        job.container,
        np.random.default_rng(job.plan.seed),
        job.plan.gap + HAIR * job.container.side,
    )


def _put(step: SeriesStep, board: WordBoard, poses: Poses, items: IntArray, known: Places) -> Poses:
    """Poses with some items put on the board; what finds no place at all lies in the middle."""
    job = step.job
    rng = np.random.default_rng(job.plan.seed)
    outlines = job.solid_outlines
    areas = np.array([outline.area for outline in outlines]) * poses.scale**2
    middle = np.reshape(job.container.outline.bounds, (2, 2)).mean(axis=0)
    rows = np.column_stack([poses.x, poses.y, poses.angle, poses.scale])
    for k in items[np.argsort(-areas[items], kind="stable")]:
        home = known.get(step.names[k])
        angles = angles_of(job.plan.rotation, rng) if home is None else (home[2],)
        near = None if home is None else home[:2]
        scale = float(poses.scale[k])
        put = board.put(outlines[k], scale, angles, near)
        rows[k] = put or (*(home or (*middle, angles[0])), scale / 2)
    x, y, angle, scale_all = rows.T.copy()
    return replace(poses, x=x, y=y, angle=angle, scale=scale_all)


def places_of(step: SeriesStep, poses: Poses) -> dict[str, tuple[float, float, float]]:
    """x, y and angle of each item, by name."""
    rows = zip(step.names, poses.x.tolist(), poses.y.tolist(), poses.angle.tolist(), strict=True)
    return {name: (x, y, angle) for name, x, y, angle in rows}


def _finished(step: SeriesStep, poses: Poses, target: FloatArray, stop: Stop) -> Finished:
    """Poses at their sizes, taken apart: what is in conflict shrinks, and grows back."""
    job = step.job
    options = FinishOptions(
        gap_cu=gap_with_bulge(job, np.arange(len(target)), target),
        sizes="fixed",
        turning=False,
        staying=True,
        loosened=True,
        seed=job.plan.seed,
    )
    whole = replace(poses, scale=target.copy())
    return finish(job.container, job.solid_outlines, whole, options, stop=stop, is_enough=stop)


SIDE_PX = 600
"""Longer side of the image. Larger wastes less room at the edges of pixels, and takes longer. As
the finest image of ``first_fit``."""

HOMING = 20.0
"""Score that an item gives for coming nearer to its home by the canvas' side, where what it touches
gives 1 at most. Larger leaves more of the room bare, smaller lets words wander. Tried."""

SIZES = (1.0, 0.9, 0.8, 0.65, 0.5, 0.35, 0.2)
"""Shares of its size at which an item is tried in turn: it grows to the whole of it later on.
Chosen."""


class WordBoard:
    """Pixels of a container, each taken or not.

    ``margin_cu``: room that every item keeps from others, canvas units.
    """

    def __init__(self, container: Container, rng: np.random.Generator, margin_cu: float) -> None:
        image, self._px_per_cu = container_image(container, SIDE_PX)
        self._occupancy = Occupancy(image > 1 - TOUCHED, REACH)
        self._noise = NOISE * rng.random(image.shape)
        self._margin_px = margin_cu * self._px_per_cu
        rows, columns = np.ogrid[: image.shape[0], : image.shape[1]]
        self._rows, self._columns = rows, columns

    def lay(self, outline: Outline) -> None:
        """Take what an item covers that lies in place."""
        posed = outline.mapped(similarity(0.0, 0.0, 0.0, self._px_per_cu))
        mask, origin = covered(posed, self._margin_px)
        self._occupancy.take(mask, -origin[0], -origin[1])

    def put(
        self,
        outline: Outline,
        scale: float,
        angles: Sequence[float],
        home: tuple[float, float] | None,
    ) -> tuple[float, float, float, float] | None:
        """Pose of an item put on the board, as large as there is room; None if there is none.

        ``scale``: the largest to try; see ``SIZES``.
        ``angles``: to try, radians, the preferred one first.
        ``home``: what it is to lie near, canvas units; None puts it where it touches most.

        Returns x, y, angle, scale.
        """
        worth = self._noise if home is None else self._noise - HOMING * self._away(home)
        for share in SIZES:
            for angle in angles:
                posed = outline.mapped(similarity(0.0, 0.0, angle, share * scale * self._px_per_cu))
                if self._is_larger(posed):
                    continue
                stencil = cut(posed, REACH, self._margin_px)
                found = self._occupancy.best_place(stencil, worth, home is not None)
                if found is not None:
                    _, row, column = found
                    self._occupancy.take(stencil.mask, row, column)
                    x, y = column + stencil.origin[1], row + stencil.origin[0]
                    return x / self._px_per_cu, y / self._px_per_cu, angle, share * scale
        return None

    def _away(self, home: tuple[float, float]) -> FloatArray:
        """Distance of each pixel's corner from a place, over the image's longer side."""
        x, y = home[0] * self._px_per_cu, home[1] * self._px_per_cu
        away = np.hypot(self._rows - y, self._columns - x)
        return np.asarray(away / max(self._noise.shape))

    def _is_larger(self, outline_px: Outline) -> bool:
        left, top, right, bottom = outline_px.bounds
        height, width = self._noise.shape
        wide, high = math.ceil(right) - math.floor(left), math.ceil(bottom) - math.floor(top)
        return bool(wide > width or high > height)
