"""Messages of a page: of each its fields, and what it has done.

``schema()`` is what both ends are checked against: the page's own list of messages, ``wire.js``, is
written from it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias

from pydantic import Field, TypeAdapter, ValidationError

from packwork.errors import PackworkError
from packwork.live import edits
from packwork.live.commands.command import Command, ItemIds, made, named_container, named_item
from packwork.live.commands.container import DrawContainer, SetContainer
from packwork.live.commands.items import Replace
from packwork.live.commands.together import AnyCommand, of_the_hand
from packwork.live.face.offers import TileWay, container_of, items_of, labels_of, told_of_map
from packwork.live.face.opening import opening_sent
from packwork.live.macros import brought, labelled, labels_in
from packwork.live.owner import Leap
from packwork.live.session import Session
from packwork.scene.container import Container, on_canvas, tiled
from packwork.studio.clipboard import Copy, Paste
from packwork.studio.documents import Begin, BeginChart, Font, Name, Open, PageRequest, ReadRequest
from packwork.studio.files import FILES
from packwork.studio.filling import Alike, Fill, Lines, Mix, Order, Picture, Words
from packwork.studio.wire import SAID
from packwork.units import canvas_size

if TYPE_CHECKING:
    from packwork.studio.tab import Tab

MOST_TEXT = 1_000_000
"""Characters of a message at most: a container's outline of 20,000 points. Chosen."""

MOST_AT_ONCE = 24
"""Items that are put into the largest voids one by one; of more, all are poured anew. Chosen."""

ADDING = "Adding items"

SAME = "same"
"""What the container of now is called."""

PAGE = "page"
"""What all of a canvas is called."""

Count32: TypeAlias = Annotated[int, Field(ge=0, lt=2**32)]
Place: TypeAlias = Annotated[float, Field(allow_inf_nan=False)]


class Do(PageRequest):
    """Do a command."""

    type: Literal["do"] = "do"
    n: Count32
    """Number of the command, counted by the page."""
    command: AnyCommand

    def act(self, tab: Tab) -> None:
        """Post it; what would move words that lines place is refused."""
        shown = tab.workspace.shown
        if shown is not None and of_the_hand(self.command, shown.view.kind):
            raise PackworkError(shown.view.kind.stays)
        tab.post(self.command, self.n)


class LeapMessage(PageRequest):
    """Go through the history."""

    type: Literal["leap"] = "leap"
    n: Count32
    """Its number, in one count with the page's commands."""
    to: Literal["undo", "redo"]

    def act(self, tab: Tab) -> None:
        """Post it."""
        tab.post(Leap(self.to), self.n)


class Ack(PageRequest):
    """A frame has come: the next may."""

    type: Literal["ack"] = "ack"
    frame: Count32

    def act(self, tab: Tab) -> None:
        """Let the next frame go."""
        tab.ack(self.frame)


class Pour(PageRequest):
    """Fill the container anew with the same items, from other first places."""

    type: Literal["pour"] = "pour"
    seed: Annotated[int, Field(ge=0, lt=2**31)]

    def act(self, tab: Tab) -> None:
        """Have a run."""
        tab.workspace.pour(self.seed)


class Stop(PageRequest):
    """End what takes long, with what there is."""

    type: Literal["stop"] = "stop"

    def act(self, tab: Tab) -> None:
        """End it."""
        tab.workspace.stop()


class Count(PageRequest):
    """Have so many items."""

    type: Literal["count"] = "count"
    count: Annotated[int, Field(ge=1, le=10_000)]

    def act(self, tab: Tab) -> None:
        """Have copies come, or items go."""
        tab.workspace.change(lambda session: edits.count(session, self.count), "Changing the count")


def _has_parts(tab: Tab) -> bool:
    shown = tab.workspace.shown
    return shown is not None and shown.view.kind.has_parts


class Bring(ReadRequest):
    """Bring items: bundled ones by name, or files that were sent before."""

    type: Literal["bring"] = "bring"
    sources: Annotated[tuple[Annotated[str, Field(max_length=200)], ...], Field(min_length=1)]
    x: Place | None = None
    y: Place | None = None

    def read(self, tab: Tab) -> None:
        """Read them, and put them where most room is, or there."""
        workspace, importer = tab.workspace, tab.importer
        if len(self.sources) == 1 and self.sources[0].startswith(FILES):
            opening = opening_sent(importer.folder(self.sources[0]))
            if opening is not None:
                importer.begin(opening)
                return
        sources = [importer.source(one) for one in self.sources]
        found = items_of(sources, has_parts=_has_parts(tab))
        for left_out in found.skipped:
            workspace.say(f"left out: {importer.without_folder(str(left_out))}", is_error=False)
        items, at = found.items, (self.x, self.y)
        if len(items) == 1 and None not in at:
            workspace.change(lambda session: edits.add(session, items, *at), ADDING)
        elif len(items) <= MOST_AT_ONCE:
            workspace.change(lambda session: edits.add(session, items), ADDING)
        else:
            workspace.pour(0, lambda session: list(brought(session, items)))


