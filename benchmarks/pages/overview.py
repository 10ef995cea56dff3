"""docs/benchmarks/README.md: ours, the paper's and the peers' side by side, of all manifests."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from benchmarks.kit.manifests import Manifest, known, write_text
from benchmarks.kit.measuring import lasting, markdown_table, plainly
from benchmarks.kit.published import (
    COMPARISONS,
    MINKOWSKI_COUNT,
    PAD_MINUTES,
    PAPER_MINUTES,
    RESOLUTIONS,
    Comparison,
)
from benchmarks.kit.runs import LC as LC_AT
from benchmarks.kit.runs import LNU, SECONDS

HEADER = ["work", "measure", "ours", "the paper's", "peer", "ours / paper", "ours / peer"]
PEERS_HEADER = [
    "work", "peer", "ours", "the peer's", "ours / peer", "time, ours", "the peer's", "ours / peer",
]  # fmt: skip
NONE = "-"

PAGE = """# Benchmarks

Ours, the paper's and the peers' side by side. Every figure of ours and of the peers' was measured
by us and stands in a manifest that a command wrote, with what it was measured on; the pages are
made of those (`packwork bench pages`), and the list below leads to both. The paper is
"Image-Space Collage and Packing with Differentiable Rendering" (Wang and Lu, SIGGRAPH 2025); its
figures, and those of ShapeWordle, PAD and ShapeCollage, are of its own inputs, which are not
public in full, on hardware that it does not name. **A ratio to them says in which range we are,
not that the same work was done**; how the inputs differ is on [the page of its
comparisons](paper.md). Ratios to peers are of the same work in the same run. A dash:
not measured, or not known.

{pictures}

## The paper

{table}

One of the paper's timed examples, of icons, took {pad} minutes where PAD took {late}; in
another, of about {minkowski} elements, it is set against penalties by Minkowski sums, which Penrose
has: the rows "kept apart".

## Peers

Medians; [the page of peers](peers.md) has the spread, versions, time-outs and what each
was asked for. Of words the row shows the best of ours whose sizes are at least as true as the
peer's, which shrinks what finds no place. {missing}

{peers}

{weak}

## All pages

{pages}

Commands: `packwork bench paper`, `packwork bench peers`, `packwork bench scaling`, and so on by
their names, in a clone with `pip install -e '.[bench]'`; each says on its page how it was run.
"""

PAGES = {
    "paper": "the paper's six comparisons",
    "resolution": "constant resolutions against hierarchies",
    "evenness": "what the loss against large gaps is worth",
    "peers": "nesting, word clouds, circles, constraints, autodiff: the same work",
    "nesting": "strip packing instances beside spyrrow",
    "scaling": "10 to 10,000 items, 50 to 4,000 px, stages, floor, cores",
    "batch": "rates by workers and a cluster, crashes, tables with bad rows, series",
    "speed": "whole runs beside an earlier version, by stage, a first run, memory",
    "engine": "milliseconds per stage, the frozen set",
    "colour": "the colour image beside the density, what a loss of colours does",
    "quality": "before the exact finish and after, voids filled, many items",
    "words": "word clouds in fat and thin shapes, in the peer's own examples",
    "photos": "photographs, and a poster's memory",
    "mosaics": "photographs on a grid that show a face, beside a program for that",
    "forces": "piles, round packs, stable words",
    "parts": "containers of several parts",
    "outlines": "outlines as a few curves",
    "tiles": "seamless tiles beside a page with walls, random ones, their seams",
    "charts": "unit charts: areas true to the data",
    "files": "drawings from anywhere, and what is written",
    "films": "recording and writing films",
    "live": "frames, settles and what becomes of a layout over random gestures",
    "studio": "frames, answers, crashes and memory of the page in a browser",
    "robustness": "spoilt files, stops at any moment, full disks",
}
"""By the end of the page's name."""


WEAK = "Where a peer comes out ahead in what its row shows:"


def write() -> None:
    """docs/benchmarks/README.md, of what there is."""
    write_text("README.md", page(known()))


def page(manifests: dict[str, Manifest]) -> str:
    peers = manifests.get("peers")
    rows = [
        *_paper_rows(manifests.get("paper")),
        *_ablation_rows(manifests.get("resolution"), manifests.get("evenness")),
        *_timed_rows(manifests),
    ]
    return PAGE.format(
        table=markdown_table(HEADER, rows),
        peers=markdown_table(PEERS_HEADER, list(_peer_rows(peers))),
        missing=_missing(peers),
        minkowski=MINKOWSKI_COUNT,
        pad=PAPER_MINUTES,
        late=PAD_MINUTES,
        pictures=_pictures(manifests.get("paper")),
        weak=_weak(peers),
        pages="\n".join(
            f"- [{name}]({name}.md): {said}{_source(name, manifests)}"
            for name, said in PAGES.items()
        ),
    )


