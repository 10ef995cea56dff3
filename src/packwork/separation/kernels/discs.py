"""Jammed packings of discs: energy of overlaps, its descent by FIRE, and exchanges of radii.

Sources of the whole: ``separation/discs.py``. ``discs``: ``(n, 2)`` centres; ``radii``: ``(n,)`` of
the places that they are, with half the gap; ``owners``: ``(n,)`` which item lies in which place.
"""

from __future__ import annotations

import math

import numpy as np

from packwork.compiled import helper, kernel
from packwork.separation.kernels.wall import edge_distance, edge_push

SKIN = 0.5
"""Distance up to which pairs are listed, mean radii; they are looked for anew once two discs may
have come nearer by that. Larger lists more, smaller looks more often. Tried."""

LONGEST, SHORTEST, FIRST = 0.6, 0.02, 0.1
"""Time steps of the descent. A longer one overshoots, a shorter one creeps. Tried."""

FASTER, SLOWER, PATIENCE = 1.1, 0.5, 5
"""Factors on the time step after steps downhill, and after one uphill. As published."""

STEERING, EASING = 0.1, 0.99
"""Share of the velocity that is turned into the force's direction, and what is left of it after a
step downhill. As published."""

WALL = 2.0
"""Stiffness of the edge against that of discs: as if a disc's mirror image pushed it. Derived."""

SHRINKING, SWELLING = 0.1, 0.5
"""Part of the overlaps that a disc's radius would lose, and of the room round it that it would gain
where nothing presses on it. Larger exchanges more at a time than the forces can tell. Tried."""

MOST_SWELLING = 0.15
"""The most that it would gain so, mean radii. Chosen."""

ROUNDING = 1e-9
"""Share of a distance below which a direction is not to be told. Derived."""


@kernel
def near_pairs(discs, radii, skin, pairs):
    """Write pairs nearer to each other than ``skin``, the larger disc first; their number.

    Each disc looks for smaller ones in the cells of a grid, so that few large ones among many small
    cost no more than their own surroundings.
    """
    n = radii.shape[0]
    cell = 2.0 * radii.mean() + skin
    left, top = discs[:, 0].min(), discs[:, 1].min()
    columns = int((discs[:, 0].max() - left) / cell) + 1
    rows = int((discs[:, 1].max() - top) / cell) + 1
    starts, cells = np.zeros(rows * columns + 1, np.int64), np.empty(n, np.int64)
    for i in range(n):
        row, column = int((discs[i, 1] - top) / cell), int((discs[i, 0] - left) / cell)
        cells[i] = row * columns + column
        starts[cells[i] + 1] += 1
    starts = np.cumsum(starts)
    ends, order = starts.copy(), np.empty(n, np.int64)
    for i in range(n):
        order[ends[cells[i]]] = i
        ends[cells[i]] += 1
    count = 0
    for i in order:
        x, y, own = discs[i, 0], discs[i, 1], radii[i]
        reach = 2.0 * own + skin
        first = max(int((x - reach - left) / cell), 0) if x - reach > left else 0
        last = min(int((x + reach - left) / cell), columns - 1)
        row = max(int((y - reach - top) / cell), 0) if y - reach > top else 0
        while row < rows and top + row * cell <= y + reach:
            for at in range(starts[row * columns + first], starts[row * columns + last + 1]):
                j = order[at]
                if radii[j] > own or (radii[j] == own and j <= i):
                    continue
                dx, dy, near = x - discs[j, 0], y - discs[j, 1], own + radii[j] + skin
                if dx * dx + dy * dy < near * near:
                    if count < pairs.shape[0]:
                        pairs[count, 0], pairs[count, 1] = i, j
                    count += 1
            row += 1
    return count


