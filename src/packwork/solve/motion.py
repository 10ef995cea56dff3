"""Poses under optimisation: bounded steps of Adam, with one step length per quantity.

D. Kingma and J. Ba, "Adam: a method for stochastic optimization", ICLR 2015, arXiv:1412.6980. Ours
shares the second moment among the components of an item, and ties epsilon to the size of the
typical gradient.
"""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.scene.pose import NO_LIMITS, Limits, Poses, turn_sides
from packwork.solve import _kernels
from packwork.solve.options import SolveOptions

STILLNESS = 1.5e-2
"""Gradients this small against the typical one move an item less than a full step; without it a
trapped item, whose forces cancel to rounding, would dance. Larger slows settling. Tried."""


class Adam:
    """Moments of one quantity of n items, possibly a vector of several components.

    Components of one item share their second moment, so that a step's direction does not depend on
    how the canvas is turned. ``decay``: of the first and of the second moment; both 0.9 in Wang and
    Lu 2025.

    >>> adam = Adam((1, 2))
    >>> adam.step(np.array([[3.0, 4.0]]), 1.0).round(2).tolist()
    [[-0.59, -0.79]]
    """

    def __init__(self, shape: tuple[int, int], decay: tuple[float, float] = (0.9, 0.9)) -> None:
        self._mean = np.zeros(shape)
        self._square = np.zeros(shape[0])
        self._change = np.zeros(shape)
        self._decay = decay
        self._count = 0

    def step(self, gradient: FloatArray, rate: float) -> FloatArray:
        """Change ``(n, components)`` of the quantity, in its unit, about ``rate`` long.

        ``gradient``: of the same shape. The next call reuses the result.
        """
        self._count += 1
        # Columns of a wider array would need a kernel of their own.
        _kernels.adam(
            np.ascontiguousarray(gradient), self._mean, self._square, *self._decay, self._count,
            STILLNESS, rate, self._change,
        )  # fmt: skip
        return self._change

    def forget(self, items: list[int]) -> None:
        """Start the moments of these items anew, after they were moved by force."""
        self._mean[items] = 0.0
        self._square[items] = np.mean(self._square)

    def copy_moments(self, other: Adam, mine: IntArray, theirs: IntArray) -> None:
        """Take over what another has learnt about some items: ``theirs`` there, ``mine`` here.

        >>> one, two = Adam((1, 1)), Adam((3, 1))
        >>> step = one.step(np.array([[3.0]]), 1.0)
        >>> two.copy_moments(one, np.array([2]), np.array([0]))
        >>> two.step(np.zeros((3, 1)), 1.0)[:, 0].round(1).tolist()
        [-0.0, -0.0, -0.7]
        """
        self._mean[mine] = other._mean[theirs]
        self._square[:] = np.mean(other._square)
        self._square[mine] = other._square[theirs]
        self._count = other._count


