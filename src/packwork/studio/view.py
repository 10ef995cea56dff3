"""View of a moment on a page, wherever it comes from: a run on its way, or a session."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from itertools import starmap
from typing import Any, cast

import numpy as np

from packwork.arrays import BoolArray, FloatArray, IntArray
from packwork.live.document import (
    PROPERTIES,
    Document,
    counted_weight,
    halos_of,
    is_ring_text,
    is_straight_word,
)
from packwork.live.face.offers import INK_FINENESS, Drawing, drawing_of, font_told, path_of
from packwork.live.ground import Mosaic, gradient_text, underlays
from packwork.live.kinds import COLLAGE, Kind, LineKind
from packwork.live.notes import Attached
from packwork.live.relayout import Moment
from packwork.scene.container import Container
from packwork.scene.item import Art, Item, PhotoArt
from packwork.scene.layout import ground_in
from packwork.scene.pose import Poses
from packwork.studio.wire import DrawnNote, LeftOut, Scene, Shape, State, Thing, Underlay
from packwork.studio.wording import for_page

MOST_LEFT_OUT = 100
"""Unplaced items that pages are told of at most. Chosen."""

MOST_TOLD = 200
"""Characters of their names and reasons at most. Chosen."""


@dataclass(frozen=True, eq=False, kw_only=True)
class View:
    """All that is drawn.

    ``poses``: as many as items; None before they have a place.
    ``angles``: the only ones allowed, radians; None for any.
    ``palette``: colours put on all items; ``ground``: colour behind them, ``behind``: picture or
    gradient there.
    """

    container: Container
    items: tuple[Item, ...]
    ids: IntArray
    weights: FloatArray
    held: BoolArray
    options: Mapping[str, Any] = field(default_factory=dict)
    angles: tuple[float, ...] | None = None
    kind: Kind = COLLAGE
    title: str = ""
    palette: tuple[str, ...] = ()
    shades: str = ""
    ground: str = ""
    notes: tuple[Attached, ...] = ()
    left_out: Mapping[str, float] = field(default_factory=dict)
    mosaic: Mosaic | None = None
    behind: Item | None = None
    halos: str = ""
    rim: float = 0.0
    poses: Poses | None

    @classmethod
    def of_document(cls, document: Document, poses: Poses | None = None) -> View:
        """View of a document, with its own poses or with others."""
        return cls(
            container=document.container,
            items=document.items,
            ids=document.ids,
            weights=document.weights,
            held=document.held,
            options=document.options.model_dump(),
            angles=document.options.rotation.choices,
            kind=document.kind,
            title=document.title,
            palette=document.palette,
            shades=document.shades or "",
            ground=ground_in(document.manifest),
            notes=document.notes,
            left_out=document.left_out,
            mosaic=document.mosaic,
            behind=document.behind,
            halos=document.halos or halos_of(document.items),
            rim=document.rim,
            poses=poses or document.poses,
        )

    @classmethod
    def of_moment(cls, moment: Moment) -> View:
        """View of a run on its way."""
        rows = moment.rows
        count = len(rows)
        return cls(
            container=moment.container,
            items=tuple(moment.items[k] for k in rows),
            ids=rows,
            weights=np.ones(count),
            held=np.zeros((count, len(PROPERTIES)), dtype=bool),
            poses=moment.poses,
        )

    @property
    def covered(self) -> float:
        """Covered share of the container, as if nothing overlapped."""
        if self.poses is None or not len(self.items):
            return 0.0
        areas = sum(
            item.outline.area * scale**2
            for item, scale in zip(self.items, self.poses.scale.tolist(), strict=True)
        )
        return min(float(areas / self.container.outline.area), 1.0)

    def is_like(self, other: View) -> bool:
        """Whether nothing differs but poses."""
        names = (one.name for one in fields(self) if one.name != "poses")
        return all(_same(getattr(self, name), getattr(other, name)) for name in names)

    @property
    def likeness(self) -> float | None:
        """Mean share of the picture's colours that items of a mosaic take on; else None."""
        if self.mosaic is None or not self.items:
            return None
        return float(np.mean([self.mosaic.tint_of(item) for item in self.items]))

    @property
    def rings(self) -> tuple[str, ...]:
        """Texts round the edge of the container."""
        return self.kind.ring if isinstance(self.kind, LineKind) else ()

    def is_on_line(self, item: Item) -> bool:
        """Whether an item is a word that follows a line, and no text of a ring."""
        is_word = item.text is not None and not is_ring_text(item, self.kind)
        return is_word and isinstance(self.kind, LineKind)

    @property
    def numbers(self) -> FloatArray:
        """``(n, 4)`` x, y, angle and scale of each item."""
        if self.poses is None:
            return np.zeros((0, 4))
        columns = (self.poses.x, self.poses.y, self.poses.angle, self.poses.scale)
        return np.column_stack(columns)


