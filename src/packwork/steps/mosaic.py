"""Colours with which items show a picture from afar, and whether it is recognised."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias, final

import numpy as np

from packwork.arrays import BoolArray, FloatArray
from packwork.fields.filters import structural_similarity
from packwork.phrasing import number_of
from packwork.pipeline.findings import Finding, Sentence
from packwork.pipeline.job import Job
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.raster.coverage import coverage
from packwork.scene.colour import css_colour, hex_colour
from packwork.scene.container import Container
from packwork.scene.contrast import between, channels_of, light_of, oklabs_of_light, readable
from packwork.scene.item import Art, Item, PhotoArt
from packwork.scene.layout import Layout
from packwork.scene.recolour import tinted_photo, with_own_art
from packwork.scene.swatch import ShownLight, mean_lights, shown_light
from packwork.scene.target import TargetPicture, blurred
from packwork.writers.recolour_drawings import with_mean_colour

STEPS, STEP = 24, 1.2
"""Steps towards the colours, and how far each goes over what is missing at an item. More change
nothing that is seen; longer ones swing. Tried."""

SQUARE = 0.6
"""Side of the squares over that of an item's share of the canvas. Larger lets neighbours make up
for each other further, smaller shows less of what lies between items. Tried."""

GREYS = 6
"""Greys that are tried as ground, beside colours of the picture. Chosen."""

SPARSE = 4
"""Rows and columns of pixels of which one is looked at for the ground. Larger is quicker and sees
less. Chosen."""

SHADES = 5
"""Colours of the picture along each channel that are tried. Chosen."""

NEAR, HIDDEN = 0.1, 0.12
"""Distance in Oklab from the ground at which an item is half hidden by it, and the distance from
the picture that is taken so that no item be hidden. Larger ones show items and the container
better, the picture worse. Chosen by eye."""

SEAMS = 0.1
"""Share of gaps below which items are seen less and less by them: of tiles side by side they are
seams, and are to be like the picture. Larger lets photographs with narrow gaps lie on a pale
ground, smaller shows seams. Chosen by eye."""

READ = 1.6
"""Least contrast of a word with the ground, as WCAG counts it. Larger lets dark parts of a picture
fade, smaller hides words. Chosen by eye."""

FINENESS = 4
"""Steps of 255 between colours that are given: finer ones are not told apart. Chosen."""


@dataclass(frozen=True, eq=False)
class CoverWindow:
    """Share of each pixel that an item covers, in the rows and columns that it reaches."""

    rows: slice
    columns: slice
    shares: FloatArray

    def mean(self, image: FloatArray) -> FloatArray:
        """``(3,)`` mean of an image under the item."""
        seen = image[self.rows, self.columns]
        whole = max(float(self.shares.sum()), 1e-9)
        return np.asarray(self.shares.ravel() @ seen.reshape(-1, seen.shape[2]) / whole)


def in_picture(
    layout: Layout, target: TargetPicture, tints: FloatArray, ground: str | None
) -> Layout:
    """Layout whose items have the colours that show a picture, on the ground that suits it.

    ``tints``: ``(n,)`` how far each takes them on; ``ground``: None for the one that shows it best.
    """
    if not layout.items:
        return layout
    windows = windows_of(layout, target)
    ground = ground or best_ground(target, _covered(windows, target))
    own = mean_lights(layout.items)
    wanted = _wanted(target, windows, own, tints, light_of(_channels(ground)))
    shown = _Shown()
    items = [
        _tinted(item, _hex(colour), share, light, ground, shown)
        for item, colour, share, light in zip(layout.items, wanted, tints, own, strict=True)
    ]
    return replace(layout, items=tuple(items), ground=hex_colour(css_colour(ground)))


def best_ground(target: TargetPicture, covered: float) -> str:
    """Colour of the gaps with which items of any colours show a picture best and are seen.

    Examples
    --------
    >>> dark = np.zeros((20, 20, 3)); dark[:10, :10] = 0.05
    >>> best_ground(TargetPicture(dark, 1.0), 0.8)
    '#000000'
    >>> best_ground(TargetPicture(np.full((20, 20, 3), 0.2), 1.0), 0.9998)
    '#7c7c7c'
    """
    seen = blurred(target.light, 1.0, 1_000)[::SPARSE, ::SPARSE].reshape(-1, 3)
    greys = np.repeat(np.linspace(0, 1, GREYS)[:, None], 3, axis=1)
    own = np.quantile(channels_of(seen), np.linspace(0, 1, SHADES), axis=0)
    grounds = np.vstack([greys, own, channels_of(seen.mean(axis=0))[None]])
    labs = oklabs_of_light(seen)
    hidden = HIDDEN * min((1 - covered) / SEAMS, 1.0)

    def missed(ground: FloatArray) -> float:
        floor = (1 - covered) * light_of(ground)
        shown = np.clip(seen, floor, floor + covered)
        away = np.linalg.norm(oklabs_of_light(shown) - labs, axis=1)
        off = np.linalg.norm(labs - oklabs_of_light(light_of(ground)[None]), axis=1)
        lost = hidden * np.exp2(-((off / NEAR) ** 2)) + (HIDDEN - hidden) * off
        return float((away + lost).mean())

    return _hex(light_of(min(grounds, key=missed)))


def windows_of(layout: Layout, target: TargetPicture) -> list[CoverWindow]:
    """Pixels of a picture that the items of a layout cover, one of each."""
    found = []
    shape = np.array(target.light.shape[1::-1])
    for ink in layout.inks:
        points = ink.points * target.px_per_cu
        first = np.clip(np.floor(points.min(axis=0)), 0, shape - 1).astype(int)
        last = np.clip(np.ceil(points.max(axis=0)), first + 1, shape).astype(int)
        (left, top), (right, bottom) = first, last
        size = (int(bottom - top), int(right - left))
        shares = coverage(points - first, ink.starts, size, np.float64)
        found.append(CoverWindow(slice(top, bottom), slice(left, right), np.clip(shares, 0, 1)))
    return found


def _covered(windows: Sequence[CoverWindow], target: TargetPicture) -> float:
    """Share of what lies about the items that they cover."""
    image = np.zeros((*target.light.shape[:2], 1))
    for one in windows:
        image[one.rows, one.columns, 0] += one.shares
    near = blurred(image, SQUARE, len(windows))[..., 0] > 0.3
    return float(np.clip(image[near].mean(), 0.05, 1.0)) if near.any() else 0.5


def _wanted(
    target: TargetPicture,
    windows: Sequence[CoverWindow],
    own: FloatArray,
    tints: FloatArray,
    ground: FloatArray,
) -> FloatArray:
    """``(n, 3)`` light of each item that shows the picture, if it takes on ``tints`` of it."""
    share = np.zeros(target.light.shape[:2])
    for one in windows:
        share[one.rows, one.columns] += one.shares
    gaps = (1 - np.clip(share, 0, 1))[..., None] * ground
    # Beyond the items nothing can be shown, and nothing is missed.
    counts = (blurred(share[..., None], SQUARE, len(windows)) > 0.05).astype(np.float64)
    weight = np.maximum(blurred(counts, SQUARE, len(windows)), 1e-6)
    colours = np.array([one.mean(target.light) for one in windows])
    for _ in range(STEPS):
        shown = gaps.copy()
        for one, colour in zip(windows, own + tints[:, None] * (colours - own), strict=True):
            shown[one.rows, one.columns] += one.shares[..., None] * colour
        missed = blurred((target.light - shown) * counts, SQUARE, len(windows)) / weight
        colours += STEP * np.array([one.mean(missed) for one in windows])
        colours = np.clip(colours, 0.0, 1.0)
    return colours


class _Shown:
    """Light of what drawings show, found once of each."""

    def __init__(self) -> None:
        self._known: dict[Art, ShownLight | None] = {}

    def of(self, item: Item) -> ShownLight | None:
        """Of an item, which goes on being there."""
        if item.art not in self._known:
            self._known[item.art] = shown_light(item)
        return self._known[item.art]


def _tinted(
    item: Item, colour: str, share: float, own: FloatArray, ground: str, shown: _Shown
) -> Item:
    """Item that has taken on a share of a colour; a word as much of it as can still be read."""
    if share == 0:
        return item
    if isinstance(item.art, PhotoArt):
        return with_own_art(tinted_photo(item, colour, share), item)
    mixed = between((_hex(own), colour), share) if share < 1 else colour
    if item.text is not None:
        mixed = readable(mixed, ground, READ)
    return with_own_art(with_mean_colour(item, mixed, shown.of(item)), item)


def _channels(colour: str) -> FloatArray:
    return np.array(css_colour(colour)[:3]) / 255


def _hex(light: FloatArray) -> str:
    steps = np.rint(channels_of(light) * 255 / FINENESS) * FINENESS
    return hex_colour(tuple(np.minimum(steps, 255).astype(int).tolist()))


SIDE_PX = 64
"""Longer side at which a thumbnail is looked at. Larger asks for details, smaller for blots alone.
Chosen."""

LEAST = 0.7
"""Correlation from which a picture is recognised. Larger blames a face of 300 icons (0.77), smaller
passes 300 photographs of any colours (0.58) and 60 icons (0.43). By eye."""

SHOWN = 0.84
"""Structural similarity of a picture and the means in its cells from which it is recognised. Larger
asks for more tiles than it takes, smaller passes faces that nobody knows. By eye: decision 0053."""

FINE = 0.95
"""The same from which nothing is lost that is seen. Larger asks for thousands of tiles. By eye."""

COUNTS = (100, 200, 300, 500, 700, 1_000, 1_500, 2_000, 3_000, 5_000, 7_000, 10_000)
"""Numbers of items that are named. Chosen."""

HALF = "50%"
"""Tint that shows a picture by photographs of any colours. By eye."""

MORE_PHOTOS = f"--tint {HALF} or more photographs, of its colours,"
"""What shows a picture where photographs lack its colours."""


Judge: TypeAlias = Callable[[Job, TargetPicture, Layout], Finding | None]
"""What tells that a layout does not show a picture."""


def unrecognised(job: Job, target: TargetPicture, layout: Layout) -> Finding | None:
    """Finding of a picture that does not show, and what would do; None where it shows."""
    found = correlation_with(layout, target) if layout.items else LEAST
    if found >= LEAST:
        return None
    are_photos = any(isinstance(one.art, PhotoArt) for one in layout.items)
    remedy = None
    if job.tints.mean() < 0.5 and are_photos:
        # Of tiles that blend no number shows what no photograph has.
        remedy = MORE_PHOTOS if _would_show(target, layout) else None
    remedy = remedy or _more_items(job, found, len(layout.items))
    percent = max(100 * found, 0)
    return Finding(Sentence.PICTURE_HIDDEN, {"percent": percent, "remedy": remedy})


def _would_show(target: TargetPicture, layout: Layout) -> bool:
    """Whether as many items would show a picture, had they its colours."""
    side = float(np.sqrt(layout.container.outline.area / len(layout.items)))
    thumbs = _thumb(_in_squares(target, side)), _thumb(target.light)
    return _correlation(*thumbs, _inside(layout, target)) >= LEAST


def _more_items(job: Job, found: float, count: int) -> str:
    """Number of items that would show a picture, or the tint.

    What a correlation lacks falls at least as fast as the root of the number grows, so the
    number is no smaller than it takes. Measured with 30, 60, 100, 200 and 300 icons: it lacks
    .71, .49, .34, .24 and .15 of a portrait, .33, .23, .17, .11 and .07 of a photograph.
    """
    needed = count * ((1 - found) / (1 - LEAST)) ** 2
    more = [f"-n {count:,}".replace(",", "") for count in COUNTS if count >= needed][:1]
    if job.tints.mean() < 0.5:
        more.append(f"--tint {HALF}")
    return " or ".join(more) or "a plainer picture"


def too_fine(target: TargetPicture, container: Container, count: int, what: str) -> Finding | None:
    """Finding of a picture that is finer than so many items show, ``what`` they are called."""
    area = container.outline.area

    def shows(count: int) -> bool:
        return structure_in_squares(target, float(np.sqrt(area / count))) >= SHOWN

    if not count or shows(count):
        return None
    more = (f"-n {n}" for n in COUNTS if n > count and shows(n))
    values = {"tiles": number_of(count, what), "remedy": next(more, "a plainer picture")}
    return Finding(Sentence.FEW_TILES, values)


def shown_by(target: TargetPicture, container: Container, count: int, what: str) -> Finding:
    """Remark on how alike a picture is in so many squares, and the number that loses nothing."""
    area = container.outline.area

    def alike(count: int) -> float:
        return max(structure_in_squares(target, float(np.sqrt(area / count))), 0.0)

    now, more = alike(count), [n for n in COUNTS if n > count]
    finer = next((n for n in more if alike(n) >= FINE), max(more, default=0)) * (now < FINE)
    then = f"; -n {finer} to {100 * alike(finer):.0f} %" if finer else ""
    values = {"tiles": number_of(count, what), "percent": 100 * now, "then": then}
    return Finding(Sentence.SHOWN_TO, values)


def correlation_with(layout: Layout, target: TargetPicture) -> float:
    """Correlation of a layout with the picture, both thumbnails, inside the container."""
    seen = _thumb(_seen(layout, target))
    return _correlation(seen, _thumb(target.light), _inside(layout, target))


def structure_in_squares(target: TargetPicture, side: float) -> float:
    """Structural similarity of a picture and the same in squares of its mean colours.

    Of lightness, both thumbnails. ``side``: in canvas units.

    Examples
    --------
    >>> lines = TargetPicture(np.tile(np.arange(12.0)[:, None, None] % 2, (1, 12, 3)), 1.0)
    >>> structure_in_squares(lines, 1.0), round(structure_in_squares(lines, 2.0))
    (1.0, 0)
    """
    return structural_similarity(
        *(
            np.ascontiguousarray(_thumb(one)[..., 0])
            for one in (target.light, _in_squares(target, side))
        )
    )


def _in_squares(target: TargetPicture, side: float) -> FloatArray:
    """Light of a picture in squares of its mean colours; ``side``: in canvas units."""
    squares = target.light
    for axis in (0, 1):
        cell = (np.arange(squares.shape[axis]) / (side * target.px_per_cu)).astype(np.int64)
        firsts = np.flatnonzero(np.diff(cell, prepend=-1))
        sums = np.add.reduceat(squares, firsts, axis)
        sizes = np.diff(firsts, append=len(cell))
        squares = np.repeat(sums / np.expand_dims(sizes, (1 - axis, 2)), sizes, axis)
    return squares


def _seen(layout: Layout, target: TargetPicture) -> FloatArray:
    """Light of a layout in the pixels of the picture, each item in its mean colour."""
    ground = light_of(np.array(css_colour(layout.ground or "white")[:3]) / 255)
    light = np.broadcast_to(ground, target.light.shape).copy()
    lights = mean_lights(layout.items)
    for window, own in zip(windows_of(layout, target), lights, strict=True):
        part = light[window.rows, window.columns]
        part += window.shares[..., None] * (own - ground)
    return np.clip(light, 0.0, 1.0)


def _thumb(light: FloatArray) -> FloatArray:
    """The same, averaged over squares, in Oklab ``(rows, columns, 3)``."""
    size = max(round(max(light.shape[:2]) / SIDE_PX), 1)
    rows, columns = (max(n // size, 1) for n in light.shape[:2])
    squares = light[: rows * size, : columns * size].reshape(rows, size, columns, size, -1)
    mean = squares.mean(axis=(1, 3))
    return oklabs_of_light(mean.reshape(-1, 3)).reshape(rows, columns, 3)


def _inside(layout: Layout, target: TargetPicture) -> BoolArray:
    outline = layout.container.outline
    shape = target.light.shape[:2]
    whole = coverage(outline.points * target.px_per_cu, outline.starts, (shape[0], shape[1]))
    size = max(round(max(shape) / SIDE_PX), 1)
    rows, columns = (max(n // size, 1) for n in shape)
    squares = whole[: rows * size, : columns * size].reshape(rows, size, columns, size)
    return np.asarray(squares.mean(axis=(1, 3)) > 0.5)


def _correlation(one: FloatArray, other: FloatArray, inside: BoolArray) -> float:
    a, b = (values[inside] - values[inside].mean(axis=0) for values in (one, other))
    scale = float(np.sqrt((a**2).sum() * (b**2).sum()))
    return float((a * b).sum()) / scale if scale > 0 else 0.0


@final
class ShowPicture(RunStep):
    """Colours by which the items show a picture from afar, and advice where they do not."""

    def __init__(self, target: TargetPicture, judge: Judge) -> None:
        self._target, self._judge = target, judge

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State whose layout is recoloured."""
        layout, _ = state.measured
        with state.job.clock.time("measure"):
            job = state.job
            layout = in_picture(layout, self._target, job.tints, job.recipe.ground)
        found = self._judge(job, self._target, layout)
        if found is None and layout.items:
            found = shown_by(self._target, layout.container, len(layout.items), "item")
        findings = state.findings if found is None else (*state.findings, found)
        return replace(state, layout=layout, findings=findings)
