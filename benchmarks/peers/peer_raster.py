"""A plain soft rasteriser in PyTorch: every item a picture of its own, autodiff through all.

What one writes first: an item is a sampled distance field, its mask a sigmoid of that field at
each pixel of the image, the density their sum; PyTorch finds the derivative. One thread.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import Any

import numpy as np
import shapely
from scipy import ndimage

from benchmarks.kit import frozen
from benchmarks.kit.epochs import EDGES, epoch_of
from benchmarks.kit.manifests import Manifest
from benchmarks.kit.measuring import timed
from benchmarks.peers.peering import RUNS, entry, missing, version
from packwork import precompile, uses
from packwork.arrays import FloatArray
from packwork.geometry.outline import Outline
from packwork.metrics.pixel import pixel_metrics
from packwork.raster.membership import centre_count
from packwork.recipe import make_recipe
from packwork.scene.container import Container
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.start.angles_and_sizes import nominal_scales

COUNTS, RESOLUTIONS = (10, 100, 1_000), (50, 200, 600)
WEIGHTS = {"containment": 5.0, "overlap": 5.0, "filling": 1.0, "evenness": 0.0}
TEXTURE_PX = 96
MARGIN = 1.5
"""Half the side of a distance field, in radii of its item."""

BYTES = 8 * 2**30
"""More memory than that is not tried."""

BYTES_A_PIXEL = 60
"""Of one item's picture, its derivative taken in: measured."""

EPOCHS = {50: 100, 200: 100}
"""Of the whole run, by resolution."""

STEPS = {"place": 0.003, "angle": 0.05, "size": 0.01}
START_SHARE = 0.55


def measure(
    counts: Sequence[int] = COUNTS, resolutions: Sequence[int] = RESOLUTIONS
) -> list[Manifest]:
    """An epoch by items and pixels, ours and theirs, and one whole run of each."""
    known = version("torch")
    found = [] if known else [missing("PyTorch, soft masks", "pip install packwork[torch]")]
    precompile.warm_up()
    for count in counts:
        for px in resolutions:
            task = f"epoch, {px} px"
            call = epoch_of(WEIGHTS, count, px)
            seconds = _seconds(call, RUNS if px * count < 10**5 else 3)
            found.append(entry("packwork", str(version("packwork")), task, count, seconds, {}))
            if known:
                found.append(_epoch_of_theirs(known, task, count, px))
    found.append(_our_run())
    if known:
        found.append(_their_run(known))
    return found


def _seconds(call: Any, runs: int) -> list[float]:
    """Medians of blocks of calls."""
    return [timed(call, seconds=0.2, least=3).median / 1e3 for _ in range(runs)]


def _epoch_of_theirs(known: str, task: str, count: int, px: int) -> Manifest:
    if count * px**2 * BYTES_A_PIXEL > BYTES:
        found = {"program": "PyTorch, soft masks", "version": known, "task": task}
        return {**found, "count": count, "gib": count * px**2 * BYTES_A_PIXEL / 2**30}
    epoch = SoftRaster(frozen.round_container(), _outlines(count), px).epoch
    epoch()
    seconds = []
    for _ in range(RUNS):
        began = time.process_time()
        epoch()
        seconds.append(time.process_time() - began)
    return entry("PyTorch, soft masks", known, task, count, seconds, {})


def _outlines(count: int) -> list[Outline]:
    known = frozen.outlines_of(EDGES)
    return [known[k % len(known)] for k in range(count)]


