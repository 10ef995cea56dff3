"""Places and sizes that commands have asked of items, held against what the items have got."""

from __future__ import annotations

import math
from collections.abc import Iterable

from packwork.live.commands.command import Command
from packwork.live.commands.items import Replace
from packwork.live.commands.placing import NEARLY, Arrange, Cover, Exchange, Move, Scale
from packwork.live.document import Document

NEAR = 0.005
"""Distance from the place asked for, in sides of the canvas, up to which an item is there. Larger
passes over what is seen, smaller tells of what is not. Chosen."""

ROUNDING = 1e-6
"""Share by which a size may miss its range and keep it. Derived: rounding of the finish."""


class Requests:
    """Notes of what was asked of items and not taken back since."""

    def __init__(self) -> None:
        self._places: dict[int, tuple[float, float]] = {}
        self._sizes: dict[int, tuple[float, float]] = {}

    def note(self, commands: Iterable[Command], before: Document, after: Document) -> None:
        """Note what commands ask for that have made one document of another."""
        for one in commands:
            if isinstance(one, Move):
                self._places[one.item] = one.x, one.y
            elif isinstance(one, Scale):
                row, first = after.index(one.item), before.index(one.item)
                if row is not None and first is not None:
                    known = self._sizes.get(one.item, (0.0, _size(before, first)))[1]
                    self._sizes[one.item] = _size(after, row), known
            elif isinstance(one, Arrange | Cover | Exchange | Replace):
                # Other places and sizes are asked for now.
                self.forget()

    def forget(self) -> None:
        """Take back all that was asked for."""
        self._places.clear()
        self._sizes.clear()

    def unmet(self, document: Document) -> tuple[str, ...]:
        """Sentences about what items of a document have not got."""
        poses, told = document.poses, []
        for number, (x, y) in self._places.items():
            k = document.index(number)
            if k is None or math.dist((x, y), (poses.x[k], poses.y[k])) <= (
                NEAR * document.container.side
            ):
                continue
            told.append(
                f"{called(document, k)} is at {poses.x[k]:.4g}, {poses.y[k]:.4g}, not at "
                f"{x:.4g}, {y:.4g}: there is no room for it"
            )
        for number, (asked, first) in self._sizes.items():
            k = document.index(number)
            spare = NEARLY if document.options.sizes == "free" else 1.0
            if k is None or _size(document, k) * spare >= asked * (1 - ROUNDING):
                continue
            factor = _size(document, k) / first
            told.append(
                f"{called(document, k)} is {factor:.3g} times as large as it was, "
                f"not {asked / first:.3g} times: there is no room for more"
            )
        return tuple(told)


def _size(document: Document, k: int) -> float:
    """Size of an item: beside the others' where sizes are in shares."""
    if document.options.sizes == "shared":
        return math.sqrt(document.weights[k])
    return float(document.poses.scale[k])


def called(document: Document, k: int) -> str:
    """Name of the item at a place in the document, numbered among others of it: ``owl#2``."""
    names = [item.name for item in document.items]
    name = names[k]
    return name if names.count(name) == 1 else f"{name}#{names[: k + 1].count(name)}"
