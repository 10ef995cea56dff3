"""Runs of a session: the same items put anew, in an order, by likeness or chance; or others."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from packwork import threads, uses
from packwork.arrays import IntArray
from packwork.errors import RecipeError
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import difference, valid
from packwork.live.certificate import promise_of
from packwork.live.chart_groups import poured_by_group
from packwork.live.commands.command import made
from packwork.live.commands.placing import Arrange
from packwork.live.document import PROPERTIES, Document
from packwork.live.ground import Mosaic
from packwork.live.kinds import LineKind, PileKind
from packwork.live.macros import word_rows
from packwork.live.nested_again import nested_again
from packwork.metrics.certificate import Promise
from packwork.pipeline import run
from packwork.pipeline.job import Job
from packwork.pipeline.plan.copies import ItemRules, RuleSource
from packwork.pipeline.plan.vectors import ItemVectors
from packwork.precompile import warm_up_once
from packwork.progress import Step, Stop, never
from packwork.readers.target import painted
from packwork.recipe import Recipe, make_recipe
from packwork.recipe.order import FROM_TEXT
from packwork.recipe.piles import PileOptions
from packwork.recipe.rules import AUTO, Pin, Rule, usual_padding
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.scene.recolour import run_together
from packwork.temporary import TemporaryFolder
from packwork.units import parse_length
from packwork.uses.icons import keeps_gaps, one_colour_gap
from packwork.uses.words.use import with_sizes_that_give_way

BY_TEXT = FROM_TEXT
"""Stands for vectors that are made from the text of the words."""


def usual_gap(document: Document) -> float:
    """Gap, canvas units, that the run found by itself; of one that was told, the usual one."""
    container, found = document.container, document.manifest.get("recipe")
    said = found if isinstance(found, Mapping) else {}
    promise = Promise.of(document.manifest)
    # Of a layout that was edited it is the promise of that.
    if promise and said.get("padding") == AUTO and "edited" not in document.manifest:
        return promise.gap
    gap = parse_length(usual_padding(said), container.unit, container.side)
    is_kept = gap or document.kind.name == "pile" or keeps_gaps(document.options.sizes, said)
    if is_kept or not run_together(document.items):
        return gap
    return one_colour_gap(container, len(document.items))


def poured_again(
    document: Document,
    seed: int,
    shown: Shown = lambda _: None,
    stop: Stop = never,
    **asked: str | Sequence[str],
) -> Arrange:
    """The same items in the same container, from other first places: a command that puts them so.

    What is held stays where it is, and the others lie about it; where it has no room there, it
    is in nobody's way until they settle.

    ``asked``: where items are to lie, as recipes say it: ``arrange``, or ``embeddings`` with
    ``anchors``.
    """
    if isinstance(document.kind, LineKind):
        raise RecipeError("pour", "words on lines have one layout; change words, weights or lines")
    if document.kind.has_parts:
        return _nested(document, seed, shown, stop, asked)
    if isinstance(document.kind, PileKind):
        return _heaped(document, document.kind, seed, shown, stop, asked)
    if document.chart_groups:
        poses = poured_by_group(
            document, lambda part, show: _together(part, seed, show, stop, asked), shown
        )
        return arranged(document.ids.tolist(), poses)
    return _together(document, seed, shown, stop, asked)


def _together(
    document: Document, seed: int, shown: Shown, stop: Stop, asked: Mapping[str, Any]
) -> Arrange:
    """All items of a document anew in the whole of its container."""
    is_by_text = asked.get("embeddings") == BY_TEXT
    mosaic = document.mosaic
    if mosaic is not None and not asked and mosaic.is_seen_on(document.container):
        job = _mosaic_again(document, seed, mosaic)
    else:
        job = job_again(document, seed, {} if is_by_text else asked)
    if is_by_text:
        job = replace(job, vectors=_vectors_by_text(document, asked))
    asked_of = list(_asked(document))
    while True:
        try:
            layout, kept = run_shown(replace(job, asked=tuple(asked_of)), shown, stop)
            break
        except RecipeError as error:
            # It has no room where it is held: it is in nobody's way.
            row = next((k for k, one in enumerate(asked_of) if _concerns(one, error)), None)
            if row is None:
                raise
            asked_of[row] = ItemRules()
    poses = layout.poses
    if document.kind.refusal:
        # Where there is too little room for that, a settle takes it back and says so.
        poses = replace(poses, scale=document.poses.scale[kept])
    return arranged(document.ids[kept].tolist(), poses)


def _nested(
    document: Document, seed: int, shown: Shown, stop: Stop, asked: Mapping[str, Any]
) -> Arrange:
    if asked:
        raise RecipeError(next(iter(asked)), "parts of a nest lie where most fit, in no order")

    def show(share: float) -> None:
        shown(Moment(
            container=document.container, items=document.items, poses=document.poses,
            progress=min(share, 1.0),
        ))  # fmt: skip

    return nested_again(document, seed, show, stop)


def _heaped(
    document: Document,
    kind: PileKind,
    seed: int,
    shown: Shown,
    stop: Stop,
    asked: Mapping[str, Any],
) -> Arrange:
    """A pile heaped up anew about what is held, every item as large as it is."""
    if asked:
        raise RecipeError(next(iter(asked)), "items of a pile lie as they fall, in no order")
    container, poses = document.container, document.poses
    rows = np.flatnonzero(~document.held[:, PROPERTIES.index("place")])
    held = np.setdiff1d(np.arange(len(document)), rows)
    if not len(rows):
        raise RecipeError("pile", "all items are held; release some")
    region = container.outline.region
    for k in held.tolist():
        region = difference(region, document.items[k].outline.mapped(poses.matrix(k)).region)
    room = container
    if len(held):
        room = replace(container, outline=Outline.from_region(valid(region)), walls=None)
    # Of an item of weight 1 the longer side is that of the canvas: weights say all sizes.
    extents = np.array([document.items[k].outline.extent for k in rows])
    weights = np.square(poses.scale[rows] * extents / container.side).tolist()
    items = [
        replace(document.items[k], weight=w) for k, w in zip(rows.tolist(), weights, strict=True)
    ]
    whole = PileOptions(size=f"{container.side:.17g}{container.unit}", **kind.pouring)
    recipe = _recipe(document, seed, {"pile": whole, "count": len(rows)})

    def show(moment: Moment) -> None:
        # What has not come yet is far above.
        there = poses.with_some(rows, replace(poses.subset(rows), y=np.full(len(rows), FAR_ABOVE)))
        if moment.poses is not None:
            there = there.with_some(rows[moment.rows], moment.poses)
        shown(replace(moment, items=document.items, poses=there))

    layout, kept = run_shown(uses.read(recipe, items, room), show, stop)
    return arranged(document.ids[rows[kept]].tolist(), layout.poses)


FAR_ABOVE = -1e6
"""Where items are that have not come in yet, canvas units: out of sight. Chosen."""


def job_again(document: Document, seed: int, asked: Mapping[str, Any]) -> Job:
    """A run of the items of a document in its container, with the weights that they have there."""
    pairs = zip(document.items, document.positive_weights.tolist(), strict=True)
    items = [replace(item, weight=weight) for item, weight in pairs]
    job = uses.read(_recipe(document, seed, asked), items, document.container.sheet)
    return with_sizes_that_give_way(job) if gives_way(document) else job


def gives_way(document: Document) -> bool:
    """Whether a cloud's words are in proportion only as far as that leaves it full."""
    is_free = document.options.sizes == "shared" and not promise_of(document).areas_in_shares
    return is_free and 0 < len(document) == len(word_rows(document))


