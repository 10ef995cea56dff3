"""What a run measured, as JSON beside the page that is made of it.

``docs/manifests/NAME.json`` is what one benchmark measured; the pages of ``docs/benchmarks`` are
functions of such manifests and of nothing else, so that no figure stands on a page but those of a
run whose manifest is committed with it. ``packwork bench pages`` writes the pages anew, without
measuring.
"""

from __future__ import annotations

import datetime
import json
import math
import os
import re
import sys
from pathlib import Path
from typing import Any

from benchmarks.kit.measuring import DOCS, machine, markdown_table

FOLDER = DOCS / "manifests"
PAGES = DOCS / "benchmarks"

Manifest = dict[str, Any]

DIGITS = 6
"""Significant digits that are kept of a number."""


def stamp() -> Manifest:
    """When, on what and by which command something is measured."""
    return {
        "command": " ".join(["packwork bench", Path(sys.argv[0]).stem, *sys.argv[1:]]),
        "date": datetime.date.today().isoformat(),
        "machine": machine(),
        "cores": os.cpu_count(),
        "load": list(os.getloadavg()),
    }


def write_manifest(name: str, manifest: Manifest) -> Manifest:
    """Write it; return it as it is read back."""
    FOLDER.mkdir(exist_ok=True)
    text = json.dumps(_plain(manifest), indent=1, ensure_ascii=False, allow_nan=False)
    # A list that holds no other stands on one line.
    text = re.sub(r"\[\n\s*([^\[\]{}]*?)\n\s*\]", _on_one_line, text)
    path = FOLDER / f"{name}.json"
    path.write_text(text + "\n", encoding="utf-8")
    print(f"wrote {path}", flush=True)
    return read_manifest(name)


def read_manifest(name: str) -> Manifest:
    return dict(json.loads((FOLDER / f"{name}.json").read_text(encoding="utf-8")))


def known() -> dict[str, Manifest]:
    """All manifests by name."""
    return {path.stem: read_manifest(path.stem) for path in sorted(FOLDER.glob("*.json"))}


def write_text(name: str, text: str) -> None:
    """Write a page of figures."""
    (PAGES / name).write_text(text, encoding="utf-8")
    print(f"wrote {PAGES / name}", flush=True)


def write_page(name: str, page: str, **parts: str) -> None:
    """Manifest and page: a format string and its parts."""
    blocks = {key: blocks_of(part) for key, part in parts.items()}
    manifest = write_manifest(name.removesuffix(".md"), {**stamp(), "parts": blocks})
    write_text(name, of_parts(page, manifest))


def of_parts(page: str, manifest: Manifest) -> str:
    """A page's text: ``{date}``, ``{machine}`` and the parts of its manifest."""
    parts = {key: text_of(blocks) for key, blocks in manifest["parts"].items()}
    return page.format(date=manifest["date"], machine=manifest["machine"], **parts)


def blocks_of(text: str) -> list[Any]:
    """Text as lines, its Markdown tables as columns and rows.

    >>> blocks_of("so:\\n\\n| a | b |\\n| --- | --- |\\n| 1 | 2 |")
    ['so:', '', {'columns': ['a', 'b'], 'rows': [['1', '2']]}]
    """
    blocks: list[Any] = []
    for is_table, lines in _runs(text.split("\n")):
        if is_table:
            columns, _, *rows = ([c.strip() for c in line[1:-1].split(" | ")] for line in lines)
            blocks.append({"columns": columns, "rows": rows})
        else:
            blocks += lines
    return blocks


def text_of(blocks: list[Any]) -> str:
    """What ``blocks_of`` took apart."""
    return "\n".join(
        block if isinstance(block, str) else markdown_table(block["columns"], block["rows"])
        for block in blocks
    )


def _runs(lines: list[str]) -> list[tuple[bool, list[str]]]:
    """Neighbouring lines that are of a table, or are not."""
    found: list[tuple[bool, list[str]]] = []
    for line in lines:
        is_table = line.startswith("| ")
        if not found or found[-1][0] != is_table:
            found.append((is_table, []))
        found[-1][1].append(line)
    return found


def _on_one_line(found: re.Match[str]) -> str:
    return "[" + re.sub(r"\n\s*", " ", found[1]) + "]"


def _plain(value: Any) -> Any:
    """Arrays as lists, numbers of few digits; one that is not finite is none."""
    if isinstance(value, dict):
        return {str(key): _plain(one) for key, one in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(one) for one in value]
    if hasattr(value, "tolist"):
        return _plain(value.tolist())
    if isinstance(value, float):
        return float(f"{value:.{DIGITS}g}") if math.isfinite(value) else None
    return value
