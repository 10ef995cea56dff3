"""Holds of a document, as rules of recipes say them."""

from __future__ import annotations

import math

from packwork.live.document import Document


def pin_of(document: Document, k: int) -> dict[str, str | float]:
    """Held parts of the pose of row ``k``, as ``pin`` of a rule has it; empty if there are none."""
    poses, (place, angle, size) = document.poses, document.held[k]
    unit = document.container.unit
    pin: dict[str, str | float] = {}
    if place:
        pin |= {"x": f"{poses.x[k]:.17g}{unit}", "y": f"{poses.y[k]:.17g}{unit}"}
    if angle:
        pin["angle"] = math.degrees(poses.angle[k])
    if size:
        pin["size"] = f"{document.items[k].outline.extent * poses.scale[k]:.17g}{unit}"
    return pin
