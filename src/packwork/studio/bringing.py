"""Requests of pages that read something first: items and containers; and their choices."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from functools import cache
from typing import Any

from packwork.errors import PackworkError, ReadError
from packwork.live.anew import BY_TEXT
from packwork.live.assets import named_container, named_item
from packwork.live.commands.command import Command, made
from packwork.live.commands.container import SetContainer
from packwork.live.commands.items import Replace
from packwork.live.commands.together import Together
from packwork.live.composed import brought
from packwork.live.face.asking import questions
from packwork.live.face.bringing import (
    container_of,
    items_of,
    offered_containers,
    offered_fonts,
    offered_items,
    offered_palettes,
    only_file,
)
from packwork.live.face.drawing import FINENESS, drawing_of, path_of
from packwork.live.named import NamedSession
from packwork.scene.container import Container, on_canvas
from packwork.scene.item import Item
from packwork.studio import wire
from packwork.studio.desk import Desk
from packwork.studio.uploads import Uploads
from packwork.units import canvas_size

MOST_AT_ONCE = 24
"""Items that are put into the largest voids one by one; of more, all are poured anew. Chosen."""

_FOLDER = re.compile(r"[\\/][0-9a-f]{16}[\\/]?")

FILES = "file:"
"""What stands before the name of a batch of files."""

BUILTIN = "builtin:"
TEXT = "text:"

SAME = "same"
"""What the container of now is called."""


class Bringer:
    """Reads what pages ask for, in the desk's worker."""

    def __init__(self, desk: Desk, uploads: Uploads) -> None:
        self._desk, self._uploads = desk, uploads

    @property
    def acts(self) -> Mapping[str, Callable[[Any], object]]:
        """Handlers by type of message."""
        return {
            "bring": self._bring,
            "room": self._room,
            "swap": self._swap,
            "fill": self._fill,
            "words": self._words,
            "picture": self._picture,
            "order": self._order,
            "alike": self._alike,
        }

    def _bring(self, message: wire.Bring) -> None:
        self._read(lambda: self._brought(message))

    def _brought(self, message: wire.Bring) -> None:
        found = items_of([self._source(one) for one in message.sources])
        for left_out in found.skipped:
            self._desk.say(f"left out: {self._named(str(left_out))}", is_error=False)
        items, at = found.items, (message.x, message.y)
        if len(items) == 1 and None not in at:
            self._desk.change(lambda session: session.add_items(items, *at))
        elif len(items) <= MOST_AT_ONCE:
            self._desk.change(lambda session: session.add_items(items))
        else:
            self._desk.pour(0, lambda session: added(session, items))

    def _room(self, message: wire.Room) -> None:
        def make(session: NamedSession) -> Sequence[Command]:
            return [made(SetContainer, asset=named_container(session.library, container[0]))]

        container: list[Container] = []

        def read() -> None:
            container.append(self._room_of(message))
            self._desk.pour(0, make)

        self._read(read)

    def _room_of(self, message: wire.Room) -> Container:
        shown = self._desk.shown
        if message.source == SAME and message.canvas is not None and shown is not None:
            return on_canvas(shown.view.container, canvas_size(message.canvas))
        canvas = message.canvas or self._desk.canvas
        return container_of(self._container(message.source), canvas, self._font(message.font))

    def _fill(self, message: wire.Fill) -> None:
        def read() -> None:
            source = self._source(message.source)
            if message.use == "words" and message.source.startswith(FILES):
                source = str(only_file(self._uploads.folder(message.source.removeprefix(FILES))))
            options: dict[str, Any] = {"count": message.count}
            if message.use == "words":
                options |= {"font": self._font(message.font), "palette": message.palette}
            self._desk.fill(message.use, source, options)

        self._read(read, "Pouring")

    def _picture(self, message: wire.Picture) -> None:
        def read() -> None:
            file = str(only_file(self._uploads.folder(message.source.removeprefix(FILES))))
            self._desk.change(lambda session: session.show_picture(file))

        self._read(read)

    def _order(self, message: wire.Order) -> None:
        asked = {"arrange": f"{message.way} by={message.by}"}
        self._read(lambda: self._desk.pour_now(asked), "Pouring")

    def _alike(self, message: wire.Alike) -> None:
        def read() -> None:
            source = message.source
            if source != BY_TEXT:
                source = str(only_file(self._uploads.folder(source.removeprefix(FILES))))
            self._desk.pour_now({"embeddings": source})

        self._read(read, "Pouring")

    def _words(self, message: wire.Words) -> None:
        def read() -> None:
            font = self._font(message.font)
            options = {} if font is None else {"fonts": [font]}

            def act(session: NamedSession) -> None:
                session.set_words(dict(message.words), options)

            self._desk.change(act)

        self._read(read)

    def _swap(self, message: wire.Swap) -> None:
        def read() -> None:
            (item, *_) = items_of([self._source(message.source)]).items
            self._desk.change(lambda session: session.apply(replaced(session, message.items, item)))

        self._read(read)

    def _read(self, job: Callable[[], object], what: str = "Reading") -> None:
        """Have something read; what is refused names no folder of ours."""

        def read() -> None:
            try:
                job()
            except PackworkError as error:
                raise PackworkError(self._named(str(error))) from error

        self._desk.work(what, read)

    def _source(self, asked: str) -> str:
        """Source that a page names, as readers name it."""
        if asked.startswith(FILES):
            return str(self._uploads.folder(asked.removeprefix(FILES)))
        if asked.startswith(BUILTIN):
            return asked
        raise ReadError(asked[:40], "is neither bundled nor a file that was sent")

    def _container(self, asked: str) -> str:
        if asked.startswith(FILES):
            return str(only_file(self._uploads.folder(asked.removeprefix(FILES))))
        return asked if asked.startswith(TEXT) else self._source(asked)

    def _font(self, asked: str | None) -> str | None:
        """A font as readers call it: pages name no files of this machine."""
        if asked is None or asked in offered_fonts():
            return asked
        if asked.startswith(FILES):
            return str(only_file(self._uploads.folder(asked.removeprefix(FILES))))
        raise ReadError(asked[:40], "is neither an installed font nor a file that was sent")

    def _named(self, text: str) -> str:
        """A line without the folder that nobody knows."""
        return _FOLDER.sub("", text.replace(str(self._uploads.root), ""))


def added(session: NamedSession, items: Sequence[Item]) -> list[Command]:
    """Commands that bring items, each to where most room is."""
    return list(brought(session.document, session.library, session.shapes, items))


def replaced(session: NamedSession, numbers: Sequence[int], item: Item) -> Command:
    """Command that puts an item in the place of some."""
    asset = named_item(session.library, item)
    return made(Together, commands=[made(Replace, item=number, asset=asset) for number in numbers])


@cache
def choices() -> dict[str, Any]:
    """Bundled containers and items, with pictures, fonts and palettes; made once."""
    containers = [
        {"name": one.name, "path": path_of(one.outline, FINENESS), "box": one.outline.bounds}
        for one in offered_containers()
        if one.outline is not None
    ]
    return {
        "options": [asdict(one) for one in questions()],
        "containers": containers,
        "fonts": offered_fonts(),
        "palettes": offered_palettes(),
        "items": [_choice(one.item) for one in offered_items() if one.item is not None],
    }


def _choice(item: Item) -> dict[str, Any]:
    return {"name": item.name, **asdict(drawing_of(item))}
