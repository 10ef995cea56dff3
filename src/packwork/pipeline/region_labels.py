"""Names of groups of like items and of a map's parts, on plates that are placed as items are.

A label that lies over a full collage covers what it names. So each is an upright item: that of a
group has the mean vector of the group, so that it comes to lie in the middle of that; that of a
part is pinned where it has most room.
"""

from __future__ import annotations

import logging
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, pairwise

import numpy as np
import shapely

from packwork.assignment.graph import unit_rows
from packwork.errors import ReadError, RecipeError
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import buffered, prepared
from packwork.geometry.polygon import Region
from packwork.phrasing import enumerated
from packwork.pipeline.job import Job
from packwork.pipeline.plan.copies import ItemRules, RuleSource
from packwork.pipeline.plan.vectors import ItemVectors
from packwork.readers.container import read_parts
from packwork.readers.fonts.fallback import Fonts, open_fonts
from packwork.readers.fonts.lettering import Lettering
from packwork.readers.reading import UnfitError
from packwork.recipe.rules import OWN_COLOURS
from packwork.scene.item import Item, Label, VectorArt
from packwork.scene.notation import matrix_text, path_data

_LOG = logging.getLogger("packwork")

LARGEST, SMALLEST = 0.035, 0.016
"""Height of an em over the canvas' longer side. Larger outshouts the items, smaller cannot be read
without a glass. Chosen by eye."""

WIDE = 0.6
"""Width of a plate over the side of a square as large as what its group has. Larger parts the
group. Chosen by eye."""

ACROSS, ALONG = 0.45, 0.3
"""Room about letters on their plate, in ems: beside them, over and under them. Chosen by eye."""

ROUND = 0.35
"""Radius of its corners, in ems. Chosen by eye."""

PLATE, LETTERS = "#1a202c", "#ffffff"
"""Contrast of 16: they can be read on and beside any colour."""

UNIT = 100.0
"""Units of a plate to an em. Any would do."""

WEIGHT = 600
MOST_LINES, LINE_FROM = 3, 12
"""Lines of a name, and letters from which it is broken. Chosen by eye."""

PLACES, SIZES = 25, 5
"""Places each way, and heights of letters, that are tried in a part. More find a little more room.
Chosen."""

DIGITS = 6
LABEL, PART_LABEL = "label:", "part-label:"
"""Begins of the source of a plate: of a group, and of a part."""

LABEL_RULE = RuleSource("label_regions")


def labelled(job: Job) -> Job:
    """The job with a plate for each group of its vectors, or part of its container."""
    if job.vectors is not None and job.vectors.groups:
        return _with_groups(job, job.vectors)
    parts = read_parts(job.container)
    if not parts:
        raise RecipeError(
            "label_regions",
            "nothing has names: neither groups, a column of texts beside the numbers of "
            "--embeddings, nor parts, shapes with a title or an id in the container's SVG",
        )
    return _with_parts(job, parts)


def _with_groups(job: Job, vectors: ItemVectors) -> Job:
    groups = np.array(vectors.groups_of(job.items))
    plates, told = _plates({name for name in groups.tolist() if name})
    room = job.container.outline.area * job.weights / job.weights.sum()
    sides = {name: float(np.sqrt(room[groups == name].sum())) for name in plates}
    em = _common_em(plates, sides, job.container.side)
    fits = [name for name, plate in plates.items() if plate.wide * em <= sides[name]]
    rows = unit_rows(vectors.of(job.items))
    means = [rows[groups == name].mean(axis=0) for name in fits]
    items = tuple(plates[name].item(LABEL, name) for name in fits)
    asked = [_asked(job, plates[name].longest * em) for name in fits]
    told += _without_room([name for name in plates if name not in fits])
    if items:
        job = replace(job, vectors=vectors.joined_by(items, np.array(means)))
    return _joined(job, items, asked, told)


def _with_parts(job: Job, parts: Sequence[tuple[str, Region]]) -> Job:
    labels, told = part_labels(parts, job.container.side)
    asked = [_asked(job, label.size, (label.x, label.y)) for label in labels]
    return _joined(job, [label.item for label in labels], asked, told)


@dataclass(frozen=True, eq=False)
class PartLabel:
    """Plate with the name of a part, where that has most room.

    ``size``: its longer side, canvas units; ``x``, ``y``: its middle, as well.
    """

    item: Item
    size: float
    x: float
    y: float


def part_labels(
    parts: Sequence[tuple[str, Region]], side: float
) -> tuple[list[PartLabel], list[ReadError]]:
    """Plates for parts of a container whose longer side is ``side``; what has to be told of others.

    ``parts``: names, and regions in canvas units.
    """
    plates, told = _plates({name for name, _ in parts})
    labels, narrow = [], []
    for name, region in parts:
        if name not in plates:
            continue
        found = _place(plates[name], region, side)
        if found is None:
            narrow.append(name)
            continue
        em, x, y = found
        plate = plates[name]
        labels.append(PartLabel(plate.item(PART_LABEL, name), plate.longest * em, x, y))
    return labels, told + _without_room(narrow)


