"""That files do not depend on the number of threads, whatever is asked for."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from PIL import Image
from typer.testing import Result

Command = Callable[..., Result]

VERBS = {
    "fill": "fill circle icons -n 60 --epochs 40 --seed 3",
    "shared": "fill bear icons -n 40 --epochs 40 --sizes shared",
    "gaps": "fill heart icons -n 20 --epochs 40 --max-items 60",
    "forces": "fill square star heart -n 30 --epochs 40 --force down",
    "words": "words heart words.txt -n 40 --epochs 40",
    "photos": "photos circle a.png b.png -n 20 --epochs 40",
    "chart": "chart circle data.csv --size-by size --epochs 40",
    "pile": "pile square star moon -n 20",
    "best": "fill star icons -n 30 --effort best --epochs 40",
}
"""Command lines, by what they are for; enough items for several to be tried at once."""


@pytest.mark.parametrize("verb", VERBS)
def test_bytes_do_not_depend_on_threads(verb: str, folder: Path, packwork: Command) -> None:
    words = " ".join(f"word{k}" for k in range(60) for _ in range(60 - k))
    (folder / "words.txt").write_text(words, encoding="utf-8")
    rows = "".join(f"r{k},{1 + k % 7}\n" for k in range(40))
    (folder / "data.csv").write_text("name,size\n" + rows, encoding="utf-8")
    for name, width in (("a", 40), ("b", 70)):
        Image.new("RGB", (width, 50), (width, 90, 120)).save(folder / f"{name}.png")
    found = set()
    for count in (1, 2, 8):
        done = packwork(f"{VERBS[verb]} -q --threads {count} -o {count}.svg -o {count}.geojson")
        assert done.exit_code in (0, 1), done.stderr
        layout = json.loads((folder / f"{count}.geojson").read_text(encoding="utf-8"))
        # How long it took is another number each time.
        found.add(((folder / f"{count}.svg").read_bytes(), json.dumps(layout["features"])))
    assert len(found) == 1
