"""The renderer as a PyTorch function: our image, our gradients, to points and to poses."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import packwork as pw
from numerics import STEP, compare, white_image
from packwork.adapters.torch import render, render_colour, render_items
from packwork.geometry.outline import Outline, joined
from packwork.scene.pose import Poses
from scenes import disc, placed, poses, star
from strategies import POLYGONS
from strategies import joined as joined_rings

torch: Any = pytest.importorskip("torch")

SHAPE = (9, 11)
KINDS = ["inside", "partly off", "self-crossing", "tiny", "holed", "nearly upright"]
each_kind = pytest.mark.parametrize("kind", KINDS)


def leaf(array: Any, dtype: Any = None) -> Any:
    return torch.tensor(array, dtype=dtype or torch.float64, requires_grad=True)


@each_kind
def test_gradients_to_points_pass_pytorchs_own_check(kind: str, rng: np.random.Generator) -> None:
    points, starts = joined_rings(POLYGONS[kind](rng, 9.0))
    assert torch.autograd.gradcheck(
        lambda p: render(p, starts, SHAPE), leaf(points), eps=STEP, atol=1e-6, rtol=1e-6
    )


@each_kind
def test_image_and_gradient_are_the_renderers_bit_for_bit(
    kind: str, rng: np.random.Generator
) -> None:
    points, starts = joined_rings(POLYGONS[kind](rng, 9.0))
    adjoint = white_image(rng, SHAPE)
    seen = leaf(points)
    image = render(seen, torch.from_numpy(starts), SHAPE)
    image.backward(torch.from_numpy(adjoint))
    np.testing.assert_array_equal(image.detach().numpy(), pw.render(points, starts, SHAPE))
    np.testing.assert_array_equal(seen.grad.numpy(), pw.render_pullback(points, starts, adjoint))


def test_single_precision_stays_so_and_is_close(rng: np.random.Generator) -> None:
    points, starts = joined_rings(POLYGONS["holed"](rng, 9.0))
    adjoint = white_image(rng, SHAPE)
    seen = leaf(points, torch.float32)
    image = render(seen, starts, SHAPE)
    (image * torch.tensor(adjoint, dtype=torch.float32)).sum().backward()
    assert image.dtype == seen.grad.dtype == torch.float32
    np.testing.assert_allclose(image.detach(), pw.render(points, starts, SHAPE), atol=1e-4)
    met = compare(seen.grad.numpy(), pw.render_pullback(points, starts, adjoint))
    assert met.error < 1e-4, met


def test_the_record_outlives_points_moved_in_place_and_serves_twice() -> None:
    points = np.array([[1.2, 1.1], [6.3, 1.4], [3.1, 7.2]])
    seen = leaf(points)
    image = render(seen, [0, 3], SHAPE)
    weights = torch.arange(99.0, dtype=torch.float64).reshape(SHAPE)
    loss = (image * weights).sum()
    with torch.no_grad():
        seen += 1
    (first,) = torch.autograd.grad(loss, seen, retain_graph=True)
    kept = first.clone()
    (second,) = torch.autograd.grad(loss, seen)
    np.testing.assert_array_equal(first, kept)
    np.testing.assert_array_equal(first, second)
    np.testing.assert_array_equal(first, pw.render_pullback(points, [0, 3], weights.numpy()))


def test_second_derivatives_are_refused_not_wrong() -> None:
    seen = leaf([[1.2, 1.1], [6.3, 1.4], [3.1, 7.2]])
    square = (render(seen, [0, 3], SHAPE) ** 2).sum()
    (first,) = torch.autograd.grad(square, seen, create_graph=True)
    with pytest.raises(RuntimeError, match="once_differentiable"):
        first.sum().backward()


@pytest.mark.parametrize(
    ("points", "starts", "problem"),
    [
        ([[0, 0], [1, 0], [1, 1]], [0, 3], "must be float32 or float64, not torch.int64"),
        ([0.0, 1.0], [0, 2], r"must have shape \(n, 2\)"),
        ([[0.0, 0.0], [1.0, 0.0], [1.0, float("nan")]], [0, 3], "NaN or infinite"),
        ([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]], [0, 4], "from 0 to the number of points"),
    ],
)
def test_bad_points_and_starts_are_refused_on_one_line(
    points: Any, starts: Any, problem: str
) -> None:
    with pytest.raises(pw.ShapeError, match=problem):
        render(torch.tensor(points), starts, SHAPE)


def test_points_that_are_not_on_the_cpu_are_refused() -> None:
    with pytest.raises(pw.ShapeError, match=r"on the CPU, not on meta; use points\.cpu\(\)"):
        render(torch.zeros(3, 2, device="meta"), [0, 3], SHAPE)


OUTLINES = [star(1.3), disc(0.9, 7), star(1.1)]
START = poses([2.3, 6.1, 8.4], [2.2, 3.1, 7.3], [0.3, -0.4, 1.2], [1.4, 1.7, 0.9], [1.3, 0.8, 1.0])
PARTS = ("x", "y", "angle", "scale", "stretch")


@each_kind
def test_gradients_of_colours_pass_pytorchs_own_check(kind: str, rng: np.random.Generator) -> None:
    points, starts = joined_rings(POLYGONS[kind](rng, 9.0))
    colours, background = rng.random((len(starts) - 1, 3)), rng.random(3)
    assert torch.autograd.gradcheck(
        lambda *parts: render_colour(parts[0], starts, parts[1], SHAPE, parts[2]),
        (leaf(points), leaf(colours), leaf(background)),
        eps=STEP, atol=1e-6, rtol=1e-6,
    )  # fmt: skip


def test_colours_are_the_renderers_bit_for_bit(rng: np.random.Generator) -> None:
    points, starts = joined_rings(POLYGONS["holed"](rng, 9.0))
    colours, adjoint = rng.random((len(starts) - 1, 3)), rng.normal(size=(*SHAPE, 3))
    parts = leaf(points), leaf(colours)
    image = render_colour(parts[0], starts, parts[1], SHAPE, 0.25)
    image.backward(torch.from_numpy(adjoint))
    expected = pw.render_colour(points, starts, colours, SHAPE, 0.25)
    np.testing.assert_array_equal(image.detach().numpy(), expected)
    slopes = pw.render_colour_pullback(points, starts, colours, adjoint, 0.25)
    for part, slope in zip(parts, slopes, strict=False):
        np.testing.assert_array_equal(part.grad.numpy(), slope)


def test_colours_of_items_pull_at_poses_sizes_and_colours(rng: np.random.Generator) -> None:
    start = [leaf(getattr(START, part)) for part in PARTS[:4]]
    colours = leaf(rng.random((3, 3)))

    def seen(*parts: Any) -> Any:
        return render_items(
            OUTLINES, *parts[:4], shape=(18, 22), px_per_cu=2.0, colours=parts[4], background=1.0
        )

    assert torch.autograd.gradcheck(seen, (*start, colours), eps=STEP, atol=1e-6, rtol=1e-6)


@pytest.mark.parametrize(
    ("changed", "problem"),
    [
        ({"colours": [0.0]}, r"must have shape \(rings, channels\), not \(1,\)"),
        ({"colours": [[0.0] * 3] * 2}, r"must have shape \(1, channels\)"),
        ({"background": [0.0, 1.0]}, r"one number or 3, not of shape \(2,\)"),
    ],
)
def test_bad_colours_are_refused_on_one_line(changed: dict[str, Any], problem: str) -> None:
    good = {"colours": [[0.0, 0.5, 1.0]], "background": 0.0}
    asked = {key: torch.tensor(value) for key, value in {**good, **changed}.items()}
    with pytest.raises(pw.ShapeError, match=problem):
        render_colour(torch.zeros(3, 2), [0, 3], asked["colours"], SHAPE, asked["background"])


def test_items_need_a_colour_each() -> None:
    zero = torch.zeros(3)
    with pytest.raises(pw.ShapeError, match=r"one per outline \(3\), not 2"):
        render_items(OUTLINES, zero, zero, zero, zero + 1, SHAPE, colours=torch.zeros(2, 3))


def test_items_lie_where_the_layouts_poses_put_them() -> None:
    image = render_items(
        OUTLINES,
        *(torch.from_numpy(getattr(START, part)) for part in PARTS[:4]),
        (18, 22),
        stretch=torch.from_numpy(START.stretch),
        px_per_cu=2.0,
    )
    points, starts = joined(placed(OUTLINES, START))
    np.testing.assert_allclose(image, pw.render(2 * points, starts, (18, 22)), atol=1e-10)


@pytest.mark.parametrize("part", PARTS)
def test_gradients_to_poses_pass_pytorchs_own_check(part: str) -> None:
    given = {name: torch.from_numpy(getattr(START, name)) for name in PARTS}

    def image(value: Any) -> Any:
        return render_items(OUTLINES, **{**given, part: value}, shape=SHAPE, px_per_cu=0.97)

    start = given[part].clone().requires_grad_()
    assert torch.autograd.gradcheck(image, start, eps=STEP, atol=1e-5, rtol=1e-5)


def test_no_stretch_is_a_stretch_of_one() -> None:
    one = Poses(START.x, START.y, START.angle, START.scale)
    given = {part: torch.from_numpy(getattr(one, part)) for part in PARTS}
    plain = {part: given[part] for part in PARTS[:4]}
    np.testing.assert_array_equal(
        render_items(OUTLINES, **plain, shape=SHAPE), render_items(OUTLINES, **given, shape=SHAPE)
    )


def test_no_items_give_an_empty_image() -> None:
    nothing = torch.zeros(0)
    image = render_items([], nothing, nothing, nothing, nothing, SHAPE)
    assert tuple(image.shape) == SHAPE
    assert not image.any()


def test_as_many_poses_as_outlines() -> None:
    one, two = torch.ones(1), torch.ones(2)
    outline: Outline = disc()
    with pytest.raises(pw.ShapeError, match=r"angle must hold one number per outline \(2\)"):
        render_items([outline, outline], two, two, one, two, SHAPE)


def test_an_optimiser_of_ones_own_parts_two_items() -> None:
    outlines = [star(2.0), star(2.0)]
    x = leaf([4.0, 5.0])
    y, angle, scale = torch.full((2,), 4.5), torch.zeros(2), torch.ones(2)
    optimiser = torch.optim.Adam([x], lr=0.2)
    for _ in range(30):
        optimiser.zero_grad()
        density = render_items(outlines, x, y, angle, scale, SHAPE)
        overlap = torch.relu(density - 1).sum()
        overlap.backward()
        optimiser.step()
    assert float(overlap.detach()) < 1e-3
    assert 0 < float(x.detach().min()) < float(x.detach().max()) < SHAPE[1]
