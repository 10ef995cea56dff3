"""A PyTorch function as a loss: its value and adjoint, in runs by value and by name."""

from __future__ import annotations

import importlib
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import packwork as pw
from numerics import assert_gradient
from packwork.adapters.torch import torch_loss
from packwork.arrays import FloatArray, Image
from packwork.losses.image import overlap
from packwork.losses.registry import takes_colour
from packwork.pipeline.plan.own_losses import background_of
from packwork.scene.contrast import channels_of
from packwork.scene.item import FlatArt
from packwork.scene.swatch import mean_lights
from scenes import box

torch: Any = pytest.importorskip("torch")

EXAMPLE = Path(__file__).parents[2] / "examples" / "torch_loss"


def crowding(density: Any, container: Any) -> Any:
    """Mean squared density, dearer outside: smooth everywhere."""
    return (density**2 * (2 - container)).mean()


@pytest.fixture
def images(rng: np.random.Generator) -> tuple[Image, Image]:
    """Density and container of one size, float32 as the solver has them."""
    density, container = rng.uniform(0, 2, (2, 9, 7)).astype(np.float32)
    return density, np.minimum(container, 1)


def test_value_and_adjoint_are_those_of_a_loss_by_hand(images: tuple[Image, Image]) -> None:
    def excess(density: Any, container: Any) -> Any:
        return torch.relu(density - 1).mean()

    by_torch, by_hand = torch_loss(excess)(*images), overlap(*images)
    assert by_torch.value == pytest.approx(by_hand.value, rel=1e-6)
    assert by_torch.adjoint.dtype == np.float32
    np.testing.assert_allclose(by_torch.adjoint, by_hand.adjoint, rtol=1e-6)


def test_the_adjoint_is_the_values_derivative(images: tuple[Image, Image]) -> None:
    density, container = (image.astype(np.float64) for image in images)

    def value(at: FloatArray) -> float:
        return torch_loss(crowding)(at, container).value

    assert_gradient(value, torch_loss(crowding)(density, container).adjoint, density)


def test_a_network_serves_and_its_parameters_gather_nothing(images: tuple[Image, Image]) -> None:
    class Eye(torch.nn.Module):  # type: ignore[misc]
        def __init__(self) -> None:
            super().__init__()
            self.look = torch.nn.Conv2d(1, 1, 3)

        def forward(self, density: Any, container: Any) -> Any:
            return self.look((density * container)[None]).square().mean()

    torch.manual_seed(0)
    eye = Eye()
    loss = torch_loss(eye)
    assert loss.__name__ == loss.__qualname__ == "Eye"  # type: ignore[attr-defined]
    assert np.abs(loss(*images).adjoint).max() > 0
    assert eye.look.weight.grad is None


def test_a_function_may_do_to_its_images_what_it_likes(images: tuple[Image, Image]) -> None:
    kept = [image.copy() for image in images]

    def rough(density: Any, container: Any) -> Any:
        container.zero_()
        return density.mul(2).sub_(container).mean()

    torch_loss(rough)(*images)
    for image, before in zip(images, kept, strict=True):
        np.testing.assert_array_equal(image, before)


def test_gradients_are_found_even_where_they_are_switched_off(
    images: tuple[Image, Image],
) -> None:
    loss = torch_loss(crowding)
    usual = loss(*images).adjoint
    with torch.no_grad():
        np.testing.assert_array_equal(loss(*images).adjoint, usual)


@pytest.mark.parametrize(
    ("function", "problem"),
    [
        (lambda density, container: 1.0, "must return a tensor of one number, not float"),
        (lambda density, container: density, r"one number, not shape \(\d+, \d+\)"),
        (lambda density, container: density.detach().mean(), "must depend on the density"),
        (lambda density, container: container.mean(), "must depend on the density"),
        (lambda density, container: density.mean() / 0, "adjoint must be finite"),
        (lambda density, container: density.no_such_method(), "failed: AttributeError"),
    ],
)
def test_a_loss_that_is_none_ends_the_run_on_one_line(function: Any, problem: str) -> None:
    with pytest.raises(pw.RecipeError, match=problem) as met:
        pw.fill("circle", "star", epochs=1, levels="16", losses={torch_loss(function): 1.0})
    assert "\n" not in str(met.value)