@dataclass(frozen=True, eq=False)
class Shown:
    """View of a workspace at a moment.

    ``done``: how many commands it knows, in the count of the session's owner.
    """

    view: View
    state: State
    done: int


def _same(one: Any, other: Any) -> bool:
    is_array = isinstance(one, np.ndarray)
    return one is other or bool(np.array_equal(one, other) if is_array else one == other)


def _drawn(one: Attached) -> DrawnNote:
    note, matrix = one.note, _plain(one.note.matrix)
    return DrawnNote(path=note.path, matrix=matrix, fill=note.fill, item=one.item, pose=one.pose)


def _plain(matrix: FloatArray) -> tuple[float, float, float, float, float, float]:
    """A map as SVGs have it."""
    return cast(tuple[float, float, float, float, float, float], tuple(matrix.T.ravel()))


class Scenes:
    """Scenes of views, each drawn once; not for several threads at once."""

    def __init__(self) -> None:
        self._drawings: dict[Item, Drawing] = {}
        self._last: tuple[View, Scene] | None = None
        self._outline: tuple[Container, str] | None = None
        self._under: tuple[tuple[object, ...], tuple[Underlay, ...]] = ((), ())
        self.shapes: dict[str, Shape] = {}
        """Looks by their keys."""

    def known(self, view: View) -> Scene | None:
        """The last scene where nothing but poses differs; for any thread."""
        last = self._last
        return last[1] if last is not None and last[0].is_like(view) else None

    def of(self, view: View) -> Scene:
        """Scene of a view; the last one where nothing but poses differs."""
        if (known := self.known(view)) is not None:
            return known
        version = 1 if self._last is None else self._last[1].version + 1
        container = view.container
        scene = Scene(
            version=version,
            name=container.name,
            outline=self._path(container),
            is_lined=container.walls != (),
            width=container.width,
            height=container.height,
            unit=container.unit,
            items=tuple(self._thing(view, k) for k in range(len(view.items))),
            options=dict(view.options),
            angles=view.angles,
            kind=view.kind.name,
            notes=tuple(map(_drawn, view.notes)),
            title=view.title or container.name,
            palette=view.palette,
            shades=view.shades,
            ground=view.ground,
            gradient=gradient_text(view.behind),
            font=_font_of(view.items),
            left_out=dict(view.left_out),
            likeness=view.likeness,
            halos=view.halos,
            rim=view.rim,
            repeat=_repeat_of(container),
            along=view.kind.along if isinstance(view.kind, LineKind) else None,
            ring=view.rings,
            under=self._underlays(view),
        )
        # The scene before may still be on its way; of what was wanted longer ago little is kept.
        keys = {*scene.shapes, *([] if self._last is None else self._last[1].shapes)}
        longest_ago = max(len(self._drawings) - 2 * len(scene.items), 0)
        self._drawings = dict(list(self._drawings.items())[longest_ago:])
        keys.update(one.key for one in self._drawings.values())
        self.shapes = {key: self.shapes[key] for key in keys}
        self._last = (view, scene)
        return scene

    def _thing(self, view: View, k: int) -> Thing:
        item = view.items[k]
        place, angle, size = view.held[k].tolist()
        return Thing(
            id=int(view.ids[k]),
            shape=self._drawing(item).key,
            name=item.name,
            weight=float(view.weights[k]),
            stretch=1.0 if view.poses is None else float(view.poses.stretch[k]),
            count=counted_weight(item),
            is_word=is_straight_word(item) or view.is_on_line(item),
            held=(place, angle, size),
            halo=item.halo,
            crop=None if item.parts is not None else _crop_of(item.art),
            parts=0 if item.parts is None else len(item.parts.items),
        )

    def _drawing(self, item: Item) -> Drawing:
        drawing = self._drawings.pop(item, None)
        if drawing is None:
            drawing = drawing_of(item)
            fields = {name: getattr(drawing, name) for name in Shape.model_fields}
            self.shapes[drawing.key] = Shape(**fields)
        self._drawings[item] = drawing
        return drawing

    def _underlays(self, view: View) -> tuple[Underlay, ...]:
        """Pictures under the items, drawn anew where they or the container are others."""
        of = (view.container, view.behind, None if view.mosaic is None else view.mosaic.picture)
        if self._under[0] != of:
            under = underlays(view.container, view.behind, view.mosaic)
            self._under = (of, tuple(starmap(self._underlay, under)))
        return self._under[1]

    def _underlay(self, item: Item, matrix: FloatArray, is_faint: bool) -> Underlay:
        return Underlay(shape=self._drawing(item).key, matrix=_plain(matrix), faint=is_faint)

    def _path(self, container: Container) -> str:
        if self._outline is None or self._outline[0] is not container:
            path = path_of(container.outline, INK_FINENESS)
            self._outline = (container, path)
        return self._outline[1]


