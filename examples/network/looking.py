"""Hearts and stars that a network arranges: it is shown them in colour, and told what to see."""

from __future__ import annotations

import itertools
from dataclasses import replace

import torch

import packwork as pw
from packwork.adapters.torch import torch_loss
from packwork.scene.item import FlatArt

# Images this small gain nothing from threads, and one sums in one order everywhere.
torch.set_num_threads(1)

SKY = "#10243f"
COLOURS = ("#10376b", "#1f5f9e", "#7f4a86", "#e0563f", "#f79d3c", "#ffd766")
SEEN_PX = 32


class Eye(torch.nn.Module):
    """Fixed random convolutions: two pictures look alike to it if colours lie alike."""

    def __init__(self) -> None:
        super().__init__()
        torch.manual_seed(0)
        self.layers = torch.nn.Sequential(
            torch.nn.Conv2d(3, 24, 7, stride=2, padding=3),
            torch.nn.Tanh(),
            torch.nn.Conv2d(24, 24, 5, stride=2, padding=2),
        )

    def forward(self, picture: torch.Tensor) -> torch.Tensor:
        """Features of a picture ``(3, rows, columns)`` of any size."""
        small = torch.nn.functional.interpolate(picture[None], (SEEN_PX, SEEN_PX), mode="area")
        return self.layers(small)


def sunset(size: int = 96) -> torch.Tensor:
    """A low sun in a sky that goes from blue over violet to red: ``(3, rows, columns)``."""
    y, x = torch.meshgrid(torch.linspace(0, 1, size), torch.linspace(-1, 1, size), indexing="ij")
    shades = torch.tensor([[int(c[k : k + 2], 16) / 255 for k in (1, 3, 5)] for c in COLOURS])
    near = 1 - torch.hypot(x, 1.6 * (y - 0.72)) / 1.3
    place = near.clamp(0, 1) * (len(COLOURS) - 1)
    low = place.long().clamp(max=len(COLOURS) - 2)
    share = (place - low)[..., None]
    return ((1 - share) * shades[low] + share * shades[low + 1]).permute(2, 0, 1)


EYE = Eye()
ASKED = EYE(sunset()).detach()


@torch_loss
def evening(density: torch.Tensor, colour: torch.Tensor, container: torch.Tensor) -> torch.Tensor:
    """How unlike a sunset the layout looks to the network."""
    return (EYE(colour.permute(2, 0, 1)) - ASKED).square().mean()


evening.background = SKY

if __name__ == "__main__":
    shapes = pw.read_items(["heart", "star"])
    items = [
        replace(item, art=FlatArt(colour)) for colour, item in itertools.product(COLOURS, shapes)
    ]
    losses = {evening: 400.0}
    layout = pw.fill("square", items, count=360, size_ratio=4, losses=losses)
    layout.save("looking.svg", background=SKY)
    layout.save("looking.png", background=SKY, pixels=700)
