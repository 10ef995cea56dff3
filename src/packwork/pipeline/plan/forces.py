"""Forces of a recipe on the items and the canvas of a job."""

from __future__ import annotations

import math
from collections.abc import Sequence
from contextlib import nullcontext, suppress

import numpy as np

from packwork.arrays import FloatArray
from packwork.errors import RecipeError
from packwork.forces.bonds import Alignment, Balance, TogetherBond
from packwork.forces.field import Bond, Direction, Distance, Fading, Field, Inward
from packwork.forces.forces import BondForce, FieldForce, Forces
from packwork.forces.spec import ForceSpec, parse_force
from packwork.pipeline.plan.copies import RuleSource, kinds, matching
from packwork.readers.svg.curve import read_curve
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.units import length_asked


def forces_of(
    texts: Sequence[str],
    items: Sequence[Item],
    weights: FloatArray,
    container: Container,
    *,
    are_all: bool = True,
) -> Forces:
    """Forces that are asked for, on these items and this canvas.

    ``are_all``: whether a name that none of the items has is a mistake.

    Examples
    --------
    >>> from packwork.readers.builtin import builtin_container, builtin_item
    >>> star = builtin_item("star")
    >>> texts = ["down", "away centre items=star"]
    >>> forces = forces_of(texts, [star], np.ones(1), builtin_container("square"))
    >>> [force.strengths.tolist() for force in forces.fields]
    [[1.0], [-1.0]]
    """
    fields: list[FieldForce] = []
    bonds: list[BondForce] = []
    for text in texts:
        spec = parse_force(text)
        strengths = _strengths(spec, items, weights, are_all=are_all)
        if not (are_all or strengths.any()):
            continue
        if spec.kind in {"align", "balance", "together"}:
            bonds.append(BondForce(_bond(spec, container), strengths))
        else:
            fields.append(FieldForce(_field(spec, container), strengths))
    return Forces(fields, bonds, kinds(items), container.side)


def _strengths(
    spec: ForceSpec, items: Sequence[Item], weights: FloatArray, *, are_all: bool
) -> FloatArray:
    strengths = np.full(len(items), -spec.strength if spec.kind == "away" else spec.strength)
    if spec.by_weight:
        strengths *= weights / weights.mean()
    if spec.items:
        names = [item.name for item in items]
        acted_on = np.zeros(len(items), dtype=bool)
        for pattern in spec.items:
            with nullcontext() if are_all else suppress(RecipeError):
                acted_on[matching([pattern], RuleSource("force"), names)] = True
        strengths[~acted_on] = 0.0
    return strengths


def _bond(spec: ForceSpec, container: Container) -> Bond:
    if spec.kind == "together":
        return TogetherBond(is_one=bool(spec.items))
    if spec.kind == "align":
        return Alignment(0 if spec.axis == "vertical" else 1)
    point = point_at(spec.places[0], container)
    # A vertical axis is one of x, and so on: the other coordinate does not matter.
    if spec.axis:
        point[1 if spec.axis == "vertical" else 0] = np.nan
    return Balance(point)


def _field(spec: ForceSpec, container: Container) -> Field:
    if spec.kind == "direction":
        return Direction(math.radians(spec.angle))
    field: Field
    if spec.kind == "inward":
        field = Inward(container.outline)
    elif spec.file is not None:
        field = Distance(*read_curve(spec.file, container.width, container.height))
    else:
        points = np.array([point_at(place, container) for place in spec.places])
        field = Distance.from_line(points) if spec.is_line else Distance.from_points(points)
    if spec.reach is None:
        return field
    return Fading(field, _length(spec.reach, container, container.side))


def point_at(pair: str, container: Container, key: str = "force") -> FloatArray:
    """Point of ``X,Y``, percents of the canvas' width and height; may lie off the canvas."""
    pairs = zip(pair.split(","), (container.width, container.height), strict=True)
    return np.array([_length(text, container, whole, key) for text, whole in pairs])


def _length(text: str, container: Container, whole: float, key: str = "force") -> float:
    sign = -1.0 if text.startswith("-") else 1.0
    return sign * length_asked(key, text.removeprefix("-"), container.unit, whole)