class Motion:
    """Moves, turns, resizes and stretches items step by step, within their bounds.

    ``nominal``: ``(n,)`` scales that bounds and proportions refer to; ``side``: longer side of the
    canvas.
    """

    def __init__(
        self,
        poses: Poses,
        nominal: FloatArray,
        side: float,
        options: SolveOptions,
        limits: Limits = NO_LIMITS,
    ) -> None:
        self._options = options
        self._side = side
        n = len(poses)
        self.x, self.y = poses.x.copy(), poses.y.copy()
        self.angle = poses.angle.copy()
        self._nominal = np.log(nominal)
        self._growth = np.log(poses.scale) - self._nominal
        self._shape = np.log(poses.stretch)
        bound = np.log(options.size_ratio)
        self._growth_range: tuple[FloatArray | float, FloatArray | float] = (-bound, bound)
        self._turn_range: tuple[FloatArray | float, FloatArray | float] | None = None
        if options.turn_limit is not None:
            self._bound_turns(options.turn_limit)
        self._free: FloatArray | None = None
        self.floor: FloatArray | None = None
        """``(n,)`` logarithms of growth that shared sizes do not fall below; None for any."""
        self.pace: FloatArray | None = None
        """``(n,)`` factors on the moves and turns of single items; None for 1."""
        if limits.binds:
            self._bound_items(limits)
        decay = (options.momentum, options.memory)
        self._moves, self._turns = Adam((n, 2), decay), Adam((n, 1), decay)
        self._sizes = Adam((1 if options.sizes == "shared" else n, 1), decay)
        self._shapes = Adam((n, 1), decay)

    @property
    def poses(self) -> Poses:
        """Poses of the items now; arrays of its own."""
        scale, stretch = np.exp(self._nominal + self._growth), np.exp(self._shape)
        return Poses(self.x.copy(), self.y.copy(), self.angle.copy(), scale, stretch)

    def follow(self, gradient: FloatArray, factor: float) -> None:
        """One step against the pose gradient, at ``factor`` of the full rates.

        ``gradient``: ``(n, 5)`` by x, y (canvas units), angle (rad), log scale, log stretch.
        """
        options = self._options
        if self._free is not None:
            gradient = gradient * self._free
        move = self._moves.step(gradient[:, :2], options.position_rate * self._side * factor)
        if self.pace is not None:
            move = move * self.pace[:, None]
        self.x += move[:, 0]
        self.y += move[:, 1]
        if options.turn_rate > 0:
            turn = self._turns.step(gradient[:, 2:3], options.turn_rate * factor)[:, 0]
            self.angle += turn if self.pace is None else turn * self.pace
            if self._turn_range is not None:
                np.clip(self.angle, *self._turn_range, out=self.angle)
        self._resize(gradient[:, 3:4], options.size_rate * factor)
        if options.stretch > 1:
            self._reshape(gradient[:, 4:5], options.stretch_rate * factor)

    def _bound_turns(self, limit: FloatArray | float) -> None:
        leans = self._options.leans
        self._turn_range = (-limit, limit) if leans is None else turn_sides(limit, np.array(leans))

    def _bound_items(self, limits: Limits) -> None:
        self._free = np.logical_not(limits.held).astype(np.float64)
        self._bound_turns(limits.turn_limit)
        if self._options.sizes == "free":
            low, high = np.log(limits.smallest), np.log(limits.largest)
            self._growth_range = (low - self._nominal, high - self._nominal)

    def _resize(self, gradient: FloatArray, rate: float) -> None:
        if self._options.sizes == "free":
            self._growth += self._sizes.step(gradient, rate)[:, 0]
            np.clip(self._growth, *self._growth_range, out=self._growth)
        elif self._options.sizes == "shared":
            total = gradient.sum(axis=0, keepdims=True)
            step = self._sizes.step(total, rate)[0, 0]
            self._growth += step if self._free is None else step * self._free[:, 3]
            if self.floor is not None:
                np.maximum(self._growth, self.floor, out=self._growth)

    def _reshape(self, gradient: FloatArray, rate: float) -> None:
        bound = np.log(self._options.stretch)
        self._shape += self._shapes.step(gradient, rate)[:, 0]
        np.clip(self._shape, -bound, bound, out=self._shape)

    def replace(self, poses: Poses, items: list[int]) -> None:
        """Take over poses in which ``items`` were moved by force."""
        self.x, self.y, self.angle = poses.x.copy(), poses.y.copy(), poses.angle.copy()
        self._growth = np.log(poses.scale) - self._nominal
        self._shape = np.log(poses.stretch)
        for adam in (self._moves, self._turns, self._shapes):
            adam.forget(items)
        if self._options.sizes == "free":
            self._sizes.forget(items)

    def put(self, items: IntArray, poses: Poses) -> None:
        """Put items ``(m,)`` to poses, as many; moments stay."""
        self.x[items], self.y[items], self.angle[items] = poses.x, poses.y, poses.angle
        self._growth[items] = np.log(poses.scale) - self._nominal[items]

    def copy_moments(self, other: Motion, mine: IntArray, theirs: IntArray) -> None:
        """Take over the moments of items ``theirs`` of another for items ``mine`` of this.

        ``(m,)`` indices each; both of free or both of other sizes.
        """
        columns = ((self._moves, other._moves), (self._turns, other._turns))
        for own, theirs_adam in (*columns, (self._shapes, other._shapes)):
            own.copy_moments(theirs_adam, mine, theirs)
        if self._options.sizes == "free":
            self._sizes.copy_moments(other._sizes, mine, theirs)
