"""Copies of items between others that lie in place, each where there is most room."""

from __future__ import annotations

from collections.abc import Hashable, Sequence

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.progress import Stop, never
from packwork.scene.container import Container
from packwork.start.first_fit.graded import AHEAD, Graded, sizes_down
from packwork.start.first_fit.greedy_board import BoardPlace, Candidate, GreedyBoard, PoseRow


def fit_between(
    container: Container,
    lying: Sequence[Outline],
    candidates: Sequence[Candidate],
    smallest: FloatArray,
    rng: np.random.Generator,
    *,
    kinds: Sequence[Hashable] = (),
    margin_cu: float = 0.0,
    most: int = 1_000,
    stop: Stop = never,
) -> Graded:
    """Poses of copies between items that lie already, each where there is most room.

    Candidates are sorts of copies, in turn again and again as long as one finds a place; their
    steps are their largest scales, ``smallest`` ``(n,)`` the least. ``lying``: in place, clear of
    each other; ``kinds``: of these, as those of the candidates.

    Examples
    --------
    >>> tile = Outline.from_rings([np.array([[-1.0, -1], [1, -1], [1, 1], [-1, 1]])])
    >>> wall = tile.mapped(np.array([[50.0, 0, 50], [0, 50.0, 50]]))
    >>> container = Container("", "", wall, 100.0, 100.0)
    >>> lying = [tile.mapped(np.array([[30.0, 0, 50], [0, 30.0, 50]]))]
    >>> rng = np.random.default_rng(0)
    >>> found = fit_between(container, lying, [Candidate(tile, 9.0)], np.array([8.0]), rng)
    >>> len(found.placed), float(found.poses.scale.max())
    (16, 9.0)
    """
    board = GreedyBoard(container, len(lying) + most, rng, margin_cu)
    board.is_loose = True
    for outline, kind in zip(lying, kinds or [None] * len(lying), strict=True):
        board.lay(outline, kind)
    placed, rows = list[int](), list[PoseRow]()
    left = list(range(len(candidates)))
    sizes = [
        sizes_down(one.step, float(least)) for one, least in zip(candidates, smallest, strict=True)
    ]
    while left and len(placed) < most and not stop():
        # The first that stands beside no other of its kind, or else the first.
        found: tuple[int, BoardPlace] | None = None
        for k in left[:AHEAD]:
            place = board.find(candidates[k], sizes[k])
            if place is None:
                left.remove(k)
                continue
            # What finds no place now finds none later.
            sizes[k] = [size for size in sizes[k] if size <= place.pose[3]]
            if not place.is_beside:
                found = k, place
                break
            found = found or (k, place)
        if found is not None:
            k, place = found
            board.put(place)
            left.remove(k)
            left.append(k)
            placed.append(k)
            rows.append(place.pose)
    return Graded.of(placed, rows)
