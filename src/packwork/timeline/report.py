"""Report of a series: its scale, how far words move, and each step's own report."""

from __future__ import annotations

from typing import Any

import numpy as np

from packwork.timeline.solve import Solved


def report(series: Solved) -> dict[str, Any]:
    """Plain values for ``--report``."""
    moves = [round(float(np.median(one)), 6) if len(one) else None for one in series.moves]
    every = np.concatenate(series.moves)
    return {
        "scale": series.size,
        "moved": {
            "median": float(np.median(every)) if len(every) else None,
            "p90": float(np.quantile(every, 0.9)) if len(every) else None,
            "medians": moves,
        },
        "certified": all(run.certified for run in series.runs),
        "steps": [
            {"step": step.label, **run.report()}
            for step, run in zip(series.steps, series.runs, strict=True)
        ],
    }
