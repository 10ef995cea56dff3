"""The paper's six cases of comparison, on shapes of the same character that may be shipped."""

from __future__ import annotations

import hashlib
import tempfile
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from benchmarks.kit import frozen
from benchmarks.kit.manifests import DOCS, Manifest
from benchmarks.quality.photos import COUNT as PHOTOS
from benchmarks.quality.photos import album
from benchmarks.words.clouds import vocabulary
from packwork import pipeline, uses
from packwork.geometry import affine
from packwork.readers.builtin import builtin_item
from packwork.readers.container import read_container
from packwork.recipe import Recipe, make_recipe
from packwork.scene.container import Container
from packwork.writers.diagnose import diagnose_png

WORDS, ICONS = 100, frozen.COUNT
MARGIN = 0.04
"""Of the canvas, round a container that is a bundled icon."""

MEGAPIXELS = 0.5
TARGET = 0.94
PICTURES = DOCS / "pictures"
PICTURE_PX = 360


@dataclass(frozen=True)
class Case:
    """One container, filled with one kind of item.

    ``shape`` is a container's name, or an icon's that is taken for one.
    """

    name: str
    kind: str
    shape: str


@dataclass(frozen=True)
class Setting:
    """What a run is asked for beside its items, and the kinds that it is for."""

    options: Mapping[str, Any]
    kinds: tuple[str, ...]
    seeds: int | None = None


CASES = (
    Case("flower", "words", "icon:flower"),
    Case("leaf", "words", "icon:leaf"),
    Case("letter P", "icons", "text:P"),
    Case("Australia", "icons", "australia"),
    Case("moon", "photos", "moon"),
    Case("fish", "photos", "fish"),
)

FILLED = "voids filled"
SETTINGS = {
    "packwork": Setting({}, ("words", "icons", "photos")),
    FILLED: Setting({"target_coverage": TARGET}, ("icons",), seeds=1),
    "preset paper": Setting(
        {"preset": "paper", "epochs": 200, "levels": "50,200,600", "finish": "none"},
        ("icons", "photos"),
    ),
}
"""What is run, in the order of the table."""


def container_of(case: Case) -> Container:
    """The case's container, on a canvas of 600."""
    if not case.shape.startswith("icon:"):
        return read_container(case.shape)
    outline = builtin_item(case.shape.removeprefix("icon:")).outline
    left, top, right, bottom = outline.bounds
    scale = frozen.SIDE * (1 - 2 * MARGIN) / max(right - left, bottom - top)
    middle = frozen.SIDE / 2
    at = (middle - scale * (left + right) / 2, middle - scale * (top + bottom) / 2)
    moved = outline.mapped(affine.similarity(*at, 0.0, scale))
    return Container(case.name, "bundled", moved, frozen.SIDE, frozen.SIDE)


def recipe_of(case: Case, seed: int, photos: Path, options: Mapping[str, Any]) -> Recipe:
    """What a run of it is asked to do."""
    given = {"seed": seed, **options}
    if case.kind == "words":
        weights = vocabulary(WORDS)
        return uses.words_recipe(
            case.name, weights, count=WORDS, padding="0", rotate="mixed", **given
        )
    if case.kind == "photos":
        return uses.photos_recipe(case.name, str(photos), **given)
    return make_recipe(container=case.name, items=["icons"], **given)


def measure(seeds: Sequence[int]) -> Manifest:
    """All cases and settings; pictures of the first seed of the plain runs."""
    found: Manifest = {}
    with tempfile.TemporaryDirectory() as folder:
        photos = Path(folder)
        album(photos, PHOTOS, MEGAPIXELS)
        for case in CASES:
            container, runs, picture = container_of(case), {}, {}
            for name, setting in SETTINGS.items():
                if case.kind not in setting.kinds:
                    continue
                some = [
                    _run(recipe_of(case, seed, photos, setting.options), case, container)
                    for seed in seeds[: setting.seeds]
                ]
                runs[name] = [figures for _, figures in some]
                picture[name] = draw(f"{case.name} {name}", some[0][0])
                print(case.name, name, runs[name][0], flush=True)
            found[case.name] = {"kind": case.kind, "runs": runs, "pictures": picture}
    return found


def _run(recipe: Recipe, case: Case, container: Container) -> tuple[pipeline.Run, Manifest]:
    """A run, and its figures; seconds are the processor's, of everything but writing."""
    began = time.process_time()
    items = frozen.items() if case.kind == "icons" else None
    run = uses.fill(recipe, items, container)
    seconds = time.process_time() - began
    pixel, exact = run.metrics.pixel, run.metrics.exact
    return run, {
        "items": len(run.layout.items) - len(run.unplaced),
        "LC": run.metrics.as_dict()["LC_ink"] if case.kind == "words" else pixel.LC,
        "OO": pixel.OO,
        "EA": pixel.EA,
        "LnU": pixel.LnU,
        "overlap": exact.overlap,
        "outside": exact.exceeding,
        "gap": exact.min_gap,
        "certified": run.certified,
        "seconds": seconds,
    }


def draw(name: str, run: pipeline.Run) -> Manifest:
    """The diagnostic picture of a run, and what tells it from another."""
    PICTURES.mkdir(exist_ok=True)
    path = PICTURES / f"{name.lower().replace(' ', '-')}.png"
    data = diagnose_png(run.layout, PICTURE_PX)
    path.write_bytes(data)
    return {"file": f"pictures/{path.name}", "sha256": hashlib.sha256(data).hexdigest()}
