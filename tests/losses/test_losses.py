"""Image losses: each adjoint pixel by pixel, and the fused pass against their sum."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from numerics import assert_gradient
from packwork.arrays import Image
from packwork.errors import RecipeError
from packwork.losses.image import FUSED, SLACK, FusedAdjoint, FusedWeights
from packwork.losses.registry import LOSSES, find_loss
from packwork.losses.term import ImageLoss, Term
from strategies import SHAPES, generators

BUILT_IN = pytest.mark.parametrize("loss", LOSSES.values(), ids=LOSSES.keys())

# The paper's windows count pixels of the level, and see none that is not almost empty.
BY_SHARES = pytest.mark.parametrize(
    "loss", [loss for name, loss in LOSSES.items() if name != "paper-evenness"]
)
DTYPES = pytest.mark.parametrize("dtype", [np.float32, np.float64])


def _off_kinks(rng: np.random.Generator, shape: tuple[int, int]) -> Image:
    """Densities from 0 to 3, none near one, where covered turns into covered twice."""
    density = rng.uniform(0, 2.9, shape)
    return density + np.where(density > 0.9, 0.1, 0)


@BY_SHARES
def test_adjoint_is_the_derivative_by_each_pixel(loss: ImageLoss, rng: np.random.Generator) -> None:
    density, container = _off_kinks(rng, (7, 9)), rng.uniform(0, 1, (7, 9))
    assert_gradient(
        lambda image: loss(image, container).value, loss(density, container).adjoint, density
    )


@BUILT_IN
@DTYPES
def test_images_are_left_alone_and_keep_their_type(
    loss: ImageLoss, dtype: Any, rng: np.random.Generator
) -> None:
    density = _off_kinks(rng, (5, 4)).astype(dtype)
    container = rng.uniform(0, 1, (5, 4)).astype(dtype)
    before = density.copy(), container.copy()
    term = loss(density, container)
    assert term.adjoint.dtype == dtype
    assert term.adjoint.shape == density.shape
    np.testing.assert_array_equal(density, before[0])
    np.testing.assert_array_equal(container, before[1])


@BY_SHARES
def test_a_level_of_twice_the_resolution_agrees(loss: ImageLoss, rng: np.random.Generator) -> None:
    density, container = _off_kinks(rng, (5, 4)), rng.uniform(0, 1, (5, 4))
    finer = loss(np.kron(density, np.ones((2, 2))), np.kron(container, np.ones((2, 2))))
    assert finer.value == pytest.approx(loss(density, container).value)


def test_each_loss_has_the_sign_of_its_name() -> None:
    container = np.array([[1.0, 1.0, 0.0]])
    good, crowded, outside = (np.array([row]) for row in ([1.0, 1, 0], [2.0, 1, 0], [1.0, 1, 1]))
    assert LOSSES["containment"](good, container).value == 0
    assert LOSSES["containment"](outside, container).value == pytest.approx(1 / 3)
    assert LOSSES["overlap"](good, container).value == 0
    assert LOSSES["overlap"](crowded, container).value == pytest.approx(1 / 3)
    assert LOSSES["filling"](good, container).value == pytest.approx(-2 / 3)
    assert LOSSES["filling"](crowded, container).value == pytest.approx(-2 / 3)


def test_coincident_items_outside_are_still_pushed_back() -> None:
    """Unlike min(density, 1), whose derivative is zero there."""
    term = LOSSES["containment"](np.array([[5.0]]), np.array([[0.0]]))
    assert (term.value, term.adjoint.tolist()) == (5.0, [[1.0]])


def test_rounding_above_one_is_no_overlap() -> None:
    within = np.full((1, 1), 1 + SLACK / 2, dtype=np.float32)
    term = LOSSES["overlap"](within, np.ones_like(within))
    assert (term.value, float(term.adjoint[0, 0])) == (0.0, 0.0)


weights = st.floats(0, 100)

Weighed = dict[str, float]


@DTYPES
@given(
    rng=generators(),
    shape=SHAPES,
    weighed=st.fixed_dictionaries(dict.fromkeys(FUSED, weights)),
    scale=st.sampled_from([1, 40]),
)
def test_fused_passes_equal_the_weighted_sum(
    rng: np.random.Generator, shape: tuple[int, int], weighed: Weighed, scale: int, dtype: Any
) -> None:
    # Multiples of 1/64 add up exactly, so that both ways see the same density. Large
    # images are read in blocks, of which the last may be cut off.
    shape = (scale * shape[0] + 1, shape[1])
    density = (rng.integers(0, 192, shape) / 64).astype(dtype)
    container = rng.choice([0.0, 0.25, 1.0], shape).astype(dtype)
    accumulation = np.diff(density, axis=0, prepend=0, append=0).astype(dtype)
    adjoint = FusedAdjoint(container)(accumulation, FusedWeights(**weighed))
    apart = sum(weighed[name] * LOSSES[name](density, container).adjoint for name in FUSED)
    assert adjoint.dtype == dtype
    np.testing.assert_allclose(adjoint, apart * density.size, rtol=1e-4, atol=1e-2)
    assert not accumulation.any(), "the buffer must be empty for the next image"


@pytest.mark.parametrize("evenness", [0.0, 1.0])
def test_fused_pass_forgets_the_image_before(evenness: float) -> None:
    fused = FusedAdjoint(np.ones((2, 2)))
    weights_used = FusedWeights(1, 5, 2, evenness)
    first = fused(np.array([[3.0, 0.5], [0.0, 0.0], [-3.0, -0.5]]), weights_used).tolist()
    second = fused(np.zeros((3, 2)), weights_used).tolist()
    fresh = FusedAdjoint(np.ones((2, 2)))(np.zeros((3, 2)), weights_used).tolist()
    assert first[0][0] == 5.0
    assert second == fresh


OWN_LOSS = '''
import numpy as np
from packwork.losses.term import Term

def level(density, container):
    """Items should cover the container to one half everywhere."""
    miss = (density - 0.5) * container
    return Term(float(np.mean(miss**2)), 2 * miss * container / density.size)

answer = 42
'''


@pytest.fixture
def own_module(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """Name of a module of the user's own, on the path."""
    name = "a_loss_of_ones_own"
    (tmp_path / f"{name}.py").write_text(OWN_LOSS, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    return name


def test_a_loss_of_ones_own_works(own_module: str, rng: np.random.Generator) -> None:
    loss = find_loss(f"{own_module}:level")
    density, container = rng.uniform(0, 2, (4, 5)), rng.uniform(0, 1, (4, 5))
    term = loss(density, container)
    assert isinstance(term, Term)
    assert_gradient(lambda image: loss(image, container).value, term.adjoint, density)


def test_what_is_no_function_is_refused(own_module: str) -> None:
    with pytest.raises(RecipeError, match="is not a function"):
        find_loss(f"{own_module}:answer")


@pytest.mark.parametrize("name", LOSSES)
def test_built_in_losses_are_found(name: str) -> None:
    assert find_loss(name) is LOSSES[name]


@pytest.mark.parametrize(
    ("name", "problem"),
    [
        ("evenest", "no loss is called 'evenest'; use one of containment, overlap, filling"),
        ("", "no loss is called ''"),
        ("no_such_module_here:f", "module 'no_such_module_here' cannot be imported"),
        ("packwork.losses.term:nothing", "module 'packwork.losses.term' has no function"),
        ("packwork.losses.image:SLACK", "is not a function"),
        (":f", "module '' cannot be imported"),
        (".term:Term", "module '.term' cannot be imported"),
        ("packwork.losses.term:", "has no function ''"),
    ],
)
def test_bad_names_are_refused_in_one_line(name: str, problem: str) -> None:
    with pytest.raises(RecipeError, match=problem) as caught:
        find_loss(name)
    assert caught.value.key == "losses"
    assert "\n" not in str(caught.value)
