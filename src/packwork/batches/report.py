"""Report of a batch: a table of all rows, and a page to look through."""

from __future__ import annotations

import csv
import html
import io
import json
import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any
from urllib.parse import quote

from packwork.batches.task import RowOutcome
from packwork.errors import WriteError
from packwork.writers.placements import plain_cell

SEEN = (".svg", ".png", ".jpg", ".jpeg", ".webp")
"""Endings of files that a browser shows as pictures, the best first."""

_STYLE = (
    "body{font:14px system-ui,sans-serif;margin:2rem;color-scheme:light dark}"
    "main{display:grid;grid-template-columns:repeat(auto-fill,minmax(13rem,1fr));gap:1.5rem}"
    "figure{margin:0}img{width:100%;height:13rem;object-fit:contain;background:#fff}"
    "figcaption{overflow-wrap:anywhere}.failed,.short,.stopped{color:#c0392b}"
)


def rows_of(outcomes: Iterable[RowOutcome]) -> list[dict[str, Any]]:
    """Plain rows, metrics among their columns."""
    return [
        {
            "row": one.row,
            "name": one.name,
            "status": one.status,
            "seconds": round(one.seconds, 3),
            "said": one.said,
            "files": "; ".join(path.as_posix() for path in one.outputs),
            **flat_metrics(one.metrics),
        }
        for one in outcomes
    ]


def flat_metrics(metrics: Mapping[str, Any], before: str = "") -> dict[str, Any]:
    """Metrics by one name each: ``{"exact": {"LC": 2}}`` is ``{"exact_LC": 2}``."""
    found: dict[str, Any] = {}
    for key, value in metrics.items():
        if isinstance(value, Mapping):
            found |= flat_metrics(value, f"{before}{key}_")
        else:
            found[before + key] = value
    return found


def report_bytes(path: Path, outcomes: Sequence[RowOutcome]) -> bytes:
    """Table of a batch as CSV or JSON, by the file's ending."""
    rows = rows_of(outcomes)
    ending = path.suffix.lower()
    if ending == ".json":
        return json.dumps(rows, indent=1, ensure_ascii=False, default=str).encode() + b"\n"
    if ending != ".csv":
        raise WriteError(path, "is no table; give a file that ends in .csv or .json")
    columns = list(dict.fromkeys(name for row in rows for name in row))
    stream = io.StringIO()
    writer = csv.DictWriter(stream, columns, lineterminator="\n")
    writer.writeheader()
    writer.writerows({name: _cell(value) for name, value in row.items()} for row in rows)
    # Spreadsheets take letters beyond ASCII for what they are only after such a mark.
    return stream.getvalue().encode("utf-8-sig")


def _cell(value: Any) -> Any:
    return plain_cell(value) if isinstance(value, str) else value


def index_bytes(path: Path, outcomes: Sequence[RowOutcome]) -> bytes:
    """A page of all rows, their pictures beside it; it runs no code and loads nothing else."""
    home = Path(os.path.abspath(path)).parent  # noqa: PTH100
    figures = "\n".join(_figure(one, home) for one in outcomes)
    made = sum(one.is_well for one in outcomes)
    title = f"{made} of {len(outcomes)} made"
    policy = "default-src 'none'; img-src 'self' file:; style-src 'unsafe-inline'"
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">'
        f"<title>{title}</title><style>{_STYLE}</style></head>\n"
        f"<body><h1>{title}</h1><main>\n{figures}\n</main></body></html>\n"
    ).encode()


def _figure(one: RowOutcome, home: Path) -> str:
    paths = [quote(Path(os.path.relpath(path, home)).as_posix()) for path in one.outputs]
    seen = [p for ending in SEEN for p in paths if p.lower().endswith(ending)]
    name = html.escape(one.name)
    picture = f'<img src="{seen[0]}" alt="{name}" loading="lazy">' if seen else ""
    links = " ".join(f'<a href="{p}">{p.rpartition(".")[2]}</a>' for p in paths)
    said = f'<br><span class="{one.status}">{one.status}: {html.escape(one.said)}</span>'
    return f"<figure>{picture}<figcaption>{one.row}. {name} {links}" + (
        f"{'' if one.is_well else said}</figcaption></figure>"
    )
