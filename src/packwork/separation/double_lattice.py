"""Densest double lattice: a part and its twin, turned by 180 degrees, repeated by two vectors.

G. Kuperberg and W. Kuperberg, "Double-lattice packings of convex bodies in the plane", Discrete &
Computational Geometry 5 (1990), 389-397; D. Mount, "The densest double-lattice packing of a convex
polygon", DIMACS Series 6 (1991), 245-262. Theirs are of convex parts. Ours are of any, and may miss
the densest: rows of the part and of its twin are dropped on one another, at all angles, and the
best of them changed by chance. What touches is read from edges of no-fit polygons, of which the
reduced convolution (E. Behar and J.-M. Lien, "Fast and robust 2D Minkowski sum using reduced
convolution", IROS 2011) has all that bound them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import numpy.typing as npt
import shapely

from packwork.geometry.overlay import buffered
from packwork.geometry.polygon import Region
from packwork.separation.kernels.lattices import search_lattices
from packwork.separation.shapes import FREE_TURNS, Floats, Part, placed, rings_of

ANGLES, BEGINNINGS, STEPS = 90, 24, 500
"""Angles of rows that are tried, lattices that are made denser from there, and steps of each. More
take longer: these some tenths of a second for twenty corners. Tried."""

FIRST_STEP = 0.05
"""Deviation of the first changes of a lattice: of its angle, share, and columns. Tried."""

HAIR = 1e-6
"""Distance that parts keep, in sides of the square of a part's area: those that touch count as
overlapping. Larger wastes room, smaller rounding may take."""

PARALLEL = 1e-9
"""Product of edges over that of their lengths below which they count as parallel. Derived."""

TURNS = 4 * FREE_TURNS
"""Angles of a lattice on the sheet where parts may lie at any."""

MOST_CROPS = 256
"""Lattices and angles that are cropped to a sheet: more take longer, a millisecond or more each."""

SHORT_STEPS = np.array([[1, 0], [0, 1], [1, 1], [1, -1], [2, 1], [2, -1], [1, 2], [1, -2]])
"""Vectors of a lattice that rows on a sheet may lie along, as sums of its two."""

QUARTERS = (0.0, 0.5 * math.pi)

MOST_CLEAR = 8
"""Layouts of a box that are held against what lies on it. More take longer."""

OFFSETS = 6
"""Places of the middle of a sheet in a cell of the lattice, along each vector. More take longer,
with their square. Tried."""

ROOMIER = 0.8
"""Distance from there as far as parts are cropped, over the longer side that they need: .71 is that
of a square's corner. Derived."""


@dataclass(frozen=True)
class DoubleLattice:
    """Vectors ``(2, 2)``, one a row, by which a part repeats, and where its twin lies.

    ``twin``: (x, y) of the origin of the part turned by 180 degrees; None where there is none.
    """

    vectors: Floats
    twin: Floats | None

    @property
    def area(self) -> float:
        """Area for each part, in square units."""
        return abs(float(np.linalg.det(self.vectors))) / (1 if self.twin is None else 2)

    def places(self, angle: float, reach: float) -> tuple[Floats, Floats]:
        """``(n, 2)`` origins of parts within a reach of 0, and of twins, of the lattice turned."""
        turn = _turn(angle)
        vectors = self.vectors @ turn
        # So many steps along each vector leave the circle: their columns' lengths in its inverse.
        far = np.ceil(reach * np.linalg.norm(np.linalg.inv(vectors), axis=0)).astype(int) + 1
        steps = np.stack(np.meshgrid(*(np.arange(-n, n + 1) for n in far)), axis=-1).reshape(-1, 2)
        own = steps @ vectors
        twins = np.zeros((0, 2)) if self.twin is None else own + self.twin @ turn
        return (
            own[np.hypot(*own.T) <= reach],
            twins[np.hypot(*twins.T) <= reach],
        )


