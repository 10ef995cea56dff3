"""Draws the pictures of docs/how-it-works.md: ``python tools/draw_figures.py``.

One run, watched: its density, adjoint and accumulation images, the pull on the vertices, and
the layout before and after the exact finish. Writes PNGs into docs/pictures/figures/.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import combinations, pairwise
from pathlib import Path

import numpy as np
import numpy.typing as npt
import shapely
from PIL import Image, ImageDraw

import packwork as pw
from packwork.losses.image import FusedAdjoint, FusedWeights
from packwork.raster.coverage import Rasteriser
from packwork.scene.pose import Poses
from packwork.solve.options import SolveOptions
from packwork.solve.outlines import Ensemble, simplify_for_level
from packwork.solve.schedule import weights_at

OUT = Path(__file__).parents[1] / "docs" / "pictures" / "figures"
COUNT = 36
LEVELS = (50, 200, 600)
PANEL_PX = 300
GAP_PX = 12
ZOOM = 100.0
"""Side of what is shown of an overlap, over its half depth."""
MOVED_CU = 2.0
"""By how much an item may move in the finish and still be shown before and after it."""
HEAD, LEGS = (0, 10, 90, 100), (26, 8, 50, 32)
"""Parts of the 200 and the 50 px wide image, px: left, top, right, bottom."""
POSE = ("x", "y", "angle", "scale", "stretch")
PAPER, INK, BLUE, RED = ((255, 255, 255), (38, 50, 56), (38, 99, 165), (200, 50, 45))

Picture = npt.NDArray[np.float64]
"""(rows, columns, 3), 0..255."""


@dataclass
class Watch:
    """Keeps the steps of a run."""

    every: int = 1
    steps: list[pw.Step] = field(default_factory=list)

    def on_step(self, step: pw.Step) -> None:
        """Keep what the levels tell."""
        if not step.is_finish:
            self.steps.append(step)


class Scene:
    """The run's container and items at one resolution and one moment."""

    def __init__(self, layout: pw.Layout, resolution: int, poses: Poses | None = None) -> None:
        side = layout.container.side
        self.px_per_cu = resolution / side
        self.shape = tuple(
            round(resolution * length / side)
            for length in (layout.container.height, layout.container.width)
        )
        outlines = [item.outline for item in layout.items]
        if poses is not None:
            # As the solver sees them at this level: no finer than its pixels.
            outlines = simplify_for_level(outlines, poses, self.px_per_cu, 0.0)
        self.ensemble = Ensemble(outlines)
        self.rasteriser = Rasteriser(self.shape, np.float32)
        region = layout.container.outline
        points = np.vstack(region.rings) * self.px_per_cu
        starts = np.cumsum([0, *(len(ring) for ring in region.rings)])
        self.container = pw.render(points, starts, self.shape, np.float32)
        self._items = len(layout.items)

    def sweep(self, poses: Poses) -> None:
        """Put all edges into the accumulation buffer."""
        self._points = self.ensemble.place(poses, self.px_per_cu)
        self.rasteriser.sweep(self._points, self.ensemble.ring_starts)

    def density(self, poses: Poses) -> npt.NDArray[np.float32]:
        """Image S."""
        self.sweep(poses)
        return self.rasteriser.density()

    def adjoint(self, poses: Poses, progress: float) -> npt.NDArray[np.float32]:
        """Image A of the default losses at a moment of the run."""
        self.sweep(poses)
        weights = weights_at(SolveOptions(), progress)
        fused = FusedWeights(**{name: weights.get(name, 0.0) for name in FusedWeights().__dict__})
        return FusedAdjoint(self.container, self._items)(self.rasteriser.accumulation, fused).copy()

    def pull(self, poses: Poses, progress: float) -> tuple[Picture, Picture]:
        """Vertices, and the way that each is pulled: against its gradient."""
        adjoint = self.adjoint(poses, progress)
        return self._points.copy(), -self.rasteriser.pullback(adjoint).copy()