def _repeat_of(container: Container) -> tuple[float, float, float] | None:
    lattice = container.lattice
    return None if lattice is None else (lattice.width, lattice.height, lattice.drop)


def _crop_of(art: Art) -> tuple[float, float, float] | None:
    if not isinstance(art, PhotoArt):
        return None
    return (1.0, 0.0, 0.0) if art.crop is None else (art.crop.zoom, art.crop.x, art.crop.y)


def _font_of(items: Sequence[Item]) -> str:
    """Name of the font that most words begin with, as pages know it; empty without words."""
    names = Counter(font_told(one.text.runs[0].font) for one in items if one.text and one.text.runs)
    return names.most_common(1)[0][0][:MOST_TOLD] if names else ""


def left_out_of(manifest: Mapping[str, Any]) -> tuple[LeftOut, ...]:
    """Items that the run of a manifest could not place.

    Examples
    --------
    >>> row = {"item": "bee", "index": 3, "reason": "no void is large enough"}
    >>> left_out_of({"unplaced": [row]})
    (LeftOut(name='bee', reason='no void is large enough'),)
    """
    found = manifest.get("unplaced")
    # A layout's file may come from anywhere.
    rows = [one for one in found if isinstance(one, Mapping)] if isinstance(found, list) else []
    return tuple(
        LeftOut(
            name=str(one.get("item"))[:MOST_TOLD],
            reason=for_page(str(one.get("reason")))[:MOST_TOLD],
        )
        for one in rows[:MOST_LEFT_OUT]
    )


def told_of(manifest: Mapping[str, Any]) -> list[str]:
    """Sentences of a run about what it has left out of what it read, the first few.

    Examples
    --------
    >>> told_of({"skipped": ["cups.csv: left out 1 row of 9 whose cups is 0: Chad"]}), told_of({})
    (['cups.csv: left out 1 row of 9 whose cups is 0: Chad'], [])
    """
    found = manifest.get("skipped")
    return [str(one)[:MOST_TOLD] for one in found[:3]] if isinstance(found, list) else []
