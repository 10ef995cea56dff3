"""Drawings of a layout that a file holds as shapes: read again from where its run had them.

GeoJSON names the file of each item and its colour. What is there no longer, or has another outline
now, stays a shape.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from packwork.errors import PackworkError
from packwork.phrasing import enumerated
from packwork.pipeline.registration import SAME_AREA, is_alike
from packwork.readers.items import read_items
from packwork.readers.photo_options import PhotoOptions
from packwork.readers.photos import read_photos
from packwork.recipe_paths import files_outside
from packwork.scene.item import FlatArt, Item, PhotoArt
from packwork.scene.layout import Layout
from packwork.scene.palette import palette_colours
from packwork.scene.recolour import has_one_colour, recoloured
from packwork.scene.swatch import representative_colour
from packwork.writers.recolour_drawings import in_palette, in_shades_of


def with_drawings(layout: Layout, folder: Path) -> tuple[Layout, tuple[str, ...]]:
    """The layout with the drawings of its items, and sentences about what could not be had.

    Parameters
    ----------
    folder
        Where that file lies: names of files are seen from the working folder, then from there.
    """
    recipe = layout.manifest.get("recipe")
    asked = recipe if isinstance(recipe, Mapping) else {}
    drawings: dict[str, Item | None] = {}
    made: dict[tuple[Item, str], Item] = {}
    items, missing = list(layout.items), []
    for k, shape in enumerate(layout.items):
        if shape.source not in drawings:
            drawings[shape.source] = _read(shape.source, folder, asked)
        drawing = drawings[shape.source]
        if drawing is None or not _is_same(drawing, shape):
            # Letters are their shapes.
            if not asked.get("words") or drawing is not None:
                missing.append(shape.name)
            continue
        fill = representative_colour(shape)
        if (drawing, fill) not in made:
            made[drawing, fill] = _coloured(drawing, fill, asked)
        art = made[drawing, fill].art
        items[k] = replace(drawing, name=shape.name, art=art, label=shape.label, datum=shape.datum)
    told = (*_told_outside(drawings, folder), *_told(missing, len(items)))
    beside = _TOLD_BESIDE if asked.get("chart") or asked.get("label_regions") else ()
    return replace(layout, items=tuple(items)), (*told, *beside)


_TOLD_BESIDE = (
    "titles, keys and labels are not in a GeoJSON; edit the SVG or the session to keep them",
)


def _told_outside(sources: Iterable[str], folder: Path) -> tuple[str, ...]:
    """A sentence about files that lie neither here nor beside the layout."""
    outside = files_outside({"items": list(sources)}, [folder, Path.cwd()])
    names = enumerated(outside)
    return (f"names drawings outside its folder, which are read: {names}",) if outside else ()


def _told(missing: Sequence[str], count: int) -> tuple[str, ...]:
    if not missing:
        return ()
    names = enumerated(list(dict.fromkeys(missing)))
    return (
        f"{len(missing)} of {count} items are plain shapes ({names}): the files of their drawings "
        "are not there, or are others now; give them with --items",
    )


def _read(source: str, folder: Path, recipe: Mapping[str, Any]) -> Item | None:
    """The one drawing of a source; None if it cannot be read."""
    for name in _names(source, folder):
        with contextlib.suppress(PackworkError, ValidationError):
            if recipe.get("photos"):
                options = PhotoOptions.model_validate({**recipe["photos"], "sources": name})
                found = read_photos(options).items
            else:
                found = read_items([name], holes=recipe.get("holes") or "fill").items
            if len(found) == 1:
                return found[0]
    return None


def _names(source: str, folder: Path) -> Iterator[str]:
    """Names by which a source may be found: it is a file, or what is bundled."""
    if Path(source).is_file():
        yield source
    elif (folder / source).is_file():
        yield str(folder / source)
    elif not Path(source).suffix and "/" not in source:
        yield source


def _is_same(drawing: Item, shape: Item) -> bool:
    own, other = drawing.outline.area, shape.outline.area
    return abs(own - other) <= SAME_AREA * drawing.coarseness * other and is_alike(drawing, shape)


def _coloured(drawing: Item, fill: str, recipe: Mapping[str, Any]) -> Item:
    """The drawing in the colours that it had, of which the mean is known."""
    if isinstance(drawing.art, PhotoArt) or representative_colour(drawing) == fill:
        return drawing
    if isinstance(drawing.art, FlatArt) or has_one_colour(drawing.art):
        return recoloured(drawing, fill)
    try:
        palette = palette_colours(recipe["palette"]) if recipe.get("palette") else ()
    except ValueError:
        palette = ()
    ways = [in_shades_of(drawing, colour) for colour in palette]
    ways += [in_palette(drawing, palette)] if palette else []
    # Of a rule's colour all of it is.
    return next(
        (one for one in ways if representative_colour(one) == fill), recoloured(drawing, fill)
    )
