"""Layouts read back from SVG, DXF and GeoJSON files that Packwork wrote, and from sessions."""

from __future__ import annotations

# Not from ``typing``, which takes long to load: the package itself loads this.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from packwork.scene.layout import Layout

MAX_LAYOUT_BYTES = 200_000_000
"""Size of a layout file: 9,000 items with hundreds of vertices each. Chosen."""

HANDED_IN: dict[str, Callable[[str | Path], Layout]] = {}
"""Readers of files that only packages above this one know, by their endings."""
