"""Colours, names, links and halos of placed items; colours of neighbours differ."""

from __future__ import annotations

import io
from dataclasses import replace
from typing import TypeAlias, final

import numpy as np
from PIL import Image

from packwork.arrays import FloatArray, IntArray
from packwork.assignment.graph import clusters
from packwork.assignment.orders import min_conflicts_order
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.phrasing import enumerated
from packwork.pipeline.findings import Sentence
from packwork.pipeline.job import Job
from packwork.pipeline.plan.copies import ItemRules, kinds
from packwork.pipeline.plan.own_losses import sees_colours
from packwork.pipeline.state import RunContext, RunState, RunStep
from packwork.raster.coverage import coverage
from packwork.raster.drawing import drawn_png
from packwork.recipe.rules import OWN_COLOURS
from packwork.scene.container import Backdrop, Container
from packwork.scene.contrast import channels_of, contrast_over, luminances, readable, readable_over
from packwork.scene.item import Art, Item, Label, PhotoArt, PictureArt
from packwork.scene.layout import Layout
from packwork.scene.neighbours import side_by_side
from packwork.scene.notation import matrix_text
from packwork.scene.palette import palette_colours
from packwork.scene.recolour import has_one_colour, recoloured
from packwork.scene.swatch import mean_lights, representative_colour
from packwork.writers.recolour_drawings import in_palette, in_shades_of


def beside(layout: Layout) -> IntArray:
    """``(m, 2)`` pairs of items that lie side by side, as ``scene.neighbours`` says."""
    lattice = layout.container.lattice
    if lattice is None:
        return side_by_side(layout.outlines)
    # Over the edge of a tile lie neighbours too.
    shifts, count = np.concatenate([np.zeros((1, 2)), lattice.neighbours()]), len(layout.items)
    everywhere = [
        outline.mapped(affine.similarity(right, down, 0.0, 1.0))
        for right, down in shifts.tolist() for outline in layout.outlines
    ]  # fmt: skip
    pairs = side_by_side(everywhere)
    pairs = np.sort(pairs[pairs[:, 0] < count] % count, axis=1)
    return np.unique(pairs[pairs[:, 0] < pairs[:, 1]], axis=0)


def same_kind_beside(layout: Layout) -> int:
    """Number of neighbouring pairs of one kind."""
    first, second = kinds(layout.items)[beside(layout)].T
    return int(np.count_nonzero(first == second))


_Arts: TypeAlias = dict[tuple[Art, Outline, str, bool], Art]


def colours_seen(job: Job, layout: Layout) -> FloatArray:
    """``(n, 3)`` mean colours, sRGB 0 to 1, in which losses see items that lie as in a layout."""
    return channels_of(mean_lights(as_asked(job, layout).items))


def as_asked(job: Job, layout: Layout) -> Layout:
    """Layout whose items look and are called as rules and palette ask.

    Colours of a palette are given out in the order of the items, as many of each; then
    neighbours of one colour exchange theirs with others, unless a loss has placed them by it.
    Where it is known which items are alike, those of one cluster get one colour. What has several
    colours gets their tints and shades.
    """
    if job.plan.shades == "nearest":
        layout = _in_nearest(job, layout)
    coloured = job.use.colours(job, layout)
    palettes: list[tuple[str, ...]] = [] if coloured else _by_cluster(job, _palettes(job))
    if coloured is None and not any(palettes) and not any(_label(one) for one in job.asked):
        return layout
    is_mixed = not sees_colours(job.plan.losses)
    colours = given_out(palettes, layout, is_mixed, job.plan.seed) if coloured is None else coloured
    known: dict[tuple[Item, str | None, Label | None, bool], Item] = {}
    arts: _Arts = {}
    items = []
    for item, one, colour in zip(layout.items, job.asked, colours, strict=True):
        key = (item, colour, _label(one), coloured is None and "color" not in one.values)
        if key not in known:
            known[key] = _dressed(item, *key[1:], arts)
        items.append(known[key])
    return replace(layout, items=tuple(items))