def _mosaic_again(document: Document, seed: int, mosaic: Mosaic) -> Job:
    """The same, whose items lie where they show a picture best."""
    with TemporaryFolder("mosaic") as folder:
        file = folder.path / "picture.png"
        file.write_bytes(painted(mosaic.picture))
        return job_again(document, seed, {"picture": str(file), "tint": mosaic.tint})


def _asked(document: Document) -> tuple[ItemRules, ...]:
    """Rules that holds make for each item on the canvas, as pins do."""
    found = []
    for k, item in enumerate(document.items):
        one, pin = ItemRules(), pin_of(document, k)
        if pin and min(document.poses.x[k], document.poses.y[k]) >= 0:
            rule = Rule(items=(item.name,), pin=Pin.model_validate(pin))
            one = one.merged(rule, RuleSource(f"hold {k}"))
        found.append(one)
    return tuple(found)


def _concerns(one: ItemRules, error: RecipeError) -> bool:
    """Whether a refusal is of what was asked for an item."""
    return any(source.key == error.key for source in one.sources.values())


def _vectors_by_text(document: Document, asked: Mapping[str, Any]) -> ItemVectors:
    """Vectors of words, by the text that the run had which made the layout."""
    recipe = document.manifest.get("recipe")
    known = recipe.get("words") if isinstance(recipe, Mapping) else None
    if not isinstance(known, Mapping) or not known.get("source"):
        raise RecipeError(
            "embeddings", f"{BY_TEXT} is for words of a text; give a file of vectors here"
        )
    given = {key: value for key, value in known.items() if value is not None and key != "source"}
    words = uses.words_recipe("page", known.get("source"), **given, **asked)
    found = uses.read(words, None, document.container)
    assert found.vectors is not None  # noqa: S101
    vectors = found.vectors.of(found.items)
    by_word = {item.name: row for item, row in zip(found.items, vectors, strict=True)}
    items = document.items
    nothing = np.zeros_like(next(iter(by_word.values())))
    rows = np.array([by_word.get(item.name, nothing) for item in items])
    is_known = np.array([item.name in by_word for item in items])
    return ItemVectors.of_rows(items, rows, is_known, anchors=found.vectors.anchors)


