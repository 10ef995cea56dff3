"""Films before they are encoded: layout, length, what is seen, and poses in each frame."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from typing import TypeAlias

import numpy as np

from packwork.arrays import FloatArray, IntArray
from packwork.errors import WriteError
from packwork.scene.colour import parse_colour
from packwork.scene.item import Item
from packwork.scene.layout import Layout, framed
from packwork.scene.track import TURN, Track, poses_of
from packwork.writers.film.options import FilmOptions
from packwork.writers.svg import SvgOptions

FREE = 0.04
"""Free edge round a layout in a frame of a given ratio, as a share of its longer side. Chosen."""

_UNSEEN = 1e-3
"""Share of the canvas by which an item may stick out unseen. Chosen."""


def in_frame(film: Film) -> Film:
    """Film whose first picture is whole, and that in which the items have arrived.

    Its canvas grows to where they stick out of it; to the ratio that is asked for, the layout in
    the middle.
    """
    container, ratio = film.layout.container, film.options.ratio
    low, high = np.zeros(2), np.array([container.width, container.height])
    boxes = list(_boxes(film))
    if boxes:
        out = _UNSEEN * container.side
        seen = np.array(boxes)
        low = np.where(seen[:, 0].min(axis=0) < -out, seen[:, 0].min(axis=0), low)
        high = np.where(seen[:, 1].max(axis=0) > high + out, seen[:, 1].max(axis=0), high)
    if ratio is not None:
        edge = FREE * float((high - low).max())
        width, height = high - low + 2 * edge
        size = np.array([max(width, height * ratio), max(height, width / ratio)])
        low, high = (low + high - size) / 2, (low + high + size) / 2
    margins = (*-low, *(high - (container.width, container.height)))
    return replace(film, layout=framed(film.layout, margins)) if any(margins) else film


def _boxes(film: Film) -> Iterator[tuple[FloatArray, FloatArray]]:
    """Box of each item that is there, in the two pictures that are to be whole."""
    for frame in (film.frames[0], film.frames[film.arrival]):
        poses = poses_of(frame)
        for k in np.flatnonzero(poses.scale > 0).tolist():
            box = film.items[k].ink.mapped(poses.matrix(k)).bounds
            yield np.array(box[:2]), np.array(box[2:])


PAPER = "#ffffff"
"""Behind the items of a film unless something else is asked for, as in a PNG."""

SOFT_SECONDS = 0.6
"""Time over which items set off and stop, and over which a leap from one place to another is
drawn out. Longer blurs the small moves of the end, shorter lets items flit. Chosen by eye."""

SOFT_SHARE = 0.2
"""The same as a share of the film at most, for films of a second. Chosen."""

Tell: TypeAlias = Callable[[float], None]
"""Told how much of a film has been encoded, 0 to 1."""


def tell_nobody(_: float) -> None:
    """Encode in silence."""


@dataclass(frozen=True, eq=False)
class Film:
    """Source of a film in every format: a layout with a track of its items.

    A WriteError if it has none, or one of other items. ``background`` is a CSS colour; ``"none"``
    leaves it clear where a format can.
    """

    layout: Layout
    options: FilmOptions = field(default_factory=FilmOptions)
    background: str = PAPER
    show_container: bool | None = None

    def __post_init__(self) -> None:
        self.layout.container.check_edge("film", "film")
        if self.track.count != len(self.layout.items):
            raise WriteError(
                "film", f"the track is of {self.track.count} items, not {len(self.layout.items)}"
            )
        # Refuses what is no colour.
        _ = self.drawing

    @property
    def track(self) -> Track:
        """The way of the items."""
        track = self.layout.track
        if track is None:
            raise WriteError("film", "the run was not recorded; give record=True to fill or words")
        return track

    @property
    def drawing(self) -> SvgOptions:
        """Drawing options of a frame, but for its items."""
        return SvgOptions(background=self.background, show_container=self.show_container)

    @property
    def is_opaque(self) -> bool:
        """Whether nothing shines through the background."""
        return parse_colour("background", self.background)[3] == 255

    @property
    def leaving(self) -> int:
        """Number of items of the layout before that are shown besides."""
        return 0 if self.layout.leaving is None else len(self.layout.leaving)

    @cached_property
    def items(self) -> tuple[Item, ...]:
        """All that are shown, from the bottom up: those that leave, then the layout's."""
        leaving = self.layout.leaving
        return self.layout.items if leaving is None else (*leaving.items, *self.layout.items)

    @cached_property
    def frames(self) -> FloatArray:
        """``(frames, n, 5)`` numbers of all items, frame by frame, eased as asked."""
        way, back = self._way, self.options.frames_back
        if not back:
            return way
        if self.options.loop == "back":
            return np.concatenate([way, way[-1:], way[-2:0:-1]])
        return np.concatenate([way, way[-1:], _glide(way[-1], way[0], back)])

    @cached_property
    def seconds(self) -> FloatArray:
        """Time for which each frame is shown; that in which items have arrived is held."""
        shown = np.full(len(self.frames), 1 / self.options.fps)
        shown[self.arrival] += self.options.hold
        return shown

    @cached_property
    def starts(self) -> FloatArray:
        """Time at which each frame begins, seconds."""
        return np.cumsum(self.seconds) - self.seconds

    def knots(self, k: int, tolerance: float) -> IntArray:
        """Frames between which an item may go straight on, canvas units."""
        # While it is held, it stays.
        held = [at for at in (self.arrival, self.arrival + 1) if at < len(self.frames)]
        return item_knots(self.frames[:, k], self.items[k].ink.radius, tolerance, held)

    @property
    def arrival(self) -> int:
        """Number of the frame in which the items have arrived."""
        return self.options.frames - 1

    @cached_property
    def _way(self) -> FloatArray:
        options = self.options
        if options.easing == "smooth":
            reach = round(min(SOFT_SECONDS * options.fps, SOFT_SHARE * options.frames) / 2)
            return _softened(self._sampled, options.frames, reach)
        return self._sampled(_EASED[options.easing](np.linspace(0.0, 1.0, options.frames)))

    def _sampled(self, times: FloatArray) -> FloatArray:
        """Poses at times of the track; those beyond its ends are its ends."""
        numbers, leaving = self.track.sampled(times), self.layout.leaving
        if leaving is None:
            return numbers
        return np.concatenate([leaving.sampled(times), numbers], axis=1)


