"""A layout under the hand, an immutable value with all that a person may change; how two differ."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from enum import IntEnum
from functools import cached_property
from typing import Any, Literal, TypeAlias, get_args

import numpy as np

from packwork.arrays import BoolArray, FloatArray, IntArray, frozen
from packwork.forces.forces import NO_FORCES, Forces
from packwork.live.ground import Mosaic, covering, sheet_box
from packwork.live.kinds import Kind, LineKind, LiveOptions, kind_of
from packwork.live.notes import Attached, attached, notes_on
from packwork.pipeline.plan.forces import forces_of
from packwork.readers.words.word import as_one_line
from packwork.recipe.pictures import Shades
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.layout import Layout, ground_in, is_hex
from packwork.scene.pose import Poses
from packwork.writers.options import HaloChoice
from packwork.writers.svg import HALO_SHARE

Property: TypeAlias = Literal["place", "angle", "size"]
"""What of an item can be held, each by itself."""

PROPERTIES: tuple[Property, ...] = get_args(Property)
"""In the order of the columns of :attr:`Document.held`."""

SAME_PLACE = 1e-6
"""Share of the canvas by which two places may differ and be the same. Derived: rounding."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Document:
    """Container, items, poses, what is held and the numbers for all; nothing else is in a session.

    Commands make new documents, which share what has not changed. Arrays are read-only.

    Parameters
    ----------
    items
        One per number; copies repeat the same ``Item``.
    ids
        ``(n,)`` numbers by which commands call the items; an item keeps its own for ever.
    weights
        ``(n,)`` share of area asked for each.
    smallest, largest
        ``(n,)`` scales between which an item's size may vary.
    held
        ``(n, 3)`` whether place, angle and size stay exactly as they are.
    notes
        Labels on items and letters beside them, as they were at first.
    mosaic
        The picture that items show from afar; None for none.
    behind
        Picture or gradient that covers the canvas behind all; None for none.
    put
        Numbers of items that a hand has put somewhere since a run has put them elsewhere.

    Examples
    --------
    >>> from packwork import fill
    >>> document = Document.from_layout(fill("circle", "star", count=3, levels="50"))
    >>> document.ids.tolist(), document.held.any()
    ([0, 1, 2], np.False_)
    """

    container: Container
    items: tuple[Item, ...]
    ids: IntArray
    poses: Poses
    weights: FloatArray
    smallest: FloatArray
    largest: FloatArray
    held: BoolArray
    options: LiveOptions
    next_id: int
    manifest: Mapping[str, Any] = field(default_factory=dict)
    notes: tuple[Attached, ...] = ()
    mosaic: Mosaic | None = None
    behind: Item | None = None
    put: frozenset[int] = frozenset()

    def __post_init__(self) -> None:
        put = object.__setattr__
        for name in ("ids", "weights", "smallest", "largest", "held"):
            put(self, name, frozen(getattr(self, name)))
        columns = (getattr(self.poses, column.name) for column in fields(Poses))
        put(self, "poses", Poses(*(frozen(values) for values in columns)))

    @classmethod
    def from_layout(cls, layout: Layout) -> Document:
        """Document of a layout: nothing held, sizes as free as its run had them.

        Of a nest, parts that may have other angles than most are held at theirs.
        """
        count = len(layout.items)
        options = LiveOptions.from_manifest(layout.manifest)
        kind = kind_of(layout.manifest)
        held = np.zeros((count, len(PROPERTIES)), dtype=bool)
        own = np.isin(np.arange(count) + 1, list(kind.own_angles))
        held[own, PROPERTIES.index("angle")] = True
        document = cls(
            container=kind.ground(layout.container, options.padding),
            items=layout.items,
            ids=np.arange(count),
            poses=layout.container.brought_in(layout.poses),
            weights=layout.weights,
            smallest=layout.poses.scale,
            largest=layout.poses.scale,
            held=held,
            options=options,
            next_id=count,
            manifest=_with_halos(kind.begun(layout.manifest, options.padding), layout),
            notes=attached(layout),
        )
        return document.with_ranges(options)

    def __len__(self) -> int:
        return len(self.items)

    @property
    def layout(self) -> Layout:
        """The layout as it is now; of its manifest what does not depend on places."""
        ground = ground_in(self.manifest)
        manifest = self.kind.stated(self.manifest, self.ids)
        made = Layout(self.grounded, self.items, self.poses, self.weights, manifest, ground=ground)
        rows = {number: row for row, number in enumerate(self.ids.tolist())}
        return replace(made, notes=tuple(notes_on(made, rows, self.notes)))

    @cached_property
    def grounded(self) -> Container:
        """The container with what is behind all."""
        if self.behind is None:
            return self.container
        return replace(self.container, backdrop=covering(self.behind, sheet_box(self.container)))

    @cached_property
    def chart_groups(self) -> dict[str, IntArray]:
        """Rows of the marks of each group of a chart, by its name; empty where it has none."""
        found = dict[str, list[int]]()
        for k, item in enumerate(self.items):
            if item.datum is not None and item.datum.group:
                found.setdefault(item.datum.group, []).append(k)
        return {name: np.array(rows) for name, rows in found.items()}

    @property
    def positive_weights(self) -> FloatArray:
        """Weights; fillers, which ask for nothing, have the smallest of any other."""
        asked = self.weights > 0
        least = self.weights[asked].min() if asked.any() else 1.0
        return np.where(asked, self.weights, least)

    @property
    def title(self) -> str:
        """Title that a person has given, or its container's name."""
        given = self.manifest.get("title")
        return given if isinstance(given, str) and given else self.container.name

    @property
    def halos(self) -> HaloChoice | None:
        """Items that were asked to have halos; None where nothing was."""
        asked = self.manifest.get("halos")
        return asked if asked in get_args(HaloChoice) else None

    @property
    def shades(self) -> Shades | None:
        """Treatment of drawings of several colours by the palette put on last; None of none."""
        asked = self.manifest.get("shades")
        return asked if asked in get_args(Shades) else None

    @property
    def rim(self) -> float:
        """Distance by which halos reach beyond their items, canvas units."""
        return HALO_SHARE * self.container.side

    @property
    def left_out(self) -> dict[str, float]:
        """Words that a person left out, with how often they were there."""
        kept = self.manifest.get("left_out")
        return dict(kept) if isinstance(kept, Mapping) else {}

    @cached_property
    def kind(self) -> Kind:
        """Kind of document that this is: what of it may change."""
        has_numbers = bool(self.notes) or any(item.datum is not None for item in self.items)
        repeats = self.container.lattice is not None
        return kind_of(self.manifest, has_numbers=has_numbers, repeats=repeats)

    @property
    def palette(self) -> tuple[str, ...]:
        """Colours that were put on all items last; none where each has its own."""
        found = self.manifest.get("painted")
        listed = found if isinstance(found, list | tuple) else []
        return tuple(one for one in listed if isinstance(one, str) and is_hex(one))

    def unmoved_in(self, other: Document) -> set[int]:
        """Numbers of items that lie in the same places in another document."""
        _, mine, theirs = np.intersect1d(self.ids, other.ids, return_indices=True)
        here, there = self.poses.subset(mine), other.poses.subset(theirs)
        far = np.maximum(np.abs(here.x - there.x), np.abs(here.y - there.y))
        return set(self.ids[mine[far <= SAME_PLACE * self.container.side]].tolist())

    def with_held_hand(self) -> Document:
        """The document with the places held of what a hand has put somewhere."""
        held = self.held.copy()
        held[np.isin(self.ids, list(self.put)), PROPERTIES.index("place")] = True
        return replace(self, held=held)

    @property
    def own_areas(self) -> FloatArray:
        """``(n,)`` areas of the outlines, squared item units."""
        return np.array([item.outline.area for item in self.items])

    @property
    def areas(self) -> FloatArray:
        """``(n,)`` areas of the items as large as they lie, squared canvas units."""
        return self.own_areas * self.poses.scale**2

    @property
    def covered(self) -> float:
        """Share of the container that items cover."""
        return float(self.areas.sum()) / self.container.outline.area

    def forces(self, rows: IntArray) -> Forces:
        """Forces on some items; one that names others alone is none on these."""
        texts = self.options.force
        if not texts:
            return NO_FORCES
        items, weights = [self.items[k] for k in rows], self.weights[rows]
        return forces_of(texts, items, weights, self.container, are_all=False)

    def rows_moved_from(self, before: Document) -> IntArray:
        """Rows of items that are new or lie elsewhere than before; in another container all do."""
        _, rows, theirs = np.intersect1d(self.ids, before.ids, return_indices=True)
        stays = np.zeros(len(self), dtype=bool)
        if self.container is before.container:
            stays[rows] = ~differing(self.poses.subset(rows), before.poses.subset(theirs))
        return np.flatnonzero(~stays)

    def with_ranges(self, options: LiveOptions) -> Document:
        """The same with other options, and sizes that vary as these say.

        Free sizes are between those of the typical item, which is as large as the mean, over and
        times the ratio; an item that is outside them already may stay as it is, and a group is as
        many items as it has parts. Where forces pull, nothing becomes larger than it is.
        """
        scale = self.poses.scale
        smallest = largest = scale
        if options.sizes == "free" and len(self):
            counts = [1 if one.parts is None else len(one.parts.items) for one in self.items]
            areas = self.own_areas / counts
            typical = np.sqrt(np.mean(areas * scale**2) / areas)
            smallest = np.minimum(typical / options.size_ratio, scale)
            widest = np.maximum(typical * options.size_ratio, scale)
            largest = scale if options.force else widest
        return replace(self, options=options, smallest=smallest, largest=largest)

    def scaled(self, rows: int | Sequence[int], factor: float | FloatArray) -> Document:
        """The same with some items so many times as large, ranges of their sizes too."""
        columns = {name: getattr(self, name).copy() for name in ("smallest", "largest")}
        scale = self.poses.scale.copy()
        for values in (scale, *columns.values()):
            values[rows] *= factor
        return replace(self, poses=replace(self.poses, scale=scale), **columns)

    def with_poses(self, poses: Poses) -> Document:
        """The same with the items elsewhere."""
        return replace(self, poses=poses)

    def index(self, number: int) -> int | None:
        """Index of an item in the arrays, by its number; None if there is none such."""
        found = np.flatnonzero(self.ids == number)
        return int(found[0]) if len(found) else None


