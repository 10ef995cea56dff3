"""Files held against what their run promised, from their own text, before they are written."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import shapely

from packwork.errors import PackworkError
from packwork.metrics.certificate import Promise, unclean
from packwork.metrics.exact import exact_metrics
from packwork.readers.gate.door import MAX_BYTES
from packwork.readers.layouts.read import ENDINGS, read_content
from packwork.scene.layout import Layout


def faults_in_file(data: bytes, path: str | Path, layout: Layout) -> tuple[str, ...]:
    """Parts of a layout's promise that the text of a file breaks, a sentence each.

    Transforms and outlines are those that stand in the text, curves followed anew. Files that
    have no outlines break nothing.

    Parameters
    ----------
    data
        What is to be written.
    path
        Where to; its ending says what it is.
    layout
        What is to stand in it.

    Examples
    --------
    >>> from packwork.scene.blank import blank
    >>> faults_in_file(b"", "layout.png", blank())
    ()
    """
    # Of larger ones mostly pixels.
    if (
        Promise.of(layout.manifest) is None
        or Path(path).suffix.lower() not in ENDINGS
        or len(data) > MAX_BYTES
    ):
        return ()
    try:
        found = read_content(data, path, outlines_only=True)
    except PackworkError as error:
        return (f"what is written cannot be read back: {error}",)
    if len(found.items) != len(layout.items):
        return (f"{len(found.items)} of {len(layout.items)} items are written",)
    # In the file's own units.
    promise = Promise.of(found.manifest)
    if promise is None:
        return ("what was promised is not written",)
    if is_clear(found, promise.least_gap(found.container.side)):
        return ()
    return unclean(promise, found, exact_metrics(found.outlines, found.container.outline))


def is_clear(layout: Layout, gap: float) -> bool:
    """Whether no item is nearer than a gap to another one, or to the container's edge.

    Quicker than to measure how near they are.
    """
    regions = np.array([outline.region for outline in layout.outlines], dtype=object)
    whole = layout.container.outline.region
    edge = whole.boundary
    shapely.prepare([whole, edge, *regions])
    if not shapely.covers(whole, regions).all():
        return False
    tree = shapely.STRtree(regions)
    near = tree.query(regions, predicate="dwithin", distance=gap)
    return near.shape[1] == len(regions) and not shapely.dwithin(edge, regions, gap).any()
