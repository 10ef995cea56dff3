"""Tables with bad rows, the best of several seeds, and series of clouds."""

from __future__ import annotations

import csv
import json
import math
import sys
import time
from pathlib import Path

import numpy as np

import packwork as pw
from benchmarks.batch.wall import line, made, tiny

Row = list[str]

STEPS, WORDS, POOL = 24, 100, 160
"""Steps of the series, words of each, and words there are."""


def bad_rows(home: Path, rows: int, makes: int) -> list[Row]:
    """A dry run of a long table in which every twentieth row is bad, and a run of a shorter one."""
    dry = made(line(tiny(home / "dry", rows, 20), "out", "--dry-run"))
    last = next(one for one in dry.said.splitlines() if "to make" in one)
    report = home / "report.csv"
    options = ("-q", "--workers", "2", "--report", str(report))
    real = made(line(tiny(home / "real", makes, 20), "out", *options))
    files = len(list((home / "real" / "out").glob("*.svg")))
    with report.open(newline="") as stream:
        named = sum(row["status"] == "failed" for row in csv.DictReader(stream))
    return [
        [
            f"a dry run of {rows:,} rows, every twentieth bad",
            f"exit code {dry.code}: {last}; {dry.seconds:.1f} s, {dry.peaks[0]:.0f} MB",
            "9,500 and 500 of 10,000; under 1 GB",
        ],
        [
            f"{makes:,} tiny posters made, every twentieth bad",
            f"exit code {real.code}: {files:,} made, {named:,} named in the report;"
            f" {real.seconds:.0f} s, all processes {sum(real.peaks):.0f} MB at their fullest",
            "as above",
        ],
    ]


def best_of(home: Path) -> list[Row]:
    """The best of eight bears of a hundred icons beside one of them."""
    line = [sys.executable, "-m", "packwork", "fill", "builtin:bear", "-n", "100", "-q", "-o"]
    home.mkdir(parents=True, exist_ok=True)
    out = str(home / "bear.svg")
    made([*line, out])
    alone, single = [], []
    for seed in range(8):
        report = home / f"{seed}.json"
        run = made([*line, out, "--seed", str(seed), "--report", str(report), "--threads", "1"])
        single.append(json.loads(report.read_text(encoding="utf-8"))["metrics"]["exact"]["LC"])
        alone.append(run.seconds)
    report = home / "best.json"
    best = made([*line, out, "--best-of", "8", "--report", str(report)])
    found = json.loads(report.read_text(encoding="utf-8"))["metrics"]["exact"]["LC"]
    one = float(np.median(alone))
    return [
        [
            "`--best-of 8` of a bear of 100 icons, over one run",
            f"{best.seconds / one:.2f} x: {best.seconds:.1f} s and {one:.1f} s of one thread;"
            f" covered {found:.4f}, of all eight {np.mean(single):.4f}"
            f" ({min(single):.4f} to {max(single):.4f}): {found - np.mean(single):+.4f}",
            "4.5 x; +.01",
        ]
    ]


def series() -> list[Row]:
    """Clouds of words whose shares wander from step to step, beside clouds made singly."""
    weights = wandering()
    began = time.perf_counter()
    found = pw.series("circle", weights, weight_is="area", seed=1)
    seconds = time.perf_counter() - began
    sizes, inks = [], []
    for label, layout in zip(found.labels, found.layouts, strict=True):
        true = [math.sqrt(weights[label][item.name]) for item in layout.items]
        sizes += (layout.poses.scale / true).tolist()
        alone = pw.words("circle", weights[label], weight_is="area", seed=1)
        inks.append(layout.metrics["LC_ink"] / alone.metrics["LC_ink"])
    moved = found.report["moved"]
    certified = sum(layout.certified for layout in found.layouts)
    return [
        [
            f"a series of {STEPS} steps of {WORDS} words, in {seconds:.0f} s",
            f"{certified} steps certified, {len(sizes):,} of {STEPS * WORDS:,} words set; sizes"
            f" true to {100 * (max(sizes) / min(sizes) - 1):.4f} %; median move"
            f" {100 * moved['median']:.2f} % of the diagonal (of the step that moves most"
            f" {100 * max(moved['medians']):.2f} %)",
            "all certified; .1 %; 5 %",
        ],
        [
            "its ink over that of clouds made singly",
            f"mean {np.mean(inks):.2f}, {min(inks):.2f} to {max(inks):.2f}",
            ".9",
        ],
    ]


def wandering() -> dict[str, dict[str, float]]:
    """Weights by word by step: lognormal, each a walk of its own; as much area in each step."""
    rng = np.random.default_rng(4)
    letters = "aeiou", "bcdfghklmnprstvw"
    words: list[str] = []
    while len(words) < POOL:
        made = "".join(letters[(k + 1) % 2][rng.integers(len(letters[(k + 1) % 2]))]
                       for k in range(int(rng.integers(3, 9))))  # fmt: skip
        words += [made] if made not in words else []
    logs = rng.normal(0.0, 0.9, POOL)
    steps = {}
    for step in range(STEPS):
        logs += rng.normal(0.0, 0.15, POOL)
        top = np.argsort(-logs)[:WORDS]
        whole = sum(math.exp(logs[k]) * len(words[k]) for k in top)
        steps[f"{step + 1:02}"] = {words[k]: float(math.exp(logs[k]) / whole) for k in top}
    return steps
