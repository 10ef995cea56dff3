"""One pass: each part that collides is taken up and put where its weighted price is least.

Random numbers of a worker: Marsaglia's xorshift over one word, which must not be 0.
"""

from __future__ import annotations

import math

import numpy as np

from packwork.compiled import helper, kernel
from packwork.separation.kernels.collision import (
    ANGLE,
    EDGE,
    EDGE_END,
    POLES,
    SHAPE,
    SIDE,
    TURN,
    X0,
    X1,
    Y0,
    Y1,
    X,
    Y,
    price,
)  # fmt: skip
from packwork.separation.kernels.field import draw_others, propose

PROPOSED = 8
"""Places of the image that are priced exactly."""

NEAR = 5
"""Random places near where the part lies."""

DESCENTS = 2

TURNS_TRIED = 8
"""Of a part that may lie at any angle, for one move."""

_NEAR_SPREAD = 0.25
"""Deviation of near places, over the part's shorter side."""

_TURN_SPREAD = 0.1
"""Deviation of near angles, in radians."""

_COARSE, _MIDDLE, _FINE = 0.25, 0.02, 0.001
"""Steps of descents over the part's shorter side: first, last of all, last of the best."""

_COARSE_TURN, _MIDDLE_TURN, _FINE_TURN = 0.09, 0.009, 0.0009
"""The same of turns, in radians."""

_LONGER, _SHORTER = 1.1, 0.5


@helper
def turn_part(shape, cosine, sine, side, shapes, turned):
    """Write a shape's edges and poles as turned about its own point, and the box of its edges.

    ``side``: -1 for a shape that is mirrored, left to right, before it is turned; else 1.
    """
    shape_edges, shape_poles, edge_at = shapes
    edges, poles = turned
    first, count = edge_at[shape], edge_at[shape + 1] - edge_at[shape]
    x0, y0, x1, y1 = np.inf, np.inf, -np.inf, -np.inf
    for k in range(count):
        for end in range(0, 4, 2):
            px, py = side * shape_edges[end, first + k], shape_edges[end + 1, first + k]
            qx, qy = cosine * px - sine * py, sine * px + cosine * py
            edges[end, k], edges[end + 1, k] = qx, qy
            x0, x1, y0, y1 = min(x0, qx), max(x1, qx), min(y0, qy), max(y1, qy)
    edges[0, count], edges[1, count], edges[2, count], edges[3, count] = x0, y0, x1, y1
    for k in range(POLES):
        px, py = side * shape_poles[shape, 0, k], shape_poles[shape, 1, k]
        poles[0, k], poles[1, k] = cosine * px - sine * py, sine * px + cosine * py
        poles[2, k] = shape_poles[shape, 2, k]


@helper
def turn_to(shape, angle, turn, shapes, turns, turned):
    """Turn a part to an angle, by the table where it has the angle exactly; on the turn's side."""
    if turns[2, turn] == angle:
        turn_part(shape, turns[0, turn], turns[1, turn], turns[3, turn], shapes, turned)
    else:
        turn_part(shape, math.cos(angle), math.sin(angle), turns[3, turn], shapes, turned)


@helper
def nearest_turn(shape, angle, side, table):
    """Number of the turn of that side that is nearest to an angle; its own where not all are free.

    -1 if there is none.
    """
    turns, turn_at, is_free, reach = table[0], table[1], table[2], table[5][shape]
    first, last = turn_at[shape], turn_at[shape + 1]
    if is_free[shape]:
        # Those of the other side come after all of this one.
        count = last - first if turns[3, last - 1] > 0.0 else (last - first) // 2
        if reach < np.inf:
            turn = first + round((angle / reach + 1.0) / 2.0 * (count - 1))
        else:
            turn = first + round(angle / (2.0 * math.pi) * count) % count
        return turn if side > 0.0 else turn + count
    for turn in range(first, last):
        if turns[2, turn] == angle and turns[3, turn] == side:
            return turn
    return -1


@helper
def put_part(i, x, y, angle, side, turn, layout, turned):
    """Write part ``i`` at a pose; it is turned to its angle."""
    items, index, edges, poles = layout
    own_edges, own_poles = turned
    first, count = index[i, EDGE], index[i, EDGE_END] - index[i, EDGE]
    for k in range(count):
        edges[0, first + k], edges[1, first + k] = x + own_edges[0, k], y + own_edges[1, k]
        edges[2, first + k], edges[3, first + k] = x + own_edges[2, k], y + own_edges[3, k]
    items[X0, i], items[Y0, i] = x + own_edges[0, count], y + own_edges[1, count]
    items[X1, i], items[Y1, i] = x + own_edges[2, count], y + own_edges[3, count]
    for k in range(POLES):
        poles[i, 0, k], poles[i, 1, k] = x + own_poles[0, k], y + own_poles[1, k]
        poles[i, 2, k] = own_poles[2, k]
    items[X, i], items[Y, i], items[ANGLE, i], items[SIDE, i] = x, y, angle, side
    index[i, TURN] = turn


