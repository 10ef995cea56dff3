"""White paint of SVG containers over darker paint, as holes."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import shapely

from packwork.geometry.bezier import FLATTENING
from packwork.geometry.overlay import difference, intersection, union
from packwork.geometry.polygon import Region
from packwork.readers.svg.drawing import Drawing
from packwork.readers.svg.region.follow import Follower
from packwork.readers.svg.region.sheet import is_near_white
from packwork.readers.svg_syntax.extent import drawing_box
from packwork.readers.svg_syntax.painted import Painted
from packwork.readers.svg_syntax.painting import opacity

MOST_WHITES = 2_000
"""White shapes whose place among the others is looked at; more are passed over. Chosen."""

_HALF = 0.5
_SPECIAL = frozenset({"mask", "filter"})


@dataclass(frozen=True, eq=False)
class _Layer:
    """What one shape paints in one colour.

    Parameters
    ----------
    region
        In CSS pixels.
    is_white
        Whether it is opaque and nearly white.
    """

    region: Region
    is_white: bool


def without_whites(drawing: Drawing, region: Region) -> Region:
    """Region less what white paint covers of dark fills below it.

    White on nothing counts, as a panda's face does and a drawing in white alone; so does what
    is painted over in turn.

    Parameters
    ----------
    region
        What all shapes of the drawing cover.
    """
    holes = [hole for hole in _holes(drawing) if hole.area > 0]
    return difference(region, union(holes)) if holes else region


def has_whites(drawing: Drawing) -> bool:
    """Whether any shape is painted white."""
    return any(is_near_white(_fill(s)) or is_near_white(_stroke(s)) for s in drawing.shapes)


def _holes(drawing: Drawing) -> Iterator[Region]:
    shapes, box = drawing.shapes, drawing_box(drawing.shapes)
    whites = sum(is_near_white(_fill(s)) or is_near_white(_stroke(s)) for s in shapes)
    if box is None or not 0 < whites <= MOST_WHITES:
        return
    follower = Follower(max(box[2] - box[0], box[3] - box[1]), FLATTENING)
    layers = list(_layers(shapes, drawing.root, follower))
    dark = [k for k, layer in enumerate(layers) if not layer.is_white]
    tree = shapely.STRtree([layers[k].region for k in dark])
    for k, layer in enumerate(layers):
        if not layer.is_white:
            continue
        near = [dark[i] for i in tree.query(layer.region, "intersects")]
        below = [layers[i].region for i in near if i < k]
        if below:
            above = union([layers[i].region for i in near if i > k])
            hole = intersection(layer.region, union(below))
            yield difference(hole, above)


def _layers(shapes: Sequence[Painted], root: ET.Element, follower: Follower) -> Iterator[_Layer]:
    """Fills in their order, and strokes where they are white; dark lines hide nothing."""
    parents = {child: parent for parent in root.iter() for child in parent}
    for shape in shapes:
        painting = shape.painting
        is_plain = _opacity(shape.element, parents) >= _HALF
        if painting.has_fill:
            is_white = is_near_white(_fill(shape))
            if not is_white or (is_plain and painting.fill_opacity >= _HALF):
                yield _Layer(follower.fill(shape), is_white)
        is_seen = is_plain and painting.stroke_opacity >= _HALF
        if painting.has_stroke and is_seen and is_near_white(_stroke(shape)):
            yield _Layer(follower.stroke(shape), True)


def _opacity(element: ET.Element, parents: dict[ET.Element, ET.Element]) -> float:
    """Opacity of an element in all that it stands in; 0 where a mask or a filter decides."""
    product, one = 1.0, element
    while True:
        if _SPECIAL & one.attrib.keys():
            return 0.0
        product *= opacity(one.get("opacity"), 1.0)
        if one not in parents:
            return product
        one = parents[one]


def _fill(shape: Painted) -> str:
    return _plain(shape.painting.fill, shape)


def _stroke(shape: Painted) -> str:
    return _plain(shape.painting.stroke, shape)


def _plain(paint: str, shape: Painted) -> str:
    return shape.painting.color if paint.strip().lower() == "currentcolor" else paint
