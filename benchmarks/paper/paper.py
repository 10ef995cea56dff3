"""The paper's evaluation, re-run: ``packwork bench paper [short] [resolution|evenness|cases]``.

"Image-Space Collage and Packing with Differentiable Rendering" (Wang and Lu, SIGGRAPH 2025): the
ablation of resolutions, that of evenness, and six cases of comparison. Words restrict what is run
again; the rest stays as it was. Writes manifests, the pages made of them and the pictures;
``short`` takes one seed and only prints, beside the pictures.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np

from benchmarks.kit import frozen
from benchmarks.kit.manifests import Manifest, stamp, write_manifest, write_text
from benchmarks.kit.measuring import machine, markdown_table, ranged
from benchmarks.kit.published import COMPARISONS, Comparison
from benchmarks.pages import overview
from benchmarks.paper import cases, resolution
from benchmarks.quality import evenness
from packwork import precompile, uses
from packwork.recipe import make_recipe

SEEDS = (0, 1, 2, 3, 4)
SECTIONS = ("cases", "evenness", "resolution")
ABLATED = "letter"
"""Container of the two pictures with evenness and without."""

HEADER = [
    "case", "of", "run", "items", "LC", "published", "ratio", "OO", "EA", "exact overlap",
    "least gap", "L-nU", "s",
]  # fmt: skip

PAGE = """# The paper's comparisons

Made by `{command}` on {date}.
{machine}.

Six cases, as "Image-Space Collage and Packing with Differentiable Rendering" (Wang and Lu, SIGGRAPH
2025) compares itself with others on them: words against ShapeWordle, icons against PAD,
photographs against ShapeCollage. Its ablations: [resolutions](resolution.md),
[evenness](evenness.md).

**The inputs are not the paper's**, whose data is not public in full. The containers are of the
same character: a flower and a leaf (outlines of bundled icons), the letter P of the bundled font,
Australia, a moon and a fish (bundled). The words are {words} of this gallery's, with weights
1 / rank^0.35, one in four upright; the icons {icons}, of the frozen set; the photographs {photos},
of half a megapixel, made up, with aspects from 2:3 to 3:2. How many items the paper's cases have is
not known to us. So "published" and "ratio" (ours over the middle of what is published) say in
which range a result lies, not that the same work was done better.

"packwork" is a run with the defaults, the exact finish included (words: no padding); "voids
filled" is the same with `--target-coverage 0.94`; "preset paper" is the paper's algorithm in our
renderer: its losses, weights and start, 200 epochs on 50+200+600 px, no finish. LC (of words:
their ink), OO, EA and L-nU are by pixels, shares of the container; exact overlap is by polygons
and the worst of the seeds, the least gap is in canvas units of 600. Seconds are the processor's,
all but writing. Medians, least and most in brackets, of {seeds} seeds ("voids filled": one).

{table}

Published: words' ink 0.28 to 0.29, ShapeWordle's 0.18 to 0.25; photographs 0.86 to 0.87 with an
overlap of 0.9e-4, ShapeCollage 0.67 with 4 %; PAD 0.91 to 0.94 with overlaps of 3 to 6 %. Of icons
by the paper's own method we know no coverage. All figures of others that these pages quote stand
in `benchmarks/kit/published.py`.

## Pictures

Seed 0; the container is yellow, items grey, overlap red, what sticks out blue.

{pictures}

## Evenness

The letter of the frozen set, 800 epochs, seed 0, before the finish: L-nU {without_LnU:.1f} without
the loss, {with_LnU:.1f} with it.

{ablated}
"""


def measure(seeds: Sequence[int]) -> Manifest:
    """The six cases, and what evenness looks like."""
    return {"seeds": len(seeds), "cases": cases.measure(seeds), "evenness": _evenness_pictures()}


def _evenness_pictures() -> Manifest:
    container = {make().name: make for make in frozen.CONTAINERS}[ABLATED]()
    found = {}
    for name, losses in {"without": {"evenness": 0.0}, "with": {}}.items():
        recipe = make_recipe(container=ABLATED, items=["icons"], finish="none", losses=losses)
        run = uses.fill(recipe, frozen.items(), container)
        found[name] = {**cases.draw(f"evenness {name}", run), "LnU": run.metrics.pixel.LnU}
    return found


def row(name: str, kind: str, setting: str, runs: list[Manifest]) -> list[str]:
    """A line of the table."""
    published = COMPARISONS[kind]

    def many(key: str, form: str) -> str:
        return ranged([run[key] for run in runs], form)

    coverage = float(np.median([run["LC"] for run in runs]))
    return [
        name, kind, setting, f"{runs[0]['items']:,}", many("LC", ".3f"), _said(published),
        _ratio(coverage, published), f"{max(run['OO'] for run in runs):.1e}",
        f"{max(run['EA'] for run in runs):.1e}", f"{max(run['overlap'] for run in runs):.1e}",
        f"{min(run['gap'] for run in runs):.2g}", many("LnU", ".1f"),
        f"{np.median([run['seconds'] for run in runs]):.1f}",
    ]  # fmt: skip


def _said(published: Comparison) -> str:
    return "not known" if published.coverage is None else "{} to {}".format(*published.coverage)


def _ratio(coverage: float, published: Comparison) -> str:
    return "-" if published.coverage is None else f"{coverage / np.mean(published.coverage):.2f}"


def page(manifest: Manifest) -> str:
    """docs/benchmarks/paper.md."""
    rows = [
        row(name, case["kind"], setting, runs)
        for name, case in manifest["cases"].items()
        for setting, runs in case["runs"].items()
    ]
    plain = [
        (name, case["pictures"]["packwork"]["file"]) for name, case in manifest["cases"].items()
    ]
    even = manifest["evenness"]
    return PAGE.format(
        command=manifest["command"],
        date=manifest["date"],
        machine=manifest["machine"],
        seeds=manifest["seeds"],
        words=cases.WORDS,
        icons=cases.ICONS,
        photos=cases.PHOTOS,
        table=markdown_table(HEADER, rows),
        pictures=_gallery(plain),
        without_LnU=even["without"]["LnU"],
        with_LnU=even["with"]["LnU"],
        ablated=_gallery([(name, even[name]["file"]) for name in ("without", "with")]),
    )


def _gallery(pictures: list[tuple[str, str]]) -> str:
    """Pictures three in a row, with their names."""
    lines = []
    for start in range(0, len(pictures), 3):
        some = pictures[start : start + 3]
        shown = [f'<img src="../{file}" width="260" alt="{name}"><br>{name}' for name, file in some]
        lines.append("| " + " | ".join(shown) + " |")
        if start == 0:
            lines.append("|" + " :---: |" * len(some))
    return "\n".join(lines)


def main(words: list[str]) -> None:
    """Measure, print, write manifests, pages and pictures."""
    sections = [name for name in SECTIONS if name in words] or list(SECTIONS)
    is_short = "short" in words
    print(machine(), flush=True)
    precompile.warm_up()
    if "cases" in sections:
        manifest = {**stamp(), **measure(SEEDS[:1] if is_short else SEEDS)}
        if is_short:
            print(page(manifest))
        else:
            write_text("paper.md", page(write_manifest("paper", manifest)))
    for module in (evenness, resolution):
        if module.__name__ in sections:
            module.main(["short"] if is_short else [])
    if not is_short:
        overview.write()


if __name__ == "__main__":
    main(sys.argv[1:])