@kernel
def put_all(poses, layout, shapes, table, weights, losses, sheet, turned, scratch):
    """Write all parts at poses (x, y, angle, side), and the prices of all pairs into ``losses``.

    ``poses``: of those that move; NaN for one that is not laid. What comes after them are
    obstacles, which lie where they are.
    """
    items, index = layout[0], layout[1]
    moving = len(poses)
    turns = table[0]
    for i in range(items.shape[1]):
        shape, x, y, angle, side = index[i, SHAPE], 0.0, 0.0, 0.0, 1.0
        if i < moving:
            x, y, angle, side = poses[i, 0], poses[i, 1], poses[i, 2], poses[i, 3]
        if math.isnan(x):
            items[X, i], items[Y, i], items[ANGLE, i], items[SIDE, i] = x, y, angle, side
            items[X0, i], items[Y0, i], items[X1, i], items[Y1, i] = (
                np.inf,
                np.inf,
                -np.inf,
                -np.inf,
            )
            continue
        turn = nearest_turn(shape, angle, side, table)
        turn_to(shape, angle, turn, shapes, turns, turned)
        put_part(i, x, y, angle, side, turn, layout, turned)
    losses[:] = 0.0
    for i in range(moving):
        if math.isnan(items[X, i]):
            continue
        turn_to(index[i, SHAPE], items[ANGLE, i], index[i, TURN], shapes, turns, turned)
        price(i, items[X, i], items[Y, i], np.inf, losses[i], layout, weights, turned, sheet,
              scratch)  # fmt: skip
    for i in range(items.shape[1]):
        for j in range(i):
            losses[i, j] = losses[j, i] = max(losses[i, j], losses[j, i])


@helper
def _descend(i, place, last, last_turn, step, turn_step, is_free, state, layout, weights, shapes,
             table, sheet, turned, scratch, nothing):  # fmt: skip
    """Walk from a place along random axes to lower prices, with steps from ``step`` to ``last``.

    ``place``: price, x, y, angle; changed to the best that was met. Returns evaluations.
    """
    shape, turns, tried = layout[1][i, SHAPE], table[0], 0
    reach = table[5][shape]
    turn = int(place[4])
    turn_to(shape, place[3], turn, shapes, turns, turned)
    while step > last or (is_free and turn_step > last_turn):
        axis = below(state, 5 if is_free else 4)
        x, y, angle = place[1], place[2], place[3]
        better = False
        for sign in (-1.0, 1.0):
            if axis == 4:
                to_x, to_y = x, y
                to_angle = min(max(angle + sign * turn_step, -reach), reach)
                turn_part(shape, math.cos(to_angle), math.sin(to_angle), turns[3, turn], shapes,
                          turned)  # fmt: skip
            else:
                to_x = x + sign * step * (axis != 1)
                to_y = y + sign * step * ((axis != 0) if axis != 3 else -1.0)
                to_angle = angle
            found = price(i, to_x, to_y, place[0], nothing, layout, weights, turned, sheet, scratch)
            tried += 1
            if found < place[0]:
                place[0], place[1], place[2], place[3] = found, to_x, to_y, to_angle
                better = True
        if axis == 4:
            turn_step *= _LONGER if better else _SHORTER
            turn_to(shape, place[3], turn, shapes, turns, turned)
        else:
            step *= _LONGER if better else _SHORTER
        if place[0] == 0.0:
            break
    return tried


@helper
def _rank(best, cost, x, y, angle, turn, apart):
    """Put a place among the best, none nearer to a better one of its angle than ``apart``."""
    last = len(best) - 1
    for k in range(last + 1):
        if best[k, 3] == angle and max(abs(best[k, 1] - x), abs(best[k, 2] - y)) < apart:
            if best[k, 0] <= cost:
                return
            last = k
            break
    if cost >= best[last, 0]:
        return
    while last > 0 and best[last - 1, 0] > cost:
        best[last] = best[last - 1]
        last -= 1
    best[last, 0], best[last, 1], best[last, 2], best[last, 3] = cost, x, y, angle
    best[last, 4] = turn


