"""docs/benchmarks/peers.md, of its manifest."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from benchmarks.kit.manifests import Manifest
from benchmarks.kit.measuring import lasting, markdown_table, ranged
from benchmarks.peers import peer_circles, peer_icons, peer_penrose, peer_raster
from benchmarks.words.clouds import SIZE_RATIO

PAGE = """# Peers

Made by `packwork bench peers`, a section at a time; each says when and on what. One thread;
times are the processor's where nothing else is said, medians with the least and the most in
brackets, five runs each, one where a run took more than 10 s. Peers in Python come with
`pip install -e '.[bench,torch]'`, those in JavaScript with `packwork bench peers install`.

{sections}
"""

SECTION = """## {title}

{machine}; {date}, `{command}`.

{text}

{table}
{missing}"""

TEXTS = {
    "icons": (
        "Icons in a rectangle: spyrrow",
        f"""The frozen set's 100 icons, {peer_icons.EDGES:,} edges in all, each scaled to the same
area; one icon of several parts is taken as its hull, for both. spyrrow (the heuristic sparrow, for
nesting, as a Python package) packs them into a strip of height {peer_icons.STRIP:g} as short as it
can, with one thread and for {peer_icons.SECONDS} s by the clock; sizes are given, the strip's
length is what it seeks. Packwork fills the shorter of the rectangles that the peer needed, in the
same time, with turns of any angle (`sizes = "shared"`, `effort = "best"`, `time`): the rectangle is
given, the common size is what it seeks. So each does what it was made for, and density, the items'
area over the rectangle's, says the same of both. Overlap and what sticks out are shares of the
rectangle, by polygons, the worst of all seeds; the least gap is in canvas units of 600.""",
    ),
    "words": (
        "Words: wordcloud, d3-cloud",
        f"""A hundred words with weights 1 / rank^0.35, heights of letters in proportion, one in
four upright, no padding. Ink, gaps and L-nU by pixels at 1,200 px, as on the page of
[word clouds](words.md), which has more containers. wordcloud shrinks words that find no
place: "sizes off by" is the median distance of a word's height from its share; "scaling 1" is the
peer asked for proportion; in "sizes free" ours give way too (`--sizes free --size-ratio
{SIZE_RATIO:g}`). d3-cloud fills rectangles alone, takes sizes as they are given and leaves out what
finds no place; it was given the largest that place all words, found by halving, and the time is of
one run at that size, of the search not. Its overlap is by its own drawing; wordcloud says
none of words. Ours is by polygons.""",
    ),
    "circles": (
        "Circles round each other: d3-hierarchy, packcircles, circlify",
        f"""Density is the circles' area over that of the smallest circle round them all: `packwork
