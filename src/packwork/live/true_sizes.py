"""Rules of a nest in a session: parts of true size, at allowed angles, off the sheet's edge."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from packwork.arrays import IntArray
from packwork.errors import RecipeError, ShapeError
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import buffered
from packwork.recipe.rules import Rotation
from packwork.scene.container import Container


@dataclass(frozen=True)
class NestRules:
    """Rules that the manifest of a nest states.

    ``rotate``: angles of most parts, as options say them.
    ``own_angles``, ``mirrored``: numbers, from 1, of parts with other angles, of those turned over.
    ``margin``: least distance from the sheet's edge, canvas units.
    """

    rotate: str = "none"
    own_angles: frozenset[int] = frozenset()
    mirrored: frozenset[int] = frozenset()
    margin: float = 0.0

    @classmethod
    def of(cls, manifest: Mapping[str, Any]) -> NestRules | None:
        """Rules in a manifest, which may hold anything; None if it is of no nest.

        Examples
        --------
        >>> NestRules.of({"nest": {"rotate": "0,180", "mirrored": [2, "x"]}})
        NestRules(rotate='0,180', own_angles=frozenset(), mirrored=frozenset({2}), margin=0.0)
        >>> NestRules.of({}) is None, NestRules.of({"nest": {"rotate": "up", "margin": -1}})
        (True, NestRules(rotate='none', ...))
        """
        said = manifest.get("nest")
        if not isinstance(said, Mapping):
            return None
        rotate, margin = said.get("rotate"), said.get("margin")
        try:
            Rotation.parse(str(rotate))
        except (RecipeError, ValueError):
            rotate = "none"
        is_length = isinstance(margin, int | float) and 0 < margin < math.inf
        own, mirrored = (_numbers(said.get(name)) for name in ("own_angles", "mirrored"))
        return cls(str(rotate), own, mirrored, float(str(margin)) if is_length else 0.0)

    def rows(self, ids: IntArray) -> dict[str, list[int]]:
        """The numbers as rows, from 1, where parts stand that had those numbers less 1 as ids."""
        found = {"own_angles": self.own_angles, "mirrored": self.mirrored}
        return {
            name: (np.flatnonzero(np.isin(ids + 1, list(known))) + 1).tolist()
            for name, known in found.items()
        }

    def ground(self, container: Container, gap: float) -> Container:
        """The container less what the margin keeps free beyond the gap."""
        if self.margin <= gap:
            return container
        region = buffered(container.outline.region, gap - self.margin, join_style="mitre")
        try:
            return replace(container, outline=Outline.from_region(region))
        except ShapeError:
            return container


def _numbers(said: object) -> frozenset[int]:
    found = said if isinstance(said, list | tuple) else ()
    return frozenset(one for one in found if isinstance(one, int))