@helper
def best_place(i, best, found, state, layout, weights, shapes, table, sheet, pixel, image, scores,
                turned, scratch, nothing):  # fmt: skip
    """Seek the best place of a part; ``best[0]`` is price, x, y, angle and turn of it."""
    items, index = layout[0], layout[1]
    turns, turn_at, free, span_at, spans, reaches = table
    shape = index[i, SHAPE]
    is_free, first = free[shape], turn_at[shape]
    many = turn_at[shape + 1] - first
    count = index[i, EDGE_END] - index[i, EDGE]
    side = min(items[X1, i] - items[X0, i], items[Y1, i] - items[Y0, i])
    draw_others(i, pixel, items, index, weights, span_at, spans, image)
    kept = 0
    for k in range(min(many, TURNS_TRIED) if is_free else many):
        turn = first + (below(state, many) if is_free else k)
        turn_part(shape, turns[0, turn], turns[1, turn], turns[3, turn], shapes, turned)
        kept = propose(i, turn, turned[0][:, count], pixel, sheet, span_at, spans, image, scores,
                       found, kept, side / 4.0)  # fmt: skip
    tried = 0
    for k in range(kept + NEAR):
        if k < kept:
            turn = int(found[k, 3])
            x, y, angle = found[k, 1], found[k, 2], turns[2, turn]
        else:
            x = items[X, i] + normal(state) * side * _NEAR_SPREAD
            y = items[Y, i] + normal(state) * side * _NEAR_SPREAD
            angle, turn = items[ANGLE, i], index[i, TURN]
            if is_free:
                angle += normal(state) * _TURN_SPREAD
                angle = min(max(angle, -reaches[shape]), reaches[shape])
            elif uniform(state) < 0.5:
                turn = first + below(state, many)
                angle = turns[2, turn]
        turn_to(shape, angle, turn, shapes, turns, turned)
        cost = price(i, x, y, best[DESCENTS - 1, 0], nothing, layout, weights, turned, sheet,
                     scratch)  # fmt: skip
        tried += 1
        _rank(best, cost, x, y, angle, turn, side / 4.0)
    for k in range(DESCENTS):
        tried += _descend(i, best[k], _MIDDLE * side, _MIDDLE_TURN, _COARSE * side, _COARSE_TURN,
                          is_free, state, layout, weights, shapes, table, sheet, turned, scratch,
                          nothing)  # fmt: skip
    for k in range(1, DESCENTS):
        if best[k, 0] < best[0, 0]:
            best[0] = best[k]
    return tried + _descend(i, best[0], _FINE * side, _FINE_TURN, _MIDDLE * side, _MIDDLE_TURN,
                            is_free, state, layout, weights, shapes, table, sheet, turned, scratch,
                            nothing)  # fmt: skip


@kernel
def move_pass(moving, state, layout, weights, losses, shapes, table, sheet, pixel, image, scores,
              turned, scratch):  # fmt: skip
    """Take up each part that collides, in a random order, and put it where its price is least.

    ``moving``: number of parts, before the obstacles; ``state``: of the random numbers. Returns the
    number of places that were priced.
    """
    items, index = layout[0], layout[1]
    turns = table[0]
    found, best = np.empty((PROPOSED, 4)), np.empty((DESCENTS, 5))
    nothing, order, left = np.empty(0), np.empty(moving, np.int64), 0
    for i in range(moving):
        if np.any(losses[i] > 0.0):
            order[left] = i
            left += 1
    tried = 0
    while left > 0:
        chosen = below(state, left)
        i = order[chosen]
        left -= 1
        order[chosen] = order[left]
        now = 0.0
        for j in range(items.shape[1]):
            now += weights[i, j] * losses[i, j]
        if now == 0.0:
            continue
        best[:, 0] = np.inf
        tried += best_place(i, best, found, state, layout, weights, shapes, table, sheet, pixel,
                             image, scores, turned, scratch, nothing)  # fmt: skip
        if not best[0, 0] < now:
            continue
        shape, angle, turn = index[i, SHAPE], best[0, 3], int(best[0, 4])
        if table[2][shape]:
            turn = nearest_turn(shape, angle, turns[3, turn], table)
        turn_to(shape, angle, turn, shapes, turns, turned)
        put_part(i, best[0, 1], best[0, 2], angle, turns[3, turn], turn, layout, turned)
        price(i, best[0, 1], best[0, 2], np.inf, losses[i], layout, weights, turned, sheet,
              scratch)  # fmt: skip
        for j in range(items.shape[1]):
            losses[j, i] = losses[i, j]
    return tried


@kernel
def raise_weights(weights, losses, most, least, decay):
    """Raise the weights of pairs that collide, by their share of the worst; let the others fall."""
    worst = losses.max()
    if worst == 0.0:
        return
    for i in range(len(weights)):
        for j in range(len(weights)):
            if losses[i, j] > 0.0:
                weights[i, j] *= least + (most - least) * losses[i, j] / worst
            else:
                weights[i, j] = max(1.0, weights[i, j] * decay)


_13, _7, _17, _11 = np.uint64(13), np.uint64(7), np.uint64(17), np.uint64(11)
_UNIT = 1.0 / (1 << 53)


@helper
def uniform(state):
    """From 0 to before 1."""
    word = state[0]
    word ^= word << _13
    word ^= word >> _7
    word ^= word << _17
    state[0] = word
    return float(word >> _11) * _UNIT


@helper
def below(state, count):
    """A whole number from 0 to before ``count``."""
    return min(int(uniform(state) * count), count - 1)


@helper
def normal(state):
    """Of mean 0 and deviation 1 (Box and Muller)."""
    radius = math.sqrt(-2.0 * math.log(1.0 - uniform(state)))
    return radius * math.cos(2.0 * math.pi * uniform(state))