class Swap(ReadRequest):
    """Put another item in the place of some."""

    type: Literal["swap"] = "swap"
    items: ItemIds
    source: Annotated[str, Field(max_length=200)]

    def read(self, tab: Tab) -> None:
        """Read it, and put it there."""
        source = tab.importer.source(self.source)
        (item, *_) = items_of([source], has_parts=_has_parts(tab)).items

        def put(session: Session) -> None:
            asset = named_item(session.library, item)
            session.do_together(made(Replace, item=k, asset=asset) for k in self.items)

        tab.workspace.change(put, "Replacing")


class Room(ReadRequest):
    """Fill another container.

    It is a bundled one, ``text:WORD``, a file that was sent before, ``page``, or ``same``: that of
    now on another canvas.
    """

    type: Literal["room"] = "room"
    source: Name
    font: Font | None = None
    """Of a word: an installed family, or a file that was sent before."""
    canvas: Annotated[str, Field(max_length=40)] | None = None
    """Its size, as on the command line; that of now if None."""
    tile: TileWay | None = None
    """The way in which the canvas repeats; a page it has to be then."""
    names: bool = False
    """Whether the names of the parts that its file has are written on them."""

    def read(self, tab: Tab) -> None:
        """Read it, and have a run."""
        container = self._container(tab)
        is_sent = self.names and self.source.startswith(FILES)
        labels, told = labels_of(container, tab.workspace.is_stopped) if is_sent else ([], [])
        if self.source.startswith(FILES):
            told = [*told, told_of_map(container)]
        for line in filter(None, told):
            tab.workspace.say(tab.importer.without_folder(line), is_error=False)

        def make(session: Session) -> list[Command]:
            asset = named_container(session.library, container)
            is_same = self.source == SAME
            names = labels_in(session.document, container) if is_same else labels
            return [made(SetContainer, asset=asset), *labelled(session, names)]

        tab.workspace.pour(0, make)

    def _container(self, tab: Tab) -> Container:
        shown = tab.workspace.shown
        if self.source == SAME and self.canvas is not None and shown is not None:
            return on_canvas(shown.view.container, canvas_size(self.canvas))
        canvas = self.canvas or tab.workspace.canvas
        importer = tab.importer
        source = self.source if self.source == PAGE else importer.container(self.source)
        found = container_of(source, canvas, importer.font(self.font))
        return found if self.tile is None else tiled(found, self.tile)


class OutlineMessage(PageRequest):
    """Fill what a line encloses that was drawn on the canvas."""

    type: Literal["outline"] = "outline"
    line: Annotated[tuple[tuple[Place, Place], ...], Field(min_length=3, max_length=10_000)]

    def act(self, tab: Tab) -> None:
        """Have a run."""
        tab.workspace.pour(0, lambda _: [made(DrawContainer, line=self.line)])


class More(PageRequest):
    """Try the same items from other first places, beside what there is."""

    type: Literal["more"] = "more"
    seed: Annotated[int, Field(ge=0, lt=2**30)]

    def act(self, tab: Tab) -> None:
        """Have a run of each."""
        tab.workspace.try_more(self.seed)


class Set(PageRequest):
    """Set numbers for all items, as people write them."""

    type: Literal["set"] = "set"
    options: dict[Annotated[str, Field(max_length=40)], str | float | tuple[str, ...]]

    def act(self, tab: Tab) -> None:
        """Set them."""
        tab.workspace.change(lambda session: edits.set(session, **self.options), "Setting options")


Told: TypeAlias = Annotated[
    Do | LeapMessage | Ack | Pour | Stop | Count | Bring | Open | Begin | BeginChart | Swap | Room
    | OutlineMessage | Fill | Mix | Copy | Paste | Picture | Order | Alike | Words | Lines
    | More | Set,
    Field(discriminator="type"),
]  # fmt: skip
"""What a page says."""

TOLD: TypeAdapter[Told] = TypeAdapter(Told)


class UnreadableError(PackworkError):
    """A message that means nothing; its text is a line for people."""


def read(text: str) -> Told:
    """Message that a page has sent.

    Examples
    --------
    >>> read('{"type": "ack", "frame": 4}')
    Ack(type='ack', frame=4)
    """
    if len(text) > MOST_TEXT:
        raise UnreadableError(f"a message of {len(text)} characters is too long")
    try:
        return TOLD.validate_json(text)
    except ValidationError as error:
        first = error.errors(include_url=False, include_input=False)[0]
        where = ".".join(str(part)[:40] for part in first["loc"][:6])
        raise UnreadableError(f"message: {where or 'it'}: {first['msg'][:120]}") from None
    except (ValueError, RecursionError):
        raise UnreadableError("message: cannot be read") from None


def schema() -> dict[str, Any]:
    """JSON schema of all messages, both ways."""
    return {"told": TOLD.json_schema(), "said": SAID.json_schema()}