def _source(name: str, manifests: dict[str, Manifest]) -> str:
    """Where a page's figures are, as a link."""
    return f" ([manifest](../manifests/{name}.json))" if name in manifests else ""


def _median(values: list[float]) -> float:
    return float(np.median(values))


def _row(
    work: str,
    measure: str,
    form: str,
    ours: float,
    paper: float | tuple[float, float] | None,
    peer: tuple[str, float | tuple[float, float]] | None,
) -> list[str]:
    """A line, its ratios by the middle of a range."""

    def said(value: float | tuple[float, float]) -> str:
        low, high = (value, value) if isinstance(value, float) else value
        return f"{low:{form}}" if low == high else f"{low:{form}} to {high:{form}}"

    def ratio(value: float | tuple[float, float] | None) -> str:
        return NONE if value is None else f"{ours / np.mean(value):.3g}"

    return [
        work, measure, said(ours), NONE if paper is None else said(paper),
        NONE if peer is None else f"{peer[0]} {said(peer[1])}",
        ratio(paper), ratio(None if peer is None else peer[1]),
    ]  # fmt: skip


def _paper_rows(paper: Manifest | None) -> Iterator[list[str]]:
    """Coverages, with the overlaps that they were paid with."""
    for name, case in (paper or {"cases": {}})["cases"].items():
        published = COMPARISONS[case["kind"]]
        measure = "ink" if case["kind"] == "words" else "LC"
        for setting, runs in case["runs"].items():
            work = f"{case['kind']}, {name}" + ("" if setting == "packwork" else f", {setting}")
            peer = (f"{published.peer} (published)", published.peer_coverage)
            ours = _median([run["LC"] for run in runs])
            row = _row(work, f"{measure}, overlap", ".2f", ours, published.coverage, peer)
            overlap = _median([run["overlap"] for run in runs])
            row[2] += f", {overlap:.1e}" if overlap else ", 0"
            row[3] += "" if published.overlap is None else f", {published.overlap:.1e}"
            row[4] += _their_overlap(published)
            yield row


def _their_overlap(published: Comparison) -> str:
    if published.peer_overlap is None:
        return ""
    low, high = published.peer_overlap
    return f", {low:.0%}" if low == high else f", {low:.0%} to {high:.0%}"


def _ablation_rows(resolution: Manifest | None, evenness: Manifest | None) -> Iterator[list[str]]:
    for levels, of in (resolution or {"levels": {}})["levels"].items():
        if levels not in ("600", "50,200,600"):
            continue
        for preset, runs in of.items():
            work = f"200 epochs on {levels.replace(',', '+')} px, preset `{preset}`"
            published = RESOLUTIONS[levels]
            ours = _median([one[LC_AT] for one in runs])
            yield _row(work, "LC", ".3f", ours, float(published.LC) / 100, None)
            ours = _median([one[SECONDS] for one in runs])
            yield _row(work, "s", ".3g", ours, float(published.seconds), None)
    for title, taken in (evenness or {"settings": {}})["settings"].items():
        without, including = (np.array(taken[key])[-1, :, LNU] for key in ("without", "with"))
        work = f"evenness, {title}"
        fall = _median((1 - including / without).tolist())
        yield [work, "L-nU with, without", f"{np.median(including):.1f}, {np.median(without):.1f}"
               f" ({fall:.0%} less)", NONE, NONE, NONE, NONE]  # fmt: skip


def _timed_rows(manifests: dict[str, Manifest]) -> Iterator[list[str]]:
    """The paper's two timed examples."""
    paper, peers = manifests.get("paper"), manifests.get("peers")
    for name, case in (paper or {"cases": {}})["cases"].items():
        for setting, runs in case["runs"].items():
            if case["kind"] == "icons" and setting != "preset paper":
                ours = _median([run["seconds"] for run in runs])
                yield _row(
                    f"icons, {name}, {runs[0]['items']} items (the paper's count not known)",
                    "s", ".0f", ours, 60.0 * PAPER_MINUTES,
                    ("PAD (published)", 60.0 * PAD_MINUTES),
                )  # fmt: skip
    for one in _runs(peers, "apart"):
        if one["program"] == "Penrose" and "limit" in one:
            mine = [
                other for other in _runs(peers, "apart")
                if other["program"] == "packwork" and other["task"] == one["task"]
                and other["count"] >= one["count"]
            ]  # fmt: skip
            if mine:
                first = min(mine, key=lambda other: other["count"])
                ours = _median(first["seconds"])
                yield [
                    f"{one['task']} kept apart, {first['count']} items", "s", f"{ours:.2g}", NONE,
                    f"Penrose: stopped after {one['limit']:.0f} s at {one['count']} items", NONE,
                    f"under {ours / one['limit']:.2g}",
                ]  # fmt: skip