def _in_nearest(job: Job, layout: Layout) -> Layout:
    """Layout in which each colour of a drawing of several has become the palette's nearest."""
    palette = job.plan.palette
    if not (palette and job.use.has_nearest):
        return layout
    known: dict[Item, Item] = {}
    for item in layout.items:
        if item not in known:
            stays = isinstance(item.art, PhotoArt) or has_one_colour(item.art)
            known[item] = item if stays else in_palette(item, palette)
    pairs = zip(layout.items, job.asked, strict=True)
    items = [item if "color" in one.values else known[item] for item, one in pairs]
    return replace(layout, items=tuple(items))


def _dressed(
    item: Item, colour: str | None, label: Label | None, tinted: bool, arts: _Arts
) -> Item:
    """Item in its colour; items that share a drawing share it in each colour too.

    ``tinted`` lets a drawing of several colours have tints and shades of it.
    """
    if colour is not None:
        key = (item.art, item.ink, colour, tinted)
        if key not in arts:
            arts[key] = (in_shades_of if tinted else recoloured)(item, colour).art
        item = replace(item, art=arts[key])
    return item if label is None else replace(item, label=label)


def _label(one: ItemRules) -> Label | None:
    said = {key: one.values[key] for key in ("name", "link", "title") if key in one.values}
    return Label(**said) if said else None


def _palettes(job: Job) -> list[tuple[str, ...]]:
    """Colours that each copy may have; none for those that keep theirs."""
    common = job.plan.palette
    plain: dict[Item, bool] = {}
    found = []
    for item, one in zip(job.items, job.asked, strict=True):
        if "color" in one.values:
            color = one.values["color"]
            found.append(() if color == OWN_COLOURS else palette_colours(color))
            continue
        if common and item not in plain:
            plain[item] = has_one_colour(item.art) or _is_tinted(job, item)
        found.append(common if plain.get(item) else ())
    return found


def _by_cluster(job: Job, palettes: list[tuple[str, ...]]) -> list[tuple[str, ...]]:
    """One colour of each palette for items of one group or cluster, where that is known."""
    most = max(map(len, palettes), default=0)
    if job.vectors is None or most < 2:
        return palettes
    if job.vectors.groups:
        numbers = np.unique(job.vectors.groups_of(job.items), return_inverse=True)[1]
    else:
        numbers = clusters(job.vectors.of(job.items), most, np.random.default_rng(job.plan.seed))
    pairs = zip(palettes, numbers.tolist(), strict=True)
    return [(palette[k % len(palette)],) if palette else () for palette, k in pairs]


def _is_tinted(job: Job, item: Item) -> bool:
    """Whether a drawing of several colours is to have the tints and shades of one.

    Not among words, whose palette is theirs: emoji and icons keep their colours there.
    """
    is_asked = job.plan.shades == "tint" and job.use.palette_tints
    return is_asked and not isinstance(item.art, PhotoArt)


def given_out(
    palettes: list[tuple[str, ...]], layout: Layout, is_mixed: bool, seed: int
) -> list[str | None]:
    """One colour of each copy's palette, unlike its neighbours' where it is mixed."""
    several = sorted({palette for palette in palettes if palette})
    known = sorted({colour for palette in several for colour in palette})
    numbers = {colour: k for k, colour in enumerate(known)}
    # Copies that keep their colours are unlike all others.
    labels: IntArray = len(known) + np.arange(len(palettes))
    groups = np.full(len(palettes), -1)
    for number, palette in enumerate(several):
        members = [k for k, own in enumerate(palettes) if own == palette]
        groups[members] = number
        labels[members] = np.resize([numbers[colour] for colour in palette], len(members))
    if is_mixed and any(len(palette) > 1 for palette in several):
        pairs = beside(layout)
        rng = np.random.default_rng(seed)
        labels = labels[min_conflicts_order(labels, pairs, groups, rng)]
    return [known[label] if label < len(known) else None for label in labels]


TEXT, GRAPHIC = 4.5, 3.0
"""Least contrast of words and of other items with what lies under them: WCAG 2.2, 1.4.3 and
1.4.11, level AA."""

GROUND_PX = 500
"""Longer side of the image in which it is looked up what lies under an item. Larger is slower
and sees grain that no eye does. Chosen."""

DARKEST, BRIGHTEST = 5.0, 95.0
"""Percentiles of luminance under an item that count as the darkest and the brightest: a spark
does not make a word unreadable. Chosen."""

