"""Commands that change what is filled, the lines that words follow, and the numbers for all."""

from __future__ import annotations

import math
from dataclasses import asdict, replace
from typing import Annotated, Any, Literal, cast

import numpy as np
from pydantic import Field

from packwork.errors import RecipeError, ShapeError
from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import difference, valid
from packwork.geometry.polygon import region
from packwork.live.commands.command import (
    FARTHEST,
    Command,
    Library,
    Number,
    check_one_container,
    known,
)
from packwork.live.document import PROPERTIES, Document
from packwork.live.file.records import Text
from packwork.live.kinds import LiveOptions
from packwork.metrics.certificate import Promise
from packwork.pipeline.plan.forces import forces_of
from packwork.pipeline.plan.limits import check_padding
from packwork.readers.words.options import Along
from packwork.recipe.refusals import validated
from packwork.scene.container import Container
from packwork.scene.item import MAX_LENGTH
from packwork.start.angles_and_sizes import nearest_allowed

MOST_POINTS = 100_000
"""Points of an outline at most. Chosen."""


class SetContainer(Command):
    """Fill another container; the items keep their places on the canvas."""

    kind: Literal["set_container"] = "set_container"
    asset: str
    """Name of the container in the library."""

    def applied(self, document: Document, library: Library) -> Document:
        """The document with the container."""
        check_one_container(document)
        new = cast(Container, known(library.containers, self.asset, "container"))
        if new.lattice is not None:
            _check_repeats(document)
        return replace(document, container=new)


class Reshape(Command):
    """Give the container other vertices."""

    kind: Literal["reshape"] = "reshape"
    rings: Annotated[
        tuple[tuple[tuple[Number, Number], ...], ...], Field(min_length=1, max_length=10_000)
    ]
    """Canvas units; outer rings and holes."""

    def applied(self, document: Document, library: Library) -> Document:
        """The document with the outline."""
        _check_outline(document)
        if sum(map(len, self.rings)) > MOST_POINTS:
            raise RecipeError("reshape", f"more than {MOST_POINTS} points; use fewer")
        arrays = [np.array(ring, dtype=np.float64).reshape(-1, 2) for ring in self.rings]
        if max(float(np.abs(ring).max(initial=0.0)) for ring in arrays) > (
            FARTHEST * document.container.side
        ):
            raise RecipeError("reshape", "points are nowhere near the canvas")
        try:
            outline = Outline.from_region(valid(Outline.from_rings(arrays).region))
        except (ShapeError, ValueError) as error:
            raise RecipeError("reshape", "the outline has no area; give three points") from error
        return replace(document, container=_outlined(document.container, outline))


class DrawContainer(Command):
    """Have what a closed line encloses as the container, or cut it out of the container."""

    kind: Literal["draw_container"] = "draw_container"
    line: Annotated[tuple[tuple[Number, Number], ...], Field(min_length=3, max_length=10_000)]
    """Canvas units; it may cross itself."""
    is_hole: bool = False

    def applied(self, document: Document, library: Library) -> Document:
        """The document with the outline."""
        _check_outline(document)
        line, container = np.array(self.line), document.container
        if float(np.abs(line).max()) > FARTHEST * container.side:
            raise RecipeError("container", "points are nowhere near the canvas")
        inside = region([line])
        if self.is_hole:
            inside = difference(container.outline.region, inside)
        try:
            outline = Outline.from_region(inside)
        except ShapeError as error:
            raise RecipeError("container", "nothing of it would be left") from error
        made = _outlined(container, outline)
        return replace(document, container=made if self.is_hole else replace(made, name="drawn"))


class PlaceContainer(Command):
    """Move, scale and turn the container on its canvas."""

    kind: Literal["place_container"] = "place_container"
    x: Number = 0.0
    """By how much to the right, canvas units."""
    y: Number = 0.0
    """By how much down."""
    factor: Annotated[Number, Field(ge=0.01, le=100)] = 1.0
    """By how much larger, about the middle of its box."""
    angle: Number = 0.0
    """By how much it turns about that, degrees, clockwise."""

    def applied(self, document: Document, library: Library) -> Document:
        """The document with the container there."""
        _check_outline(document)
        container = document.container
        if max(abs(self.x), abs(self.y)) > FARTHEST * container.side:
            raise RecipeError("container", f"{self.x:g}, {self.y:g} is nowhere near the canvas")
        left, top, right, bottom = container.outline.bounds
        x, y = (left + right) / 2, (top + bottom) / 2
        turn = math.radians(self.angle)
        across, along = self.factor * math.cos(turn), self.factor * math.sin(turn)
        to_x = x - across * x + along * y + self.x
        to_y = y - along * x - across * y + self.y
        place = affine.similarity(to_x, to_y, turn, self.factor)
        return replace(document, container=_outlined(container, container.outline.mapped(place)))


MOST_LEFT_OUT = 500
"""Words that are kept as left out, the last ones. Chosen."""


