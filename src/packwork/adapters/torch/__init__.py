"""PyTorch on both sides of the renderer: images with gradients, losses without adjoints.

Needs the extra ``packwork[torch]``. Importing this needs nothing yet; calling does.
"""

from packwork.adapters.torch.loss import torch_loss
from packwork.adapters.torch.rendering import render, render_colour, render_items

__all__ = ["render", "render_colour", "render_items", "torch_loss"]