BRIGHT = 0.4
"""Mean luminance under items from which halos are black: the eye's middle grey has 0.18, and
white rims look better than black ones for long. Chosen by eye."""

PAPER = "white"
"""What is seen where the picture does not reach."""


def legible(job: Job, layout: Layout) -> Layout:
    """Layout whose items stand out from the picture behind.

    Photos stay as they are. What has one colour gets a lighter or darker one of that hue where
    it needs to; where none would do, and what has several colours, gets a halo.
    """
    behind = layout.container.backdrop
    if behind is None:
        return layout
    ground = ground_luminance(layout.container, behind)
    words = set(job.use.words)
    under = luminances_under(layout, ground)
    # One colour for all: halos of two colours look like a mistake.
    halo = "white" if np.mean(under) < BRIGHT else "black"
    items = tuple(
        _told_apart(item, pair, TEXT if original in words else GRAPHIC, halo)
        for item, original, pair in zip(layout.items, job.items, under, strict=True)
    )
    return replace(layout, items=items)


def ground_luminance(container: Container, behind: Backdrop) -> FloatArray:
    """``[row, col]`` luminance, 0..1, of the picture behind on its canvas."""
    scale = GROUND_PX / container.side
    width, height = (max(1, round(side * scale)) for side in (container.width, container.height))
    art = behind.art.preview
    place = matrix_text(affine.compose(behind.matrix, art.matrix))
    text = (
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
        f'width="{width}" height="{height}" viewBox="0 0 {container.width} {container.height}" '
        f'preserveAspectRatio="none"><rect width="100%" height="100%" fill="{PAPER}"/>'
        f'<g transform="{place}">{art.markup}</g></svg>'
    )
    with Image.open(io.BytesIO(drawn_png(text))) as picture:
        return luminances(np.asarray(picture.convert("RGB"), dtype=np.float64) / 255)


def luminances_under(layout: Layout, ground: FloatArray) -> list[tuple[float, float]]:
    """Least and greatest luminance of ``ground`` ``(rows, columns)`` under each item."""
    scale = GROUND_PX / layout.container.side
    found = []
    for ink in layout.inks:
        share = coverage(ink.points * scale, ink.starts, ground.shape, np.float32)
        seen = ground[share >= min(0.5, float(share.max()))]
        low, high = np.percentile(seen, [DARKEST, BRIGHTEST])
        found.append((float(low), float(high)))
    return found


def _told_apart(item: Item, under: tuple[float, float], least: float, halo: str) -> Item:
    if isinstance(item.art, PhotoArt):
        return item
    own = representative_colour(item)
    if contrast_over(own, *under) >= least:
        return item
    can_change = has_one_colour(item.art)
    better = readable_over(own, *under, least) if can_change else None
    if better is not None:
        return recoloured(item, better)
    if not can_change:
        return replace(item, halo=halo)
    return replace(recoloured(item, readable(own, halo, least)), halo=halo)


@final
class Dress(RunStep):
    """Colours, names and links as rules, palette and data ask."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State whose layout is dressed."""
        layout, _ = state.measured
        with state.job.clock.time("measure"):
            dressed = as_asked(state.job, layout)
        state = replace(state, layout=dressed)
        if state.job.plan.shades != "tint":
            return state
        pairs = zip(layout.items, dressed.items, strict=True)
        changed = {
            before.art: before.name
            for before, now in pairs
            if now.art is not before.art and isinstance(now.art, PictureArt)
        }
        tinted = [name for art, name in changed.items() if not has_one_colour(art)]
        return state.with_finding(Sentence.TINTED, names=enumerated(tinted)) if tinted else state


@final
class StandOut(RunStep):
    """Colours and halos by which items stand out from a picture behind them."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State whose layout can be told from what is behind it."""
        layout, _ = state.measured
        with state.job.clock.time("measure"):
            return replace(state, layout=legible(state.job, layout))


@final
class CountBeside(RunStep):
    """Number of pairs of one kind that lie side by side, where they were not to."""

    def run(self, state: RunState, context: RunContext) -> RunState:
        """State with that number."""
        layout, _ = state.measured
        if not state.limits.binds:
            return state
        with state.job.clock.time("measure"):
            return replace(state, beside=same_kind_beside(layout))