class Look(torch.nn.Module):  # type: ignore[misc]
    """Small fixed random network: what it says of the picture, near to what was asked."""

    def __init__(self) -> None:
        super().__init__()
        torch.manual_seed(3)
        self.layers = torch.nn.Sequential(
            torch.nn.AdaptiveAvgPool2d(24),
            torch.nn.Conv2d(3, 8, 5, stride=2),
            torch.nn.Tanh(),
            torch.nn.Conv2d(8, 8, 3, stride=2),
            torch.nn.Tanh(),
            torch.nn.Flatten(),
        )
        ramp = torch.linspace(0, 1, 24).expand(24, 24)
        asked = torch.stack([1 - ramp, torch.full_like(ramp, 0.3), ramp])
        self.asked = self.layers(asked[None]).detach()

    def forward(self, density: Any, colour: Any, container: Any) -> Any:
        said = self.layers(colour.permute(2, 0, 1)[None])
        return 1 - torch.cosine_similarity(said, self.asked).mean()


def test_adjoints_of_colours_are_the_derivatives(rng: np.random.Generator) -> None:
    colour = rng.uniform(0, 1, (9, 7, 3))
    density, container = rng.uniform(0, 2, (2, 9, 7))

    def mixed(density: Any, colour: Any, container: Any) -> Any:
        return ((colour**2).sum(dim=2) * density * container).mean()

    loss = torch_loss(mixed)
    term = loss(density, colour, container)
    assert term.colour_adjoint is not None
    assert_gradient(lambda at: loss(density, at, container).value, term.colour_adjoint, colour)
    assert_gradient(lambda at: loss(at, colour, container).value, term.adjoint, density)


def test_a_loss_of_colours_alone_has_no_adjoint_of_the_density(
    rng: np.random.Generator,
) -> None:
    density, container = rng.uniform(0, 1, (2, 30, 30)).astype(np.float32)
    colour = rng.uniform(0, 1, (30, 30, 3)).astype(np.float32)
    term = torch_loss(Look())(density, colour, container)
    assert not term.adjoint.any()
    assert term.colour_adjoint is not None
    assert term.colour_adjoint.dtype == np.float32
    assert term.colour_adjoint.any()


def test_modules_are_told_by_what_their_forward_takes() -> None:
    assert takes_colour(torch_loss(Look()))
    assert takes_colour(torch_loss(lambda density, colour, container: colour.mean()))
    assert not takes_colour(torch_loss(crowding))


def test_a_function_keeps_its_background() -> None:
    def dark(density: Any, colour: Any, container: Any) -> Any:
        return colour.mean()

    dark.background = "#000080"  # type: ignore[attr-defined]
    np.testing.assert_allclose(background_of(torch_loss(dark)), [0, 0, 128 / 255])


def test_what_depends_on_neither_image_is_refused() -> None:
    def none_of_them(density: Any, colour: Any, container: Any) -> Any:
        return container.mean()

    with pytest.raises(pw.RecipeError, match="must depend on the density or the colours"):
        pw.fill("circle", "star", epochs=1, levels="16", losses={torch_loss(none_of_them): 1.0})


def test_a_network_pulls_on_poses_and_sizes_through_colour() -> None:
    look = torch_loss(Look())
    (one,) = pw.read_items("circle")
    items = [replace(one, art=FlatArt(colour)) for colour in ("#ff4d00", "#004dff", "#804d80")]
    run: dict[str, Any] = {"count": 24, "epochs": 150, "levels": "40,80", "effort": "draft"}

    def said(layout: pw.Layout) -> float:
        """What the network says of the finished layout."""
        side = 96 / layout.container.side
        points = np.vstack([o.points for o in layout.outlines]) * side
        rings = [len(ring) for o in layout.outlines for ring in o.rings]
        own = channels_of(mean_lights(layout.items))
        per_ring = np.repeat(own, [len(o.rings) for o in layout.outlines], axis=0)
        image = pw.render_colour(points, np.cumsum([0, *rings]), per_ring, (96, 96), 1.0)
        return float(look(image[..., 0], np.float32(image), image[..., 0]).value)

    plain = pw.fill("square", items, seed=1, **run)
    pulled = pw.fill("square", items, seed=1, losses={look: 60.0}, **run)
    assert said(pulled) < said(plain)
    assert pulled.certified
    assert np.abs(pulled.poses.scale - plain.poses.scale).max() > 0


