"""Live sessions as Python people use them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from packwork.api.inputs import handed_over, read_container, read_items
from packwork.api.layout import Layout, public
from packwork.api.plain import Colour, Colours, plain_colour, plain_colours, plain_texts
from packwork.display.picture import notebook_png, notebook_svg
from packwork.errors import RecipeError, WriteError
from packwork.live import edits, picture_edits
from packwork.live.clips import CopiedItems
from packwork.live.commands.aligning import Direction, Edge
from packwork.live.document import Document, Property
from packwork.live.file.disk import ENDING, Disk
from packwork.live.file.recipe import SessionRecipe, write_recipe
from packwork.live.names import Coordinate, Which
from packwork.live.session import Session as LiveSession
from packwork.readers.memory.values import Value
from packwork.recipe.pictures import Shades
from packwork.recipe.typed import Anchor
from packwork.scene import layout as scene


class Session(LiveSession):
    """A layout under the hand: items are moved, held, added; the others make room.

    :meth:`Layout.edit` gives one. Used in a ``with`` block it is settled at the block's end;
    :attr:`layout` is then certified, or ``in_the_way`` says why not. Each call of a verb is one
    entry of the history; what adds or sets several, one for each. An item is called by its name,
    ``"owl"``, or, of several of that name, ``"owl#2"``; ``*`` stands for any letters; or by its
    number. Places are canvas units or lengths such as ``"10mm"``; ``"45%"`` is a share of the
    canvas' width or height.

    Examples
    --------
    >>> from packwork import fill
    >>> layout = fill("circle", ["star", "hexagon"], count=6, effort="draft", levels="50")
    >>> with layout.edit() as session:
    ...     session.hold("star#1")
    ...     session.move("hexagon#2", "50%", "50%")
    >>> session.layout.certified, float(session.layout.poses.x[3])
    (True, 300.0)
    >>> held = session.layout.poses.x[0] == layout.poses.x[0]
    >>> bool(held)
    True
    """

    _disk: Disk | None = None

    def __repr__(self) -> str:
        return repr(self.layout).replace("Layout", "Session", 1)

    def _repr_svg_(self) -> str | None:
        return notebook_svg(self.layout)

    def _repr_png_(self) -> tuple[bytes, dict[str, int]] | None:
        return notebook_png(self.layout)

    @property
    def layout(self) -> Layout:
        """The layout as it is now: what saves, shows and measures itself."""
        return public(super().layout)

    @classmethod
    def open(cls, path: str | Path, *, journal: bool = False) -> Session:
        """A session out of a file that :meth:`save` has written, with all that undo leads to.

        Parameters
        ----------
        journal
            Note all that is done beside the file, in ``path.log``, at the end of each gesture: a
            crash then loses at most the last one, for what the journal holds is done again when
            the file is opened next.

        Raises
        ------
        ReadError
            If it is no session file, or a spoilt one.
        WriteError
            If a journal is asked for and another session writes it.
        """
        disk = Disk(path, is_journaled=journal)
        session = disk.opened(cls)
        session._disk = disk
        return session

    def save(self, path: str | Path | None = None, *, journal: bool | None = None) -> None:
        """Write the session to a file: layout, drawings, what is held, all that undo leads to.

        The file opens anywhere: it holds photographs (4,000 px on the longer side) and fonts too.
        :attr:`layout` saves pictures.

        Parameters
        ----------
        path
            Such as ``work.packwork``; unless given, the file that was opened or saved last.
        journal
            As for :meth:`open`; unless given, as before for the same file, none for another.

        Raises
        ------
        RecipeError
            If there is no such file yet, or something is held by the hand.
        WriteError
            If it cannot be written, another session writes it, or it was changed by others since
            it was read. What was there is as it was, and so is the session.
        """
        before = self._disk
        if path is None and before is None:
            raise RecipeError("path", "the session has no file yet; give one, as work.packwork")
        if path is not None and Path(path).suffix.lower() != ENDING:
            raise WriteError(
                path, f"is no session's file; end it in {ENDING}, or save session.layout"
            )
        disk = before
        if disk is None or (path is not None and not disk.is_at(path)):
            disk = Disk(path or "", is_journaled=False)
        disk.save(self, journal)
        self._disk = disk
        if before is not None and before is not disk:
            before.close(self)

    def recipe(self, folder: str | Path) -> SessionRecipe:
        """Write a folder with a recipe that goes on from here; how it is run.

        The run begins with the present layout, stays near it, and keeps what is held. Words are
        drawings in it.

        Raises
        ------
        WriteError
            If nothing can be written there.
        """
        return write_recipe(self, folder)

    def close(self) -> None:
        """End the journal, if there is one; what it holds is done again when the file is opened.

        The end of a ``with`` block does it too.
        """
        if self._disk is not None:
            self._disk.close(self)

    def __exit__(self, kind: type[BaseException] | None, *rest: object) -> None:
        super().__exit__(kind, *rest)
        self.close()

    move = edits.move
    turn = edits.turn
    scale = edits.scale
    flip = edits.flip
    exchange = edits.exchange
    align = edits.align
    distribute = edits.distribute
    group = edits.group
    ungroup = edits.ungroup
    crop = edits.crop
    hold = edits.hold
    release = edits.release
    remove = edits.remove
    duplicate = edits.duplicate
    copy = edits.copy
    paste = edits.paste
    weigh = edits.weigh
    rename = edits.rename
    background = edits.background
    reshape = edits.reshape
    place_container = edits.place_container
    draw_container = edits.draw_container
    set = edits.set
    count = edits.count
    cover = edits.cover
    words = edits.words
    mix = edits.mix
    arrange = edits.arrange

    def widget(self) -> Any:
        """The session under the hand in a notebook, as the studio shows it; needs anywidget.

        ``widget.layout`` is the layout as it is now.

        Raises
        ------
        PackworkError
            If anywidget is not installed.
        """
        from packwork.api.widget import widget_of

        return widget_of(self)

    def recolor(self, which: Which, color: Colour) -> None:
        """Give items one colour, any of CSS or Matplotlib."""
        edits.recolor(self, which, plain_colour(color))

    def palette(self, palette: Colours | None, shades: Shades = "tint") -> None:
        """Put the colours of a palette on all items, neighbours unlike ones; None: their own again.

        Parameters
        ----------
        palette, shades
            As for :func:`fill`. Photographs keep theirs.
        """
        edits.palette(self, None if palette is None else plain_colours(palette), shades)

    def add(
        self, source: Value, x: Coordinate | None = None, y: Coordinate | None = None
    ) -> tuple[int, ...]:
        """Bring items from whatever :func:`read_items` reads; their numbers.

        Parameters
        ----------
        x, y
            Where; unless given, where there is most room.
        """
        return edits.add(self, read_items(source), x, y)

    def replace(self, which: Which, source: Value) -> None:
        """Put another item in an item's place."""
        found = read_items(source)
        if len(found) != 1:
            raise RecipeError("replace", f"takes one item, not {len(found)}")
        edits.replace(self, which, found[0])

    def set_container(self, source: Value) -> None:
        """Fill another container, whatever :func:`read_container` reads, on a canvas as large."""
        edits.set_container(self, read_container(source, canvas=self.canvas))

    def picture(self, source: Value | None = None, tint: float | str | None = None) -> None:
        """Have a picture that the items show from afar: each takes on its colour where it lies.

        Parameters
        ----------
        source
            As ``picture`` of :func:`fill`: a file, or an image in memory; unless given, the one
            that there is.
        tint
            How far, as ``.3`` or ``"30%"``. Unless given, photographs keep their colours.
        """
        with handed_over() as handed:
            name = None if source is None else handed.picture_name_of(source, "picture")
            edits.picture(self, name, tint)

    def backdrop(self, source: Value) -> None:
        """Have a picture behind all, which covers the canvas, also in files that are written."""
        with handed_over() as handed:
            edits.backdrop(self, handed.picture_name_of(source, "backdrop"))

    def embeddings(
        self, source: Any, anchors: str | Anchor | Sequence[str | Anchor] = (), *, seed: int = 0
    ) -> None:
        """Put all anew, like items side by side; what is held stays.

        Parameters
        ----------
        source, anchors
            As ``embeddings`` and ``anchors`` of :func:`fill`.
        """
        listed = (anchors,) if isinstance(anchors, str | Anchor) else anchors
        with handed_over() as handed:
            name = handed.vectors_name_of(source, "embeddings")
            edits.embeddings(self, name, plain_texts(list(listed)), seed=seed)


def session_of(layout: scene.Layout, *, record: bool) -> Session:
    """A session that begins with a layout."""
    return Session(Document.from_layout(layout), record=record)


# Edits are declared without loading what they are annotated with, for help of command lines is made
# of them: here it is there, for ``typing.get_type_hints``.
vars(edits).update(
    Session=LiveSession,
    CopiedItems=CopiedItems,
    Direction=Direction,
    Edge=Edge,
    Property=Property,
    Coordinate=Coordinate,
    Which=Which,
    Shades=Shades,
)
vars(picture_edits)["Session"] = LiveSession
