"""Circle packing about the origin: front chain, descent of squared overlaps, hops.

``discs``: ``(n, 2)`` centres. Overlaps of discs, and what they stick out of the circle, are
squared and summed, with the circle's own square as a pressure, and go down by L-BFGS (J. Nocedal,
"Updating quasi-Newton matrices with limited storage", Mathematics of Computation 35 (1980),
773-782). Sources of the whole: ``settle/round_pack.py``.
"""

from __future__ import annotations

import math

import numpy as np

from packwork.compiled import helper, kernel

PRESSURES = (1e-1, 1e-2, 1e-3)
"""Weights of the circle's square, one after another. A smaller last one leaves less overlap, by
which all is spread at the end, and takes longer. Tried."""

STEPS = (30, 40, 80)
"""Steps of descent at each of them, at most. Tried."""

STILL = 1e-5
"""Slope, in shares of the pressure's, at which a descent ends. Chosen."""

MEMORY = 8
"""Steps that a descent remembers. Chosen."""

CURVED = 1e-12
"""Least curvature along a step that is remembered. Chosen."""

HALVINGS = 12
"""Halvings of a step before a descent ends. Chosen."""

ENOUGH = 1e-4
"""Share of what the slope promises that a step has to gain. As usual (Armijo)."""

SAMPLES = 48
"""Places that are looked at for the largest hole. More finds the same hole each time. Tried."""

RIM = 0.6
"""Breadth of the rim, mean radii, of which discs are taken out. Tried."""

SHAKE = 0.35
"""Standard deviation by which discs near a place are shaken, mean radii. Tried."""

NEAR = 5.0
"""How far from that place, mean radii. Tried."""

BETTER = 1e-7
"""Share by which a circle has to be smaller to be better. Chosen."""

SKIN = 1.0
"""Distance up to which pairs are listed, mean radii; they are looked for anew after an eighth of
it, and no step is longer. Larger lists more, smaller looks more often. Chosen."""

ROUNDING = 1e-9
"""Share of a distance that rounding may take. Derived, as for the check of the finish."""

NOTHING = 1e-300
"""Guard of divisions by a distance of 0. Derived: the least of normal numbers, about."""


@kernel
def front_chain(radii, order, shift, aside):
    """Front chain: discs one after another where they touch two and lie nearest to the origin.

    The first two touch each other across the origin, moved by ``shift`` along their line and
    by ``aside`` off it. ``order``: the largest first.
    """
    n = radii.shape[0]
    discs = np.zeros((n, 2))
    pairs, count = np.empty((32 * n, 4), np.int64), 0
    for k in range(n):
        i = order[k]
        # None that comes is wider than the next.
        widest = 2.0 * radii[order[k + 1]] if k + 1 < n else 0.0
        if k < 2:
            apart = 0.0 if n == 1 else radii[order[0]] + radii[order[1]]
            discs[i, 0], discs[i, 1] = shift + (apart if k else 0.0) - radii[order[0]], aside
        else:
            best = np.inf
            for p in range(count):
                best = _touching(discs, radii, order, k, pairs[p], best)
        for c in range(k):
            j = order[c]
            dx, dy = discs[i, 0] - discs[j, 0], discs[i, 1] - discs[j, 1]
            reach = radii[i] + radii[j] + widest
            if dx * dx + dy * dy < reach * reach:
                if count == pairs.shape[0]:
                    fewer, pairs = pairs, np.empty((2 * count, 2), np.int64)
                    for p in range(count):
                        pairs[p, 0], pairs[p, 1] = fewer[p, 0], fewer[p, 1]
                pairs[count, 0] = pairs[count, 2] = pairs[count, 3] = j
                pairs[count, 1] = i
                count += 1
    return discs


@helper
def _meet(x, y, own, discs, radii, j):
    """True if a disc at a point meets another."""
    least = (own + radii[j]) * (1.0 - ROUNDING)
    return (x - discs[j, 0]) ** 2 + (y - discs[j, 1]) ** 2 < least * least


@helper
def _touching(discs, radii, order, k, pair, best):
    """Put disc ``order[k]`` where it touches a pair, if that is free and better.

    ``pair``: two discs, and which one was in the way on either side the last time.
    """
    i, a, b = order[k], pair[0], pair[1]
    along_x, along_y = discs[b, 0] - discs[a, 0], discs[b, 1] - discs[a, 1]
    square = along_x * along_x + along_y * along_y
    one, other = radii[a] + radii[i], radii[b] + radii[i]
    if square >= (one + other) * (one + other) or square <= (one - other) * (one - other):
        return best
    along = (one * one - other * other + square) / (2.0 * square)
    across = math.sqrt(max(one * one / square - along * along, 0.0))
    for side in range(2):
        x = discs[a, 0] + along * along_x - (2 * side - 1) * across * along_y
        y = discs[a, 1] + along * along_y + (2 * side - 1) * across * along_x
        height = x * x + y * y
        if height >= best * (1.0 - ROUNDING):
            continue
        if _meet(x, y, radii[i], discs, radii, pair[2 + side]):
            continue
        is_free = True
        for c in range(k):
            if _meet(x, y, radii[i], discs, radii, order[c]):
                pair[2 + side] = order[c]
                is_free = False
                break
        if is_free:
            best = height
            discs[i, 0], discs[i, 1] = x, y
    return best


