"""Parts of the run as they are kept, so that they may be run one by one."""

from __future__ import annotations

import json
import subprocess
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from benchmarks.robustness.hostile.trying import CRASH, HANG

ROOT = Path(__file__).resolve().parents[3]
COLUMN_OF = {"crash": CRASH, "hang": HANG, "lost": "lost files"}


@dataclass
class Tally:
    """Counts of one row, and what went wrong."""

    counts: Counter[str] = field(default_factory=Counter)
    faults: list[str] = field(default_factory=list)

    def add(self, other: Tally) -> None:
        """Count what another row counted, too."""
        self.counts += other.counts
        self.faults += other.faults

    def blame(self, faults: Sequence[str]) -> None:
        """Count sentences by the word that they begin with."""
        self.counts.update(COLUMN_OF[fault.partition(":")[0]] for fault in faults)
        self.faults += faults


@dataclass
class Part:
    """One part of the run: its rows, facts for the page, and which code it tells of.

    Parameters
    ----------
    settings
        What was typed.
    commits
        Commits of the checkout, each with how many runs it made; a plus sign where files differed.
    """

    name: str
    rows: dict[str, Tally] = field(default_factory=dict)
    facts: dict[str, Any] = field(default_factory=dict)
    settings: str = ""
    commits: dict[str, int] = field(default_factory=dict)

    def save(self, folder: Path) -> None:
        """Keep it."""
        folder.mkdir(parents=True, exist_ok=True)
        # asdict would make a counter of a counter's pairs.
        rows = {
            name: {"counts": dict(tally.counts), "faults": tally.faults}
            for name, tally in self.rows.items()
        }
        text = json.dumps({**vars(self), "rows": rows}, indent=1)
        (folder / f"{self.name}.json").write_text(text, encoding="utf-8")

    @classmethod
    def load(cls, folder: Path, name: str) -> Part | None:
        """A part that was kept; None if there is none."""
        path = folder / f"{name}.json"
        if not path.exists():
            return None
        kept = json.loads(path.read_text(encoding="utf-8"))
        rows = {
            title: Tally(Counter(row["counts"]), row["faults"])
            for title, row in kept.pop("rows").items()
        }
        return cls(rows=rows, **kept)


def state() -> str:
    """The commit of this checkout; with a plus sign where files differ from it."""
    try:
        name = _git("rev-parse", "--short=10", "HEAD")
        return name + ("+" if _git("status", "--porcelain", "src", "benchmarks/hostile") else "")
    except (OSError, subprocess.CalledProcessError):
        return "unknown"


def _git(*words: str) -> str:
    done = subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True, check=True)
    return done.stdout.strip()