def _missing(peers: Manifest | None) -> str:
    names = [
        one["program"]
        for section in (peers or {"sections": {}})["sections"].values()
        for one in section["runs"]
        if "missing" in one
    ]
    return f"Not installed: {', '.join(names)}." if names else "All of them were installed."


def _runs(peers: Manifest | None, section: str) -> list[Manifest]:
    found = (peers or {"sections": {}})["sections"].get(section, {"runs": []})["runs"]
    return [one for one in found if "missing" not in one]


SHOWN = {
    "words": ("ink", ".3f"),
    "circles": ("density", ".3f"),
    "icons": ("density", ".3f"),
    "apart": ("overlap", ".1e"),
    "raster": ("LC", ".3f"),
}
"""The figure of each section of peers that stands in the overview."""

OURS = "packwork"

LEAST = 20
"""Items from which a peer's work stands in the overview."""


def _peer_rows(peers: Manifest | None) -> Iterator[list[str]]:
    """Each peer beside ours, at the same task and count."""
    for section in SHOWN:
        for one, own in _pairs(peers, section):
            if one["count"] >= LEAST:
                yield _peer_row(section, one, own)


def _pairs(peers: Manifest | None, section: str) -> Iterator[tuple[Manifest, Manifest]]:
    """A peer's work that came to an end, and ours: the best whose sizes are at least as true.

    Where none is, ours whose sizes are the truest.
    """
    runs = [one for one in _runs(peers, section) if "seconds" in one]
    key, _ = SHOWN[section]
    for one in runs:
        alike = [own for own in runs if _is_alike(one, own, section)]
        as_true = [own for own in alike if _off(own) <= _off(one)]
        if as_true:
            best = min if key == "overlap" else max
            yield one, best(as_true, key=lambda own: _median(own.get(key, [0.0])))
        elif alike:
            yield one, min(alike, key=_off)


def _off(one: Manifest) -> float:
    """How far sizes are off; 0 where they are given."""
    return _median(one.get("off", [0.0]))


def _is_alike(one: Manifest, own: Manifest, section: str) -> bool:
    """Whether ``own`` is ours, of the same work as a peer's."""
    is_ours = own["program"].startswith(OURS) and not one["program"].startswith(OURS)
    # In a rectangle ours turns by any angle, whatever the peer does.
    is_same = one["task"] == own["task"] or section == "icons"
    return is_ours and is_same and one["count"] == own["count"]


def _peer_row(section: str, one: Manifest, own: Manifest) -> list[str]:
    key, form = SHOWN[section]
    cells = [NONE] * 3
    if key in one:
        theirs, ours = _median(one[key]), _median(own[key])
        ratio = f"{ours / theirs:.2f}" if theirs and key != "overlap" else NONE
        cells = [f"{key} {ours:{form}}", f"{theirs:{form}}", ratio]
    if "off" in one:
        cells[:2] = [
            f"{cell}, sizes off by {_median(made['off']):.0%}"
            for cell, made in zip(cells, (own, one), strict=False)
        ]
    theirs, ours = _median(one["seconds"]), _median(own["seconds"])
    return [
        f"{section}: {one['task']}, {one['count']:,}", f"{one['program']} {one['version']}",
        *cells, lasting([ours]), lasting([theirs]), plainly(ours / theirs),
    ]  # fmt: skip


def _weak(peers: Manifest | None) -> str:
    """Where a peer of the same work does better by what it is measured by."""
    found = [
        f"- {one['program']} in {section}, {one['task']}, {one['count']:,} items ({key} "
        f"{_median(one[key]):.3f}, ours {_median(own[key]):.3f})"
        for section, (key, _) in SHOWN.items()
        if key != "overlap"
        for one, own in _pairs(peers, section)
        if key in one and _median(one[key]) > _median(own[key])
    ]
    if not found:
        return "No peer comes out ahead in what its row shows; in time several do, see there."
    return "\n".join([WEAK, "", *found])


def _pictures(paper: Manifest | None) -> str:
    if paper is None:
        return ""
    cells = [
        f'<img src="../{case["pictures"]["packwork"]["file"]}" width="130" alt="{name}">'
        for name, case in paper["cases"].items()
    ]
    return "\n".join(["| " + " | ".join(cells) + " |", "|" + " :---: |" * len(cells)])
