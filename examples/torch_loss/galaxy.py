"""Stars that gather into a galaxy: a loss in PyTorch, which finds its derivative itself."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import torch

import packwork as pw
from packwork.adapters.torch import torch_loss
from packwork.scene.item import FlatArt

# Images this small gain nothing from threads, and one sums in one order everywhere.
torch.set_num_threads(1)

COLOURS = ("#fff6d8", "#ffe08a", "#ffc857", "#f7a072")


@cache
def brightness(rows: int, columns: int) -> torch.Tensor:
    """Galaxy from black (0) to white (1): a core, and two arms that wind out of it."""
    y, x = torch.meshgrid(
        torch.linspace(-1, 1, rows), torch.linspace(-1, 1, columns), indexing="ij"
    )
    radius = torch.hypot(x, y) + 1e-3
    arms = torch.cos(torch.atan2(y, x) - 2 * torch.log(radius)) ** 4
    core = torch.exp(-((radius / 0.16) ** 2))
    return (core + (0.06 + 0.94 * arms) * (1.15 - radius).clamp(0, 1)).clamp(max=1)


@torch_loss
def spiral(density: torch.Tensor, container: torch.Tensor) -> torch.Tensor:
    """Mean squared difference from the galaxy, both seen from afar."""
    afar = torch.nn.AvgPool2d(max(1, len(density) // 30))
    wanted = brightness(*density.shape) * container
    return (afar(density[None]) - afar(wanted[None])).square().mean()


if __name__ == "__main__":
    (star,) = pw.read_items("star")
    stars = [replace(star, art=FlatArt(colour)) for colour in COLOURS]
    losses = {spiral: 6.0, "overlap": 25.0, "filling": 0.0, "evenness": 0.0}
    layout = pw.fill("circle", stars, count=600, size_ratio=4, losses=losses)
    layout.save("galaxy.svg", background="#0d1033")
    layout.save("galaxy.png", background="#0d1033", pixels=700)
