"""The paper's own forms: what they count and what they leave alone."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from numerics import assert_gradient
from packwork.losses.registry import OUTSIDE, WINDOWS_PX, paper_containment, paper_evenness


def test_an_error_outside_costs_a_hundred_times_one_inside() -> None:
    container = np.array([[1.0, 0.0]])
    bare = paper_containment(np.array([[0.0, 0.0]]), container).value
    spilt = paper_containment(np.array([[1.0, 1.0]]), container).value
    assert (bare, spilt) == (0.5, OUTSIDE / 2)


def test_twice_covered_inside_is_no_error_of_containment() -> None:
    assert paper_containment(np.array([[3.0]]), np.array([[1.0]])).value == 0


def test_only_windows_that_are_wholly_empty_count(rng: np.random.Generator) -> None:
    container = np.ones((40, 40))
    density = np.ones((40, 40))
    density[10:15, 10:15] = 0
    term = paper_evenness(density, container)
    assert term.value == pytest.approx(1 / 1_600)
    inside = np.zeros((40, 40), dtype=bool)
    inside[10:15, 10:15] = True
    assert (term.adjoint[inside] < 0).all()
    assert (term.adjoint[~inside] == 0).all()
    density[12, 12] = 0.5
    assert paper_evenness(density, container).value == 0


def test_derivative_where_windows_are_almost_empty(rng: np.random.Generator) -> None:
    density, container = rng.uniform(1e-5, 5e-4, (13, 14)), np.ones((13, 14))
    term = paper_evenness(density, container)
    assert_gradient(
        lambda image: paper_evenness(image, container).value, term.adjoint, density, step=1e-6
    )


def test_larger_gaps_are_seen_by_more_windows() -> None:
    container = np.ones((80, 80))
    values = []
    for size in WINDOWS_PX:
        density = np.ones((80, 80))
        density[10 : 10 + size, 10 : 10 + size] = 0
        values.append(paper_evenness(density, container).value)
    assert all(later > earlier for earlier, later in itertools.pairwise(values))