class LeaveOut(Command):
    """Keep which words of a cloud are left out, and how often they were there; moves nothing."""

    kind: Literal["leave_out"] = "leave_out"
    words: Annotated[dict[Text, float], Field(max_length=MOST_LEFT_OUT)]

    def applied(self, document: Document, library: Library) -> Document:
        """The document with these left out, and no other."""
        return replace(document, manifest={**document.manifest, "left_out": self.words})


class Entitle(Command):
    """Give the document a title."""

    kind: Literal["entitle"] = "entitle"
    title: Annotated[Text, Field(max_length=MAX_LENGTH)]
    """Empty for that of its container."""

    def applied(self, document: Document, library: Library) -> Document:
        """The document with the title."""
        return replace(document, manifest={**document.manifest, "title": self.title})


class SetOption(Command):
    """Set a number or a choice that holds for all items."""

    kind: Literal["set_option"] = "set_option"
    name: str
    """Such as ``padding``, ``sizes``, ``size_ratio``, ``rotate``."""
    value: float | str | tuple[str, ...]

    def applied(self, document: Document, library: Library) -> Document:
        """The document with the option."""
        if self.name not in LiveOptions.model_fields:
            choices = ", ".join(LiveOptions.model_fields)
            raise RecipeError(self.name[:40], f"is no option of a session; use one of {choices}")
        values: dict[str, Any] = {**dict(document.options), self.name: self.value}
        options = validated(LiveOptions, values)
        if options.force:
            document.container.check_edge("force", "places to be pulled to")
            # Of those that were there items may have gone.
            fresh = [one for one in options.force if one not in (document.options.force or ())]
            forces_of(fresh, document.items, document.weights, document.container)
        if document.kind.sizes not in {None, options.sizes}:
            raise RecipeError("sizes", document.kind.refusal)
        check_padding(document.container, options.padding, len(document))
        ranging = ("sizes", "size_ratio", "force")
        if all(getattr(options, one) == getattr(document.options, one) for one in ranging):
            # Sizes that were given by hand stay what they are.
            return _turned(replace(document, options=options), document.options)
        return _within(document.with_ranges(options), document.options)


def _check_outline(document: Document) -> None:
    check_one_container(document)
    document.container.check_edge("container", "outline to be changed")


def _check_repeats(document: Document) -> None:
    """Refuse a tile of what needs an edge, or places."""
    if document.kind.name not in {"collage", "tile"}:
        raise RecipeError("tile", f"has no edge, which {document.kind.called} would need")
    if document.options.force or document.mosaic is not None:
        what = "forces" if document.options.force else "a picture to be shown from afar"
        raise RecipeError("tile", f"has no places, which {what} would need; take that away first")


def _within(document: Document, before: LiveOptions) -> Document:
    """The document with sizes in a narrower range, where that was asked for."""
    options = document.options
    if options.sizes != "free" or options.size_ratio >= before.size_ratio:
        return document
    scale, areas = document.poses.scale, document.own_areas
    typical = np.sqrt(np.mean(areas * scale**2) / areas)
    inside = np.clip(scale, typical / options.size_ratio, typical * options.size_ratio)
    is_held = document.held[:, PROPERTIES.index("size")]
    poses = replace(document.poses, scale=np.where(is_held, scale, inside))
    return document.with_poses(poses).with_ranges(options)


def _turned(document: Document, before: LiveOptions) -> Document:
    """The document with items turned to the nearest angle that they may have now."""
    poses, rotation = document.poses, document.options.rotation
    if rotation == before.rotation:
        return document
    nearest = nearest_allowed(poses.angle, rotation.limit, rotation.choices)
    is_held = document.held[:, PROPERTIES.index("angle")]
    angle = np.where(is_held | np.isclose(nearest, poses.angle), poses.angle, nearest)
    return document.with_poses(replace(poses, angle=angle))


def _outlined(container: Container, outline: Outline) -> Container:
    # Parts of its file lie elsewhere.
    return replace(container, outline=outline, backdrop=None, walls=None, file=None)


RingText = Annotated[Text, Field(max_length=MAX_LENGTH)]


class SetLines(Command):
    """Note which lines words were set along, in which colours, and what is promised of their sizes.

    Moves nothing.
    """

    kind: Literal["lines"] = "lines"
    along: Along | None = None
    ring: Annotated[tuple[RingText, ...], Field(max_length=2)] = ()
    palette: RingText | None = None
    areas_in_shares: bool | None = None
    """Whether areas are promised to be in the shares of weights; None for as they were."""

    def applied(self, document: Document, library: Library) -> Document:
        """The document of words on these lines; of others where there are none."""
        said = None
        if self.along is not None or self.ring:
            said = {"along": self.along, "ring": self.ring, "palette": self.palette}
        manifest = {**document.manifest, "lines": said}
        if self.areas_in_shares is not None:
            promise = Promise(document.options.padding, self.areas_in_shares)
            manifest["promised"] = asdict(promise)
        return replace(document, manifest=manifest)