def arranged(numbers: Sequence[int], poses: Poses) -> Arrange:
    """Command that puts items to poses, by their numbers."""
    columns = (poses.x, poses.y, np.degrees(poses.angle), poses.scale)
    asked = np.column_stack(columns).tolist()
    return made(Arrange, items=tuple(numbers), poses=[tuple(pose) for pose in asked])


def ground_of(document: Document) -> dict[str, Any]:
    """Canvas of a document, and the way in which it repeats, as recipes have them."""
    container = document.container
    size = f"{container.width:.17g}x{container.height:.17g}{container.unit}"
    return {"canvas": size, "tile": container.lattice and container.lattice.kind}


def _recipe(document: Document, seed: int, asked: Mapping[str, Any]) -> Recipe:
    options = document.options
    return make_recipe(
        container="page",
        items=["circle"],
        effort="draft",
        seed=seed,
        **ground_of(document),
        padding=f"{options.padding:.17g}{document.container.unit}",
        sizes=options.sizes,
        size_ratio=options.size_ratio,
        rotate=options.rotate,
        force=options.force,
        **{"count": len(document), **asked},
    )


EPOCHS_BETWEEN = 3
"""Epochs between two moments that are shown. Fewer take time from the run, more jump. Chosen."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Moment:
    """View of a run on its way.

    Parameters
    ----------
    poses
        As many as items; None before they have a place.
    progress
        From 0 to 1.
    rows
        ``(m,)`` items that are there by then, of those of the run.
    """

    container: Container
    items: tuple[Item, ...]
    poses: Poses | None
    progress: float
    rows: IntArray = field(default_factory=lambda: np.arange(0))


Shown = Callable[[Moment], object]


def run_shown(job: Job, shown: Shown, stop: Stop = never) -> tuple[Layout, IntArray]:
    """Layout of a run, every moment of it shown, and which of its items are in it."""
    shown(_moment(job, None, 0.0))
    with threads.using(job.recipe.threads):
        warm_up_once()
        done = run(job, _Watcher(job, shown), stop)
    return done.layout, np.arange(len(job.items)) if done.kept is None else np.asarray(done.kept)


class _Watcher:
    """Shows moments of a run."""

    every = EPOCHS_BETWEEN

    def __init__(self, job: Job, shown: Shown) -> None:
        self._job, self._shown = job, shown

    def on_step(self, step: Step) -> None:
        """Show it, unless other items are there by now than were read."""
        rows = np.arange(len(self._job.items)) if step.ids is None else step.ids
        if len(step.poses) == len(rows):
            moment = _moment(self._job, step.poses, step.progress)
            self._shown(replace(moment, rows=rows))


def _moment(job: Job, poses: Poses | None, progress: float) -> Moment:
    return Moment(container=job.container, items=job.items, poses=poses, progress=progress)


def pin_of(document: Document, k: int) -> dict[str, str | float]:
    """Held parts of the pose of row ``k``, as ``pin`` of a rule has it; empty if there are none."""
    poses, (place, angle, size) = document.poses, document.held[k]
    unit = document.container.unit
    pin: dict[str, str | float] = {}
    if place:
        pin |= {"x": f"{poses.x[k]:.17g}{unit}", "y": f"{poses.y[k]:.17g}{unit}"}
    if angle:
        pin["angle_deg"] = math.degrees(poses.angle[k])
    if size:
        pin["size"] = f"{document.items[k].outline.extent * poses.scale[k]:.17g}{unit}"
    return pin


def poured(
    recipe: Recipe, shown: Shown, stop: Stop = never, container: Container | None = None
) -> Layout:
    """Layout of a recipe, every moment of its run shown; in a container in place of its own."""
    return run_shown(uses.read(recipe, None, container), shown, stop)[0]
