"""What a run promised of its layout, in words that fit into any file.

A measure of the file alone can then say whether the promise holds.
"""

from __future__ import annotations

from collections.abc import Mapping

from packwork.scene.layout import Layout


def promised(layout: Layout) -> tuple[str, bool]:
    """Smallest gap in canvas units, empty without a promise; and whether shares are kept.

    Examples
    --------
    >>> import numpy as np
    >>> from packwork.geometry.outline import Outline
    >>> from packwork.scene.container import Container
    >>> from packwork.scene.pose import Poses
    >>> tile = Container("", "", Outline.from_rings([[[0, 0], [4, 0], [4, 4]]]), 4.0, 4.0)
    >>> none, said = np.zeros(0), {"promised": {"gap": 0.5, "areas_in_shares": False}}
    >>> promised(Layout(tile, (), Poses(none, none, none, none), none, said))
    ('0.5', False)
    """
    found = layout.manifest.get("promised")
    if not isinstance(found, Mapping):
        return "", False
    return f"{float(found.get('gap', 0.0)):.12g}", found.get("areas_in_shares") is True


def stated_weights(layout: Layout) -> list[str]:
    """Weight of each item where a promise speaks of it; else empty texts.

    Examples
    --------
    >>> import numpy as np
    >>> from packwork.geometry.outline import Outline
    >>> from packwork.scene.container import Container
    >>> from packwork.scene.pose import Poses
    >>> tile = Container("", "", Outline.from_rings([[[0, 0], [4, 0], [4, 4]]]), 4.0, 4.0)
    >>> none = np.zeros(0)
    >>> stated_weights(Layout(tile, (), Poses(none, none, none, none), none))
    []
    """
    has_shares = promised(layout)[1]
    weights = layout.weights.tolist()
    return [f"{weight:.12g}" if has_shares and weight != 1.0 else "" for weight in weights]
