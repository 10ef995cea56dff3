"""Plain values to JSON, as ``--report`` writes them."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from packwork.writers.geojson import plain


def json_bytes(values: Mapping[str, Any]) -> bytes:
    """Indented JSON of plain values; what JSON cannot hold becomes null or text.

    Examples
    --------
    >>> json.loads(json_bytes({"gap": float("inf")}))
    {'gap': None}
    """
    return (json.dumps(plain(values), indent=2, allow_nan=False) + "\n").encode()
