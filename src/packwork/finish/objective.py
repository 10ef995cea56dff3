"""Objective of a finish: the size mode that is asked for, and the forces.

Forces push items in the linear programmes, and set a price on trials that undo what they ask.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.compaction.arrangement import Arrangement
from packwork.compaction.kernels.steps import Objective
from packwork.compaction.objective import FixedSize, FreeSizes, SharedSize, Sizing, turn_ranges
from packwork.finish.options import FinishOptions
from packwork.forces.forces import Forces
from packwork.scene.pose import Poses


def sizing_of(poses: Poses, areas: FloatArray, options: FinishOptions) -> Sizing:
    """Size mode that the options ask for; ``areas``: ``(n,)`` of the items at these poses."""
    turns = turn_ranges(poses.angle, options)
    if options.sizes == "free":
        smallest = poses.scale / 2 if options.smallest is None else np.array(options.smallest)
        largest = poses.scale * 2 if options.largest is None else np.array(options.largest)
        return FreeSizes(
            areas, turns, np.log(smallest / poses.scale), np.log(largest / poses.scale)
        )
    return (FixedSize if options.sizes == "fixed" else SharedSize)(areas, turns)


YIELDING = 0.2
"""Most that a push may be worth where sizes are common, over what growing is worth to the same
item's rim. Larger makes all items smaller. Tried."""


@dataclass(frozen=True, eq=False)
class ForceTerm:
    """Forces on the items of a finish, in the unit of its objective.

    ``areas``: ``(n,)`` at the begin, so that none is shrunk for lying where it should not;
    ``unit``: value of one squared canvas unit; ``gives_way``: whether no push counts for more than
    an item's growth: where sizes are common, one that is pressed small makes all others small.
    """

    forces: Forces
    areas: FloatArray
    unit: float
    gives_way: bool

    def cost(self, places: FloatArray) -> float:
        """Cost of items at places ``(n, 4)``, in the unit of the objective."""
        return self.unit * self.forces.cost(places[:, :2], self.areas).value

    def with_push(self, objective: Objective, arrangement: Arrangement) -> Objective:
        """The objective, and where the forces push each item."""
        places = arrangement.places
        push = -self.unit * self.forces.cost(places[:, :2], self.areas).slopes
        if self.gives_way:
            growth = objective.weights * np.exp(objective.power * places[:, 3]) / arrangement.radii
            steep = np.hypot(push[:, 0], push[:, 1])
            push *= np.minimum(1.0, YIELDING * growth / np.maximum(steep, 1e-300))[:, None]
        return objective._replace(push=np.ascontiguousarray(push))

    def gains(self, places: FloatArray, item: int, others: IntArray) -> FloatArray:
        """Gains ``(m,)``, about, of exchanges of an item with others; 0 for copies of one thing."""
        points = places[:, :2]
        there = self.forces.cost_changes(points, self.areas, points[others])[item]
        here = self.forces.cost_changes(points, self.areas, points[[item]])[others, 0]
        differs = self.forces.kinds[others] != self.forces.kinds[item]
        return np.asarray(-self.unit * np.where(differs, there + here, 0.0))


def force_term_of(forces: Forces, sizing: Sizing) -> ForceTerm | None:
    """Forces in the unit of a size mode's objective; None if there are none."""
    if not forces.acts:
        return None
    # Growth is worth twice the area; where sizes are common, one for the typical item.
    is_free = isinstance(sizing, FreeSizes)
    unit = 1.0 if is_free else 1 / (2 * float(sizing.areas.mean()))
    return ForceTerm(forces, sizing.areas, unit, not is_free)
