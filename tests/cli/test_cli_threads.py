"""That files do not depend on the number of threads, whatever is asked for."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any

import pytest
from PIL import Image
from typer.testing import Result

from packwork.compaction.compact import blocks
from packwork.steps import finish
from packwork.threads import at_once, using

Command = Callable[..., Result]

QUICK = "--epochs 6 --levels 32,64"
THREADS = (1, 3)
"""Three part what is shared unevenly."""
EVERYWHERE = {"anneal", "compact", "coverage"}
VERBS = {
    "fill": (f"fill circle star drop -n 12 {QUICK} --seed 3", EVERYWHERE),
    "shared": (f"fill bear star drop -n 16 {QUICK} --sizes shared", EVERYWHERE),
    "gaps": (f"fill heart star drop -n 8 {QUICK} --max-items 12", {"compact", "coverage"}),
    "forces": (f"fill square star heart -n 9 {QUICK} --force down", {"compact", "coverage"}),
    "words": (f"words heart words.txt -n 20 {QUICK}", EVERYWHERE),
    "photos": (f"photos circle a.png b.png -n 16 {QUICK}", EVERYWHERE),
    "chart": (f"chart circle data.csv --size-by size {QUICK}", EVERYWHERE),
    "pile": ("pile square star moon -n 9", {"coverage"}),
    "best": (f"fill star heart moon -n 12 --effort best {QUICK}", EVERYWHERE),
}
"""Command lines, by what they are for, and the modules that share their work among threads."""


@pytest.fixture
def sharing(monkeypatch: pytest.MonkeyPatch) -> set[str]:
    """Small runs share their work as large ones do; modules that have shared some."""
    found = set[str]()
    # It takes over the blocks of compaction as they are when it is first loaded.
    import_module("packwork.settle.settle")

    def shared(name: str, call: Callable[..., Any], calls: Sequence[tuple[Any, ...]]) -> list[Any]:
        if len(calls) > 1:
            found.add(name)
        return at_once(call, calls)

    anneal, compact, coverage = (
        import_module(f"packwork.{name}")
        for name in ("finish.anneal", "compaction.compact", "raster.coverage")
    )
    for module in (anneal, compact, coverage):
        name = module.__name__.rpartition(".")[2]
        monkeypatch.setattr(module, "at_once", partial(shared, name))
    # Fewer trials than a full layout takes are shared out as all are.
    monkeypatch.setitem(finish.TRIALS, "best", 4)
    monkeypatch.setattr(anneal, "NEIGHBOURS", 1)
    monkeypatch.setattr(compact, "blocks", partial(blocks, most=4))
    monkeypatch.setattr(coverage, "PARTED", 1)
    return found


@pytest.mark.parametrize("verb", VERBS)
def test_bytes_do_not_depend_on_threads(
    verb: str, folder: Path, packwork: Command, sharing: set[str]
) -> None:
    words = " ".join(f"word{k}" for k in range(60) for _ in range(60 - k))
    (folder / "words.txt").write_text(words, encoding="utf-8")
    rows = "".join(f"r{k},{1 + k % 7}\n" for k in range(24))
    (folder / "data.csv").write_text("name,size\n" + rows, encoding="utf-8")
    for name, width in (("a", 40), ("b", 70)):
        Image.new("RGB", (width, 50), (width, 90, 120)).save(folder / f"{name}.png")
    line, modules = VERBS[verb]
    found = set()
    for count in THREADS:
        outputs = f"-o {count}.svg -o {count}.geojson -o {count}.dxf --report {count}.json"
        done = packwork(f"{line} -q --threads {count} {outputs}")
        assert done.exit_code in (0, 1), done.stderr
        found.add(files_of(folder, str(count)))
    assert len(found) == 1
    assert sharing == modules


def test_a_recipe_gives_the_same_bytes(folder: Path, packwork: Command, sharing: set[str]) -> None:
    fill, _ = VERBS["fill"]
    packwork(f"{fill} -q --threads 4 --save-recipe all.toml -o all.svg")
    found = {(folder / "all.svg").read_bytes()}
    for count in THREADS:
        done = packwork(f"run all.toml -q --threads {count} -o {count}.svg")
        assert done.exit_code in (0, 1), done.stderr
        found.add((folder / f"{count}.svg").read_bytes())
    assert len(found) == 1


def test_an_edit_gives_the_same_bytes(folder: Path, packwork: Command, sharing: set[str]) -> None:
    fill, _ = VERBS["fill"]
    packwork(f"{fill} -q -o all.geojson")
    found = set()
    for count in THREADS:
        # It has no option for them: as many as there are.
        with using(count):
            done = packwork(f"edit all.geojson --move star#1=50%,50% -o {count}.svg")
        assert done.exit_code == 0, done.stderr
        found.add((folder / f"{count}.svg").read_bytes())
    assert len(found) == 1


def test_measures_are_the_same(folder: Path, packwork: Command) -> None:
    fill, _ = VERBS["fill"]
    packwork(f"{fill} -q -o all.geojson")
    found = set()
    for count in THREADS:
        with using(count):
            done = packwork(f"measure all.geojson --report {count}.json")
        assert done.exit_code == 0, done.stderr
        found.add((folder / f"{count}.json").read_bytes())
    assert len(found) == 1


def files_of(folder: Path, name: str) -> tuple[bytes | str, ...]:
    """All that a run wrote, but for how long it took."""
    layout, report = (
        json.loads((folder / f"{name}.{ending}").read_text(encoding="utf-8"))
        for ending in ("geojson", "json")
    )
    kept = json.dumps(layout["features"]), json.dumps(report["metrics"])
    return *((folder / f"{name}.{ending}").read_bytes() for ending in ("svg", "dxf")), *kept
