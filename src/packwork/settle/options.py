"""Options of settling."""

from __future__ import annotations

from typing import final

from packwork.compaction.options import MoveOptions


@final
class SettleOptions(MoveOptions):
    """Gap, turns and seed of one pile."""
