"""Films as one SVG that moves by itself: no script, every browser, in pages and pictures.

Each item has its own keyframes in CSS, between which browsers interpolate place, turn and
size as we do. Programs that know no CSS animation show the end, and so do browsers of
people who asked their system for less motion.
"""

from __future__ import annotations

import hashlib
import math
from dataclasses import replace

from packwork.scene.item import VectorArt
from packwork.scene.notation import decimals, number, with_fresh_ids
from packwork.scene.track import COLUMNS, poses_of
from packwork.writers.film.film import Film, Tell, tell_nobody
from packwork.writers.frame import picture_frame
from packwork.writers.svg import sheet_of, svg_document
from packwork.writers.svg_symbols import element, item_ids, paint

TOLERANCE = 1 / 4_000
"""Largest way of an item from where a film's frames have it, as a share of the canvas: a
fifth of a pixel of 800. Smaller: longer files that look the same. Chosen."""

_PERCENT_DIGITS = 3
_STRETCH = COLUMNS.index("stretch")
_LEAVING = "leaving"


def animated_svg_bytes(film: Film, tell: Tell = tell_nobody) -> bytes:
    """SVG file of a film: the layout's own, and how its items move."""
    frame = picture_frame(film.layout.container, film.options.film_pixels)
    # Halos lie under all items, in one group: they would stay behind.
    bare = tuple(replace(item, halo="") for item in film.layout.items)
    still = svg_document(
        replace(film.layout, items=bare), film.drawing, sheet_of(frame, film.layout.container)
    )
    head, end_of_title, rest = still.partition("</title>")
    beneath, items, above = rest.partition('<g id="items"')
    drawn = [head, end_of_title, "\n", _style(film, tell), beneath, *_leaving(film), items, above]
    return "".join(drawn).encode()


def _leaving(film: Film) -> list[str]:
    """Drawings of the items that leave, which no program shows that does not move them."""
    leaving, step = film.layout.leaving, TOLERANCE * film.layout.container.side / 4
    if leaving is None:
        return []
    drawn = []
    for k, item in enumerate(leaving.items):
        if isinstance(item.art, VectorArt):
            markup = with_fresh_ids(item.art.markup, f"-{_LEAVING}-{k + 1}")
            item = replace(item, art=replace(item.art, markup=markup))
        shape = element(item, paint(item), "", decimals(step / float(leaving.poses.scale[k])))
        drawn.append(f'<g id="{_LEAVING}-{k + 1}" transform="scale(0)">{shape}</g>\n')
    return [f'<g id="{_LEAVING}">\n', *drawn, "</g>\n"] if drawn else []


def _style(film: Film, tell: Tell) -> str:
    items = film.items
    ids = [f"{_LEAVING}-{k + 1}" for k in range(film.leaving)] + item_ids(film.layout.items)
    # Several films may stand in one page, whose keyframes have one namespace.
    name = "way-" + hashlib.sha256(film.frames.tobytes()).hexdigest()[:8]
    count = "1" if film.options.loop == "once" else "infinite"
    timing = f"{film.seconds.sum():g}s linear {count} both"
    lines = []
    for k, (item, own) in enumerate(zip(items, ids, strict=True)):
        lines.append(f'[id="{own}"]{{animation:{name}-{k + 1} {timing}}}')
        lines.append(f"@keyframes {name}-{k + 1}{{{_keyframes(film, k, item.ink.radius)}}}")
        tell((k + 1) / len(items))
    still = (
        f"@media (prefers-reduced-motion:reduce){{#items *,#{_LEAVING} *"
        "{animation:none!important}}"
    )
    return "\n".join(["<style>", *lines, still, "</style>"])


def _keyframes(film: Film, item: int, radius: float) -> str:
    step = TOLERANCE * film.layout.container.side
    frames, chosen = film.frames[:, item], film.knots(item, step)
    poses = poses_of(frames[chosen])
    reach = max(radius * float(poses.scale.max()), step)
    place, turn = decimals(step / 4), decimals(math.degrees(step / 4 / reach))
    size = decimals(step / 4 / radius)
    is_stretched = bool((frames[:, _STRETCH] != 1).any())
    shares = 100 * film.starts[chosen] / film.seconds.sum()
    parts = []
    for k, share in enumerate(shares.tolist()):
        wide, high = (number(float(v), size) for v in poses.axis_scales[k])
        scale = f"{wide},{high}" if is_stretched else wide
        parts.append(
            f"{number(share, _PERCENT_DIGITS)}%{{transform:"
            f"translate({number(float(poses.x[k]), place)}px,{number(float(poses.y[k]), place)}px)"
            f"rotate({number(math.degrees(float(poses.angle[k])), turn)}deg)scale({scale})}}"
        )
    # What comes last holds to the end.
    _, _, last = parts[-1].partition("%")
    return "".join([*parts, "100%" + last])
