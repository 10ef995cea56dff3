"""Notes: filled paths drawn beside the items, such as letters and keys of a legend."""

from __future__ import annotations

from dataclasses import dataclass

from packwork.arrays import FloatArray


@dataclass(frozen=True, eq=False)
class Note:
    """One filled path; never packed, never measured.

    Parameters
    ----------
    path
        SVG path data, filled by the even-odd rule.
    matrix
        2 x 3 map from the path's units to canvas units.
    fill
        Any CSS colour.
    says
        What it says, for readers who do not see it; may be empty.
    is_on_item
        Whether it is a label on an item: what is under it can still be pointed at, and films, in
        which items move, are without it.
    """

    path: str
    matrix: FloatArray
    fill: str
    says: str = ""
    is_on_item: bool = False
