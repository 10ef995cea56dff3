"""Parts of the run as they are kept, so that they may be run one by one."""

from __future__ import annotations

import hashlib
import json
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from hostile.trying import CRASH, HANG

ROOT = Path(__file__).resolve().parents[2]
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
    """One part of the run: its rows, and facts for the page."""

    name: str
    rows: dict[str, Tally] = field(default_factory=dict)
    facts: dict[str, Any] = field(default_factory=dict)
    settings: str = ""

    def save(self, folder: Path) -> None:
        """Keep it, with what says of which code it tells."""
        folder.mkdir(parents=True, exist_ok=True)
        # asdict would make a counter of a counter's pairs.
        rows = {
            name: {"counts": dict(tally.counts), "faults": tally.faults}
            for name, tally in self.rows.items()
        }
        kept = {"code": code(), **vars(self), "rows": rows}
        text = json.dumps(kept, indent=1)
        (folder / f"{self.name}.json").write_text(text, encoding="utf-8")

    @classmethod
    def load(cls, folder: Path, name: str) -> Part | None:
        """A part that was kept; None if there is none of this very code."""
        path = folder / f"{name}.json"
        if not path.exists():
            return None
        kept = json.loads(path.read_text(encoding="utf-8"))
        if kept.pop("code") != code():
            return None
        rows = {
            title: Tally(Counter(row["counts"]), row["faults"])
            for title, row in kept.pop("rows").items()
        }
        return cls(rows=rows, **kept)


def code() -> str:
    """One word for the state of the package and of this benchmark."""
    files = [*(ROOT / "src").rglob("*.py"), *(ROOT / "benchmarks" / "hostile").glob("*.py")]
    whole = hashlib.sha256()
    for path in sorted(files):
        whole.update(path.relative_to(ROOT).as_posix().encode())
        whole.update(path.read_bytes())
    return whole.hexdigest()
