"""Losses of the colour image at one level: rendered from the walk of the density, pulled back."""

from __future__ import annotations

import numpy as np

from packwork.arrays import FloatArray, Image
from packwork.losses.term import SeenInColour, Term
from packwork.raster.colour import ColourImage
from packwork.raster.coverage import Rasteriser
from packwork.solve.ensemble import Ensemble


class ColouredLoss:
    """One loss of the colours of what a rasteriser has swept."""

    def __init__(self, seen: SeenInColour, rasteriser: Rasteriser, ensemble: Ensemble) -> None:
        self._seen = seen
        self._image = ColourImage(rasteriser, seen.colours.shape[1])
        self._colours = ensemble.per_ring(seen.colours)
        self._adjoint: Image | None = None

    def term(self, density: Image, container: Image) -> Term:
        """Value and derivatives, of the sweep of this density, ``(rows, columns)``.

        Raises
        ------
        RecipeError
            If the loss fails, or returns no such term.
        """
        term = self._seen(
            density, self._image.render(self._colours, self._seen.background), container
        )
        self._adjoint = term.colour_adjoint
        return term

    def add_pull(self, weight: float, by_points: FloatArray) -> None:
        """Add what colours pull at points by the term read last, times ``weight``, ``(n, 2)``."""
        if self._adjoint is not None:
            pull = np.multiply(self._adjoint, weight, dtype=np.float32)
            self._image.pullback(np.ascontiguousarray(pull), by_points)