class SoftRaster:
    """Items in a container, moved by Adam; poses start on a grid in it."""

    def __init__(self, container: Container, outlines: Sequence[Outline], px: int) -> None:
        import torch

        torch.set_num_threads(1)
        self._torch, self._container, self._outlines = torch, container, outlines
        self._fields = torch.tensor(np.stack([_field(one) for one in outlines]))[:, None]
        self._radii = torch.tensor([one.radius for one in outlines], dtype=torch.float32)
        start = _first(container, outlines)
        self._place = torch.tensor(start[:, :2] / container.side, dtype=torch.float32)
        self._angle = torch.tensor(start[:, 2], dtype=torch.float32)
        self._size = torch.tensor(np.log(start[:, 3]), dtype=torch.float32)
        for one in (self._place, self._angle, self._size):
            one.requires_grad_(True)
        self._adam = torch.optim.Adam(
            [
                {"params": [self._place], "lr": STEPS["place"]},
                {"params": [self._angle], "lr": STEPS["angle"]},
                {"params": [self._size], "lr": STEPS["size"]},
            ],
            betas=(0.9, 0.9),
        )
        self.see(px)

    def see(self, px: int) -> None:
        """Go on at another resolution."""
        torch, scale = self._torch, px / self._container.side
        outline = self._container.outline
        inside = centre_count(outline.points * scale, outline.starts, (px, px)) > 0
        self._inside = torch.tensor(inside, dtype=torch.float32)
        centres = (torch.arange(px) + 0.5) / px
        self._pixels = torch.stack(torch.meshgrid(centres, centres, indexing="xy"), dim=-1)
        self._px = px

    def epoch(self) -> None:
        """Render, take the losses, step."""
        torch = self._torch
        sides = torch.exp(self._size) * self._radii / self._container.side
        away = self._pixels - self._place[:, None, None]
        cos, sin = (f(self._angle)[:, None, None] for f in (torch.cos, torch.sin))
        turned = torch.stack(
            [cos * away[..., 0] + sin * away[..., 1], cos * away[..., 1] - sin * away[..., 0]], -1
        )
        seen = turned / (MARGIN * sides)[:, None, None, None]
        field = torch.nn.functional.grid_sample(
            self._fields, seen, padding_mode="border", align_corners=False
        )[:, 0]
        # The field is in radii: to pixels, half of one soft on either side.
        masks = torch.sigmoid(4.0 * self._px * field * sides[:, None, None])
        density = masks.sum(dim=0)
        loss = (
            WEIGHTS["containment"] * (density * (1 - self._inside)).mean()
            + WEIGHTS["overlap"] * torch.relu(density - 1).mean()
            - WEIGHTS["filling"] * (density.clamp(max=1) * self._inside).mean()
        )
        self._adam.zero_grad()
        loss.backward()
        self._adam.step()

    def poses(self) -> Poses:
        """Where the items are now, in canvas units."""
        place = self._place.detach().numpy().astype(float) * self._container.side
        angle = self._angle.detach().numpy().astype(float)
        return Poses(place[:, 0], place[:, 1], angle, np.exp(self._size.detach().numpy()))


def _field(outline: Outline) -> FloatArray:
    """Distance to the outline, positive inside, in radii; ``(TEXTURE_PX, TEXTURE_PX)``."""
    scale = TEXTURE_PX / (2 * MARGIN * outline.radius)
    points = outline.points * scale + TEXTURE_PX / 2
    inside = centre_count(points, outline.starts, (TEXTURE_PX, TEXTURE_PX)) > 0
    away = ndimage.distance_transform_edt(inside) - ndimage.distance_transform_edt(~inside)
    return np.asarray(away / scale / outline.radius, dtype=np.float32)


def _first(container: Container, outlines: Sequence[Outline]) -> FloatArray:
    """Poses x, y, angle, scale: on a grid inside, all of one area."""
    count, region = len(outlines), container.outline.region
    pitch = (region.area / count) ** 0.5
    while True:
        axis = np.arange(pitch / 2, container.side, pitch)
        points = np.stack(np.meshgrid(axis, axis), axis=-1).reshape(-1, 2)
        inside = points[shapely.contains_xy(region, points)]
        if len(inside) >= count:
            break
        pitch *= 0.99
    chosen = inside[np.linspace(0, len(inside) - 1, count).astype(int)]
    areas = np.array([one.area for one in outlines])
    scales = nominal_scales(areas, np.ones(count), START_SHARE * region.area)
    angles = np.random.default_rng(0).uniform(-np.pi, np.pi, count)
    return np.column_stack([chosen, angles, scales])


def _figures(layout: Layout) -> dict[str, list[float]]:
    pixel = pixel_metrics(layout.outlines, layout.container)
    return {"LC": [pixel.LC], "OO": [pixel.OO], "EA": [pixel.EA]}


def _whole() -> str:
    return f"{sum(EPOCHS.values())} epochs, {'+'.join(map(str, EPOCHS))} px"


def _our_run() -> Manifest:
    recipe = make_recipe(
        container="round", items=["-"], finish="none", epochs=sum(EPOCHS.values()),
        levels=",".join(map(str, EPOCHS)),
    )  # fmt: skip
    seconds, container = [], frozen.round_container()
    for _ in range(RUNS):
        began = time.process_time()
        run = uses.fill(recipe, frozen.items(), container)
        seconds.append(time.process_time() - began)
    known = str(version("packwork"))
    return entry("packwork", known, _whole(), frozen.COUNT, seconds, _figures(run.layout))


def _their_run(known: str) -> Manifest:
    container, items = frozen.round_container(), frozen.items()
    began = time.process_time()
    soft = SoftRaster(container, [item.outline for item in items], min(EPOCHS))
    for px, epochs in EPOCHS.items():
        soft.see(px)
        for _ in range(epochs):
            soft.epoch()
    seconds = [time.process_time() - began]
    layout = Layout(container, tuple(items), soft.poses(), np.ones(len(items)))
    return entry("PyTorch, soft masks", known, _whole(), frozen.COUNT, seconds, _figures(layout))
