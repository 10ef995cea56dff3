"""Limbs of a container: where it is long and thin, its middle lines and their half-widths.

The medial axis (H. Blum, "A transformation for extracting new descriptors of shape", in: Models for
the Perception of Speech and Visual Form, MIT Press 1967, 362-380) of an image is taken apart into
loops, of rings that are thin all the way round, and then into longest shortest paths, so that a
limb goes on through a joint and spurs of corners come last. What of a path is long for its
width is a limb. Widths are of the exact outline.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from shapely.geometry import Polygon

from packwork.arrays import BoolArray, FloatArray
from packwork.fields.distance_transform import distance_inside, longest_paths, loops_of
from packwork.fields.morphology import medial_axis
from packwork.geometry.curves import Curve
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import buffered, polygon_parts
from packwork.geometry.polygon import oriented_rings
from packwork.scene.container import Container
from packwork.start.first_poses import container_image

RESOLUTION = 1_000
"""Pixels on the longer side of the image that is thinned. More takes longer. Chosen."""

SLENDER = 2.0
"""Widths that a stretch is long at least, to be a limb. Smaller takes bellies for limbs, larger
leaves legs out. By eye."""

EVEN = 1.5
"""How much wider than in one place a limb may be in its stretch. As above."""

RING = 0.75
"""Share of a medial axis that a loop is, at least, to be walked as one. Larger cuts a Q open,
smaller takes the eye of a key for all of it. By eye."""

ROUNDEST = 1.1
"""Turn of a loop within a stretch as long as it is wide, radians, at most: round corners words do
not go, and leave them bare. Larger takes frames for rings, smaller cuts an O. By eye."""

SMOOTH = 0.5
"""Standard deviation of the smoothing of middle lines, in half-widths. Larger cuts corners, smaller
lets letters dance. By eye."""

STEP = 0.25
"""Distance of points of a middle line, in pixels of the image. Derived from what follows it."""


TIP = 0.5
"""How far limbs go beyond the last disc's centre, in its radii, and keep from other limbs. Larger
lets letters stick out of round ends, which makes them smaller. Chosen."""

AROUND = 0.05
"""Distance of points of a band along the edge, in its widths. Chosen."""

NEXT = 8
"""Of so many points of a middle line, one is looked at where limbs meet. Chosen."""


@dataclass(frozen=True, eq=False)
class Limb:
    """A long and thin part of a container.

    Parameters
    ----------
    axis
        Its middle line, from the wider end.
    half
        ``(n,)`` distance of the container's edge from the points of it.
    is_loop
        Whether words go both ways round it, the heaviest at its middle.
    is_half
        Whether it is one of these ways.
    """

    axis: Curve
    half: FloatArray
    is_loop: bool = False
    is_half: bool = False

    @property
    def is_long(self) -> bool:
        """Whether it is long enough for words."""
        return self.axis.length >= SLENDER * float(np.median(self.half))

    @property
    def ways(self) -> tuple[Limb, ...]:
        """Both ways round a loop from its middle to where it closes; of others itself."""
        if not self.is_loop:
            return (self,)
        middle = int(np.searchsorted(self.axis.lengths, self.axis.length / 2))
        back = Limb(Curve(self.axis.points[middle::-1]), self.half[middle::-1], is_half=True)
        return Limb(Curve(self.axis.points[middle:]), self.half[middle:], is_half=True), back

    @property
    def area(self) -> float:
        """Area of the limb, about."""
        return float(np.trapezoid(2 * self.half, self.axis.lengths))


def limbs_of(container: Container) -> list[Limb]:
    """Limbs, the widest first.

    Examples
    --------
    >>> bar = Container("bar", "bar", Outline.box(0.0, 0.0, 90.0, 10.0), 90.0, 10.0)
    >>> [limb] = limbs_of(bar)
    >>> bool(limb.axis.length > 70), bool(abs(limb.half[len(limb.half) // 2] - 5) < 0.1)
    (True, True)
    """
    image, px_per_cu = container_image(container, RESOLUTION)
    mask = image > 0.5
    room, thinned = distance_inside(mask), medial_axis(mask)
    found = list[Limb]()
    for loop in loops_of(thinned, RING):
        columns, rows = loop.T
        width = 2 * float(np.median(room[rows, columns]))
        limb = _closed(Polygon(loop + 0.5), width, px_per_cu, container.outline)
        if limb is not None:
            found.append(limb)
            thinned[rows, columns] = False
    for path in _paths(thinned, room):
        columns, rows = path.astype(np.int64).T
        axis = _smooth(path + 0.5, float(np.median(room[rows, columns])))
        stretches = _stretches(Curve.through(axis / px_per_cu), container.outline)
        found += [limb for one in stretches if (limb := _outside(one, found)) is not None]
    return sorted(found, key=lambda limb: -float(np.median(limb.half)))


def edges_of(container: Container, width: float) -> list[Limb]:
    """Bands of a width along the container's edge and round its holes, as limbs, the longest first.

    Their middle lines run clockwise on screen, from below the middle round to there. Corners are
    round, and bands narrower at them.

    >>> tile = Container("tile", "tile", Outline.box(0.0, 0.0, 90.0, 90.0), 90.0, 90.0)
    >>> [band] = edges_of(tile, 10.0)
    >>> band.axis.points[0].round(1).tolist(), 280 < band.axis.length < 320
    ([45.1, 85.0], True)
    """
    region = container.outline.region
    inner = buffered(buffered(region, -1.25 * width), 0.75 * width)
    lines = (line for part in polygon_parts(inner) for line in (part.exterior, *part.interiors))
    rings = sorted(map(Polygon, lines), key=lambda ring: -ring.area)
    edge = region.boundary
    found = []
    for ring in rings:
        axis = _round(ring, width)
        half = np.minimum(shapely.distance(shapely.points(axis.points), edge), width / 2)
        found.append(Limb(axis, half))
    return found


def _round(ring: Polygon, width: float) -> Curve:
    """Smooth closed curve about a ring, from its lowest place below the middle."""
    [points] = oriented_rings(ring)
    whole = Curve(np.concatenate([points, points[:1]]))
    count = int(whole.length / (width * AROUND)) + 3
    even = whole.at(np.linspace(0.0, whole.length, count, endpoint=False))
    weights = _gaussian(SMOOTH / 2 / AROUND, (count - 1) // 2)
    reach = len(weights) // 2
    even = _convolved(np.concatenate([even[-reach:], even, even[:reach]]), weights)
    x, y = even.mean(axis=0)
    first = int(np.argmin(np.where(even[:, 1] > y, np.abs(even[:, 0] - x), np.inf)))
    closed = np.roll(even, -first, axis=0)
    return Curve(np.concatenate([closed, closed[:1]]))


def _outside(limb: Limb, others: Sequence[Limb]) -> Limb | None:
    """The part of a limb that lies in no other; None where it is short."""
    from scipy.spatial import KDTree

    if not others:
        return limb
    centres = np.concatenate([one.axis.points[::NEXT] for one in others])
    halves = np.concatenate([one.half[::NEXT] for one in others])
    away, nearest = KDTree(centres).query(limb.axis.points)
    is_out = away > halves[nearest] + TIP * limb.half
    first, last = max(_runs(is_out), key=lambda run: run[1] - run[0], default=(0, 0))
    if last - first < 2:
        return None
    found = Limb(Curve(limb.axis.points[first:last]), limb.half[first:last])
    return found if found.is_long else None


def _runs(is_in: BoolArray) -> list[tuple[int, int]]:
    """First index of each run of True, and the one after its last."""
    ends = np.flatnonzero(np.diff(np.concatenate([[0], is_in.astype(int), [0]])))
    return [(int(first), int(last)) for first, last in ends.reshape(-1, 2)]


def _closed(loop: Polygon, width: float, px_per_cu: float, outline: Outline) -> Limb | None:
    """A limb round a loop, px; None where that is no ring, thin and round all the way."""
    axis = Curve(_round(loop, width).points / px_per_cu)
    half = shapely.distance(shapely.points(axis.points), outline.region.boundary)
    # Once more before and after, so that each place has its neighbours over the seam.
    along = np.concatenate([axis.lengths[:-1] + k * axis.length for k in range(3)])
    widths, count = np.tile(half[:-1], 3), len(half) - 1
    rings = [part for part in polygon_parts(outline.region) if len(part.interiors) == 1]
    if not any(part.contains(shapely.Point(axis.points[0])) for part in rings):
        return None
    angles = np.unwrap(axis.angle(axis.lengths, width / px_per_cu / 4))
    apart = round(1 / AROUND)
    if np.abs(angles[apart:] - angles[:-apart]).max(initial=0.0) > ROUNDEST:
        return None
    is_thin = all(_is_thin(along, widths, k) for k in range(count, 2 * count))
    return Limb(axis, half, is_loop=True) if is_thin else None


def _paths(thinned: BoolArray, room: FloatArray) -> Iterator[FloatArray]:
    """``(n, 2)`` x and y of pixels along middle lines, px, without the forks at their ends."""
    for found in longest_paths(thinned, 2 * SLENDER):
        path = found.astype(np.float64)
        half = room[found[:, 1], found[:, 0]]
        first, last = _fork(path, half), len(path) - _fork(path[::-1], half[::-1])
        if last - first > 2:
            yield path[first:last]


def _fork(path: FloatArray, half: FloatArray) -> int:
    """Number of points at the beginning that run from the middle of an end into its corner."""
    away = np.append(0.0, np.cumsum(np.hypot(*np.diff(path, axis=0).T)))
    return int(np.argmax(away >= half)) if (away >= half).any() else len(path)


def _smooth(path: FloatArray, half: float) -> FloatArray:
    """Evenly spaced points of a smooth line along pixels."""
    curve = Curve.through(path)
    count = max(int(curve.length / STEP), 8)
    points = curve.at(np.linspace(0.0, curve.length, count))
    weights = _gaussian(SMOOTH * half / (curve.length / (count - 1)), count - 1)
    reach = len(weights) // 2
    # Mirrored at a point, the ends stay where they are.
    before = 2 * points[0] - points[reach:0:-1]
    after = 2 * points[-1] - points[-2 : -reach - 2 : -1]
    return _convolved(np.concatenate([before, points, after]), weights)


def _gaussian(deviation: float, most: int) -> FloatArray:
    """``(2 k + 1,)`` weights of a Gaussian, k at most ``most``."""
    reach = min(int(3 * deviation) + 1, most)
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) / deviation) ** 2)
    return np.asarray(weights / weights.sum())


def _convolved(points: FloatArray, weights: FloatArray) -> FloatArray:
    return np.column_stack([np.convolve(column, weights, "valid") for column in points.T])


def _stretches(axis: Curve, outline: Outline) -> Iterator[Limb]:
    """Parts of a middle line that are long for their width."""
    edge = outline.region.boundary
    half = shapely.distance(shapely.points(axis.points), edge)
    is_thin = np.array([_is_thin(axis.lengths, half, k) for k in range(len(half))])
    for first, last in _runs(is_thin):
        if last - first < 4:
            continue
        points, own = axis.points[first:last], half[first:last]
        points, own = _to_the_tips(points, own, first == 0, last == len(half))
        if own[: len(own) // 2].mean() < own[len(own) // 2 :].mean():
            points, own = points[::-1], own[::-1]
        limb = Limb(Curve(points), own)
        if limb.is_long:
            yield limb


def _to_the_tips(
    points: FloatArray, half: FloatArray, begins: bool, ends: bool
) -> tuple[FloatArray, FloatArray]:
    """The same, straight on into the ends of the container that it begins or ends in."""
    if begins:
        ahead = Curve(points).at(-half[0] * np.linspace(TIP, 0.1, 8))
        points, half = np.concatenate([ahead, points]), np.append(np.full(8, half[0]), half)
    if ends:
        points, half = _to_the_tips(points[::-1], half[::-1], True, False)
        points, half = points[::-1], half[::-1]
    return points, half


def _is_thin(along: FloatArray, half: FloatArray, k: int) -> bool:
    """Whether a point is in a stretch that is long for its width and nowhere much wider."""
    enough = SLENDER * 2 * half[k]
    # A stretch that goes on for so long on one side alone is long.
    begin, end = np.searchsorted(along, [along[k] - enough, along[k] + enough])
    near = half[begin:end]
    wide = begin + np.flatnonzero((near > EVEN * half[k]) | (near < half[k] / EVEN))
    after = int(np.searchsorted(wide, k))
    first = along[wide[after - 1]] if after else along[begin] - (half[k] if begin == 0 else enough)
    last = (
        along[wide[after]]
        if after < len(wide)
        else along[end - 1] + (half[k] if end == len(half) else enough)
    )
    return bool(last - first >= enough)
