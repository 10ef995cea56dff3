"""Losses that are given the colour image, beside density and container."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, final

from packwork.arrays import FloatArray, Image
from packwork.losses.term import Term, checked_call


class ColourLoss(Protocol):
    """A pure function of density, colour image and the container's coverage.

    The colour image is ``(rows, columns, 3)``, sRGB from 0 to 1, of the density's dtype: items in
    their mean colours, mixed by coverage over the function's ``background`` (an attribute, a CSS
    colour; white if it has none). Where items overlap it may leave that range.
    """

    def __call__(self, density: Image, colour: Image, container: Image) -> Term:
        """Return value and derivatives; leave all images, ``(rows, columns)``, as they are."""
        ...


@final
@dataclass(frozen=True, eq=False)
class SeenInColour:
    """A colour loss, and the colours in which a run's items are seen by it.

    Parameters
    ----------
    colours
        ``(n, 3)`` of the items, sRGB from 0 to 1.
    background
        ``(3,)``: what shows where nothing lies.

    Examples
    --------
    >>> import numpy as np
    >>> def red(density, colour, container):
    ...     by_colour = np.zeros_like(colour)
    ...     by_colour[..., 0] = 1 / density.size
    ...     return Term(float(colour[..., 0].mean()), np.zeros_like(density), by_colour)
    >>> seen = SeenInColour(red, "red", np.ones((1, 3)), np.zeros(3))
    >>> seen(np.ones((1, 2)), np.ones((1, 2, 3)), np.ones((1, 2))).value
    1.0
    """

    loss: ColourLoss
    name: str
    colours: FloatArray
    background: FloatArray

    @property
    def __name__(self) -> str:
        """As functions have it."""
        return self.name

    def __call__(self, density: Image, colour: Image, container: Image) -> Term:
        """Checked term of the loss, of images ``(rows, columns)``.

        Raises
        ------
        RecipeError
            If the loss fails, or returns no such term.
        """
        return checked_call(self.loss, (density, colour, container))
