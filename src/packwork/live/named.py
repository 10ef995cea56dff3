"""Sessions as people use them: items by name, lengths as they write them."""

from __future__ import annotations

import contextlib
import fnmatch
import re
from collections.abc import Iterable, Mapping, Sequence
from numbers import Integral
from types import MappingProxyType, TracebackType
from typing import Any, Self, TypeAlias

import numpy as np

from packwork.errors import RecipeError
from packwork.live.anew import poured_again
from packwork.live.assets import named_container, named_item
from packwork.live.certificate import Settlement
from packwork.live.commands.command import Command, made
from packwork.live.commands.container import PlaceContainer, Reshape, SetContainer, SetOption
from packwork.live.commands.holding import Hold, Release
from packwork.live.commands.items import Duplicate, Recolour, Remove, Rename, Replace, Weigh
from packwork.live.commands.placing import Cover, Exchange, Move, Scale, Turn
from packwork.live.commands.together import Together
from packwork.live.composed import brought, counted, worded, words_of
from packwork.live.document import PROPERTIES, Property
from packwork.live.picturing import showing
from packwork.live.session import Session
from packwork.recipe.refusals import length_asked
from packwork.recipe.rules import MAX_COUNT
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.units import parse_share

Which: TypeAlias = str | int | Sequence[str | int]
"""An item: its name, ``owl``, or of several of that name ``owl#2``; ``*`` stands for any letters;
or its number. Where several go, a list of these too."""

Coordinate: TypeAlias = str | float
"""Canvas units, or a length such as ``10mm``; ``45%`` is a share of the canvas' width or height."""

_COPY = re.compile(r"(?P<name>.+)#(?P<copy>[1-9][0-9]{0,5})")

NOTHING: Mapping[str, Any] = MappingProxyType({})

TRIALS = 4
"""Turns tried for each item that was touched, when a block ends. Chosen."""


