"""Checks of SVG files that other programs changed: paint outside the items, lost groups.

Programs that make SVGs smaller take names, groups and hidden paths away. What is left is measured
as it stands, and what is missing is said.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Set

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.phrasing import number_of
from packwork.readers.svg_syntax.coordinates import parse_transform

PAINTED = frozenset(
    {"g", "a", "use", "path", "image", "text", "rect", "circle", "ellipse", "line", "polyline",
     "polygon", "svg", "switch", "foreignObject"}
)  # fmt: skip
"""Elements that may paint."""

OWN = frozenset(
    {"background", "backdrop", "halos", "container", "items", "images", "labels", "legend"}
)
"""Names of what our files hold at their top."""

_BEHIND = frozenset({"background", "backdrop", "halos"})
"""Those that lie below all items, and above them hide what is measured."""


_BESIDE_CUTS = frozenset({"engrave", "artwork"})
"""Groups of a nest that go with its parts and are not cut: they are looked through by themselves.
In other files they are strange like all else."""

LOST_ITEMS = (
    "has no group named items any more: each drawing counts as an item, and what was promised is "
    "not in the file"
)
LOST_CONTAINER = "has no group named container any more: the page is taken for it"
"""What is said of files from which another program has taken our groups."""


def tag(element: ET.Element) -> str:
    """Name of an element without its namespace."""
    return str(element.tag).rpartition("}")[2]


def group_named(root: ET.Element, name: str) -> ET.Element | None:
    """The first group of that name at the top; None if there is none."""
    return next((e for e in root if e.get("id") == name and tag(e) == "g"), None)


def is_of_lines(items: ET.Element | None) -> bool:
    """Whether a group of items is one of lines for a machine."""
    return items is not None and items.get("data-lines") == "cut"


def layers_beside(root: ET.Element) -> list[ET.Element]:
    """Groups at the top of a nest that go with its parts: artwork, and what is engraved.

    Examples
    --------
    >>> text = '<svg><g data-lines="engrave"/><g id="items" data-lines="cut"/></svg>'
    >>> len(layers_beside(ET.fromstring(text)))
    1
    >>> len(layers_beside(ET.fromstring(text.replace("cut", ""))))
    0
    """
    if not is_of_lines(group_named(root, "items")):
        return []
    return [e for e in root if tag(e) == "g" and e.get("data-lines") in _BESIDE_CUTS]


def declared(element: ET.Element) -> dict[str, str]:
    """Properties in an element's ``style``.

    Examples
    --------
    >>> declared(ET.fromstring('<g style="Fill: red !important;;x"/>'))
    {'fill': 'red', 'x': ''}
    """
    parts = (part.partition(":") for part in element.get("style", "").split(";"))
    return {key.strip().lower(): value.replace("!important", "").strip()
            for key, _, value in parts if key.strip()}  # fmt: skip


def unmeasured(root: ET.Element) -> tuple[str, ...]:
    """A sentence about elements at the top of a file that may paint and are measured nowhere.

    Examples
    --------
    >>> root = ET.fromstring('<svg><g id="items"/><g id="items"/><path d="M0 0"/></svg>')
    >>> unmeasured(root)
    ('2 drawings outside the group items are not measured',)
    """
    count = strange(root, OWN)
    if count == 0:
        return ()
    many = number_of(
        count, "drawing outside the group items is", "drawings outside the group items are"
    )
    return (f"{many} not measured",)


def strange(root: ET.Element, known: Set[str]) -> int:
    """Number of drawings at the top of a file that are no groups of these names, each once.

    Examples
    --------
    >>> strange(ET.fromstring('<svg><g id="items"/><g id="cut"/><rect/></svg>'), OWN)
    2
    >>> strange(ET.fromstring('<svg><g id="items"/><rect id="background"/></svg>'), OWN)
    1
    """
    met: set[str] = set()
    beside = layers_beside(root)
    count = 0
    for element in root:
        name = element.get("id", "")
        is_above = name in _BEHIND and "items" in met
        is_strange = name not in known or name in met or is_above
        if tag(element) in PAINTED and is_strange and element not in beside:
            count += 1
        met.add(name)
    return count


def loose_items(root: ET.Element) -> tuple[list[ET.Element], FloatArray]:
    """Drawings of a file without our groups, and the map of the group that they lie in.

    Goes into a group as long as that is all there is; a sheet behind all is no item.

    Examples
    --------
    >>> root = ET.fromstring('<svg><g transform="scale(2)"><path d="M0 0"/><path/></g></svg>')
    >>> found, place = loose_items(root)
    >>> [tag(one) for one in found], place[0, 0]
    (['path', 'path'], np.float64(2.0))
    """
    place, group = affine.identity(), root
    while True:
        inside = [e for e in group if tag(e) in PAINTED and not _is_sheet(e)]
        is_only_group = len(inside) == 1 and tag(inside[0]) == "g"
        if not is_only_group or "data-name" in inside[0].attrib:
            return inside, place
        group = inside[0]
        place = affine.compose(place, parse_transform(group.get("transform")))


def _is_sheet(element: ET.Element) -> bool:
    """Whether it is our background, named or not, or a path that is not shown."""
    if element.get("id") in OWN - {"items"} or element.get("display") == "none":
        return True
    sides = element.get("width"), element.get("height")
    return tag(element) == "rect" and sides == ("100%", "100%")
