"""Edits of a session, each declared once: a verb of Python and, by its flags, of ``packwork edit``.

An edit is a function of a session, whose name, signature and docstring are those of the verb of
:class:`packwork.Session`. The texts of its flags are read by the types of its parameters
(:mod:`packwork.cli.edit`). Edits with flags stand in the order in which a command line does them.
What takes long to load is loaded by the edit: help of command lines is made of this module.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from numbers import Integral
from typing import TYPE_CHECKING, Any

from packwork.errors import RecipeError
from packwork.live.edit_flags import Edit, Flag, declared_in
from packwork.live.picture_edits import PICTURE_EDITS, backdrop, mix, picture, share_of

if TYPE_CHECKING:
    from packwork.live.clips import CopiedItems
    from packwork.live.commands.aligning import Direction, Edge
    from packwork.live.document import Property
    from packwork.live.names import Coordinate, Which
    from packwork.live.session import Session
    from packwork.recipe.pictures import Shades
    from packwork.scene.container import Container
    from packwork.scene.item import Item

__all__ = ["backdrop", "mix", "picture"]

EDITS: list[Edit] = []
"""In the order in which a command line does them."""

edit = declared_in(EDITS)


@edit(Flag("--container", help="Fill another container, on that canvas."))
def set_container(session: Session, container: Container) -> None:
    """Fill another container, on a canvas as large."""
    from packwork.live.commands.command import named_container

    session.do("set_container", asset=named_container(session.library, container))


@edit(
    Flag("--padding"),
    Flag(
        "--sizes",
        help="free: each item finds its size; shared: all stay in proportion; fixed: none changes.",
    ),
    Flag("--rotate"),
    Flag("--force", is_repeated=True),
)
def set(session: Session, /, **options: str | float | Sequence[str]) -> None:
    """Set numbers for all: ``padding`` (auto: its run's), ``sizes``, ``rotate``, ``force`` ..."""
    from packwork.live.commands.command import made
    from packwork.live.commands.container import SetOption
    from packwork.recipe import AUTO
    from packwork.units import length_asked

    container, given = session.document.container, dict(options)
    asked = given.get("padding")
    if asked == AUTO:
        from packwork.live.relayout import usual_gap

        given["padding"] = usual_gap(session.document)
    elif isinstance(asked, str | int | float):
        given["padding"] = length_asked("padding", asked, container.unit, container.side, AUTO)
    session.do_together(made(SetOption, name=name, value=value) for name, value in given.items())


@edit(Flag("--remove", "ITEM", "Take items away.", of_many=True))
def remove(session: Session, which: Which) -> None:
    """Take items away; their neighbours grow into the room."""
    session.do("remove", items=session.find(which))


@edit(Flag("--replace", "ITEM=FILE", "Put another item in an item's place."))
def replace(session: Session, which: Which, item: Item) -> None:
    """Put another item in an item's place."""
    from packwork.live.commands.command import named_item

    session.do("replace", item=session.one(which), asset=named_item(session.library, item))


@edit(Flag("--recolor", "ITEM=COLOR", "Give items one colour.", of_many=True))
def recolor(session: Session, which: Which, color: str) -> None:
    """Give items one colour, any CSS colour."""
    session.do("recolour", items=session.find(which), colour=color)


@edit(Flag("--palette"))
def palette(session: Session, palette: str | Sequence[str] | None, shades: Shades = "tint") -> None:
    """Put the colours of a palette on all items, neighbours unlike ones; None: each its own again.

    Parameters
    ----------
    palette, shades
        As for :func:`fill`. Photographs keep theirs.
    """
    from packwork.recipe.pictures import check_no_names, known_palette
    from packwork.scene.palette import palette_colours

    check_no_names(known_palette(palette))
    session.do("paint", palette=palette_colours(palette) if palette else (), shades=shades)


@edit(Flag("--background"))
def background(session: Session, color: str) -> None:
    """Have a colour behind all, also in files that are written; ``none`` for none.

    Or a gradient, as CSS writes it: ``linear-gradient(90deg, navy, pink)``.
    """
    session.do("background", colour=color)


@edit(Flag("--crop", "ITEM=ZOOM[,X,Y]", "Enlarge a photograph in its frame.", "pier=1.5,.2,0"))
def crop(session: Session, which: Which, zoom: float, x: float = 0.0, y: float = 0.0) -> None:
    """Enlarge a photograph in its frame, and move it by shares of the frame; 1 shows all of it."""
    session.do("crop", item=session.one(which), zoom=zoom, x=x, y=y)


@edit(Flag("--exchange", "ITEM=ITEM", "Let two items change places."))
def exchange(session: Session, first: Which, second: Which) -> None:
    """Let two items change places."""
    session.do("exchange", first=session.one(first), second=session.one(second))


@edit(Flag("--turn", "ITEM=DEGREES", "Turn an item to that angle from upright."))
def turn(session: Session, which: Which, degrees: float) -> None:
    """Turn an item to an angle from upright, clockwise."""
    session.do("turn", item=session.one(which), angle=degrees)


@edit(Flag("--flip", "ITEM[=vertical]", "Turn items over, left to right.", of_many=True))
def flip(session: Session, which: Which, direction: Direction = "horizontal") -> None:
    """Turn items over where they are; vertically, what was above is below."""
    session.do("flip", items=session.find(which), direction=direction)


@edit(Flag("--group", "ITEM", "Have items keep their places to each other, as one.", of_many=True))
def group(session: Session, which: Which) -> int:
    """Have items keep their places to each other: one item is made of them; its number."""
    number = session.document.next_id
    session.do("group", items=session.find(which))
    return number


@edit(Flag("--ungroup", "ITEM", "Have the items of a group each by itself again.", of_many=True))
def ungroup(session: Session, which: Which) -> tuple[int, ...]:
    """Have the items of groups each by itself again, where they are; their numbers."""
    first = session.document.next_id
    session.do("ungroup", items=session.find(which))
    return tuple(range(first, session.document.next_id))


@edit(Flag("--scale", "ITEM=FACTOR", "Make an item so many times as large."))
def scale(session: Session, which: Which, factor: float) -> None:
    """Make an item so many times as large; it then keeps about that size."""
    session.do("scale", item=session.one(which), factor=factor)


@edit(Flag("--move", "ITEM=X,Y", "Put an item's middle there, as owl=50%,120.", "owl=50%,120"))
def move(session: Session, which: Which, x: Coordinate, y: Coordinate) -> None:
    """Put an item's middle somewhere."""
    from packwork.live.names import length_of

    document = session.document
    place = {"x": length_of(document, "x", x), "y": length_of(document, "y", y)}
    session.do("move", item=session.one(which), **place)


@edit(Flag("--align", "ITEM=EDGE", "Line items up, as leaf*=left.", "leaf*=left", of_many=True))
def align(session: Session, which: Which, to: Edge) -> None:
    """Line items up: ``left``, ``center``, ``right``, ``top``, ``middle`` or ``bottom``.

    What is held stays, and the others come to its line; else to that of all.
    """
    session.do("align", items=session.find(which), to=to)


@edit(
    Flag(
        "--distribute",
        "ITEM=WAY",
        "Even out their distances, horizontal or vertical.",
        "leaf*=vertical",
        of_many=True,
    )
)
def distribute(session: Session, which: Which, direction: Direction) -> None:
    """Even out the distances between items, ``horizontal`` or ``vertical``; the ends stay."""
    session.do("distribute", items=session.find(which), direction=direction)


@edit(
    Flag(
        "--hold",
        "ITEM[=place,angle,size]",
        "Keep exactly as it is: an item is NAME, NAME#2 for the second of several, or * for any "
        "letters.",
        of_many=True,
    )
)
def hold(session: Session, which: Which, *properties: Property) -> None:
    """Hold items exactly as they are: ``place``, ``angle``, ``size``, or all of it."""
    session.do("hold", items=session.find(which), **_of(properties))


def release(session: Session, which: Which, *properties: Property) -> None:
    """Let go of what is held."""
    session.do("release", items=session.find(which), **_of(properties))


def _of(properties: Sequence[Property]) -> dict[str, Any]:
    return {"properties": properties} if properties else {}


@edit(Flag("--add", "FILE[@X,Y]", "Bring an item more, there or where most room is."))
def add(
    session: Session,
    items: Sequence[Item],
    x: Coordinate | None = None,
    y: Coordinate | None = None,
) -> tuple[int, ...]:
    """Bring items, there or where there is most room; their numbers."""
    from packwork.live.commands.command import Command, made
    from packwork.live.commands.placing import Move
    from packwork.live.macros import brought
    from packwork.live.names import length_of

    if (x is None) != (y is None):
        raise RecipeError("add", "takes both x and y, or neither")
    document = session.document
    commands: list[Command] = list(brought(session, items))
    if x is not None and y is not None:
        place = {"x": length_of(document, "x", x), "y": length_of(document, "y", y)}
        # A place is noted where it is moved to; of several items one only can have it.
        asked = [made(Move, item=document.next_id, **place)] if len(items) == 1 else []
        commands = [*(command.model_copy(update=place) for command in commands), *asked]
    session.do_together(commands)
    return tuple(range(document.next_id, document.next_id + len(items)))


def duplicate(session: Session, which: Which) -> int:
    """Bring a copy of an item; its number."""
    number = session.document.next_id
    session.do("duplicate", item=session.one(which))
    return number


def copy(session: Session, which: Which) -> CopiedItems:
    """Take a copy of items as they are now, for :meth:`paste` into this or another session."""
    from packwork.live.clips import clipped

    return clipped(session.document, session.find(which))


def paste(
    session: Session, clip: CopiedItems, x: Coordinate | None = None, y: Coordinate | None = None
) -> tuple[int, ...]:
    """Bring the items of a clip, lying to each other as they did; their numbers.

    Parameters
    ----------
    x, y
        Where the middle of them all is put; unless given, where it was.
    """
    from packwork.live.clips import pasted
    from packwork.live.names import length_of

    if (x is None) != (y is None):
        raise RecipeError("paste", "takes both x and y, or neither")
    document, first = session.document, session.document.next_id
    across = None if x is None else length_of(document, "x", x)
    down = None if y is None else length_of(document, "y", y)
    session.do_together(pasted(session, clip, across, down))
    return tuple(range(first, first + len(clip)))


def weigh(session: Session, which: Which, weight: float) -> None:
    """Give items another weight, in the unit of ``layout.weights``; they grow or shrink."""
    session.do("weigh", items=session.find(which), weight=weight)


def rename(session: Session, which: Which, name: str) -> None:
    """Give an item another name."""
    session.do("rename", item=session.one(which), name=name)


def reshape(session: Session, rings: Iterable[Iterable[tuple[float, float]]]) -> None:
    """Give the container other vertices, canvas units."""
    import numpy as np

    try:
        listed = [np.asarray(ring, dtype=np.float64).reshape(-1, 2).tolist() for ring in rings]
    except (TypeError, ValueError):
        raise RecipeError(
            "rings", "must be a list of rings, each a list of vertices (x, y)"
        ) from None
    if not listed or any(len(ring) < 3 for ring in listed):
        raise RecipeError("rings", "must be one ring at least, each of three vertices (x, y)")
    session.do("reshape", rings=listed)


def draw_container(
    session: Session, line: Iterable[tuple[float, float]], *, is_hole: bool = False
) -> None:
    """Fill what a closed line encloses, canvas units; as a hole, no longer fill that.

    The line may cross itself.
    """
    points = tuple((float(x), float(y)) for x, y in line)
    session.do("draw_container", line=points, is_hole=is_hole)


def place_container(
    session: Session, x: float = 0.0, y: float = 0.0, factor: float = 1.0, degrees: float = 0.0
) -> None:
    """Move the container on its canvas, scale and turn it about its middle."""
    session.do("place_container", x=x, y=y, factor=factor, angle=degrees)


@edit(Flag("--words", help="A text or a table: have its words, with its weights."))
def words(session: Session, source: object, **options: Any) -> None:
    """Have the words of another text or table, with its weights.

    Words that stay are the same items, where they are; new ones come where most room is.

    Parameters
    ----------
    source
        As for :func:`words`.
    options
        What words there are and how they are set, as for :func:`words`; unless given, as in the
        run that made the layout, or for the words before. Other fonts set all words anew.
    """
    from packwork.live.macros import worded, words_of

    letters = {**session.letters, **options}
    read = words_of(session.document, source, letters)
    session.do_together(worded(session, read, is_lettered=bool(letters)))
    session.letters = letters


@edit(Flag("-n --count", help="Have so many items: copies come, or go."))
def count(session: Session, count: int) -> None:
    """Have so many items: copies of what is least there come, of what is most there go."""
    from packwork.live.macros import counted
    from packwork.recipe.rules import MAX_COUNT

    if not isinstance(count, Integral) or isinstance(count, bool) or not 0 < count <= MAX_COUNT:
        raise RecipeError("count", f"must be a whole number from 1 to {MAX_COUNT}, not {count!r}")
    session.do_together(counted(session, int(count)))


@edit(Flag("--cover", "SHARE", "Make all larger or smaller, to cover that."))
def cover(session: Session, share: str | float) -> None:
    """Make all larger or smaller, to cover a share of the container: ``.7`` or ``"70%"``."""
    session.do("cover", share=share_of("cover", share))


@edit(Flag("--arrange"))
def arrange(session: Session, way: str, *, seed: int = 0) -> None:
    """Put all anew in an order, as ``outwards by=weight``; what is held stays.

    A run of its own, of seconds; later verbs move items out of that order.
    """
    from packwork.live.relayout import poured_again

    session.apply(poured_again(session.document, seed, arrange=way))


@edit(Flag("--embeddings"), Flag("--anchors", is_repeated=True))
def embeddings(
    session: Session, source: str, anchors: Sequence[str] = (), *, seed: int = 0
) -> None:
    """Put all anew, like items side by side, by a file of vectors or ``auto``."""
    from packwork.live.relayout import poured_again

    session.apply(poured_again(session.document, seed, embeddings=source, anchors=anchors))


EDITS += PICTURE_EDITS