pile none CIRCLE... --compact` against front chains. Radii: equal, or lognormal with a spread of
0.5. The peers take no seed; ours ran with five. "Deepest" is how deep one lies in another at most,
in radii of the smaller. Stopped after {peer_circles.LIMIT:.0f} s.""",
    ),
    "apart": (
        "Items kept apart: Penrose",
        f"""Items of given sizes, {peer_penrose.SHARE:.0%} of a disc, none over another, none
outside. Penrose has a constraint for each pair, of polygons by their Minkowski difference; here
they are moved, not turned, in both. Polygons are hulls of icons, of {peer_penrose.CORNERS}
corners at most. Seconds are of the whole: compiling, which writes the constraints down, and
optimising. Stopped after {peer_penrose.LIMIT:.0f} s; the next larger were not tried.""",
    ),
    "raster": (
        "A soft rasteriser in PyTorch",
        f"""What one writes first (`benchmarks/peer_raster.py`): each item a sampled distance field,
its mask a sigmoid of it at every pixel, the density their sum, the derivative PyTorch's own, Adam;
the losses are ours without evenness. One thread each, on the processor. Time and memory grow with
items times pixels, ours with edges plus pixels. The runs are
{sum(peer_raster.EPOCHS.values())} epochs with the frozen icons in the round container, before a
finish. More than {peer_raster.BYTES // 2**30} GiB were not tried.""",
    ),
}


def _many(one: Manifest, key: str, form: str) -> str:
    values = [value for value in one.get(key, []) if value is not None]
    return ranged(values, form) if values else "-"


def _worst(one: Manifest, key: str) -> str:
    values = one.get(key)
    return "-" if values is None else f"{max(values):.1e}"


def _spent(one: Manifest) -> str:
    if "limit" in one:
        return f"stopped after {one['limit']:.0f} s"
    if "gib" in one:
        return f"not tried: about {one['gib']:.0f} GiB"
    return lasting(one["seconds"])


def _who(one: Manifest) -> list[str]:
    return [f"{one['program']} {one['version']}", one["task"], f"{one['count']:,}"]


def _icons(one: Manifest) -> list[str]:
    return [
        _who(one)[0], one["task"], _many(one, "density", ".3f"), _worst(one, "overlap"),
        _worst(one, "outside"), f"{min(one['gap']):.2g}", _many(one, "clock", ".1f"), _spent(one),
    ]  # fmt: skip


def _words(one: Manifest) -> list[str]:
    return [
        *_who(one), f"{one['placed'][0]:.0f}", _many(one, "ink", ".3f"),
        f"{100 * one['off'][0]:.2g} %", _many(one, "gap", ".1f"), _many(one, "LnU", ".1f"),
        _worst(one, "overlap"), _spent(one),
    ]  # fmt: skip


def _circles(one: Manifest) -> list[str]:
    return [*_who(one), _many(one, "density", ".3f"), _worst(one, "deepest"), _spent(one)]


def _apart(one: Manifest) -> list[str]:
    return [*_who(one), _worst(one, "overlap"), _worst(one, "outside"), _spent(one)]


def _raster(one: Manifest) -> list[str]:
    return [
        *_who(one), _many(one, "LC", ".3f"), _worst(one, "OO"), _worst(one, "EA"), _spent(one)
    ]  # fmt: skip


WHO = ["program", "task", "items"]
TABLES: dict[str, tuple[list[str], Callable[[Manifest], list[str]]]] = {
    "icons": (
        ["program", "turns", "density", "overlap", "outside", "least gap", "s by the clock",
         "time"],
        _icons,
    ),
    "words": (
        ["program", "container", "words", "placed", "ink", "sizes off by", "largest gap", "L-nU",
         "overlap", "time"],
        _words,
    ),
    "circles": (["program", "radii", "circles", "density", "deepest", "time"], _circles),
    "apart": ([*WHO, "overlap", "outside", "time"], _apart),
    "raster": ([*WHO, "LC", "OO", "EA", "time"], _raster),
}  # fmt: skip


def page(manifest: Manifest) -> str:
    """All sections that were measured."""
    return PAGE.format(
        sections="\n".join(
            _section(name, manifest["sections"][name])
            for name in TEXTS
            if name in manifest["sections"]
        ).rstrip()
    )


def _section(name: str, section: Manifest) -> str:
    title, text = TEXTS[name]
    header, cells = TABLES[name]
    runs = [one for one in section["runs"] if "missing" not in one]
    absent = [one for one in section["runs"] if "missing" in one]
    lines = [f"{one['program']}: not installed (`{one['missing']}`)." for one in absent]
    return SECTION.format(
        title=title, machine=section["machine"], date=section["date"], command=section["command"],
        text=text, table=markdown_table(header, sorted_rows(runs, cells)),
        missing="".join(f"\n{line}\n" for line in lines),
    )  # fmt: skip


def sorted_rows(runs: list[Manifest], cells: Callable[[Manifest], list[str]]) -> list[list[str]]:
    """Programs beside each other: by task, then by count, in the order of the first of each."""
    tasks = list(dict.fromkeys(one["task"] for one in runs))
    return [
        cells(one) for one in sorted(runs, key=lambda one: (tasks.index(one["task"]), one["count"]))
    ]


def median(one: Manifest, key: str = "seconds") -> float:
    """Of a figure's runs."""
    return float(np.median(one[key]))
