"""One rung of the resolution hierarchy: poses in, pose gradients out.

Where items repeat, coverages are summed on the torus: items are drawn into an image with a margin
about the cell. What lies in the margin is added to where it comes in again, and the sum is laid out
once more with its margin: so the losses see the plane as it will be, and the adjoint, taken back to
the cell and laid out likewise, says to every outline what its images see too. The two ways are
transposes of each other, so gradients stay exact.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeAlias, final

import numpy as np

from packwork.arrays import FloatArray, Image
from packwork.forces.forces import NO_FORCES, Forces
from packwork.geometry.lattice import Lattice
from packwork.geometry.outline import Outline
from packwork.losses.image import FUSED, FusedAdjoint, FusedWeights, evenness
from packwork.losses.pose import Recall
from packwork.losses.registry import by_name, find_loss, find_pose_loss
from packwork.losses.term import (
    ImageLoss,
    PosedItems,
    PoseLoss,
    PoseTerm,
    SeenInColour,
    Term,
    checked_term,
)
from packwork.progress import ObjectiveTerms
from packwork.raster.colour import ColourImage
from packwork.raster.coverage import Rasteriser
from packwork.scene.container import Container
from packwork.scene.pose import NO_LIMITS, Limits, Poses
from packwork.solve.free_space import FreeSpace, ZonePull
from packwork.solve.outlines import Ensemble


class Level:
    """Renders all items at one resolution and reads the losses' pose gradients.

    ``outlines``: one per item, item units, as this level sees them; ``losses``: those that will be
    weighed; ``nominal``: ``(n,)`` scales that were asked for; ``free_space``: what there is to
    fill, of the container unless given; ``seen``: how many items share its image, if not all.
    """

    corner = (0.0, 0.0)
    """Canvas coordinates of the image's corner."""

    shifts: FloatArray | None = None
    margin = 0
    """Translations, px, by which the image repeats within itself, and the margin of that."""

    def __init__(
        self,
        container: Container,
        outlines: Sequence[Outline],
        resolution: int,
        losses: Iterable[str | ImageLoss | SeenInColour] = FUSED,
        nominal: FloatArray | None = None,
        limits: Limits = NO_LIMITS,
        forces: Forces = NO_FORCES,
        free_space: FreeSpace | None = None,
        seen: int | None = None,
    ) -> None:
        self._forces = forces
        self.resolution = resolution
        self.px_per_cu = resolution / container.side
        free_space = free_space or FreeSpace.of(container, resolution)
        self.container_image, self._recall = free_space.room, free_space.recall
        shape = self.container_image.shape
        self.rasteriser = Rasteriser(shape, np.float32)
        self.ensemble = Ensemble(outlines)
        self.areas = np.array([o.area for o in outlines])
        """``(n,)`` areas of the outlines as this level sees them, item units squared."""
        self._fused = FusedAdjoint(self.container_image, len(outlines) if seen is None else seen)
        self._container_area = container.outline.area
        self._nominal = np.ones(len(outlines)) if nominal is None else nominal
        self._kinds = limits.kinds if limits.binds else np.arange(len(outlines))
        self.zones = [ZonePull(zone, outlines, shape, self.px_per_cu) for zone in limits.zones]
        self._further: dict[str | ImageLoss, ImageLoss] = {}
        self._of_poses: dict[str | ImageLoss, PoseLoss] = {}
        self._coloured: dict[Any, ColouredLoss] = {}
        for loss in losses:
            if isinstance(loss, SeenInColour):
                self._coloured[loss] = ColouredLoss(loss, self.rasteriser, self.ensemble)
            elif (of_poses := find_pose_loss(loss)) is not None:
                self._of_poses[loss] = of_poses
            elif loss not in FUSED:
                self._further[loss] = find_loss(loss)

    def gradient(
        self,
        poses: Poses,
        weights: Mapping[str | ImageLoss, float],
        recall: float = 0.0,
        force: float = 1.0,
    ) -> FloatArray:
        """Derivative of the losses by x, y, angle, log scale and log stretch, ``(n, 5)``.

        Losses count in squared canvas units (sums over pixels times a pixel's area), so that a
        level change does not change the physics. ``weights``: of losses, 0 unless named;
        ``recall``: of the pull on items whose centre is outside the container or their zone, and of
        a pixel's area beyond the image or outside a zone; ``force``: factor on the slopes of the
        forces.
        """
        self._sweep(poses)
        adjoint = self._adjoint(weights)
        by_points = self.rasteriser.pullback(adjoint, beyond=recall)
        for key, coloured in self._coloured.items():
            coloured.add_pull(weights.get(key, 0.0) * adjoint.size, by_points)
        by_pose = self.ensemble.gather(by_points, poses, self.px_per_cu)
        by_pose /= self.px_per_cu**2
        called = self._recall(poses.x, poses.y, self._areas_of(poses))
        _add(by_pose, called, recall * self.px_per_cu / self.resolution)
        for zone in self.zones:
            zone.add(by_pose, poses, recall)
        if self._forces.acts:
            centres = np.column_stack([poses.x, poses.y])
            cost = self._forces.cost(centres, self._areas_of(poses))
            by_pose[:, :2] += force * cost.slopes
        for name, of_poses in self._of_poses.items():
            # Their values have no unit: weighed by the container's area, as a mean over
            # its pixels would be.
            weight = weights.get(name, 0.0) * self._container_area
            _add(
                by_pose, of_poses(PosedItems(poses, self.areas, self._nominal, self._kinds)), weight
            )
        return by_pose

    def objective(
        self,
        poses: Poses,
        weights: Mapping[str | ImageLoss, float],
        recall: float = 0.0,
        force: float = 1.0,
    ) -> ObjectiveTerms:
        """Objective of :meth:`gradient`, over the canvas's area, and its terms."""
        density = self.density(poses)
        canvas = density.size / self.px_per_cu**2
        terms: dict[str, float] = {}
        factors: dict[str, float] = {}
        for (loss, weight), name in zip(weights.items(), by_name(weights), strict=True):
            terms[name] = self._value(loss, poses, density)
            # That of the poses has no unit, and weighs by the container's area.
            share = self._container_area / canvas if loss in self._of_poses else 1.0
            factors[name] = weight * share
        if recall:
            terms["recall"] = self._recall_value(poses, density) / canvas
            factors["recall"] = recall
        if self._forces.acts:
            centres = np.column_stack([poses.x, poses.y])
            terms["forces"] = self._forces.cost(centres, self._areas_of(poses)).value / canvas
            factors["forces"] = force
        total = sum((factors[name] * value for name, value in terms.items()), 0.0)
        return ObjectiveTerms(total, terms, factors)

    def _value(self, loss: str | ImageLoss | SeenInColour, poses: Poses, density: Image) -> float:
        """Value of one loss; ``density``: that of the last sweep, which has these poses."""
        if isinstance(loss, SeenInColour):
            return float(self._coloured[loss].term(density, self.container_image).value)
        if loss in self._of_poses:
            placed = PosedItems(poses, self.areas, self._nominal, self._kinds)
            return float(self._of_poses[loss](placed).value)
        if loss == "evenness":
            return evenness(density, self.container_image, len(self.areas)).value
        return float(checked_term(find_loss(loss), density, self.container_image).value)

    def _recall_value(self, poses: Poses, density: Image) -> float:
        """Penalty on what lies beyond the image or a zone, by its distance, squared units."""
        areas = self._areas_of(poses)
        seen = float(density.sum(dtype=np.float64)) / self.px_per_cu**2
        called = self._recall(poses.x, poses.y, areas).value * self.px_per_cu / self.resolution
        zones = sum(zone.value(poses) for zone in self.zones)
        return float(areas.sum()) - seen + called + zones

    def _areas_of(self, poses: Poses) -> FloatArray:
        return np.asarray(self.areas * poses.scale**2)

    def density(self, poses: Poses) -> Image:
        """Density image of these poses; their walk stays on record."""
        self._sweep(poses)
        return self.rasteriser.density()

    def _sweep(self, poses: Poses) -> None:
        points = self.ensemble.place(poses, self.px_per_cu)
        self.rasteriser.sweep(points, self.ensemble.ring_starts)

    def shares(self, density: Image) -> tuple[float, float, float]:
        """Shares of the container, by a density: covered, covered twice, covered outside it."""
        # A container that no pixel of this level shows counts as one pixel.
        whole = max(float(self.container_image.sum()), 1.0)
        covered = np.minimum(density, 1)
        inside = float((covered * self.container_image).sum())
        twice = float(np.maximum(density - 1, 0).sum())
        outside = float((covered * (1 - self.container_image)).sum())
        return inside / whole, twice / whole, outside / whole

    def _adjoint(self, weights: Mapping[str | ImageLoss, float]) -> Image:
        fused = FusedWeights(*(weights.get(name, 0.0) for name in FUSED))
        if not self._further and not self._coloured:
            return self._fused(self.rasteriser.accumulation, fused)
        accumulation = self.rasteriser.accumulation.copy()
        density = self.rasteriser.density()
        adjoint = self._fused(accumulation, fused)
        terms: dict[Any, Term] = {}
        for key, loss in self._further.items():
            terms[key] = checked_term(loss, density, self.container_image)
        for key, coloured in self._coloured.items():
            terms[key] = coloured.term(density, self.container_image)
        for key, term in terms.items():
            adjoint += weights.get(key, 0.0) * density.size * term.adjoint
        return adjoint


