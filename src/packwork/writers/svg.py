"""Layouts as SVG: small, valid, and in groups that an editor shows as layers.

Each distinct shape is defined once and every copy is one short ``use``. The document
has a group ``container`` and a group ``items``; item ``k`` is ``item-k``, counted from
1 in the layout's order, its name in ``data-name``; a name of its own makes its id, a link
puts it into an ``a``. What the run promised stands in ``data-`` attributes of ``items``,
so that the file can be measured by itself. References inside the document are written the
older way, ``xlink:href``, which browsers and old cutters both understand.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from packwork.errors import RecipeError
from packwork.geometry import affine
from packwork.scene.colour import parse_colour
from packwork.scene.container import Backdrop, Container
from packwork.scene.item import Item, VectorArt
from packwork.scene.layout import Layout
from packwork.scene.notation import (
    attributes,
    decimals,
    matrix_text,
    number,
    path_data,
    points_text,
    with_fresh_ids,
    xml_text,
)
from packwork.units import Unit
from packwork.writers.cutting import CutOptions, cut_group
from packwork.writers.frame import PictureFrame
from packwork.writers.options import TextChoice
from packwork.writers.promise import finest, promised, stated_limits, stated_weights
from packwork.writers.svg_lines import NAMESPACE, edge_group, layer_attributes, line_layers
from packwork.writers.svg_live_text import LiveWords
from packwork.writers.svg_symbols import (
    element,
    fill_attributes,
    item_ids,
    labelled,
    largest_scales,
    note_groups,
    paint,
    shape_key,
)

PRECISION = 1e-7
"""Every point drawn lies within this share of the canvas's longer side of its place in
the layout. Smaller: longer files, a twelfth for each digit, and programs that count in
single precision do not see it. Chosen: far below the finest gap a finish keeps."""

_STEP_SHARE = PRECISION / 4
"""Last digit of each rounded quantity, as a share of the canvas. A point gathers the
rounding of its path, scale, turn and place: half a step each, in two directions for the
path and the place, 2.4 half steps in all. Derived."""

NAME_LENGTH = 80
"""Characters of a name that are kept: it is repeated on every copy. Chosen."""

CONTAINER_STROKE = "#1a202c"
"""Colour of the container's drawn line. Chosen by eye."""

CONTAINER_STROKE_SHARE = 1 / 500
"""Width of the container's drawn line, as a share of the canvas. Chosen by eye."""

HALO_SHARE = 2 * CONTAINER_STROKE_SHARE
"""How far a halo reaches beyond its item, as a share of the canvas. Larger ones run into each
other, smaller ones are lost on busy ground."""


@dataclass(frozen=True, kw_only=True)
class SvgOptions:
    """Options of drawing a layout as SVG.

    ``background`` is a CSS colour; ``None`` or ``"none"`` leaves it clear. ``show_container`` draws
    the container's line, whose path is there either way; None: if it has a pen. ``flatten`` writes
    every copy in full, for tools that do not know ``use``. ``text`` is ``live`` for words that can
    be selected and found, in fonts that the file carries, ``outlines`` for curves. Lines for a
    cutter (``cut``) lie on top of all. Tiles are drawn ``tiles`` times each way. With ``lines``
    items are lines for a machine. ``edges`` tells items that touch apart.
    """

    background: str | None = None
    show_container: bool | None = None
    flatten: bool = False
    text: TextChoice = "outlines"
    cut: CutOptions | None = None
    tiles: int = 1
    lines: bool = False
    edges: bool = False

    def __post_init__(self) -> None:
        if self.background is not None:
            parse_colour("background", self.background)


@dataclass(frozen=True, kw_only=True)
class SheetSize:
    """Size that a document's root states: on paper or screen in ``unit``, and in canvas units."""

    size: tuple[float, float]
    unit: Unit
    view: tuple[float, float]
    is_stretched: bool = False

    def times(self, tiles: int) -> SheetSize:
        """Sheet of so many each way."""
        (width, height), (across, down) = self.size, self.view
        size, view = (width * tiles, height * tiles), (across * tiles, down * tiles)
        return replace(self, size=size, view=view)


