"""Poses on their way: one Adam step after another."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray
from packwork.scene.pose import Poses
from packwork.solve.adam import Adam
from packwork.solve.options import SolveOptions


class Motion:
    """Moves, turns and resizes items step by step, within their bounds.

    Parameters
    ----------
    poses
        Where they begin; copied.
    nominal
        ``(n,)`` scales that bounds and proportions refer to.
    side
        Longer side of the canvas.
    options
        Modes, rates and bounds.
    """

    def __init__(self, poses: Poses, nominal: FloatArray, side: float, options: SolveOptions):
        self._options = options
        self._side = side
        n = len(poses)
        self.x, self.y = poses.x.copy(), poses.y.copy()
        self.angle = poses.angle.copy()
        self._nominal = np.log(nominal)
        self._growth = np.log(poses.scale) - self._nominal
        decay = (options.momentum, options.memory)
        self._moves, self._turns = Adam((n, 2), decay), Adam((n, 1), decay)
        self._sizes = Adam((1 if options.sizes == "shared" else n, 1), decay)

    @property
    def poses(self) -> Poses:
        """Where the items are now; arrays of its own."""
        return Poses(
            self.x.copy(), self.y.copy(), self.angle.copy(), np.exp(self._nominal + self._growth)
        )

    def follow(self, gradient: FloatArray, factor: float) -> None:
        """One step against the pose gradient, at ``factor`` of the full rates."""
        options = self._options
        move = self._moves.step(gradient[:, :2], options.position_rate * self._side * factor)
        self.x += move[:, 0]
        self.y += move[:, 1]
        if options.turn_rate > 0:
            self.angle += self._turns.step(gradient[:, 2:3], options.turn_rate * factor)[:, 0]
            if options.turn_limit is not None:
                np.clip(self.angle, -options.turn_limit, options.turn_limit, out=self.angle)
        self._resize(gradient[:, 3:4], options.size_rate * factor)

    def _resize(self, gradient: FloatArray, rate: float) -> None:
        if self._options.sizes == "free":
            bound = np.log(self._options.size_ratio)
            self._growth += self._sizes.step(gradient, rate)[:, 0]
            np.clip(self._growth, -bound, bound, out=self._growth)
        elif self._options.sizes == "shared":
            total = gradient.sum(axis=0, keepdims=True)
            self._growth += self._sizes.step(total, rate)[0, 0]

    def replace(self, poses: Poses, items: list[int]) -> None:
        """Take over poses in which ``items`` were moved by force."""
        self.x, self.y, self.angle = poses.x.copy(), poses.y.copy(), poses.angle.copy()
        self._growth = np.log(poses.scale) - self._nominal
        self._moves.forget(items)
        self._turns.forget(items)
        if self._options.sizes == "free":
            self._sizes.forget(items)