@lru_cache(maxsize=64)
def densest_lattices(region: Region, *, has_twin: bool) -> tuple[DoubleLattice, ...]:
    """Lattices of a region that were found, the densest first; with its twin, and without.

    >>> triangle = shapely.Polygon([(0, 0), (1, 0), (0, 1)])
    >>> [round(densest_lattices(triangle, has_twin=it)[0].area, 2) for it in (False, True)]
    [0.75, 0.5]
    """
    grown = buffered(region, HAIR * math.sqrt(region.area), join_style="mitre")
    rings = [ring[:-1] for ring in rings_of(shapely.orient_polygons(grown))]
    rings = [ring for ring in rings if _signed_area(ring) > 0.0]
    tall = float(np.hypot(*np.ptp(np.vstack(rings), axis=0)))
    same, twin = _convolution(rings, [-ring for ring in rings]), _convolution(rings, rings)
    angles = np.arange(ANGLES) * (math.pi / ANGLES)
    noise = FIRST_STEP * np.random.default_rng(0).standard_normal((STEPS, 4))
    found = list[DoubleLattice]()
    for is_double in (False, True)[: 1 + has_twin]:
        best, other = np.zeros((BEGINNINGS, 8)), twin if is_double else twin[:0]
        least = region.area * (1 + is_double)
        search_lattices(same, other, -other, tall, least, angles, noise, best)
        for angle, _, column, shift, above, period, height, area in best:
            if math.isfinite(area):
                frame = _turn(angle)
                vectors = np.array([[period, 0.0], [shift * period, height]]) @ frame
                at = np.array([column * period, above]) @ frame if is_double else None
                found.append(DoubleLattice(vectors, at))
    return tuple(sorted(found, key=lambda one: one.area))


def _turn(angle: float) -> Floats:
    """Matrix by which rows of points are turned."""
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.array([[cosine, sine], [-sine, cosine]])


def _signed_area(ring: Floats) -> float:
    x, y = ring.T
    return float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2.0


def _convolution(first: list[Floats], second: list[Floats]) -> Floats:
    """``(m, 4)`` edges among which are all that bound the sum of two regions from outside."""
    return np.vstack([
        edges for a in first for b in second for edges in (_sums(a, b), _sums(b, a))
    ])  # fmt: skip


def _sums(a: Floats, b: Floats) -> Floats:
    """Edges of one ring at those corners of another that lie farthest out there."""
    ends = np.roll(a, -1, axis=0)
    along = ends - a
    outward = np.column_stack([along[:, 1], -along[:, 0]])
    # Of parallel edges, whose product may round to either side, both corners are taken.
    least = PARALLEL * np.abs(outward).max() * np.ptp(b)
    is_far = np.logical_and.reduce(
        [outward @ (np.roll(b, way, axis=0) - b).T <= least for way in (-1, 1)]
    )
    edge, corner = np.nonzero(is_far)
    return np.hstack([a[edge] + b[corner], ends[edge] + b[corner]])


def orientations(part: Part) -> tuple[Floats, bool]:
    """Angles at which a lattice of a part may lie, ``(n,)``, and whether its twin may be there."""
    if part.turns is None:
        if math.isinf(part.reach):
            return np.linspace(0.0, math.pi, TURNS, endpoint=False, dtype=np.float64), True
        return np.linspace(-part.reach, part.reach, TURNS, dtype=np.float64), False
    turns = np.array(part.turns, np.float64)
    has_twin = [_twin_of(turn, turns) is not None for turn in turns]
    return (turns[has_twin], True) if any(has_twin) else (turns, False)


def _twin_of(angle: float, turns: Floats) -> float | None:
    """The allowed angle that is half a turn away."""
    off = np.abs(np.remainder(turns - angle, 2.0 * math.pi) - math.pi)
    return float(turns[np.argmin(off)]) if off.min() < PARALLEL else None


@dataclass(frozen=True)
class _Crops:
    """Parts of a lattice, turned, in a box about each of several middles.

    ``poses``: of all parts near; ``first``, ``last``: their boxes; ``far``: ``(middles, n, 2)``
    twice the distance of a part's far edge from a middle.
    """

    poses: Floats
    first: Floats
    last: Floats
    far: Floats

    def kept(self, chosen: npt.NDArray[np.int64], slack: float) -> Floats:
        """Poses of some, at 0 on both axes but for what rounding may take."""
        poses = self.poses[chosen]
        poses[:, :2] += slack - self.first[chosen].min(axis=0)
        return poses


def _crops(part: Part, lattice: DoubleLattice, angle: float, box: Floats, reach: float) -> _Crops:
    """Parts of a lattice about all middles of a box ``(2,)`` that are tried, as far as a reach."""
    points = shapely.get_coordinates(part.region.convex_hull) @ _turn(angle)
    low, high = points.min(axis=0), points.max(axis=0)
    own, twins = lattice.places(angle, reach)
    shares = (np.indices((OFFSETS, OFFSETS)).reshape(2, -1).T + 0.5) / OFFSETS - 0.5
    rest = shares @ lattice.vectors @ _turn(angle)
    # Rows of parts or of twins along its edges, too.
    edges = [low] if lattice.twin is None else [low, lattice.twin @ _turn(angle) - high]
    for axis in np.flatnonzero(np.isfinite(box)):
        aligned = [rest]
        for edge in edges:
            aligned.append(rest.copy())
            aligned[-1][:, axis] = edge[axis] + 0.5 * box[axis]
        rest = np.vstack(aligned)
    widest = 0.5 * box + np.abs(rest).max(axis=0)
    own, twins = (one[(np.abs(one) <= widest).all(axis=1)] for one in (own, twins))
    poses = np.ones((len(own) + len(twins), 4))
    poses[:, :2], poses[: len(own), 2] = np.vstack([own, twins]), angle
    half = None if part.turns is None else _twin_of(angle, np.array(part.turns, np.float64))
    poses[len(own) :, 2] = angle + math.pi if half is None else half
    first, last = np.vstack([own + low, twins - high]), np.vstack([own + high, twins - low])
    far = 2.0 * np.maximum(last - rest[:, None], rest[:, None] - first)
    return _Crops(poses, first, last, far)


