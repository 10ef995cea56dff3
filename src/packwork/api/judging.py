"""Layouts of any origin: measured, and brought to where nothing overlaps."""

from __future__ import annotations

from dataclasses import asdict, replace
from pathlib import Path

import numpy as np

from packwork.api.layout import Layout, public
from packwork.api.parts import measures
from packwork.api.plain import plain_seed
from packwork.errors import RecipeError
from packwork.finish.finish import finish as exact_finish
from packwork.finish.options import FinishOptions
from packwork.metrics.certificate import Promise, unclean
from packwork.metrics.measure import LayoutMetrics, Metrics
from packwork.metrics.measure import measure as measure_layout
from packwork.progress import NOBODY, Listener, Stop, as_observer, never
from packwork.readers.layouts.read import read_written
from packwork.scene import layout as scene
from packwork.scene.item import bulge_between
from packwork.units import length_asked

LARGEST = 2.0
"""Factor by which an item may grow in a finish that grows. As of free sizes."""


def measure(layout: scene.Layout | str | Path) -> Metrics:
    """Measures by name of a layout, or of a file that holds one (.geojson, .svg, .dxf, .packwork).

    As :attr:`Layout.metrics` has them; of a file without ``LC_ink``, for it holds outlines, not
    what was drawn in them.

    Raises
    ------
    ReadError
        If the file cannot be read.

    Examples
    --------
    >>> from packwork import fill
    >>> layout = fill("circle", "hexagon", count=7, effort="draft", levels="50")
    >>> measure(layout) == layout.metrics
    True
    """
    if isinstance(layout, Layout):
        return layout.metrics
    if isinstance(layout, scene.Layout):
        return measures(measure_layout(layout).as_dict())
    found = measure_layout(read_written(layout)).as_dict()
    return measures({k: v for k, v in found.items() if k != "LC_ink"})


def finish(
    layout: scene.Layout,
    *,
    padding: str | float = 0.0,
    grow: bool = True,
    turn: bool = True,
    trials: int = 0,
    seed: int | np.random.Generator | None = 0,
    observer: Listener = NOBODY,
    stop: Stop = never,
) -> Layout:
    """Exact layout near another one: nothing overlaps, nothing sticks out.

    Parameters that :func:`fill` has too mean the same here.

    For layouts whose items were moved by hand or placed by other means. Items move, turn and
    shrink no more than they have to; where that is in vain, one is brought to a void.
    ``certified`` of the result says whether all found room.

    Parameters
    ----------
    layout
        Any, its sizes as they are to be.
    padding
        Least gap between items and to the container's edge, a length as for :func:`fill`.
    grow
        Whether items grow into the room that is left.
    turn
        Whether they may turn.
    trials
        How many turns and exchanges of items are tried, so that they can grow more.
    seed
        Of those trials.

    Raises
    ------
    RecipeError
        If the padding has no meaning.

    Examples
    --------
    >>> from packwork import fill
    >>> layout = fill("circle", "hexagon", count=7, effort="draft", levels="50")
    >>> moved = replace(layout, poses=replace(layout.poses, x=layout.poses.x + 20))
    >>> moved.certified, finish(moved).certified
    (False, True)
    """
    if not isinstance(layout, scene.Layout):
        raise RecipeError(
            "layout", f"is {type(layout).__name__}; give a layout, such as Layout.load(file)"
        )
    container = layout.container
    gap = length_asked("padding", padding, container.unit, container.side)
    scales = np.array(layout.poses.scale)
    largest = scales * (LARGEST if grow else 1.0)
    bulge = bulge_between(layout.items, largest)
    options = FinishOptions(
        gap_cu=gap + bulge, largest=tuple(largest.tolist()), turning=turn, trials=trials,
        seed=plain_seed(seed),
    )  # fmt: skip
    outlines = [item.outline for item in layout.items]
    poses = layout.poses.subset(np.arange(len(scales)))
    found = exact_finish(container, outlines, poses, options, as_observer(observer), stop)
    return _certified(replace(layout, poses=found.poses), Promise(gap))


# ``import packwork.finish.options as options`` asks the verb for the module, which it has not, and
# then looks for one by this name.
finish.__name__ = "packwork.finish"


def _certified(layout: scene.Layout, promise: Promise) -> Layout:
    """The layout, measured, and what it promises."""
    found: LayoutMetrics = measure_layout(layout)
    # It is no longer what stood in a file.
    kept = {key: said for key, said in layout.manifest.items() if key != "changed"}
    faults = unclean(promise, replace(layout, manifest=kept), found.exact)
    said = kept | {
        "promised": asdict(promise),
        "certified": not faults and len(layout.items) > 0,
        "metrics": found.as_dict(),
    }
    made = public(replace(layout, manifest=said))
    made.__dict__["metrics"] = measures(found.as_dict())
    return made
