"""The outline: a closed region as flattened, oriented rings."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt
import shapely
from shapely.geometry import LinearRing, MultiPolygon, Polygon
from shapely.geometry.base import BaseGeometry

from packwork.arrays import FloatArray, IntArray, as_points, as_starts
from packwork.errors import ShapeError
from packwork.geometry import affine
from packwork.geometry.overlay import valid
from packwork.geometry.polygon import Region, enclosed, oriented_rings, region, silhouette
from packwork.phrasing import number_of


@dataclass(frozen=True, eq=False)
class Outline:
    """Closed region: rings that neither cross themselves nor each other.

    Outer rings run clockwise on screen (positive area), holes the other way. Curves
    have been flattened before, to a tolerance stated where the outline is made.

    Parameters
    ----------
    points
        ``(n, 2)`` vertices of all rings, one after another, rings unclosed; read-only.
    starts
        Index of each ring's first vertex, and ``n`` at the end.

    Examples
    --------
    >>> square = Outline.from_rings([np.array([[0, 0], [2, 0], [2, 2], [0, 2.0]])])
    >>> square.area, square.centroid.tolist(), len(square.rings)
    (4.0, [1.0, 1.0], 1)
    """

    points: FloatArray
    starts: IntArray

    def __post_init__(self) -> None:
        points = as_points(self.points)
        object.__setattr__(self, "points", _still(points))
        object.__setattr__(self, "starts", as_starts(self.starts, len(points)))
        if len(points) < 3:
            raise ShapeError("an outline needs at least three points")

    def __setstate__(self, state: Mapping[str, Any]) -> None:
        # Arrays come out of a pickle as if they could be changed; rings are views of the points.
        kept = {name: value for name, value in state.items() if name != "rings"}
        self.__dict__.update(kept | {"points": _still(kept["points"])})

    def __repr__(self) -> str:
        rings = number_of(len(self.starts) - 1, "ring")
        return f"<Outline: {rings}, {number_of(len(self.points), 'point')}>"

    @classmethod
    def from_rings(cls, rings: Sequence[FloatArray]) -> Outline:
        """Outline of rings ``(k, 2)``, in any unit, that are already simple and oriented."""
        starts = np.concatenate([[0], np.cumsum([len(r) for r in rings])]).astype(np.int64)
        return cls(np.concatenate(rings), starts)

    @classmethod
    def box(cls, left: float, top: float, right: float, bottom: float) -> Outline:
        """Outline of an upright rectangle.

        Examples
        --------
        >>> Outline.box(1, 2, 4, 4).area
        6.0
        """
        corners = [[left, top], [right, top], [right, bottom], [left, bottom]]
        return cls.from_rings([np.array(corners, dtype=np.float64)])

    @classmethod
    def from_region(cls, shape: Region) -> Outline:
        """Outline of a valid Shapely polygon or multipolygon.

        Raises
        ------
        ShapeError
            If the region has no area.
        """
        rings = oriented_rings(shape)
        if not rings:
            raise ShapeError("the region has no area")
        return cls.from_rings(rings)

    @classmethod
    def of(cls, shape: OutlineLike) -> Outline:
        """Outline of a Shapely polygon, of one ring ``(n, 2)`` or of several; itself if it is one.

        Rings may run either way round and cross themselves; those inside others are holes.

        Raises
        ------
        ShapeError
            If it is none of these, or has no area.

        Examples
        --------
        >>> Outline.of([(0, 0), (0, 2), (2, 2), (2, 0)]).area
        4.0
        """
        if isinstance(shape, Outline):
            return shape
        if isinstance(shape, BaseGeometry):
            return cls.from_region(valid(shapely.force_2d(shape)))
        try:
            rings = [as_points(shape)]
        except (TypeError, ValueError) as error:
            if isinstance(error, ShapeError) and np.shape(shape)[1:] == (2,):
                raise
            rings = _several_rings(shape)
        return cls.from_region(region(rings, "evenodd"))

    @cached_property
    def rings(self) -> list[FloatArray]:
        """One ``(k, 2)`` array per ring, views of ``points``."""
        return np.split(self.points, self.starts[1:-1])

    @cached_property
    def area(self) -> float:
        """Area in squared units of the points, holes taken off."""
        return float(self.ring_areas.sum())

    @cached_property
    def ring_areas(self) -> FloatArray:
        """Signed area of each ring: shoelace sums about its first vertex."""
        return _signed_areas(self.points, self.starts)

    @cached_property
    def centroid(self) -> FloatArray:
        """Centre of mass ``(x, y)``."""
        return np.array(shapely.get_coordinates(self.region.centroid)[0])

    @cached_property
    def bounds(self) -> tuple[float, float, float, float]:
        """Smallest upright box ``(left, top, right, bottom)``."""
        x, y = self.points.T.copy()  # in one piece each, which is faster
        return float(x.min()), float(y.min()), float(x.max()), float(y.max())

    @cached_property
    def extent(self) -> float:
        """Longer side of the bounds."""
        left, top, right, bottom = self.bounds
        return max(right - left, bottom - top)

    @cached_property
    def radius(self) -> float:
        """Largest distance of a vertex from the origin of the outline's own units."""
        return float(np.hypot(self.points[:, 0], self.points[:, 1]).max())

    @cached_property
    def has_holes(self) -> bool:
        """Whether any ring is a hole."""
        return bool((self.ring_areas < 0).any())

    @property
    def solid_rings(self) -> list[FloatArray]:
        """Those of the rings that are no holes."""
        return [ring for ring, area in zip(self.rings, self.ring_areas, strict=True) if area > 0]

    @property
    def parts(self) -> list[list[FloatArray]]:
        """Each ring that is no hole with the holes that follow it, as readers make them.

        Examples
        --------
        >>> tile, hole = Outline.box(0, 0, 4, 4).rings[0], Outline.box(1, 1, 2, 2).rings[0][::-1]
        >>> [len(part) for part in Outline.from_rings([tile, hole, tile + 9]).parts]
        [2, 1]
        """
        begins = np.flatnonzero(self.ring_areas > 0)
        ends = [*begins[1:].tolist(), len(self.rings)]
        return [self.rings[k:end] for k, end in zip(begins.tolist(), ends, strict=True)]

    @cached_property
    def region(self) -> Region:
        """The same region as a Shapely polygon or multipolygon."""
        if len(self.rings) == 1:
            return Polygon(self.rings[0])
        if not self.has_holes:
            return MultiPolygon([Polygon(r) for r in self.rings])
        shape = self._in_order()
        if shape is not None:
            return shape
        # Even-odd nesting of rings that do not cross: holes, and islands inside holes.
        return enclosed([LinearRing(r) for r in self.rings])

    def _in_order(self) -> Region | None:
        """Region whose holes follow the rings that they lie in, as readers make them.

        None if they do not: ten times faster than to find where they lie.
        """
        outer = np.flatnonzero(self.ring_areas > 0)
        if len(outer) == 0 or outer[0] != 0:
            return None
        groups = np.split(np.arange(len(self.rings)), outer[1:])
        rings = self.rings
        shape = MultiPolygon([Polygon(rings[k[0]], [rings[h] for h in k[1:]]) for k in groups])
        return shape if shape.is_valid else None

    def mapped(self, matrix: FloatArray) -> Outline:
        """Image under an affine map (2 x 3) to any unit; it must not mirror."""
        return Outline(affine.apply(matrix, self.points), self.starts)

    def without_holes(self) -> Outline:
        """Silhouette: every hole filled, parts that lay in holes absorbed."""
        return Outline.from_region(silhouette(self.region)) if self.has_holes else self


