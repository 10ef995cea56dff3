"""What forces ask for is seen in the result, although the container is full."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import packwork as pw

SYLLABLES = "ri mo fo lu wi ga sto fe si ban".split()  # noqa: SIM905 - short to read
NAMES = [
    first + second + "n" * (k % 3) for k, first in enumerate(SYLLABLES) for second in SYLLABLES
]
STRENGTHS = "", " strength=10"
SEEDS = range(3)
WORDS = {name: 100 * (k + 1) ** -0.7 for k, name in enumerate(NAMES[::3])}


@cache
def _filled(force: str | None, sizes: str = "free", seed: int = 0) -> pw.Layout:
    layout = pw.fill(
        "circle", ["star", "heart"], count=24, force=force, sizes=sizes, effort="draft",
        levels="80", seed=seed,
    )  # fmt: skip
    assert layout.manifest["certified"]
    return layout


def _hearts(layout: pw.Layout) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """x, y and areas."""
    own = np.array([item.name == "heart" for item in layout.items])
    areas = np.array([outline.area for outline in layout.outlines])
    return layout.poses.x[own], layout.poses.y[own], areas[own]


def _mass_y(layout: pw.Layout) -> float:
    _, y, areas = _hearts(layout)
    return float(np.average(y, weights=areas) / layout.container.height)


def _spread(layout: pw.Layout) -> float:
    return float(_hearts(layout)[1].std())


def test_balance_brings_the_centre_of_mass_down() -> None:
    wanted = 0.8
    free, weak, strong = (
        np.median([abs(_mass_y(_filled(force, seed=seed)) - wanted) for seed in SEEDS])
        for force in (None, *(f"balance 50%,80% items=heart{much}" for much in STRENGTHS))
    )
    assert strong < weak < free
    assert strong < free / 2


def test_alignment_brings_items_into_a_row() -> None:
    free, weak, strong = (
        np.median([_spread(_filled(force, seed=seed)) for seed in SEEDS])
        for force in (None, *(f"align horizontal items=heart{much}" for much in STRENGTHS))
    )
    assert strong < weak < free
    assert strong < free / 2


def test_alignment_of_one_size_costs_little_of_it() -> None:
    free, aligned = (_filled(force, "shared") for force in (None, "align horizontal items=heart"))
    assert _spread(aligned) < _spread(free)
    assert aligned.metrics["LC"] > free.metrics["LC"] * 3 / 4


def test_heavy_words_gather_at_the_centre() -> None:
    found, inks = [], []
    for force in (None, "towards centre by=weight"):
        layout = pw.words("circle", WORDS, force=force, effort="draft", seed=1)
        middle = layout.container.width / 2
        far = np.hypot(layout.poses.x - middle, layout.poses.y - middle)
        found.append(float(np.average(far, weights=layout.weights)))
        inks.append(layout.metrics["LC_ink"])
        assert layout.manifest["certified"]
    assert found[1] < found[0]
    assert inks[1] > inks[0] * 3 / 4


def test_all_of_a_pile_come_into_the_row() -> None:
    layout = pw.pile(
        "none", ["heart"], count=12, size="7%",
        force=["towards centre", "align horizontal strength=20"],
    )  # fmt: skip
    assert len(layout.items) == 12
    assert np.ptp(layout.poses.y) < 0.1 * np.ptp(layout.poses.x)
    assert layout.poses.y.mean() == pytest.approx(layout.container.height / 2, rel=0.05)
