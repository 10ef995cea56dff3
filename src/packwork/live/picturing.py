"""A picture that the items of a document come to show, by their colours alone."""

from __future__ import annotations

from packwork.errors import RecipeError
from packwork.live.commands.items import Recolour
from packwork.live.commands.together import Together
from packwork.live.document import Document
from packwork.readers.target import read_target
from packwork.scene.item import PhotoArt
from packwork.steps.mosaic import colours_under


def showing(document: Document, source: str) -> Together:
    """Commands that give each item the colour of the picture under it; photographs keep theirs.

    For gaps of any colour: what ``--picture`` makes up for is that of a ground of its own.

    Raises
    ------
    ReadError
        If it cannot be read, is clear, or has one colour only.
    RecipeError
        If there is nothing whose colour could be changed.
    """
    target = read_target(source, document.container)
    colours = colours_under(document.layout, target)
    triples = zip(document.ids.tolist(), document.items, colours, strict=True)
    commands = tuple(
        Recolour(items=(number,), colour=colour)
        for number, item, colour in triples
        if not isinstance(item.art, PhotoArt)
    )
    if not commands:
        raise RecipeError(
            "picture", "needs items whose colours may change; photographs keep theirs"
        )
    return Together(commands=commands)
