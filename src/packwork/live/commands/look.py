"""Commands that change how a layout looks, and move nothing."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Annotated, Literal, cast

import numpy as np
from pydantic import Field

from packwork.errors import RecipeError
from packwork.live.commands.command import Command, ItemId, Library, Number, index_of, known
from packwork.live.document import Document
from packwork.live.file.records import Text
from packwork.live.ground import Mosaic, coloured, gradient, underlays
from packwork.recipe.pictures import Shades, known_palette
from packwork.scene.colour import hex_colour, parse_colour
from packwork.scene.contrast import channels_of
from packwork.scene.groups import of_each
from packwork.scene.item import Item, PhotoArt, VectorArt
from packwork.scene.layout import ground_in
from packwork.scene.palette import palette_colours
from packwork.scene.recolour import has_one_colour, in_own_colours, with_own_art
from packwork.scene.swatch import mean_light
from packwork.steps.appearance import given_out
from packwork.steps.mosaic import best_ground
from packwork.uses.cutting import cropped
from packwork.writers.halos import haloed
from packwork.writers.options import HaloChoice
from packwork.writers.recolour_drawings import in_palette, in_shades_of


class Paint(Command):
    """Give the colours of a palette to all items, neighbours unlike ones; photographs keep theirs.

    Drawings are painted as they were before any colour was put on them; a mosaic ends by it.
    """

    kind: Literal["paint"] = "paint"
    palette: Annotated[tuple[Text, ...], Field(max_length=100)]
    """Any CSS colours; none for those in which each item was drawn."""
    shades: Shades = "tint"
    """What becomes of drawings of several colours, as in recipes."""

    def applied(self, document: Document, library: Library) -> Document:
        """The document in these colours."""
        known_palette(list(self.palette) or None)
        palette = palette_colours(list(self.palette)) if self.palette else ()
        items = tuple(of_each(item, in_own_colours) for item in document.items)
        if any(item.datum is not None and item.datum.category for item in items):
            raise RecipeError("palette", "colours of a chart stand for its groups, as its keys say")
        if palette:
            items = self._painted(document, items, palette)
        manifest = {**document.manifest, "painted": list(palette), "shades": self.shades}
        return replace(document, items=items, manifest=manifest, mosaic=None)

    def _painted(
        self, document: Document, items: tuple[Item, ...], palette: tuple[str, ...]
    ) -> tuple[Item, ...]:
        ways = {item: self._way(item) for item in items}
        palettes = [palette if ways[item] == "tint" else () for item in items]
        layout = replace(document, items=items).layout
        colours = given_out(palettes, layout, is_mixed=True, seed=0)
        known: dict[tuple[Item, str | None], Item] = {}

        def put(way: Shades, colour: str | None, item: Item) -> Item:
            if isinstance(item.art, PhotoArt):
                return item
            made = item if colour is None else in_shades_of(item, colour)
            return with_own_art(in_palette(item, palette) if way == "nearest" else made, item)

        for pair in zip(items, colours, strict=True):
            if pair not in known:
                known[pair] = of_each(pair[0], partial(put, ways[pair[0]], pair[1]))
        return tuple(known[pair] for pair in zip(items, colours, strict=True))

    def _way(self, item: Item) -> Shades:
        if isinstance(item.art, PhotoArt):
            return "keep"
        return "tint" if has_one_colour(item.art) else self.shades


class Background(Command):
    """Have another colour, a gradient or a picture behind all, on the page and in files."""

    kind: Literal["background"] = "background"
    colour: Annotated[Text, Field(max_length=400)] = ""
    """Any CSS colour, or a gradient as CSS writes it; empty for none."""
    asset: str | None = None
    """Name of a picture in the library; None for none."""

    def applied(self, document: Document, library: Library) -> Document:
        """The document on that."""
        if self.asset is not None:
            behind: Item | None = picture_in(library, self.asset)
        else:
            behind = gradient(self.colour, document.container)
        ground = ""
        if behind is None:
            channels = parse_colour("background", self.colour or "none")
            ground = hex_colour(channels) if channels[3] else ""
        manifest = {**document.manifest, "ground": ground}
        return replace(document, manifest=manifest, behind=behind)


class SetHalos(Command):
    """Give items halos by which they stand out from the background, also from a later one."""

    kind: Literal["halos"] = "halos"
    choice: HaloChoice
    """Which items: none, all, or those that are hardly to be seen, faint."""

    def applied(self, document: Document, library: Library) -> Document:
        """The document that asks for them; the session gives them, as after all other changes."""
        return replace(document, manifest={**document.manifest, "halos": self.choice})


def with_halos(document: Document, before: Document) -> Document:
    """A document whose items have the halos that it asks for; on a picture all of them.

    As it is where items, ground and what is asked are as before.
    """
    is_same = document.items is before.items and document.behind is before.behind
    is_same &= document.halos == before.halos
    is_same &= ground_in(document.manifest) == ground_in(before.manifest)
    if is_same or not (choice := document.halos):
        return document
    ground: str | None = ground_in(document.manifest) or None
    for picture, _, _ in underlays(document.container, document.behind, None):
        choice = "none" if choice == "none" else "all"
        ground = hex_colour(tuple((255 * channels_of(mean_light(picture))).astype(int)))
    bare = tuple(replace(item, halo="") for item in document.items)
    container = replace(document.container, backdrop=None)
    layout = replace(document, container=container, items=bare, behind=None).layout
    return replace(document, items=haloed(layout, choice, ground).items)


class SetMosaic(Command):
    """Have a picture that the items show from afar; each takes on its colour there."""

    kind: Literal["mosaic"] = "mosaic"
    asset: str | None = None
    """Name of the picture in the library; None for the one that there is."""
    tint: Annotated[Number, Field(ge=0, le=1)] | None = None
    """Share of its colours that items take on; None: 0 of photographs, 1 of all else."""

    def applied(self, document: Document, library: Library) -> Document:
        """The document as a mosaic, on a ground that suits it unless it has one."""
        if document.kind.name == "chart":
            raise RecipeError("picture", "has no meaning in a chart, whose colours say something")
        if self.asset is not None:
            mosaic = Mosaic(picture_in(library, self.asset), self.tint)
        elif document.mosaic is not None:
            mosaic = replace(document.mosaic, tint=self.tint)
        else:
            raise RecipeError("tint", "is of a mosaic; give it a picture to show")
        document.container.check_edge("picture", "places at which it could be shown")
        target = mosaic.target(document.container)
        ground = ground_in(document.manifest)
        if not ground and document.grounded.backdrop is None:
            covered = float(document.areas.sum() / document.container.outline.area)
            ground = best_ground(target, min(covered, 1.0))
        manifest = {**document.manifest, "painted": [], "ground": ground}
        shown = replace(document, manifest=manifest, mosaic=mosaic)
        return coloured(shown, np.arange(len(document)))


def picture_in(library: Library, name: str) -> Item:
    """Picture of a library: a drawing or a photograph."""
    found = cast(Item, known(library.items, name, "picture"))
    if not isinstance(found.art, PhotoArt | VectorArt):
        raise RecipeError("picture", f"{found.name} is neither a drawing nor a photograph")
    return found


class CropPhoto(Command):
    """Enlarge a photograph in its frame and move it there; the frame stays as it is."""

    kind: Literal["crop"] = "crop"
    item: ItemId
    zoom: Annotated[Number, Field(ge=1, le=20)]
    """How many times as large as it was at first; 1 shows all of it."""
    x: Annotated[Number, Field(ge=-20, le=20)] = 0.0
    """Of its middle from the frame's, in widths of the frame; no farther than it fills it."""
    y: Annotated[Number, Field(ge=-20, le=20)] = 0.0
    """As above, in heights."""

    def applied(self, document: Document, library: Library) -> Document:
        """The document with the photograph so."""
        k = index_of(document, self.item, "crop")
        items = list(document.items)
        art = items[k].art
        if not isinstance(art, PhotoArt) or items[k].parts is not None:
            raise RecipeError("crop", f"is for photographs, and {items[k].name} is a drawing")
        made = cropped(art, items[k].outline, self.zoom, self.x, self.y)
        items[k] = replace(items[k], art=made)
        return replace(document, items=tuple(items))
