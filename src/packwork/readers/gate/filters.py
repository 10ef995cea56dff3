"""Filters: which are let in, and how much work they are.

Those that shade a shape from its own light and edge are part of its look. What fetches
pictures, makes noise or takes time by the square of a radius is not let in, nor is a
region far larger than what is filtered; then the shape is drawn without its filter.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET

from packwork.readers.gate.references import elements_by_id, referenced_ids
from packwork.readers.gate.vocabulary import FILTER_STEPS
from packwork.readers.svg.lengths import parse_length, parse_numbers
from packwork.readers.unfit import notice

MAX_STEPS = 800
"""Steps of all filters of a drawing, each counted for every shape it is used on. Shaded
emoji have some hundreds; each costs some microseconds of every picture. Chosen."""

LARGEST_REGION = 3.0
"""Side of a filter's region, as a multiple of what it filters or of the page. Chosen."""

FILTER = "filter"


def settle_filters(root: ET.Element) -> None:
    """Take out filters that are too large or too many, in place, and say so.

    Examples
    --------
    >>> root = ET.fromstring('<svg><filter id="f" width="9"/><g filter="url(#f)"/></svg>')
    >>> settle_filters(root)
    >>> root[1].attrib
    {}
    """
    if not any(FILTER in element.attrib for element in root.iter()):
        return
    by_id = elements_by_id(root)
    side = max(parse_numbers(root.get("viewBox"))[2:], default=0.0)
    wild = {name for name, e in by_id.items() if e.tag == FILTER and not _is_tame(e, side)}
    for element in root.iter():
        if any(name == FILTER and target in wild for name, target in referenced_ids(element)):
            del element.attrib[FILTER]
    if wild or count_steps(root) > MAX_STEPS:
        notice("some filters were left out, for they are larger or more than drawings need")
    if count_steps(root) > MAX_STEPS:
        drop_filters(root)


def drop_filters(root: ET.Element) -> None:
    """Take all filters off, in place.

    Examples
    --------
    >>> root = ET.fromstring('<svg><filter id="f"/><g filter="url(#f)"/></svg>')
    >>> drop_filters(root); ET.tostring(root).decode()
    '<svg><g /></svg>'
    """
    for element in root.iter():
        element.attrib.pop(FILTER, None)
        for child in element.findall(FILTER):
            element.remove(child)


def count_steps(root: ET.Element) -> int:
    """Steps of all filters, each counted wherever it is used.

    Examples
    --------
    >>> text = '<svg><filter id="f"><feOffset/></filter><g filter="url(#f)"/></svg>'
    >>> count_steps(ET.fromstring(text))
    1
    """
    steps = {
        name: sum(e.tag in FILTER_STEPS for e in element.iter())
        for name, element in elements_by_id(root).items()
        if element.tag == FILTER
    }
    uses = (target for element in root.iter() for name, target in referenced_ids(element))
    return sum(steps.get(target, 0) for target in uses)


def _is_tame(element: ET.Element, side: float) -> bool:
    """Whether the region lies about what is filtered, or about a page of that side."""
    whole = 1.0 if element.get("filterUnits") != "userSpaceOnUse" else side
    lengths = (parse_length(element.get(name), whole) for name in ("x", "y", "width", "height"))
    return all(abs(length or 0.0) <= LARGEST_REGION * (whole or 1.0) for length in lengths)