def sheet_of(frame: PictureFrame, container: Container) -> SheetSize:
    """Sheet of whole pixels both ways: renderers fit a fractional canvas with soft edges.

    A tile has to end where its pixels do, so it is stretched by less than a pixel.
    """
    size = (float(frame.columns), float(frame.rows))
    if container.lattice is not None:
        view = (container.width, container.height)
        return SheetSize(size=size, unit="px", view=view, is_stretched=True)
    view = (size[0] / frame.px_per_cu, size[1] / frame.px_per_cu)
    return SheetSize(size=size, unit="px", view=view)


def svg_text(layout: Layout, options: SvgOptions | None = None) -> str:
    """SVG document of a layout, as large as its canvas, in canvas units.

    Points are within ``PRECISION`` of the canvas; arts keep their colours.

    Examples
    --------
    >>> import numpy as np
    >>> from packwork.geometry.outline import Outline
    >>> from packwork.scene.container import Container
    >>> from packwork.scene.item import FlatArt
    >>> from packwork.scene.pose import Poses
    >>> square = Outline.from_rings([[[-1, -1], [1, -1], [1, 1], [-1, 1]]])
    >>> item = Item("square", "square", square, square, FlatArt("teal"))
    >>> one = np.ones(1)
    >>> poses = Poses(2 * one, 2 * one, 0 * one, one)
    >>> tile = Container("tile", "tile", square, 4.0, 4.0)
    >>> text = svg_text(Layout(tile, (item,), poses, one))
    >>> '<use id="item-1" data-name="square"' in text
    True
    """
    container = layout.container
    size = (container.width, container.height)
    sheet = SheetSize(size=size, unit=container.unit, view=size)
    return svg_document(layout, options or SvgOptions(), sheet)


def svg_document(layout: Layout, options: SvgOptions, sheet: SheetSize) -> str:
    """SVG document of a layout on a sheet of any size: :func:`svg_text`, and rendering."""
    share = finest(layout, _STEP_SHARE)
    digits = decimals(layout.container.side * share)
    live = LiveWords(layout.items if options.text == "live" else ())
    shapes = _shapes(layout, share)
    before, after = _repeated(layout.container, sheet, options.tiles)
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        _root(sheet.times(options.tiles), NAMESPACE if options.lines else ""),
        f"<title>{xml_text(layout.container.name[:NAME_LENGTH])}</title>",
        *live.style(),
        *([] if options.flatten or options.lines else _definitions(shapes.values(), live)),
        *before,
        *_background(options.background),
        *_backdrop(layout.container.backdrop),
        *_halos(layout, digits),
        *_container(layout, options, digits),
        *(_lines if options.lines else _items)(layout, shapes, digits, live, options),
        *(edge_group(layout, digits) if options.edges else ()),
        *_images(layout, digits, flatten=options.flatten),
        *note_groups(layout),
        *([] if options.cut is None else cut_group(layout, options.cut, digits)),
        *after,
        "</svg>",
        "",
    ]
    return "\n".join(lines)


@dataclass(frozen=True)
class _Shape:
    """A definition that copies share, and how finely its own units are written."""

    name: str
    item: Item
    path_digits: int
    scale_digits: int
    turn_digits: int


def _shapes(layout: Layout, share: float) -> dict[Hashable, _Shape]:
    """One definition for each distinct drawing, fine enough for its largest copy."""
    first = {shape_key(item): item for item in reversed(layout.items)}
    return {
        key: _shape(f"shape-{n}", first[key], scale, layout.container.side, share)
        for n, (key, scale) in enumerate(largest_scales(layout, shape_key).items(), start=1)
    }


def _shape(name: str, item: Item, scale: float, side: float, share: float) -> _Shape:
    radius, step = max(item.ink.radius, item.outline.radius), side * share
    # As fine as the largest that the canvas has room for needs it: how one copy is written must
    # not depend on how large another one has become.
    reach = max(side, radius * scale)
    return _Shape(
        name=name,
        item=item,
        path_digits=decimals(step * radius / reach),
        scale_digits=decimals(step / radius),
        turn_digits=decimals(math.degrees(step / reach)),
    )