def mixed(low: Sequence[int], high: Sequence[int], share: Picture) -> Picture:
    """Colours between two, by a share of 0 to 1."""
    part = np.clip(share, 0, 1)[..., None]
    return np.asarray(low) * (1 - part) + np.asarray(high) * part


def density_picture(
    density: npt.NDArray[np.float32], container: npt.NDArray[np.float32]
) -> Picture:
    """White for nothing, blue for one item, red for two or more; the container a faint grey."""
    ground = mixed(PAPER, (226, 230, 232), container)
    once = np.clip(density, 0, 1)[..., None]
    twice = np.clip(density - 1, 0, 1)[..., None]
    return (ground * (1 - once) + np.asarray(BLUE) * once) * (1 - twice) + np.asarray(RED) * twice


def signed_picture(values: npt.NDArray[np.float32], whole: float) -> Picture:
    """Blue for less than nothing, white for nothing, red for more."""
    share = np.clip(values / whole, -1, 1)
    return np.where(share[..., None] < 0, mixed(PAPER, BLUE, -share), mixed(PAPER, RED, share))


def panel(picture: Picture, side: int = PANEL_PX) -> Image.Image:
    """A picture enlarged so that its pixels are seen, or made smaller."""
    image = Image.fromarray(picture.round().astype(np.uint8))
    scale = side / max(image.size)
    size = (round(image.width * scale), round(image.height * scale))
    return image.resize(size, Image.Resampling.NEAREST if scale > 1 else Image.Resampling.BOX)


def save(name: str, panels: Sequence[Image.Image]) -> None:
    """Panels beside each other."""
    width = sum(p.width for p in panels) + GAP_PX * (len(panels) - 1)
    sheet = Image.new("RGB", (width, max(p.height for p in panels)), PAPER)
    left = 0
    for one in panels:
        sheet.paste(one, (left, 0))
        left += one.width + GAP_PX
    sheet.quantize(128).save(OUT / name, optimize=True)
    print(f"{OUT / name}: {sheet.size}, {(OUT / name).stat().st_size / 1000:.0f} kB")  # noqa: T201


def cropped(picture: Picture, box: tuple[int, int, int, int]) -> Picture:
    """Part of a picture: left, top, right, bottom."""
    left, top, right, bottom = box
    return picture[top:bottom, left:right]


def arrows(scene: Scene, step: pw.Step, box: tuple[int, int, int, int]) -> Image.Image:
    """Outlines over the pixels of a part of the image, and how their vertices are pulled."""
    points, pull = scene.pull(step.poses, step.progress)
    density = density_picture(scene.density(step.poses), scene.container)
    side = 2 * PANEL_PX
    zoom = side / (box[2] - box[0])
    ground = panel(255 - (255 - cropped(density, box)) * 0.5, side)
    draw = ImageDraw.Draw(ground)
    seen = (points - box[:2]) * zoom
    length = 1.6 * zoom / np.quantile(np.hypot(*pull.T), 0.9)
    for first, end in pairwise(scene.ensemble.ring_starts):
        ring = [tuple(p) for p in seen[first:end]]
        draw.line([*ring, ring[0]], fill=INK, width=2)
    for tail, way in zip(seen, np.clip(pull * length, -3 * zoom, 3 * zoom), strict=True):
        _arrow(draw, tail, way)
    return ground


def _arrow(draw: ImageDraw.ImageDraw, tail: Picture, way: Picture) -> None:
    size = float(np.hypot(*way))
    if size < 3:
        return
    tip = tail + way
    draw.line([tuple(tail), tuple(tip)], fill=RED, width=2)
    along = way / size * min(7.0, size)
    across = np.array([-along[1], along[0]]) * 0.5
    draw.polygon([tuple(tip), tuple(tip - along + across), tuple(tip - along - across)], fill=RED)


