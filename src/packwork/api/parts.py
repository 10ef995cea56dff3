"""Parts of layouts: immutable mappings and arrays, and one placed item."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, is_dataclass
from typing import Any, NamedTuple, NoReturn, cast

import numpy as np

from packwork.arrays import frozen
from packwork.errors import ShapeError
from packwork.geometry.outline import Outline
from packwork.metrics.measure import Metrics
from packwork.scene.item import Item
from packwork.scene.pose import Poses

OF_PLACES = ("metrics", "certified", "changed", "filling", "beside", "pile")
"""Entries of a manifest that hold for the very poses that were measured."""


class ReadOnly(dict[str, Any]):
    """A dict that nobody changes, tables in it neither."""

    def __init__(self, values: Mapping[str, Any]) -> None:
        super().__init__(
            {k: ReadOnly(v) if isinstance(v, Mapping) else v for k, v in values.items()}
        )

    def _refuse(self, *_: Any, **__: Any) -> NoReturn:
        raise TypeError("a layout's numbers are read-only; dict(...) gives a copy to change")

    __setitem__ = __delitem__ = __ior__ = _refuse
    clear = pop = popitem = setdefault = update = _refuse

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (dict(self),)


def measures(values: Mapping[str, Any]) -> Metrics:
    """Measures of a report, read-only."""
    return cast(Metrics, ReadOnly(values))


def same_content(one: Any, other: Any) -> bool:
    """Whether two values hold the same: dataclasses by their fields, arrays by their numbers."""
    if one is other:
        return True
    if type(one) is not type(other):
        return False
    if isinstance(one, np.ndarray):
        return np.array_equal(one, other)
    if is_dataclass(one):
        names = (field.name for field in fields(one))
        return all(same_content(getattr(one, name), getattr(other, name)) for name in names)
    if isinstance(one, tuple):
        return len(one) == len(other) and all(map(same_content, one, other))
    return bool(one == other)


class Manifest(ReadOnly):
    """Record of what a run did, and of the layout that it is true of."""

    def __init__(self, values: Mapping[str, Any], parts: tuple[Any, ...]) -> None:
        super().__init__(values)
        self.parts = parts

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (dict(self), self.parts)


def manifest_of(values: Mapping[str, Any], parts: tuple[Any, ...]) -> Manifest:
    """The manifest of a layout; without what was measured of one whose parts are others."""
    if not isinstance(values, Manifest):
        return Manifest(values, parts)
    if all(mine is one for mine, one in zip(values.parts, parts, strict=True)):
        return values
    return Manifest({k: v for k, v in values.items() if k not in OF_PLACES}, parts)


def checked_poses(poses: Poses) -> Poses:
    """The poses themselves, if all of them can be drawn.

    A ShapeError if a number is none, or a scale or stretch is not positive.
    """
    for column in fields(Poses):
        numbers = getattr(poses, column.name)
        is_size = column.name in {"scale", "stretch"}
        wrong = np.flatnonzero(~(np.isfinite(numbers) & ((numbers > 0) | (not is_size))))
        if len(wrong):
            needed = "finite and positive" if is_size else "finite"
            raise ShapeError(
                f"poses: {column.name} must be {needed}; "
                f"that of item {wrong[0]} is {numbers[wrong[0]]}"
            )
    return poses


def frozen_poses(poses: Poses) -> Poses:
    """Poses whose arrays nobody changes; the same, if they are such."""
    columns = [getattr(poses, column.name) for column in fields(Poses)]
    if not any(column.flags.writeable for column in columns):
        return poses
    return Poses(*map(frozen, columns))


class Pose(NamedTuple):
    """Pose of one item: canvas units and radians, as in :class:`packwork.Poses`."""

    x: float
    y: float
    angle: float
    scale: float
    stretch: float


@dataclass(frozen=True, eq=False)
class Placement:
    """One placed item.

    Parameters
    ----------
    outline
        Its outline there, canvas units.
    weight
        Share of area that was asked for it.
    """

    item: Item
    pose: Pose
    outline: Outline
    weight: float

    @property
    def name(self) -> str:
        """Name of the item, as people read it."""
        return self.item.name

    @property
    def area(self) -> float:
        """Area in place, squared canvas units."""
        return self.outline.area

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Placement):
            return NotImplemented
        return self.pose == other.pose and same_content(self.item, other.item)

    def __hash__(self) -> int:
        return hash((self.name, self.pose))

    def __repr__(self) -> str:
        return f"<Placement: {self.name} at ({self.pose.x:.1f}, {self.pose.y:.1f})>"
