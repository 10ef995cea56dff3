"""Things offered to a page: settings, items, containers, fonts and palettes; and their drawings."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import cache, lru_cache
from pathlib import Path
from typing import Any, TypeAlias, get_args

from packwork.errors import ReadError
from packwork.fonts import families_of_face, installed_families, scripts_of
from packwork.geometry.outline import Outline
from packwork.live.face.exporting import missing
from packwork.live.ground import MOSAIC_PX, MOST_PX
from packwork.live.kinds import LiveOptions
from packwork.options import SizeMode, offered
from packwork.pipeline.region_labels import PartLabel, part_labels
from packwork.progress import Stop, never
from packwork.readers.builtin import (
    NAMES,
    builtin_container,
    builtin_item,
    container_names,
    icon_names,
)
from packwork.readers.container import part_names, read_container, read_parts
from packwork.readers.container import read_again as read_again
from packwork.readers.engraving import Engraving
from packwork.readers.items import ItemsRead, read_items
from packwork.readers.maps import ENDINGS, region_key
from packwork.readers.photo_options import PhotoOptions
from packwork.readers.photos import read_photo
from packwork.readers.tables.cells import any_number, cell_text, is_missing
from packwork.readers.tables.table import read_table
from packwork.readers.target import kept_picture, picture_colours
from packwork.readers.words.items import WordsRead, read_word_items
from packwork.recipe import Recipe
from packwork.recipe.tiles import TileKind
from packwork.scene.colour import css_colour
from packwork.scene.container import Container
from packwork.scene.item import FlatArt, FontFile, Item, PhotoArt, PictureArt, VectorArt
from packwork.scene.notation import decimals, matrix_text, path_data
from packwork.scene.palette import PALETTES
from packwork.uses.words.recipe import words_recipe

TileWay: TypeAlias = TileKind
"""Ways in which a canvas repeats, as pages ask for them."""

RANGES: Mapping[str, tuple[float, float, float]] = {
    "size_ratio": (1.0, 6.0, 0.1), "evenness": (0.0, 20.0, 0.5), "padding": (0.0, 20.0, 0.5)
}  # fmt: skip
"""Least, most and step of sliders. The field itself takes more. Chosen."""

CHOICES: Mapping[str, tuple[str, ...]] = {
    "sizes": get_args(SizeMode), "rotate": ("free", "none", "15", "30", "90")
}  # fmt: skip
"""What is offered to be chosen from."""


@dataclass(frozen=True)
class FormField:
    """One number or choice.

    Parameters
    ----------
    choices
        What it may be; empty for a number.
    range
        Least, most and step of a number; empty for a choice.
    """

    name: str
    help: str
    choices: tuple[str, ...] = ()
    range: tuple[float, ...] = ()
    default: Any = field(default=None)


def form_fields() -> tuple[FormField, ...]:
    """Settings that hold for all items, in the order of the fields.

    Examples
    --------
    >>> [one.name for one in form_fields()]
    ['padding', 'sizes', 'size_ratio', 'rotate', 'evenness']
    """
    known = {option.name: option.help for option in offered(Recipe)}
    return tuple(
        FormField(
            name,
            known.get(name) or one.description or "",
            CHOICES.get(name, ()),
            RANGES.get(name, ()),
            one.default,
        )
        for name, one in LiveOptions.model_fields.items()
        if name in CHOICES or name in RANGES
    )


@cache
def offers() -> dict[str, Any]:
    """All that a page is offered, as plain values: settings, and what is bundled or installed.

    Examples
    --------
    >>> offers()["items"][0]["name"], "heart" in {one["name"] for one in offers()["containers"]}
    ('anchor', True)
    """
    # Drawings first; without names of one of many sizes.
    containers = sorted(container_names(), key=lambda name: (name in NAMES, name))
    icons = icon_names()
    return {
        "options": [asdict(one) for one in form_fields()],
        "containers": [_container(name) for name in containers if ":" not in name],
        "fonts": {family: scripts_of(family) for family in offered_fonts()},
        "palettes": dict(PALETTES),
        "missing": missing(),
        "items": [
            {"name": name, **asdict(drawing_of(builtin_item(name)))}
            for name in (*icons, *(one for one in NAMES if ":" not in one and one not in icons))
        ],
    }


def _container(name: str) -> dict[str, Any]:
    outline = builtin_container(name, 100.0).outline
    return {"name": name, "path": path_of(outline, FINENESS), "box": outline.bounds}


def items_of(sources: Sequence[str], *, has_parts: bool = False) -> ItemsRead:
    """Items of bundled names and of folders of files; of a nest they are drawings for a machine.

    Pictures that are opaque to their edges are photographs, which can be cropped.
    """
    if has_parts:
        return read_items(sources, holes="keep", engraving=Engraving())
    found = read_items(sources)
    return replace(found, items=tuple(map(_photographed, found.items)))


def _photographed(item: Item) -> Item:
    """A picture of a file that fills its rectangle as a photograph; others as they are."""
    left, top, right, bottom = item.ink.bounds
    fills = item.ink.area > WHOLE * (right - left) * (bottom - top)
    if not isinstance(item.art, PictureArt) or not fills or not Path(item.source).is_file():
        return item
    return read_photo(item.source, PhotoOptions(sources=(item.source,)))


WHOLE = 0.999
"""Share of its rectangle from which a picture fills it. Larger misses soft edges of scans."""


MOST_SHOWN = 4
"""Rows of a table that are shown. Chosen."""

MOST_COLUMNS = 60
"""Columns of a table that are offered; of tables with more, the first. Chosen."""


def columns_of(path: str, container: Container | None = None) -> dict[str, Any]:
    """Columns of a table, as a chart may stand for them, and its first rows, as plain values.

    ``numbers``: whether most cells that hold something are numbers; ``values``: how many differ;
    ``regions``: whether most name parts of the container.
    """
    table, named = read_table(path), part_names(container) if container else []
    columns, rows = list[dict[str, Any]](), list[list[str]]()
    for name in table.columns[:MOST_COLUMNS]:
        cells = [row.get(name) for row in table.with_numbers(name, None, whole=True).rows]
        held = [cell for cell in cells if not is_missing(cell)]
        numbers = sum(not math.isnan(any_number(cell)) for cell in held)
        values = {cell_text(cell) for cell in held}
        met = max((sum(region_key(one) in names for one in values) for names in named), default=0)
        is_map, is_number = 2 * met > len(values), 2 * numbers > len(held)
        columns.append(
            {"name": name, "numbers": is_number, "values": len(values), "regions": is_map}
        )
    for row in table.rows[:MOST_SHOWN]:
        cells = [row.get(one["name"]) for one in columns]
        rows.append(["" if is_missing(cell) else cell_text(cell) for cell in cells])
    return {"columns": columns, "rows": rows, "count": len(table.rows)}


def offered_fonts() -> tuple[str, ...]:
    """Families that words can be set in, as the machine has them.

    Examples
    --------
    >>> "inter display" in offered_fonts()
    True
    """
    return tuple(sorted(installed_families()))


@lru_cache(maxsize=16)
def font_told(font: FontFile) -> str:
    """Name by which pages know a font: of a family that is offered, or of its file without folders.

    Examples
    --------
    >>> from packwork.readers.fonts.fallback import open_fonts
    >>> font_told(open_fonts([]).faces[0].file), font_told(FontFile(b"", "/some/where/Own.ttf"))
    ('inter display', 'Own.ttf')
    """
    installed = installed_families()
    if font.name.lower() in installed:
        return font.name.lower()
    if any(font.name in files for files in installed.values()):
        families = sorted(one.lower() for one in families_of_face(font.data, font.index))
        for family in families:
            if font.name in installed.get(family, ()):
                return family
    return font.name.replace("\\", "/").rpartition("/")[2]


def container_of(source: str, canvas: str | None, font: str | None = None) -> Container:
    """Container of a bundled name, ``text:WORD`` or a file that was given."""
    return read_container(source, canvas, font=font)


def labels_of(container: Container, stop: Stop = never) -> tuple[list[PartLabel], list[str]]:
    """Names of the parts of a container, and what has to be told of them."""
    short = list[str]()
    parts = read_parts(container, short.append, stop)
    labels, told = part_labels(parts, container.side)
    none = f"{container.name} names no parts: a map in GeoJSON does, or an SVG by titles or ids"
    lines = [f"{container.name}: {line}" for line in short]
    return labels, [*lines, *map(str, told)] if parts else [*lines, none]


def told_of_map(container: Container) -> str:
    """Line on what fills the regions of a map by themselves; empty for any other container."""
    if Path(container.source).suffix.lower() not in ENDINGS or not part_names(container):
        return ""
    return (
        f"items fill {container.name} as one; to fill its regions, drop a table with a row for "
        "each mark and a column of regions, and choose a chart: its marks can be an icon"
    )


def picture_of(source: str, *, is_behind: bool = False) -> Item:
    """Picture of a file that a mosaic is to show, or that comes behind all."""
    return kept_picture(source, MOST_PX if is_behind else MOSAIC_PX)


MOST_COLOURS = 8
"""Colours that are taken from a picture at most. Chosen."""


def colours_of(source: str) -> list[str]:
    """Colours of a picture that differ most, the most frequent first."""
    return picture_colours(source, MOST_COLOURS)


def colours_called(palette: str | None) -> list[str]:
    """Colours of a palette that is called so."""
    return list(PALETTES.get(palette or "", ()))


def words_to_mix(container: Container, file: str, options: Mapping[str, Any]) -> WordsRead:
    """Words of a text or a table that come among other items."""
    given = {name: value for name, value in options.items() if value is not None}
    asked = words_recipe(container.name, file, **given).words
    assert asked is not None  # noqa: S101
    return read_word_items(asked)


def only_file(folder: Path) -> Path:
    """The one file of a folder."""
    files = sorted(folder.iterdir())
    if len(files) != 1:
        raise ReadError("container", f"is one file, not {len(files)}; drop one")
    return files[0]


FINENESS = 1e-3
"""By how much a silhouette may be off on the page, as a share of its extent: it is clicked on and
marked by, not measured. Larger shows corners, smaller is longer on its way. Chosen."""

INK_FINENESS = 2e-4
"""The same where the path is the drawing. Chosen."""

MARGIN = 0.01
"""Free edge of a drawing, as a share of its extent: soft edges reach beyond the ink. Chosen."""


@dataclass(frozen=True, kw_only=True)
class Drawing:
    """Drawing of one item, in its own units.

    Parameters
    ----------
    key
        The same for all that look so.
    outline
        Its silhouette, as path data.
    size
        Width and height of the silhouette.
    box
        Left, top, right and bottom of the drawing.
    fill
        Colour of ``ink``; empty where ``svg`` tells.
    ink
        What is drawn, as path data; empty where ``svg`` tells.
    svg
        A whole document, cleaned, of the size of ``box``; empty where the ink in one colour is all.
    whole
        As ``svg``, all of a photograph that is cropped; else empty.
    """

    key: str
    outline: str
    size: tuple[float, float]
    box: tuple[float, float, float, float]
    fill: str
    ink: str
    svg: str
    whole: str = ""


def drawing_of(item: Item) -> Drawing:
    """Drawing of an item.

    Examples
    --------
    >>> from packwork.readers.builtin import builtin_item
    >>> star = drawing_of(builtin_item("star"))
    >>> star.fill, star.svg, len(star.box)
    ('#1f6f78ff', '', 4)
    """
    outline = path_of(item.outline, FINENESS)
    left, top, right, bottom = item.ink.bounds
    edge = MARGIN * max(right - left, bottom - top)
    box = (left - edge, top - edge, right + edge, bottom + edge)
    art = item.art.preview if isinstance(item.art, PhotoArt) else item.art
    crop = item.art.crop if isinstance(item.art, PhotoArt) else None
    fill = ink = svg = ""
    if isinstance(art, FlatArt):
        fill, ink = _seen(art.fill), path_of(item.ink, INK_FINENESS)
    else:
        svg = _drawn(art, box)
    whole = "" if crop is None else _drawn(crop.whole.preview, box)
    parts = "\0".join((outline, fill, ink, svg)).encode()
    key = hashlib.sha256(parts).hexdigest()[:24]
    x0, y0, x1, y1 = item.outline.bounds
    size = (x1 - x0, y1 - y0)
    return Drawing(
        key=key, outline=outline, size=size, box=box, fill=fill, ink=ink, svg=svg, whole=whole
    )


def path_of(outline: Outline, fineness: float) -> str:
    """Path data of an outline that is off by no more than a share of its extent.

    Examples
    --------
    >>> path_of(Outline.box(0.0, 0.0, 9.0, 4.0), 0.01).count(" ")
    7
    """
    step = fineness * outline.extent
    region = outline.region.simplify(step)
    plain = Outline.from_region(region) if not region.is_empty and region.area > 0 else outline
    return path_data(plain, decimals(step / 4))


def _seen(colour: str) -> str:
    return "#" + "".join(f"{channel:02x}" for channel in css_colour(colour))


def _drawn(art: VectorArt | PictureArt, box: tuple[float, float, float, float]) -> str:
    return _document(f'<g transform="{matrix_text(art.matrix)}">{art.markup}</g>', box)


def _document(inside: str, box: tuple[float, float, float, float]) -> str:
    left, top, right, bottom = box
    width, height = right - left, bottom - top
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
        f' width="{width:.6g}" height="{height:.6g}"'
        f' viewBox="{left:.6g} {top:.6g} {width:.6g} {height:.6g}">{inside}</svg>'
    )
