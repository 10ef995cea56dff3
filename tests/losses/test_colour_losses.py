"""Losses that see colours: how they are told apart, what they may return, where they pull."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import packwork as pw
from numerics import assert_gradient
from packwork.arrays import FloatArray, Image
from packwork.losses.registry import takes_colour
from packwork.losses.term import SeenInColour
from packwork.pipeline.plan.own_losses import background_of
from packwork.scene.item import FlatArt
from packwork.solve.level import Level
from scenes import as_array, disc, from_array, poses, square_container, star

RUN: dict[str, Any] = {"count": 16, "epochs": 120, "levels": "40,80", "seed": 1, "effort": "draft"}


def warm_left(density: Image, colour: Image, container: Image) -> pw.Term:
    """Red wanted on the left, blue on the right."""
    side = np.linspace(-1, 1, density.shape[1], dtype=density.dtype)
    adjoint = np.zeros_like(colour)
    adjoint[..., 0], adjoint[..., 2] = side / density.size, -side / density.size
    return pw.Term(float(np.sum(adjoint * colour)), np.zeros_like(density), adjoint)


def difference(density: Image, colour: Image, container: Image) -> pw.Term:
    """Squared difference from grey where the container is, and density squared."""
    away = (colour - 0.4) * container[..., None]
    return pw.Term(
        float(np.mean(away**2) + np.mean(density**2)),
        2 * density / density.size,
        2 * away * container[..., None] / away.size,
    )


def discs() -> list[pw.Item]:
    (one,) = pw.read_items("circle")
    return [replace(one, art=FlatArt(colour)) for colour in ("#ff0000", "#0000ff")]


def score(layout: pw.Layout) -> float:
    """Loss of the finished layout, white behind."""
    side = 120 / layout.container.side
    outlines = layout.outlines
    points = np.vstack([o.points for o in outlines]) * side
    lengths = [len(ring) for o in outlines for ring in o.rings]
    rings = [len(o.rings) for o in outlines]
    own = np.array(
        [[1.0, 0, 0] if item.art.fill == "#ff0000" else [0, 0, 1.0] for item in layout.items]
    )
    starts = np.cumsum([0, *lengths])
    image = pw.render_colour(points, starts, np.repeat(own, rings, axis=0), (120, 120), 1.0)
    return warm_left(image[..., 0], image, image[..., 0]).value


def test_losses_are_told_by_what_they_take() -> None:
    assert takes_colour(warm_left)
    assert not takes_colour(lambda density, container: None)
    assert not takes_colour(lambda placed: None)
    assert not takes_colour(lambda density, container, sharp=1: None)
    assert not takes_colour(lambda *images: None)


@pytest.mark.compiled
def test_a_level_pulls_by_what_colours_change() -> None:
    """Against differences of what the level says the objective is, on its own images."""
    container, outlines = square_container(40.0), [star(7.0), disc(6.0, 9), star(6.0)]
    colours = np.array([[1.0, 0.2, 0.1], [0.1, 0.3, 0.9], [0.5, 0.9, 0.2]])
    seen = SeenInColour(difference, "difference", colours, np.array([1.0, 0.9, 0.8]))
    at = poses([12.2, 24.1, 20.4], [13.3, 17.1, 27.3], [0.3, -0.4, 1.2], [1.0, 1.1, 0.9])
    level = Level(container, outlines, 160, [seen])
    weights: Any = {seen: 3.0}

    def value(numbers: FloatArray) -> float:
        return level.objective(from_array(numbers), weights).total

    gradient = level.gradient(at, weights) / (container.width * container.height)
    # The level's images are float32: longer differences, looser agreement.
    assert_gradient(value, gradient, as_array(at), step=2.0**-8, error=3e-3)


@pytest.mark.compiled
def test_items_go_where_their_colours_are_wanted() -> None:
    scores = []
    for seed in range(3):
        run = {**RUN, "seed": seed, "levels": "40"}
        plain = pw.fill("square", discs(), **run)
        pulled = pw.fill("square", discs(), losses={warm_left: 5.0}, **run)
        assert pulled.certified
        scores.append([score(plain), score(pulled)])
    assert np.median(scores, axis=0)[1] < np.median(scores, axis=0)[0]
    assert pulled.manifest["recipe"]["losses"] == {"warm_left": 5.0}


@pytest.mark.compiled
def test_colours_of_a_palette_stay_where_the_loss_had_them() -> None:
    layout = pw.fill(
        "square", "circle", palette=["#ff0000", "#0000ff"], losses={warm_left: 5.0}, **RUN
    )
    assert [item.art.fill for item in layout.items] == ["#ff0000", "#0000ff"] * 8
    # The score of its mirror image is the same with the other sign.
    assert score(layout) < 0


@pytest.mark.compiled
def test_the_background_is_the_functions_own() -> None:
    seen: list[tuple[Image, Image]] = []

    def looking(density: Image, colour: Image, container: Image) -> pw.Term:
        seen.append((density, colour))
        return pw.Term(float(colour.sum()), np.ones_like(density) / density.size)

    looking.background = "#336699"  # type: ignore[attr-defined]
    items = [replace(discs()[0], art=FlatArt("#e9b341"))]
    pw.fill("square", items, losses={looking: 1.0}, **{**RUN, "epochs": 2})
    background, own = np.array([[0x33, 0x66, 0x99], [0xE9, 0xB3, 0x41]]) / 255
    density, colour = seen[-1]
    assert 0 in density
    assert (density > 0.5).any()
    expected = background + density[..., None] * (own - background)
    np.testing.assert_allclose(colour, expected, atol=2e-4)
    assert (background_of(warm_left) == 1).all()


def none_such(density: Image, colour: Image, container: Image) -> Any:
    return pw.Term(0.0, np.ones_like(density), np.ones((3, 3)))


def endless(density: Image, colour: Image, container: Image) -> Any:
    return pw.Term(0.0, np.ones_like(density), np.full_like(colour, np.inf))


def failing(density: Image, colour: Image, container: Image) -> Any:
    raise ValueError("no model")


def clear(density: Image, colour: Image, container: Image) -> Any:
    return warm_left(density, colour, container)


clear.background = "#ffffff80"  # type: ignore[attr-defined]


def unknown(density: Image, colour: Image, container: Image) -> Any:
    return warm_left(density, colour, container)


unknown.background = "paper"  # type: ignore[attr-defined]


def blind(density: Image, container: Image) -> Any:
    return pw.Term(0.0, np.ones_like(density), np.ones((*density.shape, 3)))


@pytest.mark.compiled
@pytest.mark.parametrize(
    ("loss", "problem"),
    [
        (none_such, r"none_such's adjoint of colours must have shape \(64, 64, 3\), not \(3, 3\)"),
        (endless, "endless's adjoint of colours must be finite"),
        (failing, "failing failed: ValueError: no model"),
        (clear, "the background '#ffffff80' is clear; use a solid colour"),
        (unknown, "'paper' is no colour"),
        (blind, "blind is given no colours, so has no adjoint of them"),
    ],
)
def test_what_is_no_loss_is_refused_on_one_line(loss: Any, problem: str) -> None:
    with pytest.raises(pw.RecipeError, match=problem) as met:
        pw.fill("square", "circle", losses={loss: 1.0}, **RUN)
    assert "\n" not in str(met.value)


@pytest.mark.compiled
def test_a_loss_of_colours_that_says_nothing_is_told(caplog: pytest.LogCaptureFixture) -> None:
    def silent(density: Image, colour: Image, container: Image) -> pw.Term:
        return pw.Term(0.0, np.zeros_like(density), np.zeros_like(colour))

    pw.fill("square", "circle", losses={silent: 1.0}, **{**RUN, "epochs": 2})
    assert "the loss silent is zero wherever items are" in caplog.text


@pytest.mark.compiled
def test_a_loss_of_colours_by_name_has_its_term_in_the_history(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    module = """
import numpy as np
import packwork as pw