def _add(by_pose: FloatArray, term: PoseTerm, weight: float) -> None:
    by_pose[:, 0] += weight * term.x
    by_pose[:, 1] += weight * term.y
    if term.log_scale is not None:
        by_pose[:, 3] += weight * term.log_scale


class ColouredLoss:
    """One loss of the colours of what a rasteriser has swept."""

    def __init__(self, seen: SeenInColour, rasteriser: Rasteriser, ensemble: Ensemble) -> None:
        self._seen = seen
        self._image = ColourImage(rasteriser, seen.colours.shape[1])
        self._colours = ensemble.per_ring(seen.colours)
        self._adjoint: Image | None = None

    def term(self, density: Image, container: Image) -> Term:
        """Value and derivatives, of the sweep of this density, ``(rows, columns)``.

        Raises ``RecipeError`` if the loss fails, or returns no such term.
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


ROOM = 1.3
"""Margin about the cell over the largest radius of an item at a level's begin. Larger takes longer,
of smaller ones items that grow leave the image. Chosen."""

_Part: TypeAlias = tuple[slice, slice]


class Torus:
    """An image with a margin about a cell, in blocks each of which is a part of the cell.

    >>> torus = Torus(Lattice(2.0, 1.0), 1.0, 1)
    >>> torus.repeated(np.arange(12.0).reshape(3, 4)).tolist()
    [[6.0, 5.0, 6.0, 5.0], [6.0, 5.0, 6.0, 5.0], [6.0, 5.0, 6.0, 5.0]]
    >>> torus.summed(np.ones((3, 4))).tolist()
    [[6.0, 6.0, 6.0, 6.0], [6.0, 6.0, 6.0, 6.0], [6.0, 6.0, 6.0, 6.0]]
    """

    def __init__(self, lattice: Lattice, px_per_cu: float, margin: int) -> None:
        rows, columns = (max(round(v * px_per_cu), 1) for v in (lattice.height, lattice.width))
        self.margin, self.cell = margin, (rows, columns)
        self.shape = (rows + 2 * margin, columns + 2 * margin)
        drop = round(lattice.drop * px_per_cu)
        beside = range(-margin // columns, (columns + margin - 1) // columns + 1)
        tops = sorted(
            (i * rows + j * drop, j)
            for j in beside
            for i in range((-margin - j * drop) // rows, (rows + margin - 1 - j * drop) // rows + 1)
        )
        # From the top and the left, so that a pixel's sum is that of its images in reading order.
        self._blocks = [self._block(top, j * columns) for top, j in tops]

    def _block(self, top: int, left: int) -> tuple[_Part, _Part]:
        """Of a cell at that place the part of the image that it is, and the part of the cell."""
        places, parts = [], []
        for begin, side in zip((top, left), self.cell, strict=True):
            first = max(begin, -self.margin)
            last = min(begin, self.margin) + side
            places.append(slice(first + self.margin, last + self.margin))
            parts.append(slice(first - begin, last - begin))
        return (places[0], places[1]), (parts[0], parts[1])

    def _laid_out(self, cell: Image, dtype: np.dtype[Any]) -> Image:
        image = np.empty(self.shape, dtype)
        for place, part in self._blocks:
            image[place] = cell[part]
        return image

    def repeated(self, image: Image) -> Image:
        """The cell of an image, with what repeats of it about it."""
        rows, columns = self.cell
        inner = image[self.margin : self.margin + rows, self.margin : self.margin + columns]
        return self._laid_out(inner, image.dtype)

    def summed(self, image: Image) -> Image:
        """Sum of an image and all its translates: the transpose of :meth:`repeated`, laid out."""
        sums = np.zeros(self.cell)
        for place, part in self._blocks:
            sums[part] += image[place]
        return self._laid_out(sums, image.dtype)


@final
class RepeatingLevel(Level):
    """Level of a tile: nothing lies outside, and what leaves it comes in again.

    Parameters as of :class:`packwork.solve.level.Level`; ``largest``: radius of the largest item,
    canvas units; ``taken``: density of what does not move, of a level of the same ``largest``.
    """

    def __init__(
        self,
        container: Container,
        lattice: Lattice,
        outlines: Sequence[Outline],
        resolution: int,
        largest: float,
        losses: Iterable[str | ImageLoss | SeenInColour] = FUSED,
        nominal: FloatArray | None = None,
        limits: Limits = NO_LIMITS,
        taken: Image | None = None,
    ) -> None:
        px_per_cu = resolution / container.side
        self._lattice = lattice
        self._torus = torus = Torus(lattice, px_per_cu, int(ROOM * largest * px_per_cu) + 2)
        everywhere = np.ones(torus.shape, np.float32)
        room = everywhere if taken is None else np.maximum(everywhere - taken, 0)
        # No item is outside: the way back weighs nothing.
        super().__init__(
            container, outlines, resolution, losses, nominal, limits,
            free_space=FreeSpace(room, Recall(np.ones((1, 1), np.float32), 1.0)),
            seen=round(len(outlines) * everywhere.size / (torus.cell[0] * torus.cell[1])),
        )  # fmt: skip
        self.corner = (-torus.margin / px_per_cu, -torus.margin / px_per_cu)
        self.shifts, self.margin = lattice.neighbours() * px_per_cu, torus.margin

    def gradient(
        self,
        poses: Poses,
        weights: Mapping[str | ImageLoss, float],
        recall: float = 0.0,
        force: float = 1.0,
    ) -> FloatArray:
        """Derivatives as without repeats; nothing calls items back."""
        return super().gradient(self._on_image(poses), weights, 0.0, force)

    def density(self, poses: Poses) -> Image:
        """Density image of these poses and all that repeats of them."""
        return super().density(self._on_image(poses))

    def _on_image(self, poses: Poses) -> Poses:
        x, y = self._lattice.wrapped(np.column_stack([poses.x, poses.y])).T
        return replace(poses, x=x - self.corner[0], y=y - self.corner[1])

    def _sweep(self, poses: Poses) -> None:
        super()._sweep(poses)
        accumulation = self.rasteriser.accumulation
        summed = self._torus.summed(self.rasteriser.density())
        accumulation[:-1] = summed
        accumulation[1:-1] -= summed[:-1]

    def _adjoint(self, weights: Mapping[str | ImageLoss, float]) -> Image:
        return self._torus.repeated(super()._adjoint(weights))
