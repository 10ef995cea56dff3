"""Poses to points, and point gradients back to poses."""

from __future__ import annotations

import math

from numba import njit


@njit(cache=True, nogil=True, error_model="numpy")
def place(own, item_starts, x, y, angle, scale, px_per_cu, points):
    """Write each item's points, in pixels: scaled, turned, moved."""
    for i in range(item_starts.shape[0] - 1):
        cosine = px_per_cu * scale[i] * math.cos(angle[i])
        sine = px_per_cu * scale[i] * math.sin(angle[i])
        move_x = px_per_cu * x[i]
        move_y = px_per_cu * y[i]
        for v in range(item_starts[i], item_starts[i + 1]):
            points[v, 0] = move_x + cosine * own[v, 0] - sine * own[v, 1]
            points[v, 1] = move_y + sine * own[v, 0] + cosine * own[v, 1]


@njit(cache=True, nogil=True, error_model="numpy")
def gather(points, gradient, item_starts, x, y, px_per_cu, by_pose):
    """Sum vertex gradients into d/dx, d/dy (per canvas unit), d/dangle, d/dlog scale."""
    for i in range(item_starts.shape[0] - 1):
        move_x = px_per_cu * x[i]
        move_y = px_per_cu * y[i]
        push_x = 0.0
        push_y = 0.0
        torque = 0.0
        growth = 0.0
        for v in range(item_starts[i], item_starts[i + 1]):
            arm_x = points[v, 0] - move_x
            arm_y = points[v, 1] - move_y
            push_x += gradient[v, 0]
            push_y += gradient[v, 1]
            torque += gradient[v, 1] * arm_x - gradient[v, 0] * arm_y
            growth += gradient[v, 0] * arm_x + gradient[v, 1] * arm_y
        by_pose[i, 0] = push_x * px_per_cu
        by_pose[i, 1] = push_y * px_per_cu
        by_pose[i, 2] = torque
        by_pose[i, 3] = growth