class Invalidation(IntEnum):
    """Degree of staleness: the part to be made anew, from nothing to everything."""

    NOTHING = 0
    DRAWING = 1
    """Names, colours, art, background: what is looked at, not what is in the way."""
    RULES = 2
    """What is held, ranges of sizes, options that all keep already."""
    POSES = 3
    """Where some items are."""
    ITEMS = 4
    """Which items there are, or their outlines."""
    EVERYTHING = 5
    """The container, a wider gap between all, what pulls at all."""


@dataclass(frozen=True, eq=False)
class Change:
    """Difference of two documents.

    ``items``: numbers of the items that changed, came or went.
    """

    stale: Invalidation
    items: IntArray

    @classmethod
    def between(cls, before: Document, after: Document) -> Change:
        """Difference of two documents."""
        is_tighter = (
            after.options.evenness != before.options.evenness
            or after.options.padding > before.options.padding
        )
        if before.container is not after.container or is_tighter:
            return cls(Invalidation.EVERYTHING, np.union1d(before.ids, after.ids))
        if not np.array_equal(before.ids, after.ids):
            return cls(Invalidation.ITEMS, np.setxor1d(before.ids, after.ids))
        outlines = [
            a.outline is not b.outline for a, b in zip(before.items, after.items, strict=True)
        ]
        if any(outlines):
            return cls(Invalidation.ITEMS, after.ids[np.array(outlines)])
        if (moved := differing(before.poses, after.poses)).any():
            return cls(Invalidation.POSES, after.ids[moved])
        ruled = (before.held != after.held).any(axis=1) | (before.options != after.options)
        ruled |= (before.smallest != after.smallest) | (before.largest != after.largest)
        if ruled.any():
            return cls(Invalidation.RULES, after.ids[ruled])
        drawn = [a is not b for a, b in zip(before.items, after.items, strict=True)]
        drawn_or_weighed = np.array(drawn, dtype=bool) | (before.weights != after.weights)
        is_dressed = before.mosaic is not after.mosaic or before.behind is not after.behind
        stated = (before.manifest.keys() | after.manifest.keys()) - {"title"}
        is_told = before.manifest is not after.manifest and any(
            before.manifest.get(k) != after.manifest.get(k) for k in stated
        )
        is_seen = is_dressed or is_told or drawn_or_weighed.any()
        stale = Invalidation.DRAWING if is_seen else Invalidation.NOTHING
        return cls(stale, after.ids[drawn_or_weighed])