@helper
def _near(z, radii, skin):
    """``(k, 2)`` discs that are nearer to each other than ``skin``."""
    n = radii.shape[0]
    pairs, count = np.empty((12 * n + 16, 2), np.int64), 0
    order = np.argsort(z[0 : 2 * n : 2])
    widest = radii.max()
    for a in range(n):
        i = order[a]
        x, y = z[2 * i], z[2 * i + 1]
        for b in range(a + 1, n):
            j = order[b]
            dx, dy = z[2 * j] - x, z[2 * j + 1] - y
            if dx > radii[i] + widest + skin:
                break
            reach = radii[i] + radii[j] + skin
            if dx * dx + dy * dy < reach * reach:
                if count == pairs.shape[0]:
                    fewer, pairs = pairs, np.empty((2 * count, 2), np.int64)
                    for p in range(count):
                        pairs[p, 0], pairs[p, 1] = fewer[p, 0], fewer[p, 1]
                pairs[count, 0], pairs[count, 1] = i, j
                count += 1
    return pairs[:count]


@helper
def _energy(z, radii, pairs, pressure, slope):
    """Cost of discs and circle, ``z`` x and y of each and the circle's radius; its slope."""
    n = radii.shape[0]
    circle = z[2 * n]
    total = pressure * circle * circle
    slope[:] = 0.0
    slope[2 * n] = 2.0 * pressure * circle
    for i in range(n):
        x, y = z[2 * i], z[2 * i + 1]
        far = math.sqrt(x * x + y * y)
        out = far + radii[i] - circle
        if out > 0.0:
            total += out * out
            slope[2 * n] -= 2.0 * out
            if far > 0.0:
                slope[2 * i] += 2.0 * out * x / far
                slope[2 * i + 1] += 2.0 * out * y / far
    for p in range(pairs.shape[0]):
        i, j = pairs[p, 0], pairs[p, 1]
        apart = radii[i] + radii[j]
        dx, dy = z[2 * i] - z[2 * j], z[2 * i + 1] - z[2 * j + 1]
        square = dx * dx + dy * dy
        if square >= apart * apart:
            continue
        near = math.sqrt(square)
        deep = apart - near
        total += deep * deep
        push = 2.0 * deep / max(near, ROUNDING * apart)
        slope[2 * i] -= push * dx
        slope[2 * i + 1] -= push * dy
        slope[2 * j] += push * dx
        slope[2 * j + 1] += push * dy
    return total


@helper
def _dot(a, b):
    """Scalar product. Loops, here and below: array expressions take LLVM four times as long."""
    total = 0.0
    for k in range(a.shape[0]):
        total += a[k] * b[k]
    return total


@helper
def _farthest(a, b, count):
    """Largest difference of the first numbers."""
    most = 0.0
    for k in range(count):
        most = max(most, abs(a[k] - b[k]))
    return most


@helper
def _combine(a, share, b, out):
    """Write ``a + share * b``."""
    for k in range(a.shape[0]):
        out[k] = a[k] + share * b[k]


@helper
def _way_down(slope, steps, bends, count, way):
    """Write the direction of L-BFGS: two loops over the last steps and changes of slope."""
    shares = np.empty(MEMORY)
    _combine(slope, -2.0, slope, way)
    latest = min(count, MEMORY)
    for back in range(latest):
        k = (count - 1 - back) % MEMORY
        shares[k] = _dot(steps[k], way) / _dot(steps[k], bends[k])
        _combine(way, -shares[k], bends[k], way)
    scale = 0.1
    if count > 0:
        k = (count - 1) % MEMORY
        scale = _dot(steps[k], bends[k]) / _dot(bends[k], bends[k])
    _combine(way, scale - 1.0, way, way)
    for back in range(latest - 1, -1, -1):
        k = (count - 1 - back) % MEMORY
        _combine(way, shares[k] - _dot(bends[k], way) / _dot(steps[k], bends[k]), steps[k], way)


