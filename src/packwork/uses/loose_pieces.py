"""Parts of several pieces, which lie together on a sheet and come apart when they are cut: told."""

from __future__ import annotations

import logging
from collections.abc import Sequence

import shapely

from packwork.phrasing import enumerated
from packwork.uses.nested import SheetPart

_LOG = logging.getLogger("packwork")


def tell_pieces(parts: Sequence[SheetPart]) -> None:
    """Name parts of more than one piece, and how many they have, in a line of the log."""
    pieces = {
        one.item.name: int(shapely.get_num_geometries(one.item.outline.region)) for one in parts
    }
    if loose := [f"{name} ({count})" for name, count in pieces.items() if count > 1]:
        _LOG.warning("of several pieces, which come apart when they are cut: %s", enumerated(loose))