@helper
def _listed(discs, radii, skin, pairs):
    """Pairs nearer than ``skin``, in an array that is long enough; their number."""
    count = near_pairs(discs, radii, skin, pairs)
    if count > pairs.shape[0]:
        pairs = np.empty((count + count // 4, 2), np.int64)
        count = near_pairs(discs, radii, skin, pairs)
    return pairs, count


@helper
def _energy(discs, radii, rim, wall, pairs, count, force, load):
    """Half the sum of squared overlaps, of discs and with the edge; forces and sums of overlaps."""
    energy = 0.0
    _, corner, cell, least, _, _ = wall
    for i in range(radii.shape[0]):
        force[i, 0], force[i, 1], load[i] = 0.0, 0.0, 0.0
        row, column = int((discs[i, 1] - corner[1]) / cell), int((discs[i, 0] - corner[0]) / cell)
        row, column = min(max(row, 0), least.shape[0] - 1), min(max(column, 0), least.shape[1] - 1)
        if least[row, column] >= radii[i] + rim:
            continue
        fx, fy, total, own = edge_push(wall, discs[i, 0], discs[i, 1], radii[i] + rim)
        force[i, 0], force[i, 1] = WALL * fx, WALL * fy
        load[i] = WALL * total
        energy += WALL * own
    for p in range(count):
        i, j = pairs[p, 0], pairs[p, 1]
        dx, dy = discs[i, 0] - discs[j, 0], discs[i, 1] - discs[j, 1]
        apart, square = radii[i] + radii[j], dx * dx + dy * dy
        if square >= apart * apart:
            continue
        near = math.sqrt(square)
        deep = apart - near
        energy += 0.5 * deep * deep
        push = deep / max(near, ROUNDING * apart)
        force[i, 0] += push * dx
        force[i, 1] += push * dy
        force[j, 0] -= push * dx
        force[j, 1] -= push * dy
        load[i] += deep
        load[j] += deep
    return energy


@helper
def _exchange(discs, radii, owners, rim, wall, pairs, count, load):
    """Give each place the radius of its rank by what it would like; the largest change.

    A place under pressure would like to be smaller, one with room larger. All radii there are get a
    place: those wished for and those given are in the same order, which is the nearest that any
    exchange comes to the wishes.
    """
    n = radii.shape[0]
    mean = radii.mean()
    room = np.empty(n)
    for i in range(n):
        own = radii[i] + rim
        room[i] = edge_distance(wall, discs[i, 0], discs[i, 1], own + mean) - own
    for p in range(count):
        i, j = pairs[p, 0], pairs[p, 1]
        near = math.hypot(discs[i, 0] - discs[j, 0], discs[i, 1] - discs[j, 1])
        free = near - radii[i] - radii[j]
        room[i], room[j] = min(room[i], free), min(room[j], free)
    wish = np.empty(n)
    for i in range(n):
        if load[i] > 0.0:
            wish[i] = radii[i] - SHRINKING * load[i]
        else:
            wish[i] = radii[i] + min(SWELLING * room[i], MOST_SWELLING * mean)
    now, then = np.argsort(radii, kind="mergesort"), np.argsort(wish, kind="mergesort")
    new_radii, new_owners, change = np.empty(n), np.empty(n, np.int64), 0.0
    for k in range(n):
        new_radii[then[k]], new_owners[then[k]] = radii[now[k]], owners[now[k]]
        change = max(change, abs(radii[now[k]] - radii[then[k]]))
    radii[:] = new_radii
    owners[:] = new_owners
    return change


@helper
def _step(discs, velocity, force, mass, state, most):
    """One step of FIRE, in place; ``state``: time step, steering, steps downhill."""
    n = discs.shape[0]
    power, pull, speed = 0.0, 0.0, 0.0
    for i in range(n):
        for axis in range(2):
            along = force[i, axis] / mass[i]
            power += force[i, axis] * velocity[i, axis]
            pull += along * along
            speed += velocity[i, axis] * velocity[i, axis]
    keep, steer = 0.0, 0.0
    if power > 0.0:
        state[2] += 1.0
        keep = 1.0 - state[1]
        steer = state[1] * math.sqrt(speed / pull)
        if state[2] > PATIENCE:
            state[0], state[1] = min(state[0] * FASTER, LONGEST), state[1] * EASING
    else:
        state[0], state[1], state[2] = max(state[0] * SLOWER, SHORTEST), STEERING, 0.0
    fastest = 0.0
    for i in range(n):
        for axis in range(2):
            along = force[i, axis] / mass[i]
            velocity[i, axis] = keep * velocity[i, axis] + (steer + state[0]) * along
            fastest = max(fastest, abs(velocity[i, axis]))
    time = state[0] if fastest * state[0] <= most else most / fastest
    for i in range(n):
        for axis in range(2):
            discs[i, axis] += time * velocity[i, axis]


@kernel
def relax(discs, radii, owners, rim, wall, steps, every, still):
    """Go down the energy of overlaps, in place; the energy, and the steps made.

    ``rim``: what a disc keeps from the edge beyond its radius; ``every``: steps between exchanges
    of radii, 0 for none; ``still``: energy at which it ends.

    FIRE: E. Bitzek, P. Koskinen, F. Gaehler, M. Moseler and P. Gumbsch, "Structural relaxation made
    simple", Physical Review Letters 97 (2006), 170201, doi:10.1103/PhysRevLett.97.170201.
    """
    n = radii.shape[0]
    mean = radii.mean()
    skin = SKIN * mean
    pairs, count = _listed(discs, radii, skin, np.empty((12 * n + 16, 2), np.int64))
    seen, grown = discs.copy(), 0.0
    velocity, force, load = np.zeros((n, 2)), np.empty((n, 2)), np.empty(n)
    # A large disc has more neighbours, which hold it the more stiffly.
    mass = 0.5 + 0.5 * radii / mean
    state = np.array([FIRST, STEERING, 0.0])
    energy = 0.0
    for step in range(steps):
        moved = 0.0
        for i in range(n):
            dx, dy = discs[i, 0] - seen[i, 0], discs[i, 1] - seen[i, 1]
            moved = max(moved, dx * dx + dy * dy)
        if 2.0 * (math.sqrt(moved) + grown) > skin:
            pairs, count = _listed(discs, radii, skin, pairs)
            seen[:], grown = discs, 0.0
        energy = _energy(discs, radii, rim, wall, pairs, count, force, load)
        if energy <= still:
            return energy, step
        if every > 0 and step % every == every - 1:
            grown += _exchange(discs, radii, owners, rim, wall, pairs, count, load)
            mass = 0.5 + 0.5 * radii / mean
        else:
            _step(discs, velocity, force, mass, state, 0.25 * skin)
    return energy, steps


@kernel
def excess(discs, radii, swelling, rim, wall):
    """Energy of overlaps, and its slope when each radius grows by ``swelling`` times a factor."""
    n = radii.shape[0]
    pairs, count = _listed(discs, radii, 0.0, np.empty((6 * n + 16, 2), np.int64))
    force, load = np.empty((n, 2)), np.empty(n)
    energy = _energy(discs, radii, rim, wall, pairs, count, force, load)
    slope = 0.0
    for i in range(n):
        slope += swelling[i] * load[i]
    return energy, slope


@kernel
def clear_scales(discs, own, margin, rim, wall, scale):
    """Largest scale at which each disc keeps clear of all others and of the edge.

    ``own``: radii at scale 1; ``margin``: half the gap; ``scale``: near the least of those sought.
    """
    n = own.shape[0]
    radii = scale * own + margin
    pairs, count = _listed(discs, radii, radii.mean(), np.empty((12 * n + 16, 2), np.int64))
    # Pairs that are not listed allow more than that.
    found = np.full(n, scale * (1.0 + radii.mean() / (2.0 * radii.max())))
    for i in range(n):
        least = margin + rim
        far = edge_distance(wall, discs[i, 0], discs[i, 1], found[i] * own[i] + least)
        found[i] = min(found[i], (far - least) / own[i])
    for p in range(count):
        i, j = pairs[p, 0], pairs[p, 1]
        far = math.hypot(discs[i, 0] - discs[j, 0], discs[i, 1] - discs[j, 1])
        apart = (far - 2.0 * margin) / (own[i] + own[j])
        found[i], found[j] = min(found[i], apart), min(found[j], apart)
    return found