def _still(points: FloatArray) -> FloatArray:
    """The same points ``(n, 2)``, in any unit, that nobody changes through this array."""
    seen = points.view()
    seen.flags.writeable = False
    return seen


def centre_of_area(outline: Outline) -> FloatArray:
    """Centre of mass ``(x, y)`` by sums over the edges, without making a region.

    Examples
    --------
    >>> tile = Outline.from_rings([np.array([[1.0, 1], [5, 1], [5, 3], [1, 3]])])
    >>> centre_of_area(tile).tolist()
    [3.0, 2.0]
    """
    first = outline.points[0]
    here = outline.points - first
    after = np.arange(1, len(here) + 1)
    after[outline.starts[1:] - 1] = outline.starts[:-1]
    there = here[after]
    doubled = here[:, 0] * there[:, 1] - there[:, 0] * here[:, 1]
    return np.asarray(first + (here + there).T @ doubled / (3 * doubled.sum()))


OutlineLike: TypeAlias = Outline | BaseGeometry | npt.ArrayLike
"""What is taken for an outline: a Shapely polygon, a ring of points, several rings."""


def _several_rings(shape: object) -> list[FloatArray]:
    try:
        return [as_points(ring) for ring in shape]  # type: ignore[attr-defined]
    except (TypeError, ValueError) as error:
        reason = str(error) if isinstance(error, ShapeError) else type(shape).__name__
        raise ShapeError(
            f"an outline is a Shapely polygon, a ring of points (n, 2) or several; met: {reason}"
        ) from None


