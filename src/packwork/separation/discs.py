"""Jammed packings of discs of given proportions: as large as they go, in a container of any form.

Discs are soft at first: larger than there is room for, so that they overlap. The energy, half the
sum of squared overlaps, goes down by FIRE while the common scale comes down to where discs jam
(C. O'Hern, L. Silbert, A. Liu and S. Nagel, "Jamming at zero temperature and zero applied stress",
Physical Review E 68 (2003), 011306, doi:10.1103/PhysRevE.68.011306). On the way radii are degrees
of freedom, too (V. Hagh, S. Nagel, A. Liu, M. Manning and E. Corwin, "Transient learning degrees
of freedom for introducing function in materials", PNAS 119 (2022), doi:10.1073/pnas.2117622119;
swaps as in A. Ninarello, L. Berthier and D. Coslovich, Physical Review X 7 (2017), 021039): discs
exchange places until each void has one that suits it. Ours keeps the very radii that were given:
wishes of places are sorted, and radii given out in that order. Where discs are few, what has jammed
is shaken and jams again, and the better of two is kept (monotonic basin hopping).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import shapely

from packwork.arrays import FloatArray, IntArray
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import prepared
from packwork.separation.kernels import discs as kernels
from packwork.separation.kernels.wall import edge_distances, list_edges

CELLS, LEAST_CELLS, MOST_CELLS = 8.0, 32, 256
"""Cells along the longer side of the grid that lists a container's edges, over the root of the
number of discs, and their bounds. More take longer to make and list fewer edges each. Tried."""

CROWDED = 0.95
"""Share of the container that soft discs have at first. Larger takes longer to come apart, smaller
leaves voids. Tried."""

ROUNDS, STEPS, EVERY = 12, 120, 20
"""Common scales on the way down to where discs jam, steps of the descent at each, and steps between
exchanges of radii. More covers up to .002 more of a container. Tried."""

CALM_ROUNDS, CALM_EVERY = 24, 10
"""The same of a first descent where work is left for more. Tried."""

LOOSEST, TIGHTEST = 0.06, 0.004
"""Excess of the scale over that at which discs jam: first and last. A larger first one mixes
more, a smaller last one has too few overlaps to tell who is pressed. Tried."""

QUENCHES, QUENCHED_STEPS = 4, 300
"""Scales that are tried without exchanges at last, ever nearer to where discs jam, and steps of
the descent at each. More gain a thousandth. Tried."""

QUENCHED, NEARER = 2e-3, 0.4
"""Excess of the first of them, and factor to the next. Tried."""

SHAKEN, SHAKEN_ROUNDS = 0.3, 5
"""Deviation by which discs are shaken, mean radii, and scales on the way down then. More forgets
what was found, fewer do not find it again. Tried."""

MOST_SHAKEN = 100
"""Times that a layout is shaken at most. More gain nothing where discs are very few. Tried."""

PROMISING = 0.999
"""Share of the best scale so far that a shaken layout has to jam at to be looked at closely.
Larger overlooks better ones, smaller takes longer. Tried."""

ALIKE = 0.05
"""Range of radii, over their mean, up to which discs begin in a triangular lattice. Larger has no
room for the larger ones. Chosen."""

OFF_EDGE, LATTICES = 0.45, 16
"""Distance of a lattice's places from the edge, over that of two, and halvings of the range of the
latter. Larger leaves the rim empty, smaller presses discs into it. Tried."""

TRAPPED, CROWD, NEAR = 0.9, 4.0, 6
"""Share of the scale at which discs jam below which one is trapped, least distance of those that
are freed at once, mean radii, and discs whose distance tells how wide a void is. Tried."""

HURRIED = 0.8
"""Share of its scale that a layout keeps whose descent is cut short. Larger leaves overlaps, by
which all shrink. Chosen."""

STILL = 1e-10
"""Energy of each disc, over the square of the mean radius, at which a descent ends. Larger leaves
overlaps, by which all shrink at the end. Chosen."""

HALVINGS = 60
"""Halvings of the range of the first scale. Derived: of a double."""

Wall = tuple[FloatArray, FloatArray, float, FloatArray, IntArray, IntArray]
"""Edges of a container and the grid that lists them, as kernels take them."""

Found = tuple[float, FloatArray, IntArray]
"""Scale, ``(n, 2)`` places, and which disc is in which."""

Tell = Callable[[float, FloatArray, float], None]
"""Told of the share of the work done, ``(n, 2)`` centres and the scale."""


@dataclass(frozen=True, eq=False)
class DiscPacking:
    """Centres ``(n, 2)`` of discs that keep clear of each other, and their common scale."""

    centres: FloatArray
    scale: float


def wall_of(container: Outline, count: int) -> Wall:
    """Edges of a container with a grid that lists those near each of its cells.

    ``count``: number of discs, of which more ask more often.
    """
    points, starts = container.points, container.starts
    numbers = np.arange(len(points))
    before, after = numbers - 1, numbers + 1
    before[starts[:-1]], after[starts[1:] - 1] = starts[1:] - 1, starts[:-1]
    edges = np.column_stack([points, points[after], before, after])
    left, top, right, bottom = container.bounds
    cell = max(right - left, bottom - top) / np.clip(
        CELLS * math.sqrt(count), LEAST_CELLS, MOST_CELLS
    )
    shape = int((bottom - top) / cell) + 1, int((right - left) / cell) + 1
    corner, least = np.array([left, top]), np.empty(shape)
    first, listed = np.empty((shape[0], shape[1] + 1), np.int64), np.empty(0, np.int64)
    count = list_edges(edges, corner, cell, least, first, listed)
    listed = np.empty(count, np.int64)
    list_edges(edges, corner, cell, least, first, listed)
    return edges, corner, cell, least, first, listed


class DiscSearch:
    """Search for the largest common scale at which all discs fit into a container.

    Parameters
    ----------
    container
        Canvas units.
    radii
        ``(n,)`` radii at a scale of 1, positive.
    gap
        Least distance of two discs, and of a disc and the edge, canvas units.
    work
        Steps of the descent times discs after which nothing more is tried.
    tell, stop
        Told now and then how far it is; asked whether to end with what there is.
    """

    def __init__(
        self,
        container: Outline,
        radii: FloatArray,
        gap: float,
        seed: int,
        work: float,
        tell: Tell = lambda share, centres, scale: None,
        stop: Callable[[], bool] = bool,
    ) -> None:
        self._radii, self._margin = np.ascontiguousarray(radii, dtype=np.float64), gap / 2
        self._wall, self._done = wall_of(container, len(radii)), 0
        self._calm = (CALM_ROUNDS * STEPS + QUENCHES * QUENCHED_STEPS) * len(radii)
        self._work = work
        self._tell, self._stop = tell, stop
        self._random = np.random.default_rng(seed)
        self._container = container
        self._are_alike = bool(np.ptp(radii) <= ALIKE * np.mean(radii))
        self._begin()

    def run(self) -> DiscPacking:
        """Centres of all discs, and the largest scale that was found."""
        is_calm = self._work > self._calm
        rounds, every = (CALM_ROUNDS, CALM_EVERY) if is_calm else (ROUNDS, EVERY)
        self._descend(rounds, every)
        best = self._quenched()
        for trial in range(MOST_SHAKEN):
            if self._done >= self._work or self._stop():
                break
            if self._are_alike and trial % 2 == 0:
                self._begin()
            else:
                self._shake(best)
            self._descend(SHAKEN_ROUNDS, CALM_EVERY)
            if self._jammed > PROMISING * best[0]:
                best = max(best, self._quenched(), key=lambda found: found[0])
        scale, discs, owners = best
        centres = np.empty_like(discs)
        centres[owners] = discs
        return DiscPacking(centres, scale)

    def _begin(self) -> None:
        """Put discs anywhere, far larger than there is room for."""
        lattice = self._lattice() if self._are_alike else None
        self._discs = self._scattered() if lattice is None else lattice
        self._owners = self._random.permutation(len(self._radii))
        self._scale = self._jammed = self._first_scale(self._container.area)

    def _shake(self, found: Found) -> None:
        """Put discs near where they lay in a packing."""
        self._scale = self._jammed = found[0]
        mean = found[0] * float(self._radii.mean())
        self._discs = found[1] + self._random.normal(0.0, SHAKEN * mean, found[1].shape)
        self._owners = found[2].copy()

    def _lattice(self) -> FloatArray | None:
        """Places ``(n, 2)`` of a triangular lattice, turned and shifted; None if it has fewer."""
        count, (left, top, right, bottom) = len(self._radii), self._container.bounds
        middle, turn = np.array([left + right, top + bottom]) / 2, self._random.uniform(0, math.pi)
        shift = self._random.uniform(-1, 1, 2)
        cosine, sine = math.cos(turn), math.sin(turn)
        usual = math.sqrt(2 * self._container.area / (math.sqrt(3) * count))

        def places(spacing: float) -> tuple[FloatArray, FloatArray]:
            most = math.ceil(math.hypot(right - left, bottom - top) / spacing) + 2
            row, column = np.mgrid[-most : most + 1, -most : most + 1].reshape(2, -1)
            points = np.column_stack([column + row / 2 - row // 2, row * math.sqrt(3) / 2])
            turned = (points + shift) @ np.array([[cosine, sine], [-sine, cosine]])
            points = middle + spacing * turned
            far = edge_distances(self._wall, points) / spacing
            return points[far > OFF_EDGE], far[far > OFF_EDGE]

        low, high = usual / 2, usual
        for _ in range(LATTICES):
            spacing = (low + high) / 2
            low, high = (spacing, high) if len(places(spacing)[0]) >= count else (low, spacing)
        points, far = places(low)
        if len(points) < count:
            return None
        return np.ascontiguousarray(points[np.sort(np.argsort(-far, kind="stable")[:count])])

    def _scattered(self) -> FloatArray:
        """Random places ``(n, 2)``, those near each other near in memory."""
        container = self._container
        count, (left, top, right, bottom) = len(self._radii), container.bounds
        room = prepared(container.region)
        found = np.empty((0, 2))
        while len(found) < count:
            drawn = self._random.uniform((left, top), (right, bottom), (count, 2))
            inside = shapely.contains_xy(room, drawn[:, 0], drawn[:, 1])
            found = np.concatenate([found, drawn[inside]])
        found = found[:count]
        rows = np.floor((found[:, 1] - top) / (2 * math.sqrt(container.area / count)))
        return np.ascontiguousarray(found[np.lexsort((found[:, 0], rows))])

    def _first_scale(self, area: float) -> float:
        """Scale at which soft discs, half the gap about each, have their share of the container."""
        low, high = 0.0, math.sqrt(area / (math.pi * float(np.square(self._radii).sum())))
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            taken = math.pi * float(np.square(middle * self._radii + self._margin).sum())
            low, high = (low, middle) if taken > CROWDED * area else (middle, high)
        return low

    def _descend(self, rounds: int, every: int) -> None:
        """Come down to where discs jam, exchanging radii on the way."""
        for excess in np.geomspace(LOOSEST, TIGHTEST, rounds):
            if self._stop():
                # What has had no time to come apart has to be far smaller.
                self._jammed *= HURRIED
                return
            self._scale = self._jammed * (1 + float(excess))
            self._relax(STEPS, every)
            if not self._are_alike:
                self._free_trapped()

    def _relax(self, steps: int, every: int) -> None:
        """Some steps of the descent, and the scale at which discs jam by what is left."""
        own = self._radii[self._owners]
        radii = self._scale * own + self._margin
        still = STILL * len(own) * float(radii.mean()) ** 2
        _, done = kernels.relax(
            self._discs, radii, self._owners, self._margin, self._wall, steps, every, still
        )
        self._done += done * len(own)
        own = self._radii[self._owners]
        radii = self._scale * own + self._margin
        energy, slope = kernels.excess(self._discs, radii, own, self._margin, self._wall)
        # Overlaps go with the excess of the scale, the energy with its square.
        beyond = 2 * energy / slope if slope > 0 else 0.0
        self._jammed = max(self._scale - beyond, self._scale / 2)
        centres = np.empty_like(self._discs)
        centres[self._owners] = self._discs
        self._tell(min(self._done / max(self._work, self._calm), 1.0), centres, self._jammed)

    def _quenched(self) -> Found:
        """Largest scale without a conflict near the one at which discs jam, and where they lie."""
        best = (self._clear_scale(), self._discs.copy(), self._owners.copy())
        for trial in range(QUENCHES):
            if trial and self._stop():
                break
            self._scale = self._jammed * (1 + QUENCHED * NEARER**trial)
            self._relax(QUENCHED_STEPS, 0)
            scale = self._clear_scale()
            if scale > best[0]:
                best = (scale, self._discs.copy(), self._owners.copy())
        return best

    def _clear_scale(self) -> float:
        return float(self._clear_scales().min())

    def _clear_scales(self) -> FloatArray:
        """``(n,)`` scales up to which each place keeps clear of all others and of the edge."""
        own, margin = self._radii[self._owners], self._margin
        scales: FloatArray = kernels.clear_scales(
            self._discs, own, margin, margin, self._wall, self._scale
        )
        return scales

    def _free_trapped(self) -> None:
        """Put discs into voids that are held back on an island or a spit where too many began.

        None can leave it, and all others would have to be as small as they are. Those that are
        alike begin where there is room.
        """
        scales = self._clear_scales()
        trapped = np.flatnonzero(scales < TRAPPED * self._jammed)
        if not len(trapped):
            return
        # Takes longer to load than all else; most runs have none that is trapped.
        from scipy.spatial import cKDTree

        usual = self._scale * float(self._radii.mean())
        left = np.empty((0, 2))
        # Once one of a crowd has left it, the next round tells whether the others have room.
        for disc in trapped[np.argsort(scales[trapped], kind="stable")]:
            if not np.any(np.hypot(*(left - self._discs[disc]).T) < CROWD * usual):
                left = np.append(left, self._discs[disc, None], axis=0)
                scales[disc] = 0.0
        places = self._scattered()
        radii = self._scale * self._radii[self._owners]
        near, which = cKDTree(self._discs).query(places, range(1, min(NEAR, len(radii)) + 1))
        room = np.minimum((near - radii[which]).min(axis=1), edge_distances(self._wall, places))
        widest = np.argsort(-room, kind="stable")[: len(left)]
        self._discs[np.flatnonzero(scales == 0.0)[: len(widest)]] = places[widest]