def _root(sheet: SheetSize, namespace: str) -> str:
    width, height, view_width, view_height = (f"{v:.12g}" for v in (*sheet.size, *sheet.view))
    unit = "" if sheet.unit == "px" else sheet.unit
    fit = ' preserveAspectRatio="none"' if sheet.is_stretched else ""
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"{namespace}'
        f' width="{width}{unit}" height="{height}{unit}"'
        f' viewBox="0 0 {view_width} {view_height}"{fit}>'
    )


def _repeated(container: Container, sheet: SheetSize, tiles: int) -> tuple[list[str], list[str]]:
    """Pattern about a drawing, and a rectangle filled with it; nothing if it stands once."""
    if tiles == 1:
        return [], []
    if container.lattice is None:
        raise RecipeError("tiles", "draws them side by side; this is none, see --tile")
    width, height = (f"{v:.12g}" for v in sheet.view)
    box = f'width="{width}" height="{height}" patternUnits="userSpaceOnUse"'
    whole = attributes({"width": "100%", "height": "100%", "fill": "url(#tile)"})
    return (
        [f'<defs><pattern id="tile" {box}>'],
        ["</pattern></defs>", f"<rect{whole}/>"],
    )


def _definitions(shapes: Iterable[_Shape], live: LiveWords) -> list[str]:
    # Text that stands for another's copy could not be selected.
    curves = (shape for shape in shapes if not live.has(shape.item))
    drawn = [element(s.item, {"id": s.name}, "", s.path_digits) for s in curves]
    return ["<defs>", *drawn, "</defs>"] if drawn else []


def _background(colour: str | None) -> list[str]:
    channels = parse_colour("background", colour or "none")
    if channels[3] == 0:
        return []
    head = attributes(fill_attributes(channels))
    return [f'<rect id="background" width="100%" height="100%"{head}/>']


def _backdrop(backdrop: Backdrop | None) -> list[str]:
    """The picture behind; as fine as it was printed, else its small copy."""
    if backdrop is None:
        return []
    art = backdrop.art.preview
    place = matrix_text(affine.compose(backdrop.matrix, art.matrix))
    return [f'<g id="backdrop" transform="{place}">{art.markup}</g>']


def _halos(layout: Layout, digits: int) -> list[str]:
    """Halos by which items stand out from a picture behind, under all of them."""
    width = f"{2 * HALO_SHARE * layout.container.side:.6g}"
    drawn = [
        f'<path{attributes({"fill": one.halo, "stroke": one.halo})} d="{path_data(ink, digits)}"/>'
        for one, ink in zip(layout.items, layout.inks, strict=True) if one.halo
    ] if any(one.halo for one in layout.items) else []  # fmt: skip
    head = f'<g id="halos" stroke-width="{width}" stroke-linejoin="round">'
    return [head, *drawn, "</g>"] if drawn else []


def container_line(container: Container, show: bool | None) -> tuple[bool, tuple[str, float]]:
    """Line of a container: if it is drawn, and its colour and width in canvas units."""
    usual = CONTAINER_STROKE, container.side * CONTAINER_STROKE_SHARE
    return container.pen is not None if show is None else show, container.pen or usual


def _container(layout: Layout, options: SvgOptions, digits: int) -> list[str]:
    container = layout.container
    layer = layer_attributes("sheet") if options.lines else ""
    is_shown, (colour, width) = container_line(container, options.show_container)
    head = attributes(
        {
            "id": "container",
            "data-name": container.name[:NAME_LENGTH],
            "data-tile": "" if container.lattice is None else container.lattice.kind,
            "fill": "none",
            "stroke": colour,
            "stroke-width": f"{width:.6g}",
            "display": "" if is_shown else "none",
        }
    )
    outline = path_data(container.outline, digits)
    if container.walls is None:
        return [f"<g{head}{layer}>", f'<path d="{outline}"/>', "</g>"]
    # The path is what items lie in, and is measured; seen are the walls.
    lines = [f'<polyline points="{points_text(line, digits)}"/>' for line in container.walls]
    return [f"<g{head}{layer}>", f'<path stroke="none" d="{outline}"/>', *lines, "</g>"]


