"""First fit: parts, one after another, are laid where nothing that lies has to give way."""

from __future__ import annotations

import numpy as np

from packwork.compiled import kernel
from packwork.separation.kernels.collision import SHAPE, SIDE, X0, X1, Y0, Y1, X
from packwork.separation.kernels.moves import (
    DESCENTS,
    PROPOSED,
    best_place,
    nearest_turn,
    put_part,
    turn_to,
)


@kernel
def lay_first_fit(order, state, layout, weights, shapes, table, sheet, pixel, image, scores,
                  turned, scratch, full):  # fmt: skip
    """Lay parts in an order; one without such a place stays where it is not laid, as do its like.

    ``state``: of the random numbers; ``full``: true for kinds of which none is tried, and for those
    of which one found no place. Returns the number of places that were priced.
    """
    items, index = layout[0], layout[1]
    turns, turn_at = table[0], table[1]
    found, best, nothing = np.empty((PROPOSED, 4)), np.empty((DESCENTS, 5)), np.empty(0)
    tried = 0
    for i in order:
        shape = index[i, SHAPE]
        if full[shape]:
            continue
        # Anywhere, so that places near where it lies are not all alike.
        first = turn_at[shape]
        turn_to(shape, turns[2, first], first, shapes, turns, turned)
        put_part(i, sheet[0] / 2.0, sheet[1] / 2.0, turns[2, first], turns[3, first], first, layout,
                 turned)  # fmt: skip
        best[:, 0] = np.inf
        tried += best_place(i, best, found, state, layout, weights, shapes, table, sheet, pixel,
                            image, scores, turned, scratch, nothing)  # fmt: skip
        if best[0, 0] == 0.0:
            angle, turn = best[0, 3], int(best[0, 4])
            if table[2][shape]:
                turn = nearest_turn(shape, angle, turns[3, turn], table)
            turn_to(shape, angle, turn, shapes, turns, turned)
            put_part(i, best[0, 1], best[0, 2], angle, turns[3, turn], turn, layout, turned)
            continue
        full[shape] = True
        items[X : SIDE + 1, i] = np.nan
        items[X0, i], items[Y0, i], items[X1, i], items[Y1, i] = (
            np.inf, np.inf, -np.inf, -np.inf,
        )  # fmt: skip
    return tried