def cropped(
    part: Part, lattice: DoubleLattice, angle: float, height: float
) -> tuple[float, Floats] | None:
    """Length and poses ``(count, 4)`` of the parts of a lattice that need the shortest strip.

    At 0 on both axes. Of a square where the height is infinite; None where so many are not met.
    """
    side = math.sqrt(part.count * lattice.area)
    if math.isfinite(height):
        side = max(part.count * lattice.area / height, height)
    # Rounding may take so much.
    slack = PARALLEL * part.region.length
    crops = _crops(part, lattice, angle, np.array([math.inf, height]),
                   ROOMIER * side + part.region.length)  # fmt: skip
    needed = crops.far.max(axis=2)
    if math.isfinite(height):
        is_low = crops.far[..., 1] <= height - 2.0 * slack
        needed = np.where(is_low, crops.far[..., 0], np.inf)
    if needed.shape[1] < part.count:
        return None
    lengths = np.partition(needed, part.count - 1, axis=1)[:, part.count - 1]
    best = int(np.argmin(lengths))
    if math.isinf(lengths[best]):
        return None
    kept = np.argsort(needed[best], kind="stable")[: part.count]
    sides = np.ptp(np.vstack([crops.first[kept], crops.last[kept]]), axis=0) + 2.0 * slack
    length = float(sides.max() if math.isinf(height) else sides[0])
    return length, crops.kept(kept, slack)


def _tried(part: Part) -> Iterator[tuple[DoubleLattice, float]]:
    """Lattices of a part, and angles of each on the sheet."""
    angles, has_twin = orientations(part)
    for lattice in densest_lattices(part.region, has_twin=has_twin)[: MOST_CROPS // len(angles)]:
        yield from ((lattice, float(angle)) for angle in angles)
        if part.turns is None and has_twin:
            # Rows along either axis.
            rows = np.array([np.arctan2(*step[::-1]) for step in SHORT_STEPS @ lattice.vectors])
            yield from ((lattice, quarter - row) for quarter in QUARTERS for row in rows.tolist())


def laid_on_lattice(part: Part, height: float) -> tuple[float, Floats] | None:
    """Shortest of the strips to which dense lattices of a part are cropped, as `cropped`."""
    found = (cropped(part, lattice, angle, height) for lattice, angle in _tried(part))
    return min((one for one in found if one), key=lambda one: one[0], default=None)


@lru_cache(maxsize=16)
def laid_on_sheet(part: Part, wide: float, tall: float, taken: tuple[Region, ...]) -> Floats:
    """Poses of the most parts of a lattice in a box at 0 that are clear of what lies there.

    ``(n, 4)``, no more than there are of the part: the first of them along x.
    """
    box, slack = np.array([wide, tall]), PARALLEL * part.region.length
    found = list[Floats]()
    for lattice, angle in _tried(part):
        crops = _crops(part, lattice, angle, box, 0.5 * math.hypot(wide, tall) + part.region.length)
        is_inside = (crops.far <= box - 2.0 * slack).all(axis=2)
        if is_inside.any():
            found.append(crops.kept(np.flatnonzero(is_inside[np.argmax(is_inside.sum(1))]), slack))
    found = sorted(found, key=len, reverse=True)[:MOST_CLEAR]
    if taken:
        held = shapely.STRtree(taken)
        regions = [np.array([placed(part.region, pose) for pose in poses]) for poses in found]
        found = [
            np.delete(poses, held.query(own, predicate="intersects")[0], axis=0)
            for poses, own in zip(found, regions, strict=True)
        ]
    best = max(found, key=len, default=np.zeros((0, 4)))
    if len(best) >= part.count:
        strip = None if taken else laid_on_lattice(part, tall)
        best = best[np.argsort(best[:, 0], kind="stable")][: part.count]
        if strip is not None and strip[0] <= wide:
            best = strip[1]
    return best
