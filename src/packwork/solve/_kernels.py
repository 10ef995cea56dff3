"""Poses to points, and point gradients back to poses."""

from __future__ import annotations

import math

from packwork.compiled import kernel


@kernel
def place(own, item_starts, x, y, angle, scale, stretch, px_per_cu, points):
    """Write each item's points, in pixels: scaled and stretched, turned, moved."""
    for i in range(item_starts.shape[0] - 1):
        root = math.sqrt(stretch[i])
        wide = px_per_cu * scale[i] * root
        high = px_per_cu * scale[i] / root
        cosine = math.cos(angle[i])
        sine = math.sin(angle[i])
        right_x = wide * cosine
        right_y = wide * sine
        down_x = high * sine
        down_y = high * cosine
        move_x = px_per_cu * x[i]
        move_y = px_per_cu * y[i]
        for v in range(item_starts[i], item_starts[i + 1]):
            points[v, 0] = move_x + right_x * own[v, 0] - down_x * own[v, 1]
            points[v, 1] = move_y + right_y * own[v, 0] + down_y * own[v, 1]


@kernel
def gather(points, gradient, item_starts, x, y, angle, px_per_cu, by_pose):
    """Sum vertex gradients into those by x, y (per canvas unit), angle, log scale, log stretch.

    By log stretch a vertex moves by half of its arm (a, b) mirrored in the item's own x
    axis, which is (a, -b) turned by twice the item's angle: two sums do for any angle,
    and half of each is in the torque and the growth.
    """
    for i in range(item_starts.shape[0] - 1):
        move_x = px_per_cu * x[i]
        move_y = px_per_cu * y[i]
        push_x = 0.0
        push_y = 0.0
        torque = 0.0
        growth = 0.0
        growth_x = 0.0
        torque_x = 0.0
        for v in range(item_starts[i], item_starts[i + 1]):
            arm_x = points[v, 0] - move_x
            arm_y = points[v, 1] - move_y
            push_x += gradient[v, 0]
            push_y += gradient[v, 1]
            torque += gradient[v, 1] * arm_x - gradient[v, 0] * arm_y
            growth += gradient[v, 0] * arm_x + gradient[v, 1] * arm_y
            growth_x += gradient[v, 0] * arm_x
            torque_x += gradient[v, 1] * arm_x
        by_pose[i, 0] = push_x * px_per_cu
        by_pose[i, 1] = push_y * px_per_cu
        by_pose[i, 2] = torque
        by_pose[i, 3] = growth
        upright = growth_x - 0.5 * growth
        diagonal = torque_x - 0.5 * torque
        by_pose[i, 4] = math.cos(2.0 * angle[i]) * upright + math.sin(2.0 * angle[i]) * diagonal


@kernel
def adam(gradient, mean, square, first, second, count, stillness, rate, change):
    """One step of Adam; components of an item share their second moment.

    ``mean`` (n, m) and ``square`` (n,) are updated; ``change`` (n, m) receives the step.
    """
    n = gradient.shape[0]
    parts = gradient.shape[1]
    fade = 1.0 - second**count
    typical = 0.0
    for i in range(n):
        squared = 0.0
        for j in range(parts):
            mean[i, j] += (1.0 - first) * (gradient[i, j] - mean[i, j])
            squared += gradient[i, j] * gradient[i, j]
        square[i] += (1.0 - second) * (squared - square[i])
        typical += square[i] / fade
    floor = stillness * math.sqrt(typical / n) + 1e-300
    length = rate / (1.0 - first**count)
    for i in range(n):
        size = math.sqrt(square[i] / fade) + floor
        for j in range(parts):
            change[i, j] = -length * mean[i, j] / size
