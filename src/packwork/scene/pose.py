"""Where items are: translations, turns, scales and stretches."""

from __future__ import annotations

from dataclasses import dataclass, field, fields

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.errors import ShapeError
from packwork.geometry import affine


def _none_given() -> FloatArray:
    return np.ones(0)


@dataclass(frozen=True, eq=False)
class Poses:
    """Poses of n items, one array per parameter.

    Parameters
    ----------
    x, y
        ``(n,)`` canvas units: where the item's origin (its centroid) lies.
    angle
        ``(n,)`` radians, clockwise on screen.
    scale
        ``(n,)`` canvas units per item unit, positive.
    stretch
        ``(n,)`` width over height of what was square in the item's own frame, before it
        was turned: the paper's elementwise scale is ``scale * sqrt(stretch)`` along the
        item's own x and ``scale / sqrt(stretch)`` along its y, so areas do not depend on
        it. All ones if none are given.

    Raises
    ------
    ShapeError
        If there are not as many stretches as items.
    """

    x: FloatArray
    y: FloatArray
    angle: FloatArray
    scale: FloatArray
    stretch: FloatArray = field(default_factory=_none_given)

    def __post_init__(self) -> None:
        if len(self.stretch) == len(self.x):
            return
        if len(self.stretch):
            raise ShapeError(
                f"poses need as many stretches as items ({len(self.x)}), not {len(self.stretch)}"
            )
        object.__setattr__(self, "stretch", np.ones(len(self.x)))

    def __len__(self) -> int:
        return len(self.x)

    @property
    def axis_scales(self) -> FloatArray:
        """``(n, 2)`` canvas units per item unit along each item's own x and y.

        Wang and Lu 2025 call them s: P' = r (P * s) + t.

        Examples
        --------
        >>> one = np.ones(1)
        >>> Poses(one, one, one, 3 * one, 4 * one).axis_scales.tolist()
        [[6.0, 1.5]]
        """
        root = np.sqrt(self.stretch)
        return np.column_stack([self.scale * root, self.scale / root])

    def matrix(self, k: int) -> FloatArray:
        """2 x 3 map from the units of item ``k`` to canvas units.

        Examples
        --------
        >>> one = np.ones(1)
        >>> Poses(2 * one, 3 * one, 0 * one, one).matrix(0)[:, 2].tolist()
        [2.0, 3.0]
        """
        place = affine.similarity(
            float(self.x[k]), float(self.y[k]), float(self.angle[k]), float(self.scale[k])
        )
        return affine.compose(place, affine.stretched(float(self.stretch[k])))

    def some(self, items: IntArray) -> Poses:
        """Poses of some items, ``(m,)`` indices.

        Examples
        --------
        >>> x = np.array([5.0, 6.0, 7.0])
        >>> Poses(x, x, x, x).some(np.array([2, 0])).x.tolist()
        [7.0, 5.0]
        """
        return Poses(*(getattr(self, column.name)[items] for column in fields(Poses)))

    def with_some(self, items: IntArray, poses: Poses) -> Poses:
        """All poses, those of some items, ``(m,)`` indices, replaced.

        Examples
        --------
        >>> x, one = np.array([5.0, 6.0, 7.0]), np.ones(1)
        >>> Poses(x, x, x, x).with_some(np.array([1]), Poses(one, one, one, one)).x.tolist()
        [5.0, 1.0, 7.0]
        """
        columns = {column.name: getattr(self, column.name).copy() for column in fields(Poses)}
        for name, values in columns.items():
            values[items] = getattr(poses, name)
        return Poses(**columns)

    def followed_by(self, poses: Poses) -> Poses:
        """These poses, then others.

        Examples
        --------
        >>> one = Poses(*(np.ones(1),) * 4)
        >>> len(one.followed_by(one))
        2
        """
        both = ((getattr(self, c.name), getattr(poses, c.name)) for c in fields(Poses))
        return Poses(*(np.append(mine, theirs) for mine, theirs in both))
