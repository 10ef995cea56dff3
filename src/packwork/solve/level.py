"""One rung of the resolution hierarchy: poses in, pose gradients out."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from packwork.arrays import FloatArray, Image
from packwork.forces.forces import NO_FORCES, Forces
from packwork.geometry.outline import Outline
from packwork.losses.image import FUSED, FusedAdjoint, FusedWeights, evenness
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
from packwork.scene.limits import NO_LIMITS, Limits
from packwork.scene.pose import Poses
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