MODULE = '''
"""A title's place kept free."""
import torch
from packwork.adapters.torch import torch_loss

@torch_loss
def headroom(density, container):
    """Density in the top third, the dearer the higher."""
    depth = torch.linspace(1 / 3, -2 / 3, len(density))
    return (density * torch.where(depth > 0, 1 + 9 * depth, 0.0)[:, None]).mean()
'''


def test_a_loss_given_as_a_function_moves_items_and_is_named_in_the_manifest() -> None:
    space: dict[str, Any] = {}
    exec(MODULE, space)  # noqa: S102

    def covered_title(losses: dict[Any, float]) -> tuple[float, pw.Layout]:
        layout = pw.fill("circle", "circle", count=12, epochs=150, levels="60", losses=losses)
        title = box(0, 0, layout.container.width, layout.container.height / 3).region
        return sum(float(o.region.intersection(title).area) for o in layout.outlines), layout

    with_it, layout = covered_title({space["headroom"]: 10.0})
    assert with_it < covered_title({})[0]
    assert layout.manifest["recipe"]["losses"] == {"headroom": 10.0}


def test_a_loss_by_name_on_the_command_line(tmp_path: Path) -> None:
    (tmp_path / "title.py").write_text(MODULE, encoding="utf-8")
    command = (
        "-m packwork fill circle star -n 3 -q --epochs 60 --levels 40 "
        "--loss title:headroom=10 -o out.svg"
    )
    subprocess.run([sys.executable, *command.split()], cwd=tmp_path, check=True)
    assert (tmp_path / "out.svg").exists()


def test_stars_of_the_example_gather_where_the_galaxy_is_bright(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.syspath_prepend(str(EXAMPLE))
    galaxy = importlib.import_module("galaxy")

    def brightness_met(losses: dict[Any, float]) -> float:
        run: dict[str, Any] = {"count": 60, "epochs": 150, "levels": "60", "size_ratio": 4}
        layout = pw.fill("circle", "star", losses=losses, **run)
        rows, columns = (
            (np.clip(v / layout.container.width, 0, 0.999) * 60).astype(int)
            for v in (layout.poses.y, layout.poses.x)
        )
        bright = galaxy.brightness(60, 60).numpy()[rows, columns]
        return float(np.average(bright, weights=layout.areas))

    alone = {"filling": 0.0, "evenness": 0.0}
    assert brightness_met({**alone, galaxy.spiral: 6.0}) > brightness_met({})
    sys.modules.pop("galaxy")


@pytest.mark.parametrize(
    ("folder", "name", "count"), [("torch_loss", "galaxy", 600), ("network", "looking", 360)]
)
def test_the_examples_run(folder: str, name: str, count: int, tmp_path: Path) -> None:
    example = (EXAMPLE.parent / folder / f"{name}.py").read_text(encoding="utf-8")
    quick = example.replace(f"count={count}", "count=12, epochs=5, levels='32'")
    assert quick != example
    (tmp_path / f"{name}.py").write_text(quick, encoding="utf-8")
    subprocess.run([sys.executable, f"{name}.py"], cwd=tmp_path, check=True)
    assert (tmp_path / f"{name}.svg").exists()
    assert (tmp_path / f"{name}.png").exists()


def test_the_network_of_the_example_sees_its_sunset(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(EXAMPLE.parent / "network"))
    looking = importlib.import_module("looking")
    sunset = looking.sunset(64).permute(1, 2, 0).numpy()
    blank = np.ones((64, 64), np.float32)
    alike = looking.evening(blank, sunset, blank)
    turned = looking.evening(blank, np.ascontiguousarray(sunset[::-1]), blank)
    assert alike.value < 0.02 * turned.value
    sys.modules.pop("looking")