def differing(before: Poses, after: Poses) -> BoolArray:
    """``(n,)`` which poses are not the same, bit for bit; both of as many items.

    Examples
    --------
    >>> differing(Poses([1, 2], [5, 5]), Poses([1, 3], [5, 5])).tolist()
    [False, True]
    """
    columns = [getattr(before, c.name) != getattr(after, c.name) for c in fields(Poses)]
    return np.asarray(np.logical_or.reduce(columns))


def is_straight_word(item: Item) -> bool:
    """Whether an item is a word that no curve bends."""
    return item.text is not None and not any(run.angle for run in item.text.runs)


def counted_weight(item: Item) -> float | None:
    """Weight that a word's tooltip tells; None of what is no word, or was renamed.

    Examples
    --------
    >>> from packwork.readers.builtin import builtin_item
    >>> counted_weight(builtin_item("star")) is None
    True
    """
    name, sign, weight = item.label.title.rpartition(": ")
    if item.text is None or not sign or name != item.name:
        return None
    try:
        found = float(weight)
    except ValueError:
        return None
    return found if 0 < found < math.inf else None


def is_ring_text(item: Item, kind: Kind) -> bool:
    """Whether an item is a text round the edge: none of its words, which may be spelled alike."""
    rings = kind.ring if isinstance(kind, LineKind) else ()
    return counted_weight(item) is None and item.name in map(as_one_line, rings)


def halos_of(items: Sequence[Item]) -> HaloChoice | Literal[""]:
    """Choice of halos that items which have them look like; empty where none has one."""
    have = [bool(item.halo) for item in items]
    return "" if not any(have) else "all" if all(have) else "faint"


def _with_halos(manifest: Mapping[str, Any], layout: Layout) -> Mapping[str, Any]:
    """Manifest that asks for the halos of a file; those on a picture follow from that."""
    found = "" if layout.container.backdrop is not None else halos_of(layout.items)
    return {"halos": found, **manifest} if found else manifest