def yellow(density, colour, container):
    by_colour = np.zeros_like(colour)
    by_colour[..., 2] = 1 / density.size
    return pw.Term(float(colour[..., 2].mean()), np.zeros_like(density), by_colour)
"""
    (tmp_path / "wishes.py").write_text(module, encoding="utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    layout = pw.fill("square", discs(), losses={"wishes:yellow": 2.0}, history=20, **RUN)
    blue = layout.history["wishes:yellow"]
    levels = blue[np.isfinite(blue)]
    assert len(levels) > 3
    assert levels[-1] < levels[0] < 1
    # Red takes blue from the white behind, blue leaves it there.
    red, kept = (
        sum(area for area, item in zip(layout.areas, layout.items, strict=True)
            if item.art.fill == fill)
        for fill in ("#ff0000", "#0000ff")
    )  # fmt: skip
    plain = pw.fill("square", discs(), **RUN)
    shares = [item.art.fill == "#ff0000" for item in plain.items]
    assert red / (red + kept) > float(np.average(shares, weights=plain.areas))


@pytest.mark.compiled
def test_the_same_layout_for_any_number_of_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("packwork.raster.coverage.PARTED", 0)
    found = []
    for count in (1, 2):
        layout = pw.fill("square", discs(), losses={warm_left: 5.0}, threads=count, **RUN)
        found.append(as_array(layout.poses).tobytes())
    assert found[0] == found[1]