class NamedSession(Session):
    """A session with a verb for each command."""

    _letters: Mapping[str, Any] = NOTHING
    """How words were asked to be set, last."""

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if kind is None:
            self.finish()

    def finish(self) -> Settlement:
        """Settle, and win back coverage where something was touched; what it came to."""
        found = self.settle()
        self.polish(TRIALS * max(found.moved, 1))
        return Settlement(self.is_certified, self.in_the_way, found.moved)

    def find(self, which: Which) -> tuple[int, ...]:
        """Numbers of the items that a name means, in their order; :meth:`positions` are others.

        Raises
        ------
        RecipeError
            If there is none.
        """
        document = self.document
        if isinstance(which, list | tuple | set | frozenset):
            return tuple(dict.fromkeys(k for one in which for k in self.find(one)))
        if isinstance(which, Integral) and not isinstance(which, bool):
            if document.index(int(which)) is None:
                numbers = f"{document.ids.min()} to {document.ids.max()}"
                raise RecipeError("item", f"there is no item {which}; numbers go from {numbers}")
            return (int(which),)
        text = str(which)
        names = [item.name for item in document.items]
        copy = None if text in names else _COPY.fullmatch(text)
        pattern = copy["name"] if copy else text
        rows = [k for k, name in enumerate(names) if name == pattern]
        rows = rows or [k for k, name in enumerate(names) if fnmatch.fnmatchcase(name, pattern)]
        if copy:
            rows = rows[int(copy["copy"]) - 1 : int(copy["copy"])]
        if not rows:
            raise RecipeError("item", f"there is no item {text[:40]!r}; {_some(names)}")
        return tuple(int(document.ids[k]) for k in rows)

    def positions(self, which: Which) -> list[int]:
        """Places of items in :attr:`layout`, for such as ``layout.poses.x[positions]``.

        Numbers that :meth:`find` gives are for ever; positions are others once items are removed.

        Raises
        ------
        RecipeError
            If there is no such item.
        """
        rows = {int(number): k for k, number in enumerate(self.document.ids)}
        return [rows[number] for number in self.find(which)]

    def one(self, which: Which) -> int:
        """Number of the one item that a name means.

        Raises
        ------
        RecipeError
            If there is none, or more than one.
        """
        found = self.find(which)
        if len(found) > 1:
            raise RecipeError(
                "item", f"{len(found)} items are called {which}; say {which}#1 to "
                f"{which}#{len(found)}",
            )  # fmt: skip
        return found[0]

    def move(self, which: Which, x: Coordinate, y: Coordinate) -> None:
        """Put an item's middle somewhere."""
        container = self.document.container
        across = self._length("x", x, container.width)
        along = self._length("y", y, container.height)
        self.apply(made(Move, item=self.one(which), x=across, y=along))

    def turn(self, which: Which, degrees: float) -> None:
        """Turn an item to an angle from upright, clockwise."""
        self.apply(made(Turn, item=self.one(which), angle=degrees))

    def scale(self, which: Which, factor: float) -> None:
        """Make an item so many times as large; it then keeps about that size."""
        self.apply(made(Scale, item=self.one(which), factor=factor))

    def exchange(self, first: Which, second: Which) -> None:
        """Let two items change places."""
        self.apply(made(Exchange, first=self.one(first), second=self.one(second)))

    def hold(self, which: Which, *properties: Property) -> None:
        """Hold items exactly as they are: ``place``, ``angle``, ``size``, or all of it."""
        asked = properties or PROPERTIES
        self.apply(made(Hold, items=self.find(which), properties=asked))

    def release(self, which: Which, *properties: Property) -> None:
        """Let go of what is held."""
        asked = properties or PROPERTIES
        self.apply(made(Release, items=self.find(which), properties=asked))

    def add_items(
        self, items: Sequence[Item], x: Coordinate | None = None, y: Coordinate | None = None
    ) -> tuple[int, ...]:
        """Bring items, there or where there is most room; their numbers."""
        if (x is None) != (y is None):
            raise RecipeError("add", "takes both x and y, or neither")
        first, container = self.document.next_id, self.document.container
        commands: list[Command] = list(brought(self.document, self.library, self.shapes, items))
        if x is not None and y is not None:
            place = {
                "x": self._length("x", x, container.width),
                "y": self._length("y", y, container.height),
            }
            # A place is noted where it is moved to; of several items one only can have it.
            asked = [made(Move, item=first, **place)] if len(items) == 1 else []
            commands = [*(command.model_copy(update=place) for command in commands), *asked]
        self._together(commands)
        return tuple(range(first, first + len(items)))

    def remove(self, which: Which) -> None:
        """Take items away; their neighbours grow into the room."""
        self.apply(made(Remove, items=self.find(which)))

    def duplicate(self, which: Which) -> int:
        """Bring a copy of an item; its number."""
        number = self.document.next_id
        self.apply(made(Duplicate, item=self.one(which)))
        return number

    def replace_by(self, which: Which, item: Item) -> None:
        """Put another item in an item's place."""
        self.apply(made(Replace, item=self.one(which), asset=named_item(self.library, item)))

    def weigh(self, which: Which, weight: float) -> None:
        """Give items another weight, in the unit of ``layout.weights``; they grow or shrink."""
        self.apply(made(Weigh, items=self.find(which), weight=weight))

    def rename(self, which: Which, name: str) -> None:
        """Give an item another name."""
        self.apply(made(Rename, item=self.one(which), name=name))

    def recolor(self, which: Which, color: str) -> None:
        """Give items one colour, any CSS colour."""
        self.apply(made(Recolour, items=self.find(which), colour=color))

    @property
    def canvas(self) -> str:
        """Longer side of the canvas as options say it."""
        container = self.document.container
        return f"{container.side:.17g}{container.unit}"

    def fill_container(self, container: Container) -> None:
        """Fill another container, on a canvas as large."""
        self.apply(made(SetContainer, asset=named_container(self.library, container)))

    def reshape(self, rings: Iterable[Iterable[tuple[float, float]]]) -> None:
        """Give the container other vertices, canvas units."""
        try:
            listed = [np.asarray(ring, dtype=np.float64).reshape(-1, 2).tolist() for ring in rings]
        except (TypeError, ValueError):
            raise RecipeError(
                "rings", "must be a list of rings, each a list of vertices (x, y)"
            ) from None
        if not listed or any(len(ring) < 3 for ring in listed):
            raise RecipeError("rings", "must be one ring at least, each of three vertices (x, y)")
        self.apply(made(Reshape, rings=listed))

    def place_container(
        self, x: float = 0.0, y: float = 0.0, factor: float = 1.0, angle: float = 0.0
    ) -> None:
        """Move the container on its canvas, scale and turn it, in degrees, about its middle."""
        self.apply(made(PlaceContainer, x=x, y=y, factor=factor, angle=angle))

    def set(self, /, **options: str | float | Sequence[str]) -> None:
        """Set numbers for all: ``padding``, ``sizes``, ``rotate``, ``force`` and so on."""
        container, given = self.document.container, dict(options)
        asked = given.get("padding")
        if isinstance(asked, str | int | float):
            given["padding"] = length_asked("padding", asked, container.unit, container.side)
        self._together([made(SetOption, name=name, value=value) for name, value in given.items()])

    def count(self, count: int) -> None:
        """Have so many items: copies of what is least there come, of what is most there go."""
        if not isinstance(count, Integral) or isinstance(count, bool) or not 0 < count <= MAX_COUNT:
            raise RecipeError(
                "count", f"must be a whole number from 1 to {MAX_COUNT}, not {count!r}"
            )
        self._together(list(counted(self.document, self.library, self.shapes, int(count))))

    def cover(self, share: str | float) -> None:
        """Make all larger or smaller, to cover a share of the container: ``.7`` or ``"70%"``."""
        try:
            asked = float(str(parse_share(share)))
        except (TypeError, ValueError) as error:
            raise RecipeError("cover", f"must be a share such as 70%, not {share!r}") from error
        if not 0 < asked < 1:
            raise RecipeError("cover", f"must be a share such as 70%, not {share}")
        self.apply(made(Cover, share=asked))

    def show_picture(self, source: str) -> None:
        """Give each item the colour of a picture under it; photographs keep theirs."""
        self.apply(showing(self.document, source))

    def arrange(self, way: str, *, seed: int = 0) -> None:
        """Put all anew in an order, as ``outwards by=weight``; what is held stays.

        A run of its own, of seconds; later verbs move items out of that order.
        """
        self.apply(poured_again(self.document, seed, arrange=way))

    def put_alike(self, source: str, anchors: Sequence[str] = (), *, seed: int = 0) -> None:
        """Put all anew, like items side by side, by a file of vectors or ``auto``."""
        self.apply(poured_again(self.document, seed, embeddings=source, anchors=anchors))

    def set_words(self, source: object, options: Mapping[str, Any] = NOTHING) -> None:
        """Have the words of a text or a table, with its weights.

        Parameters
        ----------
        options
            How they are set, in place of what was asked before; kept for the next words.
        """
        letters = {**self._letters, **options}
        read = words_of(self.document, source, letters)
        is_lettered = bool(letters)
        self._together(
            list(worded(self.document, self.library, self.shapes, read, is_lettered=is_lettered))
        )
        self._letters = letters

    def _together(self, commands: Sequence[Command]) -> None:
        """Do commands as one gesture."""
        if commands:
            self.apply(Together(commands=tuple(commands)))  # type: ignore[arg-type]

    def _length(self, key: str, value: Coordinate, side: float) -> float:
        if isinstance(value, int | float) and not isinstance(value, bool):
            return float(value)
        with contextlib.suppress(ValueError):
            return float(str(value))
        return length_asked(key, str(value).strip(), self.document.container.unit, side)


def _some(names: list[str]) -> str:
    """A few names, for messages."""
    different = list(dict.fromkeys(names))
    more = " ..." if len(different) > 5 else ""
    return f"there are {', '.join(different[:5])}{more}" if different else "the layout is empty"
