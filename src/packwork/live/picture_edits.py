"""Edits of a session by pictures, and words among other items; declared as in ``edits``."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from packwork.errors import RecipeError
from packwork.live.edit_flags import Edit, Flag, declared_in

if TYPE_CHECKING:
    from packwork.live.session import Session

PICTURE_EDITS: list[Edit] = []
"""After all others, in the order in which a command line does them."""

edit = declared_in(PICTURE_EDITS)


def share_of(key: str, share: str | float) -> float:
    """A share as people write it, above 0 and below 1."""
    from packwork.units import parse_share

    try:
        asked = float(str(parse_share(share)))
    except (TypeError, ValueError) as error:
        raise RecipeError(key, f"must be a share such as 70%, not {share!r}") from error
    if not 0 < asked < 1:
        raise RecipeError(key, f"must be a share such as 70%, not {share}")
    return asked


def mix(
    session: Session, source: object | None, share: str | float, *, seed: int = 0, **options: Any
) -> None:
    """Have words among the other items, with a share of what all cover; all is poured anew.

    Parameters
    ----------
    source
        Of words that come more, as for :func:`words`; None for the words that are there.
    share
        Of words, as ``.4`` or ``"40%"``.
    options
        As for :meth:`words`.
    """
    from packwork.live.commands.command import made
    from packwork.live.commands.together import Together
    from packwork.live.macros import mixed, prepared, words_of
    from packwork.live.relayout import poured_again

    asked = share_of("share", share)
    read = None if source is None else words_of(session.document, source, options)
    make = partial(mixed, read=read, share=asked)
    commands, document = prepared(session, make, keeps_hand=True)
    put = poured_again(document, seed)
    session.apply(made(Together, commands=(*commands, put)))


@edit(Flag("--backdrop", "PICTURE", "Have a picture behind all, also in files."))
def backdrop(session: Session, source: str) -> None:
    """Have a picture behind all, which covers the canvas, also in files that are written."""
    from packwork.live.commands.command import named_item
    from packwork.live.ground import MOST_PX
    from packwork.readers.target import kept_picture

    asset = named_item(session.library, kept_picture(source, MOST_PX))
    session.do("background", asset=asset)


@edit(
    Flag("--picture", help="Show a picture: each item takes on its colour there."),
    Flag("--tint"),
)
def picture(session: Session, source: str | None = None, tint: float | str | None = None) -> None:
    """Have a picture that the items show from afar: each takes on its colour where it lies.

    Parameters
    ----------
    source
        Unless given, the one that there is.
    tint
        How far, as ``.3`` or ``"30%"``. Unless given, photographs keep their colours.
    """
    from packwork.live.commands.command import named_item
    from packwork.live.ground import MOSAIC_PX
    from packwork.readers.target import kept_picture
    from packwork.units import parse_share

    asset = None
    if source is not None:
        asset = named_item(session.library, kept_picture(source, MOSAIC_PX))
    session.do("mosaic", asset=asset, tint=parse_share(tint))
