"""Words set along lines: the largest sizes with which all find a place, and bent letters there."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.curves import Curve
from packwork.metrics.violations import violations
from packwork.progress import Stop
from packwork.readers.fonts.fallback import Fonts
from packwork.readers.reading import UnfitError
from packwork.readers.regions import Holes
from packwork.readers.words.items import word_fonts
from packwork.readers.words.shaping import EM_PX, bent_word
from packwork.readers.words.word import Word, lines_of
from packwork.scene.container import Container
from packwork.scene.item import Item
from packwork.scene.pose import Poses
from packwork.start.lane_sizes import held_down
from packwork.start.lanes import Lanes, WordOnLine, WordShape
from packwork.start.limbs import Limb
from packwork.uses.words.graded import NEARER

if TYPE_CHECKING:
    from packwork.uses.words.use import WordsUse

CAPITAL = 0.73
"""Height of a capital, ems: words of low letters are set no larger than others. Of the bundled
font."""

LARGEST, FINER = 3.0, 0.97
"""Size that the heaviest word may ask for, over the width of the widest limb, so that later ones
take all of it too; and the factor between sizes that are tried. Chosen."""

SHRUNK, MOST_SHRUNK, SLACK = 0.95, 12, 0.9
"""Factor on words that come too near to others or to the edge, how often it is tried, and how much
of it words of the least size have room for. Chosen."""


def _first(is_so: Callable[[int], bool], low: int, high: int) -> int:
    """First number after ``low`` of which something is so, as it is of ``high``; by halves."""
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if is_so(middle) else (middle, high)
    return high


@dataclass(frozen=True, eq=False)
class Bent:
    """Bent words in place."""

    items: tuple[Item, ...]
    poses: Poses


@dataclass(frozen=True, eq=False)
class LineOfWords:
    """Words that are to be set along limbs, the heaviest first, and the fonts that draw them."""

    words: Sequence[Word]
    shapes: Sequence[WordShape]
    fonts: Fonts
    holes: Holes

    @classmethod
    def of(cls, words: Sequence[Word], use: WordsUse, holes: Holes) -> LineOfWords:
        """Words in the fonts of a use."""
        fonts, shapes = word_fonts(use.options), list[WordShape]()
        for word in words:
            if not (lines := lines_of(word.text)):
                raise UnfitError("has no letters")
            region = fonts.lettering([" ".join(lines)]).region
            left, top, right, bottom = region.bounds
            shapes.append(WordShape(right - left, max(bottom - top, CAPITAL)))
        return cls(words, shapes, fonts, "keep" if use.options.nest else holes)

    def set_along(
        self,
        limbs: Sequence[Limb],
        heights: FloatArray,
        least: float,
        gap: float,
        largest: float | None,
    ) -> list[WordOnLine]:
        """Setting that keeps most of the steps between heights with all words readable.

        Of those, that of the largest sizes with which all words find a place; where all do twice,
        they are set in turn as often as they do.
        """
        most = LARGEST * 2 * float(np.median(limbs[0].half))
        count = max(int(np.log(least / most) / np.log(FINER)), 1)
        words = len(self.shapes)
        for share in NEARER:
            own = np.cumprod(np.append(1.0, share * heights[1:] / heights[:-1] + 1 - share))

            def lanes(step: int, settings: int = words, own: FloatArray = own) -> Lanes:
                shapes = [self.shapes[k % words] for k in range(settings)]
                sizes = most * FINER**step * np.resize(own, settings)
                return Lanes(shapes, sizes, least, gap, largest)

            step = count
            if lanes(count).has_room(limbs):
                step = _first(lambda step: lanes(step).has_room(limbs), -1, count)
                break
        settings = words
        while lanes(step, 2 * settings).has_room(limbs):
            settings *= 2
        if settings > words:
            settings = (
                _first(lambda n: not lanes(step, n).has_room(limbs), settings, 2 * settings) - 1
            )
        best = lanes(step, settings)
        for limb in limbs:
            best.fill(limb)
        return [replace(one, word=one.word % words) for one in best.found]

    def bent(
        self,
        found: Sequence[WordOnLine],
        container: Container,
        gap: float,
        stop: Stop,
        wanted: FloatArray | None = None,
    ) -> Bent:
        """Words on their lines, smaller where they come too near; sizes in order if wanted."""
        pairs = [self._bent(one) for one in found]
        items = tuple(item for item, _ in pairs)
        poses = Poses(*np.array([row for _, row in pairs]).reshape(-1, 4).T)
        for _ in range(MOST_SHRUNK):
            outlines = [item.outline.mapped(poses.matrix(k)) for k, item in enumerate(items)]
            wrong = violations(outlines, container.outline, gap)
            if not wrong or stop():
                break
            scale = poses.scale.copy()
            scale[[k for one in wrong for k in (one.item, one.other) if k is not None]] *= SHRUNK
            if wanted is not None:
                scale = held_down([one.word for one in found], scale, wanted)
            poses = replace(poses, scale=scale)
        return Bent(items, poses)

    def _bent(self, one: WordOnLine) -> tuple[Item, tuple[float, float, float, float]]:
        """A word on its line, upright in its own frame, and its pose."""
        middle, size = (one.start + one.end) / 2, one.size
        angle = float(one.line.angle(middle, (one.end - one.start) / 4))
        x, y = one.line.at(middle).tolist()
        place = affine.similarity(x, y, angle, size)
        ends = one.start - size, one.end + size
        along = one.line.lengths[(one.line.lengths > ends[0]) & (one.line.lengths < ends[1])]
        points = one.line.at(np.concatenate([ends[:1], along, ends[1:]]))
        curve = Curve.through(affine.apply(affine.inverse(place), points))
        length = (one.end - one.start) / size
        word = bent_word(self.words[one.word], self.fonts, curve, 1.0, 1.0 + length, self.holes)
        [(x, y)] = affine.apply(place, -word.place[:, 2][None] / EM_PX)
        return word.item, (float(x), float(y), angle, size / EM_PX)