def window(layout: pw.Layout, poses: Poses, left: float, top: float, span: float) -> Picture:
    """What is seen of a square of the canvas, drawn anew as large as a panel."""
    side = 4 * PANEL_PX // 3
    scale = side / span

    def drawn(points: npt.NDArray[np.float64], starts: Sequence[int]) -> npt.NDArray[np.float64]:
        return pw.render((points - [left, top]) * scale, starts, (side, side))

    region = layout.container.outline
    container = drawn(np.vstack(region.rings), np.cumsum([0, *map(len, region.rings)]))
    ensemble = Ensemble([item.outline for item in layout.items])
    points = ensemble.place(poses, 1.0).copy()
    return density_picture(drawn(points, ensemble.ring_starts), container)


def worst_place(layout: pw.Layout, before: Poses) -> tuple[float, float, float]:
    """Left, top and side of a square round the deepest overlap of items that stayed near."""
    moved = np.hypot(before.x - layout.poses.x, before.y - layout.poses.y)
    placed = [_region(item, before, k) for k, item in enumerate(layout.items)]
    near = [k for k in range(len(placed)) if moved[k] < MOVED_CU]
    pairs = [placed[a].intersection(placed[b]) for a, b in combinations(near, 2)]
    deepest = max(
        (shapely.maximum_inscribed_circle(shared) for shared in pairs if shared.area > 0),
        key=lambda radius: radius.length,
    )
    x, y = deepest.coords[0]
    return x - ZOOM * deepest.length / 2, y - ZOOM * deepest.length / 2, ZOOM * deepest.length


def _region(item: pw.Item, poses: Poses, k: int) -> shapely.Geometry:
    one = Ensemble([item.outline])
    alone = Poses(*(np.array([getattr(poses, f)[k]]) for f in POSE))
    points = one.place(alone, 1.0)
    rings = [points[a:b].copy() for a, b in pairwise(one.ring_starts)]
    return shapely.make_valid(shapely.Polygon(rings[0], rings[1:]))


def main() -> None:
    """Run once, draw all."""
    OUT.mkdir(exist_ok=True)
    watch = Watch()
    levels = ",".join(map(str, LEVELS))
    layout = pw.fill("bear", count=COUNT, seed=2, levels=levels, observer=watch)
    steps = watch.steps
    half = [step for step in steps if step.level == 0][len(LEVELS) * 6]
    scenes = {resolution: Scene(layout, resolution) for resolution in LEVELS}

    def seen(resolution: int, poses: Poses) -> Image.Image:
        scene = scenes[resolution]
        return panel(density_picture(scene.density(poses), scene.container))

    save("density.png", [seen(resolution, half.poses) for resolution in LEVELS])
    fine = scenes[200]
    adjoint = fine.adjoint(half.poses, half.progress)
    whole = float(np.quantile(np.abs(adjoint), 0.995))
    save("adjoint.png", [seen(200, half.poses), panel(signed_picture(adjoint, whole))])
    fine.sweep(half.poses)
    buffer = signed_picture(fine.rasteriser.accumulation[:-1].copy(), 1.0)
    density = density_picture(fine.rasteriser.density(), fine.container)
    save("accumulation.png", [panel(cropped(p, HEAD)) for p in (buffer, density)])
    save("pull.png", [arrows(Scene(layout, LEVELS[0], half.poses), half, LEGS)])
    ends = [next(s for s in reversed(steps) if s.level == k) for k in range(len(LEVELS))]
    save("levels.png", [seen(end.resolution, end.poses) for end in ends])
    place = worst_place(layout, ends[-1].poses)
    print(f"finish.png is {place[2]:.3g} of {layout.container.side:g} canvas units wide")  # noqa: T201
    both = (ends[-1].poses, layout.poses)
    save("finish.png", [panel(window(layout, poses, *place)) for poses in both])


if __name__ == "__main__":
    main()