def _joined(
    job: Job, items: Sequence[Item], asked: Sequence[ItemRules], told: Sequence[ReadError]
) -> Job:
    for error in told:
        _LOG.warning("%s", error)
    return replace(
        job,
        items=(*job.items, *items),
        asked=(*job.asked, *asked),
        weights=np.append(job.weights, np.full(len(items), job.weights.mean())),
        skipped=(*job.skipped, *told),
    )


def _without_room(names: Sequence[str]) -> list[ReadError]:
    if not names:
        return []
    have = "has no room for its name" if len(names) == 1 else "have no room for their names"
    return [ReadError(enumerated(names), f"{have}; use fewer, shorter ones or a larger container")]


@dataclass(frozen=True, eq=False)
class _Plate:
    """A name in lines on its plate, in ems, the middle of the plate at the origin."""

    drawn: Lettering
    wide: float
    high: float

    @property
    def longest(self) -> float:
        return max(self.wide, self.high)

    def item(self, source: str, name: str) -> Item:
        """The plate as an item, whose source begins so."""
        left, top, right, bottom = self.drawn.region.bounds
        half = np.array([self.wide, self.high]) / 2 - ROUND
        inner = shapely.box(*-half, *half)
        plate = Outline.from_region(shapely.affinity.scale(
            buffered(inner, ROUND), UNIT, UNIT, origin=(0, 0)
        ))  # fmt: skip
        place = affine.similarity(
            -UNIT * (left + right) / 2, -UNIT * (top + bottom) / 2, 0.0, UNIT / self.drawn.units
        )
        markup = (
            f'<path fill="{PLATE}" d="{path_data(plate, DIGITS)}"/>'
            f'<path fill="{LETTERS}" transform="{matrix_text(place)}" d="{self.drawn.path}"/>'
        )
        art = VectorArt(markup, affine.similarity(0.0, 0.0, 0.0, 1.0))
        return Item(name, f"{source}{name}", plate, plate, art, Label(name=name))


def _plates(names: Iterable[str]) -> tuple[dict[str, _Plate], list[ReadError]]:
    """Plates of names, and what has to be told of those that cannot be drawn."""
    fonts = open_fonts([], WEIGHT)
    found: dict[str, _Plate] = {}
    told: list[ReadError] = []
    for name in sorted(names, key=lambda one: (one.casefold(), one)):
        try:
            found[name] = _plate(name, fonts)
        except UnfitError as error:
            told.append(ReadError(name[:40], f"{error}; the name is not written"))
    return found, told


def _plate(name: str, fonts: Fonts) -> _Plate:
    drawn = fonts.lettering(_lines(name.split()))
    left, top, right, bottom = drawn.region.bounds
    return _Plate(drawn, right - left + 2 * ACROSS, bottom - top + 2 * ALONG)


def _lines(words: Sequence[str]) -> tuple[str, ...]:
    """Words in as many lines as keep them short, the longest line as short as goes.

    Examples
    --------
    >>> _lines(["Papua", "New", "Guinea"]), _lines(["Peru"])
    (('Papua New', 'Guinea'), ('Peru',))
    """
    letters = len(" ".join(words))
    count = min(MOST_LINES, len(words), 1 + letters // LINE_FROM)
    ends = np.cumsum([0, *(len(word) + 1 for word in words)])
    best = min(
        combinations(range(1, len(words)), count - 1),
        key=lambda cuts: int(np.diff(ends[[0, *cuts, len(words)]]).max()),
    )
    return tuple(" ".join(words[a:b]) for a, b in pairwise([0, *best, len(words)]))


def _common_em(plates: dict[str, _Plate], sides: dict[str, float], side: float) -> float:
    """Height of an em of all names: as large as is good for the narrowest group."""
    wanted = [WIDE * sides[name] / plate.longest for name, plate in plates.items()]
    return float(np.clip(min(wanted, default=0.0), SMALLEST * side, LARGEST * side))


def _place(plate: _Plate, region: Region, side: float) -> tuple[float, float, float] | None:
    """Height of an em, x and y at which a plate lies deepest in a region, as large as goes."""
    left, top, right, bottom = region.bounds
    x, y = (one.ravel() for one in np.meshgrid(
        np.linspace(left, right, PLACES), np.linspace(top, bottom, PLACES)
    ))  # fmt: skip
    region = prepared(region)
    is_inside = shapely.contains_xy(region, x, y)
    x, y = x[is_inside], y[is_inside]
    for em in np.geomspace(LARGEST, SMALLEST, SIZES) * side:
        wide, high = plate.wide * em / 2, plate.high * em / 2
        boxes = shapely.box(x - wide, y - high, x + wide, y + high)
        fits = np.flatnonzero(shapely.contains(region, boxes))
        if len(fits):
            depths = shapely.distance(region.boundary, boxes[fits])
            best = fits[np.argmax(depths)]
            return float(em), float(x[best]), float(y[best])
    return None


def _asked(job: Job, size: float, at: tuple[float, float] | None = None) -> ItemRules:
    unit = job.container.unit
    pin = {"size": f"{size:.17g}{unit}"}
    if at is not None:
        pin |= {"x": f"{at[0]:.17g}{unit}", "y": f"{at[1]:.17g}{unit}"}
    sources = dict.fromkeys(("rotate", "color", *(f"pin.{key}" for key in pin)), LABEL_RULE)
    return ItemRules({"rotate": "none", "color": OWN_COLOURS}, pin, sources, is_central=at is None)