def _promise_attributes(layout: Layout) -> dict[str, str]:
    """Promises about the items that ``packwork measure`` cannot see."""
    gap, shares = promised(layout)
    return {
        "data-gap": gap,
        "data-count": str(len(layout.items)) if gap else "",
        "data-in-shares": "true" if shares else "",
        "data-holes": "keep" if any(item.outline.has_holes for item in layout.items) else "",
        **stated_limits(layout),
    }


def _lines(
    layout: Layout, shapes: dict[Hashable, _Shape], digits: int, _: LiveWords, __: SvgOptions
) -> list[str]:
    scales, places, names = layout.poses.axis_scales.tolist(), [], []
    for k, item in enumerate(layout.items):
        shape = shapes[shape_key(item)]
        places.append((_place(layout, k, scales[k], shape, digits), shape.path_digits))
        names.append((item.label.name or item.name)[:NAME_LENGTH])
    return line_layers(layout, places, names, _promise_attributes(layout))


def _items(
    layout: Layout, shapes: dict[Hashable, _Shape], digits: int, live: LiveWords,
    options: SvgOptions,
) -> list[str]:  # fmt: skip
    copies = [f'<g id="items"{attributes(_promise_attributes(layout))}>']
    scales, ids = layout.poses.axis_scales.tolist(), item_ids(layout.items)
    weights = stated_weights(layout)
    for k, item in enumerate(layout.items):
        shape = shapes[shape_key(item)]
        name = (item.label.name or item.name)[:NAME_LENGTH]
        own = {"id": ids[k], "data-name": name, "data-weight": weights[k], **paint(item)}
        place = _place(layout, k, scales[k], shape, digits)
        if live.has(item):
            drawn = live.element(item, own, place)
        elif options.flatten:
            drawn = _whole_copy(item, own, place, shape, k + 1)
        else:
            drawn = _use(own, place, shape)
        copies.append(labelled(drawn, item.label))
    return [*copies, "</g>"]


def _images(layout: Layout, digits: int, *, flatten: bool) -> list[str]:
    """Images of the items of a tile, where they cross its edge and come in again."""
    container = layout.container
    if container.lattice is None:
        return []
    if flatten:
        container.check_edge("flatten", "items without <use>")
    canvas, drawn = (0.0, 0.0, container.width, container.height), list[str]()
    for name, ink, outline in zip(
        item_ids(layout.items), layout.inks, layout.outlines, strict=True
    ):
        edges = np.array([ink.bounds, outline.bounds])
        box = *edges[:, :2].min(axis=0).tolist(), *edges[:, 2:].max(axis=0).tolist()
        for shift in container.lattice.meeting(box, canvas).tolist():
            if any(shift):
                x, y = (number(v, digits) for v in shift)
                head = {"xlink:href": f"#{name}", "transform": f"translate({x} {y})"}
                drawn.append(f"<use{attributes(head)}/>")
    return [f'<g id="images" data-count="{len(drawn)}">', *drawn, "</g>"]


def _use(own: dict[str, str], place: str, shape: _Shape) -> str:
    head = attributes({**own, "xlink:href": f"#{shape.name}", "transform": place})
    return f"<use{head}/>"


def _whole_copy(item: Item, own: dict[str, str], place: str, shape: _Shape, count: int) -> str:
    if isinstance(item.art, VectorArt):
        markup = with_fresh_ids(item.art.markup, f"-{count}")
        item = replace(item, art=replace(item.art, markup=markup))
    return element(item, own, place, shape.path_digits)


def _place(layout: Layout, k: int, scales: Sequence[float], shape: _Shape, digits: int) -> str:
    """Transform of one copy; turns of 0 and scales of 1 are left out."""
    poses = layout.poses
    x, y = (number(float(v), digits) for v in (poses.x[k], poses.y[k]))
    turn = number(math.remainder(math.degrees(poses.angle[k]), 360.0), shape.turn_digits)
    wide, high = (number(v, shape.scale_digits) for v in scales)
    scale = wide if wide == high else f"{wide} {high}"
    text = f"translate({x} {y})"
    text += f"rotate({turn})" if turn != "0" else ""
    return text + (f"scale({scale})" if scale != "1" else "")
