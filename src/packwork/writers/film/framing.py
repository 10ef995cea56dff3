"""Frame of a film: what is seen of the plane."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from packwork.arrays import FloatArray
from packwork.scene.layout import framed
from packwork.scene.track import poses_of
from packwork.writers.film.film import Film

FREE = 0.04
"""Free edge round a layout in a frame of a given ratio, as a share of its longer side. Chosen."""

_UNSEEN = 1e-3
"""Share of the canvas by which an item may stick out unseen. Chosen."""


def in_frame(film: Film) -> Film:
    """Film whose first picture is whole, and that in which the items have arrived.

    Its canvas grows to where they stick out of it; to the ratio that is asked for, the layout in
    the middle.
    """
    container, ratio = film.layout.container, film.options.ratio
    low, high = np.zeros(2), np.array([container.width, container.height])
    boxes = list(_boxes(film))
    if boxes:
        out = _UNSEEN * container.side
        seen = np.array(boxes)
        low = np.where(seen[:, 0].min(axis=0) < -out, seen[:, 0].min(axis=0), low)
        high = np.where(seen[:, 1].max(axis=0) > high + out, seen[:, 1].max(axis=0), high)
    if ratio is not None:
        edge = FREE * float((high - low).max())
        width, height = high - low + 2 * edge
        size = np.array([max(width, height * ratio), max(height, width / ratio)])
        low, high = (low + high - size) / 2, (low + high + size) / 2
    margins = (*-low, *(high - (container.width, container.height)))
    return replace(film, layout=framed(film.layout, margins)) if any(margins) else film


def _boxes(film: Film) -> Iterator[tuple[FloatArray, FloatArray]]:
    """Box of each item that is there, in the two pictures that are to be whole."""
    for frame in (film.frames[0], film.frames[film.arrival]):
        poses = poses_of(frame)
        for k in np.flatnonzero(poses.scale > 0).tolist():
            box = film.items[k].ink.mapped(poses.matrix(k)).bounds
            yield np.array(box[:2]), np.array(box[2:])
