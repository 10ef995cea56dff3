"""docs/benchmarks/scaling.md and its plots, of their manifest."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from benchmarks.kit.manifests import DOCS, Manifest
from benchmarks.kit.measuring import lasting, markdown_table, ranged

PICTURES = DOCS / "pictures"
MANY = 100
"""Items from which the growth of time is told."""

STAGES = ("read", "start", "levels", "finish", "measure")
INK = "#22304f"
COLOURS = {"read": "#b8c4cc", "start": "#8fb48c", "levels": "#e9b341", "finish": "#ee6c4d",
           "measure": "#7b3b5e"}  # fmt: skip

PAGE = """# Scaling

Made by `packwork bench scaling`, a section at a time; each says when and on what. Containers are
round, but for the bear; icons are the frozen set's in turn. Seconds are the processor's, reading
and measuring taken in, writing not; medians, least and most in brackets.

{sections}
"""

SECTION = """## {title}

{machine}, {cores} cores; {date}, `{command}`.

{text}
"""

BEAR = """`packwork fill bear -n 100`, five seeds: {bear} s."""

BEGIN = """By the clock, from the command to its end, in turn; without the first round, in which
Python compiles its files.

{table}"""

ITEMS = """Every run is a process of its own, with the defaults: 800 epochs on levels to 600 px
(finer where items are many), then the exact finish. The peak of memory is what the system says of
the process, of which {before:.0f} MiB are Python, the packages and the compiled kernels, before the
run begins. Time grows as the number of items to the power {power:.2f} from {low:,} to {high:,}. The
shares are of the time by the clock.

![time and memory by the number of items](../pictures/scaling-items.svg)

{table}

![share of each stage by the number of items](../pictures/scaling-stages.svg)"""

PX = """100 items, {epochs} epochs all at one resolution, no finish; a process each.

![time and memory by pixels](../pictures/scaling-px.svg)

{table}"""

FLOOR = """An epoch of 100 icons must at the least move {bytes} bytes a pixel: the buffer that edges
deposit in is read and cleared, the container read, the adjoint written, in float32; evenness adds a
pass, which reads half as much again. "Floor" is the time that a copy takes for as many bytes on an
image of the same size, in turn with the epochs. The edges come on top; their work grows with the
pixels' root, so that the ratio falls as images grow.

{table}"""

CORES = """A run uses one core, but for the reading of photographs. As many runs at once as there
are cores, of 100 items with the defaults, the start of Python taken in:

{table}"""


def page(manifest: Manifest) -> str:
    """docs/benchmarks/scaling.md."""
    sections = manifest["sections"]
    return PAGE.format(
        sections="\n".join(
            SECTION.format(
                title=title, machine=sections[name]["machine"], cores=sections[name]["cores"],
                date=sections[name]["date"], command=sections[name]["command"],
                text=text(manifest, sections[name]["found"]),
            )
            for name, (title, text) in TEXTS.items() if name in sections
        ).rstrip()
    )  # fmt: skip


def _bear_text(manifest: Manifest, found: list[float]) -> str:
    del manifest
    return BEAR.format(bear=ranged(found, ".1f"))


def _begin_text(manifest: Manifest, found: dict[str, list[float]]) -> str:
    del manifest
    rows = [[f"`{name}`" if "packwork" in name else name, lasting(taken)]
            for name, taken in found.items()]  # fmt: skip
    return BEGIN.format(table=markdown_table(["what", "takes"], rows))


def _items_text(manifest: Manifest, found: Manifest) -> str:
    del manifest
    many = [count for count in map(int, found) if count >= MANY]
    times = [_median(found[str(count)], "seconds") for count in many]
    power = np.polyfit(np.log(many), np.log(times), 1)[0] if len(many) > 1 else float("nan")
    header = ["items", "runs", "s", "peak, MiB", "LC", "certified", *STAGES]
    return ITEMS.format(
        before=np.median([run["before_mib"] for runs in found.values() for run in runs]),
        power=power,
        low=min(many, default=0),
        high=max(many, default=0),
        table=markdown_table(header, [_row(count, runs, STAGES) for count, runs in found.items()]),
    )


def _px_text(manifest: Manifest, found: Manifest) -> str:
    stages = ("start", "levels", "measure")
    rows = [_row(side, runs, stages) for side, runs in found.items()]
    table = markdown_table(["px", "runs", "s", "peak, MiB", *stages], rows)
    return PX.format(epochs=manifest["epochs"], table=table)


def _floor_text(manifest: Manifest, found: list[Manifest]) -> str:
    header = ["px", "epoch, ms", "with evenness, ms", "floor, ms", "epoch over floor",
              "with evenness over its floor"]  # fmt: skip
    table = markdown_table(header, [_floor_row(one) for one in found])
    return FLOOR.format(bytes=manifest["bytes_a_pixel"], table=table)


def _cores_text(manifest: Manifest, found: Manifest) -> str:
    del manifest
    rows = [
        [workers, f"{one['runs_a_minute']:.1f}", ranged(one["seconds"], ".1f")]
        for workers, one in found.items()
    ]
    return CORES.format(table=markdown_table(["runs at once", "runs a minute", "s of a run"], rows))


TEXTS: dict[str, tuple[str, Callable[[Manifest, Any], str]]] = {
    "bear": ("A bear of a hundred icons", _bear_text),
    "begin": ("Before anything is placed", _begin_text),
    "items": ("Items", _items_text),
    "px": ("Pixels", _px_text),
    "floor": ("The floor", _floor_text),
    "cores": ("Cores", _cores_text),
}


def _row(name: str, runs: list[Manifest], stages: tuple[str, ...]) -> list[str]:
    cells = [
        f"{int(name):,}", str(len(runs)), ranged([run["seconds"] for run in runs], ".2f"),
        f"{_median(runs, 'peak_mib'):.0f}",
    ]  # fmt: skip
    if "finish" in stages:
        certified = sum(run["certified"] for run in runs)
        cells += [f"{_median(runs, 'LC'):.3f}", f"{certified} of {len(runs)}"]
    return [*cells, *(f"{share:.0%}" for share in _shares(runs, stages))]


def _shares(runs: list[Manifest], stages: tuple[str, ...]) -> list[float]:
    """Of the time by the clock that each stage takes."""
    totals = [sum(run["stages"].values()) for run in runs]
    return [
        float(np.median([run["stages"].get(stage, 0.0) / total
                         for run, total in zip(runs, totals, strict=True)]))
        for stage in stages
    ]  # fmt: skip


def _floor_row(one: Manifest) -> list[str]:
    even = one["floor_ms"] * 1.5
    return [
        f"{one['px']:,}", f"{one['epoch_ms']:.3g}", f"{one['evenness_ms']:.3g}",
        f"{one['floor_ms']:.3g}", f"{one['epoch_ms'] / one['floor_ms']:.1f}",
        f"{one['evenness_ms'] / even:.1f}",
    ]  # fmt: skip


def _median(runs: list[Manifest], key: str) -> float:
    return float(np.median([run[key] for run in runs]))


def draw(manifest: Manifest) -> None:
    """Write the plots."""
    import matplotlib as mpl

    mpl.use("svg")
    import matplotlib.pyplot as plt

    plt.rcParams.update(
        {"svg.fonttype": "none", "svg.hashsalt": "packwork", "font.size": 10,
         "font.family": "sans-serif", "axes.spines.top": False, "axes.spines.right": False,
         "axes.edgecolor": INK, "axes.labelcolor": INK, "xtick.color": INK, "ytick.color": INK}
    )  # fmt: skip
    sections = manifest["sections"]
    for key, label in (("items", "items"), ("px", "pixels on the longer side")):
        if key not in sections:
            continue
        figure, (left, right) = plt.subplots(1, 2, figsize=(8, 3.2), layout="constrained")
        numbers = [int(name) for name in sections[key]["found"]]
        for axes, of, said in ((left, "seconds", "seconds"), (right, "peak_mib", "peak, MiB")):
            values = [_median(runs, of) for runs in sections[key]["found"].values()]
            axes.plot(numbers, values, "o-", color=INK, markersize=4)
            axes.set(xlabel=label, ylabel=said, xscale="log")
            axes.set_xticks(numbers, [f"{number:,}" for number in numbers], fontsize=8)
            axes.minorticks_off()
            axes.grid(which="major", color="#e4e8ec", linewidth=0.8)
        left.set_yscale("log")
        left.yaxis.set_major_formatter("{x:g}")
        right.set_ylim(0, None)
        _save(figure, f"scaling-{key}.svg")
    if "items" in sections:
        _save(_stages_plot(plt, sections["items"]["found"]), "scaling-stages.svg")


def _stages_plot(plt: Any, items: dict[str, list[Manifest]]) -> Any:
    figure, axes = plt.subplots(figsize=(8, 2.8), layout="constrained")
    names = [f"{int(count):,}" for count in items]
    shares = np.array([_shares(runs, STAGES) for runs in items.values()])
    left = np.zeros(len(names))
    for stage, column in zip(STAGES, shares.T, strict=True):
        axes.barh(names, column, left=left, color=COLOURS[stage], label=stage, height=0.7)
        left += column
    axes.invert_yaxis()
    axes.set(xlabel="share of the time", ylabel="items", xlim=(0, 1))
    axes.xaxis.set_major_formatter(lambda share, _: f"{share:.0%}")
    figure.legend(loc="outside upper center", ncols=len(STAGES), frameon=False)
    return figure


def _save(figure: Any, name: str) -> None:
    PICTURES.mkdir(exist_ok=True)
    figure.savefig(PICTURES / name, metadata={"Date": None})
    print(f"wrote {PICTURES / name}", flush=True)