def joined(outlines: Sequence[Outline]) -> tuple[FloatArray, IntArray]:
    """Points of all outlines in one array, and the starts of all their rings.

    Returns
    -------
    tuple of FloatArray and IntArray
        ``(n, 2)`` and ``(rings + 1,)``, as in an outline; none and ``[0]`` for no outlines.

    Examples
    --------
    >>> tile = Outline.from_rings([np.array([[0, 0], [1, 0], [1, 1.0]])])
    >>> points, starts = joined([tile, tile])
    >>> len(points), starts.tolist()
    (6, [0, 3, 6])
    """
    points = np.concatenate([np.zeros((0, 2)), *(o.points for o in outlines)])
    before = np.cumsum([0, *(len(o.points) for o in outlines)])[:-1]
    rings = [len(o.starts) - 1 for o in outlines]
    ends = np.concatenate([[0], *(o.starts[1:] for o in outlines)]).astype(np.int64)
    ends[1:] += np.repeat(before, rings)
    return points, ends


PORTION = 500
"""Outlines whose regions are made at once. Larger takes memory, smaller time."""


def regions(outlines: Sequence[Outline]) -> np.ndarray[Any, Any]:
    """Array ``(n,)`` of each outline's region, made together, which is faster than one by one.

    Not kept in the outlines; those that are there already are taken.

    Examples
    --------
    >>> tile, hole = Outline.box(0, 0, 4, 4).rings[0], Outline.box(1, 1, 2, 2).rings[0][::-1]
    >>> whole = Outline.from_rings([tile, hole, tile + 9])
    >>> [region.area for region in regions([whole, Outline.from_rings([tile])])]
    [31.0, 16.0]
    """
    found = np.empty(len(outlines), dtype=object)
    for begin in range(0, len(outlines), PORTION):
        some = outlines[begin : begin + PORTION]
        known = [one.__dict__.get("region") for one in some]
        fresh = [k for k, one in enumerate(known) if one is None]
        for k, shape in zip(fresh, _assembled([some[k] for k in fresh]), strict=True):
            known[k] = some[k].region if shape is None else shape
        found[begin : begin + PORTION] = known
    return found


def _assembled(outlines: Sequence[Outline]) -> list[Region | None]:
    """Region of each outline, its holes in the ring before them; None if they do not lie there."""
    if not outlines:
        return []
    points, starts = joined(outlines)
    lengths = np.diff(starts)
    owner = np.repeat(np.arange(len(outlines)), [len(one.starts) - 1 for one in outlines])
    is_outer = _signed_areas(points, starts) > 0
    begins = np.flatnonzero(np.diff(owner, prepend=-1))
    # Rings before the first that is no hole belong to it, wrongly: they are found invalid.
    is_shell = is_outer.copy()
    is_shell[begins] = True
    rings = shapely.linearrings(points, indices=np.repeat(np.arange(len(lengths)), lengths))
    polygons = shapely.polygons(rings, indices=np.cumsum(is_shell) - 1)
    owners = owner[is_shell]
    found = shapely.multipolygons(polygons, indices=owners)
    is_alone = np.bincount(owner, minlength=len(outlines)) == 1
    found[is_alone] = polygons[is_alone[owners]]
    has_holes = np.bincount(owner, ~is_outer, minlength=len(outlines)) > 0
    is_wrong = has_holes & ~(is_outer[begins] & shapely.is_valid(found))
    found[is_wrong] = None
    return list(found)


def _signed_areas(points: FloatArray, starts: IntArray) -> FloatArray:
    """``(rings,)`` shoelace sums of unclosed rings, each about its first vertex."""
    x, y = (points - np.repeat(points[starts[:-1]], np.diff(starts), axis=0)).T
    after = np.arange(1, len(x) + 1)
    after[starts[1:] - 1] = starts[:-1]
    return np.asarray(0.5 * np.add.reduceat(x * y[after] - x[after] * y, starts[:-1]))