@helper
def _descend(z, radii, pressure, most):
    """Go down the energy, in place."""
    n = z.shape[0]
    steps, bends, still = np.empty((MEMORY, n)), np.empty((MEMORY, n)), np.zeros(n)
    slope, new_slope, way, new = np.empty(n), np.empty(n), np.empty(n), np.empty(n)
    skin = SKIN * radii.mean()
    pairs, seen = _near(z, radii, skin), z.copy()
    value = _energy(z, radii, pairs, pressure, slope)
    count = 0
    least = STILL * 2.0 * pressure * z[n - 1]
    for _ in range(most):
        if _farthest(slope, still, n) < least:
            break
        _way_down(slope, steps, bends, count, way)
        promised = _dot(way, slope)
        if promised >= 0.0:
            count = 0
            _combine(still, -0.1, slope, way)
            promised = _dot(way, slope)
        share, found = min(1.0, 0.125 * skin / _farthest(way, still, n - 1)), False
        for _ in range(HALVINGS):
            _combine(z, share, way, new)
            now = _energy(new, radii, pairs, pressure, new_slope)
            if now <= value + ENOUGH * share * promised:
                found = True
                break
            share *= 0.5
        if not found:
            break
        k = count % MEMORY
        _combine(new, -1.0, z, steps[k])
        _combine(new_slope, -1.0, slope, bends[k])
        if _dot(steps[k], bends[k]) > CURVED:
            count += 1
        _combine(new, 0.0, still, z)
        _combine(new_slope, 0.0, still, slope)
        value = now
        if _farthest(z, seen, n - 1) > 0.125 * skin:
            pairs, seen = _near(z, radii, skin), z.copy()


@kernel
def circle_of(discs, radii):
    """Radius of the circle about the origin that holds all discs."""
    circle = 0.0
    for i in range(radii.shape[0]):
        circle = max(circle, math.sqrt(discs[i, 0] ** 2 + discs[i, 1] ** 2) + radii[i])
    return circle


@kernel
def squeeze(discs, radii):
    """Minimise overlaps under pressure, then spread until none meet, in place; the radius."""
    n = radii.shape[0]
    z = np.empty(2 * n + 1)
    z[: 2 * n] = discs.ravel()
    z[2 * n] = circle_of(discs, radii)
    for k in range(len(PRESSURES)):
        _descend(z, radii, PRESSURES[k], STEPS[k])
    spread = 0.0
    pairs = _near(z, radii, 0.0)
    for p in range(pairs.shape[0]):
        i, j = pairs[p, 0], pairs[p, 1]
        far = math.sqrt((z[2 * i] - z[2 * j]) ** 2 + (z[2 * i + 1] - z[2 * j + 1]) ** 2)
        spread = max(spread, (radii[i] + radii[j]) / max(far, NOTHING))
    if pairs.shape[0] == 0:
        spread = 1.0
    for i in range(n):
        discs[i, 0], discs[i, 1] = spread * z[2 * i], spread * z[2 * i + 1]
    return circle_of(discs, radii)


@helper
def _into_hole(discs, radii, circle, draws):
    """Put one of the rim's discs where there is most room for it, in place."""
    n = radii.shape[0]
    mean = radii.mean()
    chosen, most = 0, -1.0
    for i in range(n):
        far = math.sqrt(discs[i, 0] ** 2 + discs[i, 1] ** 2) + radii[i]
        if far > circle - RIM * mean:
            # Each disc of the rim as likely as the others.
            lot = (draws[0] * 9973.0 * (i + 1)) % 1.0
            if lot > most:
                chosen, most = i, lot
    best, x, y = -np.inf, 0.0, 0.0
    for k in range(SAMPLES):
        turn = 2.0 * math.pi * draws[1 + 2 * k]
        off = (circle - radii[chosen]) * math.sqrt(draws[2 + 2 * k])
        at_x, at_y = off * math.cos(turn), off * math.sin(turn)
        room = np.inf
        for j in range(n):
            if j != chosen:
                far = math.sqrt((at_x - discs[j, 0]) ** 2 + (at_y - discs[j, 1]) ** 2)
                room = min(room, far - radii[j])
        if room > best:
            best, x, y = room, at_x, at_y
    discs[chosen, 0], discs[chosen, 1] = x, y


@helper
def _shake(discs, radii, circle, draws):
    """Move the discs near a place at random, in place."""
    mean = radii.mean()
    turn, off = 2.0 * math.pi * draws[0], circle * math.sqrt(draws[1])
    x, y = off * math.cos(turn), off * math.sin(turn)
    for i in range(radii.shape[0]):
        if (discs[i, 0] - x) ** 2 + (discs[i, 1] - y) ** 2 < (NEAR * mean) ** 2:
            for c in range(2):
                lot = draws[(2 + 2 * i + c) % draws.shape[0]]
                discs[i, c] += SHAKE * mean * 3.4 * (lot - 0.5)


@kernel
def hop(discs, radii, draws):
    """Monotonic basin hopping: keep hops with a smaller circle, in place; its radius.

    ``draws``: ``(k, m)`` numbers from 0 to 1, a row for each trial.
    """
    circle = circle_of(discs, radii)
    for k in range(draws.shape[0]):
        trial = discs.copy()
        if draws[k, 0] < 0.5:
            _into_hole(trial, radii, circle, draws[k, 1:])
        else:
            _shake(trial, radii, circle, draws[k, 1:])
        now = squeeze(trial, radii)
        if now < circle * (1.0 - BETTER):
            circle = now
            discs[:] = trial
    return circle
