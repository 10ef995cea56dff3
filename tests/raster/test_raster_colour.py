"""The colour image against its slow twin, and its derivatives against central differences."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import packwork as pw
from numerics import assert_adjoint, assert_gradient, central_differences, compare
from packwork import threads
from packwork.arrays import FloatArray
from packwork.geometry.polygon import signed_area
from packwork.raster.colour import MAX_CHANNELS, ColourImage
from packwork.raster.coverage import BANDS, Rasteriser
from packwork.solve.outlines import Ensemble
from raster_reference import colour_image
from scenes import disc, poses, star
from strategies import POLYGONS, SHAPES, generators, joined, lattice_rings, ring_sets

SHAPE = (9, 11)
KINDS = pytest.mark.parametrize("make", POLYGONS.values(), ids=POLYGONS.keys())
WHITE = np.ones(3)
BOTH = pytest.mark.parametrize(("dtype", "accuracy"), [(np.float32, 2e-4), (np.float64, 1e-9)])


def colours_of(rng: np.random.Generator, rings: int) -> tuple[FloatArray, FloatArray]:
    """Colours and a background that differ in each channel."""
    return rng.random((rings, 3)), rng.random(3)


@given(rings=ring_sets(), shape=SHAPES, rng=generators())
def test_equals_its_slow_twin(
    rings: list[FloatArray], shape: tuple[int, int], rng: np.random.Generator
) -> None:
    colours, background = colours_of(rng, len(rings))
    image = pw.render_colour(*joined(rings), colours, shape, background)
    expected = colour_image(rings, colours, background, shape)
    np.testing.assert_allclose(image, expected, atol=1e-9)


@given(ring=lattice_rings(), shape=SHAPES, rng=generators())
def test_edges_on_grid_lines_too(
    ring: FloatArray, shape: tuple[int, int], rng: np.random.Generator
) -> None:
    colours, background = colours_of(rng, 1)
    image = pw.render_colour(ring, [0, len(ring)], colours, shape, background)
    expected = colour_image([ring], colours, background, shape)
    np.testing.assert_allclose(image, expected, atol=1e-9)


@KINDS
@BOTH
def test_is_the_density_weighed_by_colours(
    make: Any, dtype: Any, accuracy: float, rng: np.random.Generator
) -> None:
    for _ in range(5):
        rings = make(rng, 9.0)
        colours, background = colours_of(rng, len(rings))
        image = pw.render_colour(*joined(rings), colours, SHAPE, background, dtype)
        assert image.dtype == dtype
        expected = background + sum(
            pw.render(ring, [0, len(ring)], SHAPE)[..., None] * (colour - background)
            for ring, colour in zip(rings, colours, strict=True)
        )
        np.testing.assert_allclose(image, expected, atol=accuracy)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_nothing_is_left_below_and_beside_items(dtype: Any, rng: np.random.Generator) -> None:
    """What a ring deposits on its way down it takes away again, bit for bit."""
    background = np.array([0.1, 0.7, 1 / 3])
    for _ in range(20):
        rings = [r for kind in ("inside", "partly off", "huge") for r in POLYGONS[kind](rng, 90.0)]
        colours = rng.random((len(rings), 3)) * 255
        points, starts = joined(rings)
        shape = (150, 110)
        density = pw.render(points, starts, shape, dtype)
        image = pw.render_colour(points, starts, colours, shape, background, dtype)
        assert (image[density == 0] == background.astype(dtype)).all()


@KINDS
def test_derivatives_by_points_equal_central_differences(
    make: Any, rng: np.random.Generator
) -> None:
    for _ in range(3):
        points, starts = joined(make(rng, 9.0))
        colours, background = colours_of(rng, len(starts) - 1)
        adjoint = rng.normal(size=(*SHAPE, 3))

        def value(at: FloatArray) -> float:
            image = pw.render_colour(at, starts, colours, SHAPE, background)  # noqa: B023
            return float(np.sum(adjoint * image))  # noqa: B023

        gradient = pw.render_colour_pullback(points, starts, colours, adjoint, background)[0]
        if not gradient.any():
            np.testing.assert_allclose(central_differences(value, points), 0, atol=1e-9)
        else:
            reach = max(1.0, float(np.abs(points).max()) / 100)
            assert_gradient(value, gradient, points, error=1e-6 * reach)


@KINDS
def test_derivatives_by_colours_and_background(make: Any, rng: np.random.Generator) -> None:
    points, starts = joined(make(rng, 9.0))
    colours, background = colours_of(rng, len(starts) - 1)
    adjoint = rng.normal(size=(*SHAPE, 3))
    _, by_colours, by_background = pw.render_colour_pullback(
        points, starts, colours, adjoint, background
    )

    def of_colours(at: FloatArray) -> float:
        return float(np.sum(adjoint * pw.render_colour(points, starts, at, SHAPE, background)))

    def of_background(at: FloatArray) -> float:
        return float(np.sum(adjoint * pw.render_colour(points, starts, colours, SHAPE, at)))

    if by_colours.any():
        assert_gradient(of_colours, by_colours, colours)
    else:
        np.testing.assert_allclose(central_differences(of_colours, colours), 0, atol=1e-9)
    # A ring larger than the image leaves nothing of the background.
    if np.abs(by_background).max() > 1e-9:
        assert_gradient(of_background, by_background, background)
    else:
        np.testing.assert_allclose(central_differences(of_background, background), 0, atol=1e-9)


PARTS = ("x", "y", "angle", "scale")


@pytest.mark.parametrize("part", PARTS)
def test_derivatives_by_pose_and_size(part: str, rng: np.random.Generator) -> None:
    """Through the ensemble, as the solver has them."""
    items = Ensemble([star(1.3), disc(0.9, 7), star(1.1)])
    at = poses([2.3, 6.1, 8.4], [2.2, 3.1, 7.3], [0.3, -0.4, 1.2], [1.4, 1.7, 0.9])
    colours, background = colours_of(rng, 3)
    adjoint = rng.normal(size=(18, 22, 3))
    size = {name: getattr(at, name) for name in PARTS}

    def value(changed: FloatArray) -> float:
        placed = items.place(poses(**{**size, part: changed}), 2.0).copy()
        image = pw.render_colour(placed, items.ring_starts, colours, (18, 22), background)
        return float(np.sum(adjoint * image))

    points = items.place(at, 2.0)
    by_points = pw.render_colour_pullback(points, items.ring_starts, colours, adjoint, background)
    by_pose = items.gather(by_points[0], at, 2.0)[:, PARTS.index(part)]
    # That by size is by its logarithm.
    gradient = by_pose / at.scale if part == "scale" else by_pose
    assert_gradient(value, gradient, size[part])


@KINDS
def test_adjoint_identity(make: Any, rng: np.random.Generator) -> None:
    """The image is linear in colours and background together."""
    points, starts = joined(make(rng, 9.0))
    rings = len(starts) - 1

    def forward(table: Any) -> Any:
        return pw.render_colour(points, starts, table[:-1], SHAPE, table[-1])

    def backward(adjoint: Any) -> Any:
        _, colours, background = pw.render_colour_pullback(
            points, starts, np.zeros((rings, 3)), adjoint
        )
        return np.vstack([colours, background])

    table, adjoint = rng.normal(size=(rings + 1, 3)), rng.normal(size=(*SHAPE, 3))
    assert_adjoint(forward, backward, table, adjoint, error=1e-11)


@given(rings=ring_sets(), shift=st.floats(-2, 2), rng=generators())
def test_linear_in_colours(rings: list[FloatArray], shift: float, rng: np.random.Generator) -> None:
    points, starts = joined(rings)
    one, two = rng.random((2, len(rings), 3))
    mixed = pw.render_colour(points, starts, one + shift * two, SHAPE)
    apart = pw.render_colour(points, starts, one, SHAPE) + shift * pw.render_colour(
        points, starts, two, SHAPE
    )
    np.testing.assert_allclose(mixed, apart, atol=1e-9)


def test_a_colour_like_the_background_is_not_seen_and_feels_nothing(
    rng: np.random.Generator,
) -> None:
    points, starts = joined(POLYGONS["inside"](rng, 9.0))
    image = pw.render_colour(points, starts, [WHITE] * (len(starts) - 1), SHAPE, 1.0)
    assert (image == 1).all()
    adjoint = rng.normal(size=(*SHAPE, 3))
    by_points, by_colours, _ = pw.render_colour_pullback(
        points, starts, [WHITE] * (len(starts) - 1), adjoint, 1.0
    )
    assert not by_points.any()
    assert by_colours.any()


def test_overlapping_items_add_what_each_changes() -> None:
    tile = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    image = pw.render_colour(*joined([tile, tile]), [[0.5], [0.25]], (1, 1), 1.0)
    assert image.item() == 1 - 0.5 - 0.75


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_the_same_bytes_for_any_number_of_threads(
    dtype: Any, rng: np.random.Generator, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("packwork.raster.coverage.PARTED", 0)
    shape = (160, 40)
    corners = rng.uniform([0, 0], [35, 155], (60, 1, 2))
    rings = list(corners + rng.uniform(-3, 8, (60, 5, 2)))
    points, starts = joined(rings)
    colours, background = colours_of(rng, len(rings))
    adjoint = rng.normal(size=(*shape, 3)).astype(dtype)
    found = []
    for count in (1, 2, 4):
        with threads.using(count):
            image = pw.render_colour(points, starts, colours, shape, background, dtype)
            slopes = pw.render_colour_pullback(points, starts, colours, adjoint, background)
            found.append([part.tobytes() for part in (image, *slopes)])
    assert found[0] == found[1] == found[2]
    monkeypatch.undo()
    whole = pw.render_colour(points, starts, colours, shape, background, dtype)
    assert whole.tobytes() == found[0][0]
    parted = Rasteriser(shape, dtype)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("packwork.raster.coverage.PARTED", 0)
        parted.sweep(points, starts)
    assert len(parted.swept.records) == BANDS + 1


def test_one_image_serves_again_and_adds_to_a_gradient(rng: np.random.Generator) -> None:
    rasteriser = Rasteriser(SHAPE, np.float64)
    image = ColourImage(rasteriser)
    adjoint = rng.normal(size=(*SHAPE, 3))
    for kind in ("tiny", "inside", "holed"):
        points, starts = joined(POLYGONS[kind](rng, 9.0))
        colours, background = colours_of(rng, len(starts) - 1)
        rasteriser.sweep(points, starts)
        seen = image.render(colours, background)
        alone = pw.render_colour(points, starts, colours, SHAPE, background)
        np.testing.assert_array_equal(seen, alone)
        np.testing.assert_array_equal(rasteriser.density(), pw.render(points, starts, SHAPE))
        gradient = np.ones_like(points)
        image.pullback(adjoint, gradient)
        expected = pw.render_colour_pullback(points, starts, colours, adjoint, background)[0]
        np.testing.assert_allclose(gradient - 1, expected, atol=1e-12)


@KINDS
def test_single_precision_is_close_and_does_not_lean(make: Any, rng: np.random.Generator) -> None:
    for _ in range(3):
        points, starts = joined(make(rng, 9.0))
        colours, background = colours_of(rng, len(starts) - 1)
        adjoint = rng.normal(size=(*SHAPE, 3)).astype(np.float32)
        rough = pw.render_colour_pullback(points, starts, colours, adjoint, background)
        fine = pw.render_colour_pullback(
            points, starts, colours, adjoint.astype(np.float64), background
        )
        for one, other in zip(rough, fine, strict=True):
            if np.abs(other).max() > 1e-9:
                met = compare(one, other)
                assert met.error < 2e-4, met
                assert abs(met.bias) < 5e-5, met


anywhere = st.one_of(
    st.sampled_from(
        [0.0, -0.0, 1.0, 0.5, 3.0, 9.0, np.nextafter(1.0, 0.0), np.nextafter(1.0, 2.0)]
    ),
    st.sampled_from([1e9, -1e9, 1e5 + 0.5, -3e7, 5e-324, 2.0**-39, -(2.0**-39)]),
    st.integers(-3, 12).map(float),
    st.floats(-4, 13, allow_nan=False),
)


@given(
    points=st.lists(st.tuples(anywhere, anywhere), min_size=3, max_size=10),
    shape=SHAPES,
)
def test_white_on_black_is_the_density_wherever_points_lie(
    points: list[tuple[float, float]], shape: tuple[int, int]
) -> None:
    starts = [0, len(points)]
    image = pw.render_colour(points, starts, [[1.0]], shape)[..., 0]
    # Where an edge of a billion pixels crosses a line is known to a millionth.
    near = np.abs(points).max() < 100
    density = pw.render(points, starts, shape)
    np.testing.assert_allclose(image, density, atol=1e-9 if near else 1e-6)
    adjoint = np.random.default_rng(0).normal(size=shape)
    by_points, by_colours, _ = pw.render_colour_pullback(
        points, starts, [[1.0]], adjoint[..., None]
    )
    np.testing.assert_array_equal(by_points, pw.render_pullback(points, starts, adjoint))
    np.testing.assert_allclose(by_colours.item(), float(np.sum(adjoint * image)), atol=1e-8)


def test_far_points_colour_the_whole_image() -> None:
    far = 0.9e9
    whole = [[-far, -far], [far, -far], [far, far], [-far, far]]
    assert (pw.render_colour(whole, [0, 4], [[0.5]], (4, 5)) == 0.5).all()
    adjoint = np.ones((4, 5, 1))
    assert pw.render_colour_pullback(whole, [0, 4], [[0.5]], adjoint)[1].item() == 20


def test_by_colours_is_the_area_under_a_constant_adjoint(rng: np.random.Generator) -> None:
    ring = POLYGONS["inside"](rng, 9.0)[0]
    by_colours = pw.render_colour_pullback(ring, [0, len(ring)], [[0.3]], np.ones((20, 20, 1)))[1]
    assert by_colours.item() == pytest.approx(signed_area(ring), abs=1e-9)


TILE = [[0.0, 0], [1, 0], [1, 1], [0, 1]]


@pytest.mark.parametrize(
    ("given", "problem"),
    [
        ({"colours": [[1, 0, 0]] * 2}, r"must have shape \(1, channels\), one a ring, not \(2, 3"),
        ({"colours": 1.0}, r"one a ring, not \(\)"),
        ({"colours": [[np.nan, 0, 0]]}, "colours must be finite"),
        ({"colours": [[0.0] * (MAX_CHANNELS + 1)]}, "must have 1 to 16 channels, not 17"),
        ({"colours": np.zeros((1, 0))}, "must have 1 to 16 channels, not 0"),
        ({"background": [1, 1]}, r"one number or 3, not of shape \(2,\)"),
        ({"background": np.inf}, "background must be finite"),
        (
            {"points_px": [[0.0, 0], [1e10, 0], [1, 1], [0, 1]]},
            r"float64 image must lie within 1e\+09 px",
        ),
        (
            {"points_px": [[0.0, 0], [2e5, 0], [1, 1], [0, 1]], "dtype": np.float32},
            "float32 image must lie within 100000 px",
        ),
        ({"shape": (0, 3)}, "sides must be 1 to"),
        ({"starts": [0, 5]}, "from 0 to the number of points"),
    ],
)
def test_what_is_wrong_is_said_in_one_line(given: dict[str, Any], problem: str) -> None:
    good = {"points_px": TILE, "starts": [0, 4], "colours": [[1, 0, 0]], "shape": (2, 2)}
    with pytest.raises(pw.ShapeError, match=problem) as caught:
        pw.render_colour(**{**good, **given})
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("shape", [(2, 2), (2, 2, 1), (0, 2, 3)])
def test_an_adjoint_of_another_form_is_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(pw.ShapeError, match=r"adjoint must have shape \(rows, columns, 3\)"):
        pw.render_colour_pullback(TILE, [0, 4], [[1, 0, 0]], np.ones(shape))
