"""The layout that the verbs return: it saves, shows and measures itself."""

from __future__ import annotations

import contextlib
import io
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import cached_property, partial
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, Unpack, overload

import numpy as np
from numpy.typing import NDArray

from packwork import writers
from packwork.api.exports import Exported, drawing_options
from packwork.api.history import History
from packwork.api.keywords import FilmKeywords, SaveKeywords
from packwork.api.parts import (
    Placement,
    Pose,
    checked_poses,
    frozen_poses,
    manifest_of,
    measures,
    same_content,
)
from packwork.api.signatures import of_model
from packwork.arrays import IntArray, frozen
from packwork.display.bar import bar_for, shown
from packwork.errors import RecipeError
from packwork.metrics.certificate import Promise, unclean
from packwork.metrics.measure import Metrics, exact_of, measure
from packwork.phrasing import number_of
from packwork.pipeline import tell_coarse
from packwork.readers.layouts.read import is_session, read_written
from packwork.recipe.verbs import film_options
from packwork.scene import item as scene_item
from packwork.scene import layout as scene
from packwork.writers.film.options import FilmOptions
from packwork.writers.options import DrawingOptions

if TYPE_CHECKING:
    from packwork.api.session import Session


@dataclass(frozen=True, eq=False, repr=False)
class Layout(Exported, Sequence[Placement]):
    """Container + items + poses: what :func:`fill` returns, what is saved and shown.

    It shows itself in a notebook and never changes: ``dataclasses.replace`` gives another, which
    is measured anew. It is a sequence of its placed items, each with its outline in place, pose,
    name and weight; a slice is a layout of some. Layouts are equal if containers, items, poses and
    weights are, whatever their manifests say.

    Parameters
    ----------
    container
        The region that was filled.
    items
        One entry per placed item; copies repeat the same :class:`Item`.
    poses
        Where they are: arrays ``x``, ``y`` (canvas units, y down), ``angle`` (radians,
        clockwise on screen), ``scale`` and ``stretch``, one number per item.
    weights
        ``(n,)`` share of area asked for each item; all ones if none were given.
    manifest
        What the run did: version, recipe, seed, seconds, what each level found, metrics.
    track
        How the items came here, if that was recorded: :meth:`save_film` shows it.
    leaving
        Items of the layout before that are no more, as the same film shows them; else None.

    Examples
    --------
    >>> from packwork import fill
    >>> layout = fill("heart", ["circle", "star"], count=4, effort="draft", levels="50")
    >>> layout
    <Layout: 4 items in heart>
    >>> [item.name for item in layout.items]
    ['circle', 'star', 'circle', 'star']
    >>> len(layout), [placed.name for placed in layout if placed.pose.y > 0][:2]
    (4, ['circle', 'star'])
    >>> layout[-1].name, layout[:2], layout[0] in layout, layout[:4] == layout
    ('star', <Layout: 2 items in heart>, True, True)
    >>> layout.poses.x.shape, layout.manifest["recipe"]["effort"]
    ((4,), 'draft')
    """

    history: History | None = field(default=None, init=False)
    """Losses by epoch of the run that made it, if they were asked for (``history=True``); files and
    layouts made of it by ``replace`` have none."""

    def __post_init__(self) -> None:
        super().__post_init__()
        put = partial(object.__setattr__, self)
        put("poses", frozen_poses(checked_poses(self.poses)))
        put("weights", frozen(self.weights))
        parts = self.container, self.items, self.poses, self.weights
        put("manifest", manifest_of(self.manifest, parts))

    def __setstate__(self, state: Mapping[str, Any]) -> None:
        self.__dict__.update(state)
        # Arrays come out of a pickle as if they could be changed.
        for array in (self.weights, *(getattr(self.poses, c.name) for c in fields(self.poses))):
            array.flags.writeable = False

    def __len__(self) -> int:
        return len(self.items)

    def __bool__(self) -> bool:
        return True

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, scene.Layout):
            return NotImplemented
        parts = ("container", "items", "poses", "weights")
        return all(same_content(getattr(self, part), getattr(other, part)) for part in parts)

    def __hash__(self) -> int:
        return hash((self.container.name, *self.poses.x.tolist()))

    @overload
    def __getitem__(self, which: int) -> Placement: ...
    @overload
    def __getitem__(self, which: slice | Sequence[int] | NDArray[Any]) -> Layout: ...
    def __getitem__(self, which: int | slice | Sequence[int] | NDArray[Any]) -> Placement | Layout:
        if isinstance(which, slice) or np.shape(which):
            rows = self._rows(which)
            return replace(
                self, items=tuple(self.items[k] for k in rows), poses=self.poses.subset(rows),
                weights=self.weights[rows], notes=(), track=None, leaving=None,
            )  # fmt: skip
        try:
            row = range(len(self))[which]  # type: ignore[index]
        except IndexError:
            there = number_of(len(self), "item")
            raise IndexError(f"there is no item {which}: the layout has {there}") from None
        except TypeError:
            raise TypeError(f"items of a layout have numbers, not {which!r}") from None
        poses = self.poses
        columns = (poses.x, poses.y, poses.angle, poses.scale, poses.stretch, self.weights)
        *pose, weight = (float(column[row]) for column in columns)
        return Placement(self.items[row], Pose(*pose), self.outlines[row], weight)

    def _rows(self, which: Any) -> IntArray:
        """Numbers of the items of a slice, or that a list names or marks as true."""
        rows = np.arange(len(self))
        if isinstance(which, slice):
            return rows[which]
        asked = np.asarray(which)
        asked = asked if asked.size else asked.astype(int)
        if asked.ndim == 1 and asked.dtype.kind in "biu":
            with contextlib.suppress(IndexError):
                return np.asarray(rows[asked])
        there = number_of(len(self), "item")
        raise IndexError(
            f"the layout has {there}: give numbers below that, or a truth for each, "
            f"not {which!r:.60}"
        )

    def __iter__(self) -> Iterator[Placement]:
        return map(self.__getitem__, range(len(self)))

    @classmethod
    def load(cls, path: str | Path, items: Iterable[scene_item.Item] = ()) -> Layout:
        """Layout from a file that was saved, as ``.geojson``, ``.svg``, ``.packwork`` or ``.dxf``.

        A session (``.packwork``) and an SVG hold all that is seen, GeoJSON flat shapes in the mean
        colour of what they show, DXF shapes in place, and no poses.

        Parameters
        ----------
        items
            Drawings to have in place of shapes of the same names, as :func:`read_items` gives them.

        Raises
        ------
        ReadError
            If the file is missing or is not such a layout.

        Examples
        --------
        >>> from packwork import fill
        >>> import tempfile
        >>> layout = fill("circle", "star", count=3, effort="draft", levels="50")
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     layout.save(f"{folder}/stars.geojson")
        ...     again = Layout.load(f"{folder}/stars.geojson")
        >>> bool(abs(again.poses.angle - layout.poses.angle).max() < 1e-9)
        True
        """
        found = read_written(path)
        if drawings := list(items):
            from packwork.pipeline.registration import drawn_by

            found = drawn_by(found, drawings)
        return public(found)

    @of_model(DrawingOptions)
    def save(
        self,
        path: str | Path | IO[Any],
        format: str | None = None,
        **options: Unpack[SaveKeywords],
    ) -> None:
        """Write the layout as its ending says: .svg, .png, .jpg, .pdf, .dxf, .geojson, .packwork.

        Parameters
        ----------
        path
            Where to; an older file is replaced only when the new one is complete. Or an open
            file or buffer.
        format
            Such as ``"svg"``, in place of the ending; a buffer has none.
        options
            Those below.

        Raises
        ------
        WriteError
            If the ending is unknown or the file cannot be written.
        RecipeError
            If an option has no meaning.

        Examples
        --------
        >>> from packwork import fill
        >>> import tempfile
        >>> layout = fill("circle", "star", count=3, effort="draft", levels="50")
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     layout.save(f"{folder}/stars.png", pixels=200, background="ivory")
        """
        drawing = drawing_options(options)
        if isinstance(path, str | Path):
            if format is None and is_session(path):
                if options:
                    line = f"{path}: a session's file is no drawing; leave out "
                    raise RecipeError("path", line + ", ".join(options))
                self.edit().save(path)
            elif format is None:
                writers.write(self, path, drawing)
            else:
                writers.write_atomic(path, self._encoded(format, drawing))
        elif not hasattr(path, "write"):
            raise RecipeError("path", f"is {type(path).__name__}; give a path or an open file")
        else:
            format = format or Path(str(getattr(path, "name", ""))).suffix
            if not format:
                raise RecipeError("format", "a buffer has no ending; give a format, such as 'svg'")
            content = self._encoded(format, drawing)
            path.write(content.decode() if isinstance(path, io.TextIOBase) else content)
        tell_coarse(self, drawing.dpi)

    @of_model(FilmOptions)
    def save_film(
        self,
        path: str | Path,
        *,
        background: str = "white",
        show_container: bool | None = None,
        progress: bool | None = None,
        **options: Unpack[FilmKeywords],
    ) -> None:
        """Write a film of how the items came here, if the layout was made with ``record=True``.

        Parameters that :meth:`save` or :func:`fill` has too mean the same here.

        Parameters
        ----------
        path
            Its ending picks the format: .svg, .gif, .webp, .mp4, .webm, .json (Lottie).
        options
            Those below.

        Raises
        ------
        WriteError
            If nothing was recorded, or for what :meth:`save` raises it.

        Examples
        --------
        >>> from packwork import fill
        >>> import tempfile
        >>> layout = fill("circle", "star", count=3, epochs=9, levels="50", record=True)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     layout.save_film(f"{folder}/stars.gif", fps=10, seconds=1, film_pixels=100)
        """
        writers.check_film(path)
        film = writers.Film(self, film_options(**options), background, show_container)
        bar = bar_for(progress)
        with shown(bar):
            told = writers.tell_nobody if bar is None else partial(bar.tell, text="film")
            writers.write_atomic(path, writers.film_bytes(film, path, told))

    def edit(self, *, record: bool = False) -> Session:
        """A session in which items are moved, held, added; ``record``: for :meth:`save_film`."""
        from packwork.api.session import session_of

        return session_of(self, record=record)

    def widget(self) -> Any:
        """The layout under the hand in a notebook: as :meth:`edit` and :meth:`Session.widget`."""
        return self.edit().widget()

    @cached_property
    def metrics(self) -> Metrics:
        """Measures: ``coverage``, ``overlap``, ``outside``, ``unevenness`` and more.

        Also under the names of papers and reports: LC, OO, EA, LnU. A table ``exact`` has those of
        exact geometry. Shares are of the container's area; docs/reference/units.md says what each
        means.

        Examples
        --------
        >>> from packwork import fill
        >>> layout = fill("circle", "hexagon", count=7, effort="draft", levels="50")
        >>> 0.5 < layout.metrics["coverage"] < 1, layout.metrics["exact"]["overlap"]
        (True, 0.0)
        """
        return measures(measure(self).as_dict())

    @cached_property
    def certified(self) -> bool:
        """Whether exact geometry finds no overlap, nothing outside, and gaps as promised.

        Of a layout that was changed since it was measured, this is found anew.

        Examples
        --------
        >>> from packwork import fill
        >>> fill("circle", "hexagon", count=7, effort="draft", levels="50").certified
        True
        """
        known = self.manifest.get("certified")
        if isinstance(known, bool):
            return known
        promise = Promise.of(self.manifest) or Promise()
        return len(self) > 0 and not unclean(promise, self, exact_of(self))


def public(layout: scene.Layout) -> Layout:
    """The same layout with the methods that users know."""
    return Layout(**{one.name: getattr(layout, one.name) for one in fields(layout) if one.init})
