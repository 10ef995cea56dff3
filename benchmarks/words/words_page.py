"""docs/benchmarks/words.md, of its manifest."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from benchmarks.kit.manifests import Manifest
from benchmarks.kit.measuring import lasting, markdown_table, plainly
from benchmarks.words import examples_page
from benchmarks.words.clouds import CANVAS_PX, SIDE_PX, SIZE_RATIO, ZIPF
from benchmarks.words.drop_in import ROUNDS
from packwork.metrics.pixel import REACH

NONE = "-"

PAGE = """# Word clouds

Made by `packwork bench words`, a section at a time; each says when and on what. Weights are
1 / rank^{zipf:g}, heights of letters, and the font is the same for all, but where another thing is
said. Seconds are the processor's, on a machine that others use too. What the pictures look like:
[pairs](words-pairs.md). What `true` and `graded` mean: [words](../guide/words.md#true-or-graded).

{sections}
"""

SECTION = """## {title}

{machine}; {peer}{date}, `{command}`.

{text}

{body}
"""

TEXTS = {
    "fat": (
        "Five fat shapes",
        f""""ink" is the share of the container's pixels that is drawn on, at {SIDE_PX:,} px; "sizes
off by" the median distance of a word's height from its share, in percent of it. Ours keeps sizes
true unless another thing is said; "sizes graded" give way in the order of weights, as the peer's do
where words find no place, "sizes free" as it comes (`--sizes free --size-ratio
{SIZE_RATIO:g}`); "scaling 1" is the peer with `relative_scaling=1`, which asks for sizes in
proportion. The largest gap is the radius of the
largest empty disc and L-nU the mean squared distance from empty pixels to the nearest ink, both on
a canvas of {CANVAS_PX} px; "near a word" the share of the container that is within
{100 * REACH:g} % of its longer side from ink. Overlap and outside are exact areas of ours, shares
of the container; the peer writes pixels. Seconds take in reading and measuring.""",
    ),
    "thin": (
        "Ten thin or branched shapes",
        """A hundred words; ours with the default, `--sizes auto`, the peer with its defaults. A
bundled cat with a tail, islands and a snake, five bundled icons as logos, letters of thin strokes,
a tree that forks. Columns as above.""",
    ),
    "default": (
        "In place of the peer: the default cloud",
        f"""`WordCloud(width=400, height=200)` of 200 words with frequencies 1 / rank, generated
and drawn to an image by either package in turn, in one process, kernels compiled. "first" is the
first run of these words, "again" the median of the next {ROUNDS} with the least and the most: ours
remembers words of a process, the peer does not.""",
    ),
    "thousand": (
        "A thousand words",
        "Ours in a heart, both ways. Columns as above.",
    ),
    "examples": (
        "The peer's own examples",
        """Each of its source distribution, unchanged, by either package under the name
`wordcloud`, in turn in a process of its own; generating and drawing count, imports and reading do
not. "first" and "again" as above; ratios are ours over the peer's. "largest / median" is the
largest font size over the middle one; ink the share of the free pixels that is drawn on. Programs
that draw several clouds have one figure for each. Fonts are the example's own, or each package's
default: the peer's a thin one of fixed width, ours a black one, which has more ink; so "in our
font" is the peer's ink where ours is its default too.""",
    ),
}


def page(manifest: Manifest) -> str:
    """All sections that were measured."""
    sections = manifest["sections"]
    return PAGE.format(
        zipf=ZIPF,
        sections="\n".join(
            _section(name, sections[name]) for name in TEXTS if name in sections
        ).rstrip(),
    )


def _section(name: str, section: Manifest) -> str:
    title, text = TEXTS[name]
    peer = section.get("peer")
    return SECTION.format(
        title=title, machine=section["machine"], peer=f"wordcloud {peer}; " if peer else "",
        date=section["date"], command=section["command"], text=text, body=BODIES[name](section),
    )  # fmt: skip


HEADER = [
    "container", "words", "program", "placed", "ink", "sizes off by", "near a word", "largest gap",
    "L-nU", "overlap", "outside", "certified", "seconds",
]  # fmt: skip


def _row(one: Manifest) -> list[str]:
    return [
        one["container"], f"{one['words']:,}", one["program"], f"{one['placed']:,}",
        f"{one['ink']:.3f}", f"{100 * one['off']:.2g} %", f"{one['near']:.1%}", f"{one['gap']:.1f}",
        f"{one['LnU']:.1f}", _area(one["overlap"]), _area(one["outside"]),
        NONE if one["certified"] is None else "yes" if one["certified"] else "no",
        f"{one['seconds']:.1f}",
    ]  # fmt: skip


def _area(value: float | None) -> str:
    return NONE if value is None else f"{value:.0e}"


def _table(section: Manifest) -> str:
    return markdown_table(HEADER, [_row(one) for one in section["rows"]])


def _fat(section: Manifest) -> str:
    return "\n\n".join([_table(section), *gaps_said(section["rows"])])


def gaps_said(rows: Sequence[Manifest]) -> Iterator[str]:
    """In how many rows our largest gap is below the peer's."""
    peers = {_place(one): one["gap"] for one in rows if one["program"] == "wordcloud"}
    for program in dict.fromkeys(one["program"] for one in rows):
        if program.startswith("wordcloud"):
            continue
        own = {_place(one): one["gap"] for one in rows if one["program"] == program}
        both = own.keys() & peers.keys()
        below = sum(own[place] < peers[place] for place in both)
        if both:
            yield f"Largest gap of {program}: below the peer's in {below} of {len(both)}."


def _place(one: Manifest) -> tuple[str, int]:
    return one["container"], one["words"]


def _thin(section: Manifest) -> str:
    lines = [_table(section)]
    for program in dict.fromkeys(one["program"] for one in section["rows"]):
        own = [one for one in section["rows"] if one["program"] == program]
        ink, near = ([one[key] for one in own] for key in ("ink", "near"))
        lines.append(
            f"Of {program}: ink {min(ink):.2f} to {max(ink):.2f}, near a word {min(near):.1%} to "
            f"{max(near):.1%}, {np.median([one['seconds'] for one in own]):.1f} s in the middle."
        )
    return "\n\n".join(lines)


def _default(section: Manifest) -> str:
    peer, own = (section["runs"][name] for name in ("wordcloud", "packwork"))
    rows = [
        [name, f"{one['placed']}", lasting([one["first"]]), lasting(one["again"])]
        for name, one in section["runs"].items()
    ]
    ratios = [np.median(own[key]) / np.median(peer[key]) for key in ("first", "again")]
    rows.append(["ours / the peer's", "", *(plainly(float(ratio)) for ratio in ratios)])
    return markdown_table(["program", "words placed", "first", "again"], rows)


BODIES: dict[str, Callable[[Manifest], str]] = {
    "fat": _fat, "thin": _thin, "default": _default, "thousand": _table,
    "examples": examples_page.body,
}  # fmt: skip