_EASED: Mapping[str, Callable[[FloatArray], FloatArray]] = {
    "linear": lambda t: t,
    "ease-in": lambda t: t**3,
    "ease-out": lambda t: 1 - (1 - t) ** 3,
    "ease-in-out": lambda t: t * t * (3 - 2 * t),
}
"""Share of the way by share of the time."""


def _glide(end: FloatArray, start: FloatArray, count: int) -> FloatArray:
    """Frames between two moments, ``(n, 5)`` each, straight on; turns take the short way."""
    goal = start.copy()
    goal[:, TURN] += 2 * np.pi * np.round((end[:, TURN] - start[:, TURN]) / (2 * np.pi))
    share = _EASED["ease-in-out"](np.arange(1, count + 1) / (count + 1))[:, None, None]
    return np.asarray((1 - share) * end + share * goal)


def delays(seconds: FloatArray, ticks: float) -> list[int]:
    """Time for which each frame is shown, in whole ticks of so many to the second.

    Their sum is true to the film's length.

    Examples
    --------
    >>> delays(np.full(3, 1 / 3), 100)
    [33, 34, 33]
    """
    return [int(delay) for delay in np.diff(np.round(ticks * np.cumsum(seconds)), prepend=0)]


def _softened(sampled: Callable[[FloatArray], FloatArray], count: int, reach: int) -> FloatArray:
    """Frames that are weighed means of those ``reach`` before and after them.

    The first and the last are the track's own: it begins ``reach`` frames late, ends as many
    early, and stands still before and after.
    """
    # A window of 2 * reach + 1 frames about each frame sees those beyond the film's ends too.
    span = max(count - 1 - 2 * reach, 1)
    places = (np.arange(-reach, count + reach) - reach) / span
    path = sampled(places)
    window = np.hanning(2 * reach + 3)[1:-1]
    window /= window.sum()
    frames = np.zeros((count, *path.shape[1:]))
    for offset, weight in enumerate(window):
        frames += weight * path[offset : offset + count]
    # Means of equal numbers are off by rounding: what ends a film is the layout itself.
    frames[[0, -1]] = path[[0, -1]]
    return frames


def knots(path: FloatArray, tolerance: float, kept: Sequence[int] = ()) -> IntArray:
    """Frames between which a path may go straight on and be nowhere farther off.

    ``path`` are ``(frames, k)`` numbers, all of one unit, that of ``tolerance``. By the split of
    Douglas and Peucker (1973, see ``geometry.simplify``), with the largest difference of any number
    at the same time for a distance. Those ``kept`` are among them.

    Examples
    --------
    >>> knots(np.array([[0.0], [1.0], [2.0], [2.0], [2.0]]), 0.1).tolist()
    [0, 2, 4]
    """
    ends = sorted({0, *kept, len(path) - 1})
    found, spans = set(ends), list(pairwise(ends))
    while spans:
        begin, end = spans.pop()
        if end - begin < 2:
            continue
        share = np.arange(1, end - begin)[:, None] / (end - begin)
        straight = (1 - share) * path[begin] + share * path[end]
        off = np.abs(path[begin + 1 : end] - straight).max(axis=1)
        worst = int(np.argmax(off))
        if off[worst] > tolerance:
            middle = begin + 1 + worst
            found.add(middle)
            spans += [(begin, middle), (middle, end)]
    return np.array(sorted(found), dtype=np.int64)


def item_knots(
    frames: FloatArray, radius: float, tolerance: float, kept: Sequence[int] = ()
) -> IntArray:
    """The same of the ``(frames, 5)`` numbers of one item: no point of it is farther off.

    ``radius`` is the item's in its own units, ``tolerance`` in canvas units for each of place, turn
    and size.
    """
    x, y, angle, scale, stretch = frames.T
    reach = radius * float(scale.max())
    ways = (x, y, reach * angle, radius * scale, reach * np.sqrt(stretch))
    return knots(np.column_stack(ways), tolerance, kept)
