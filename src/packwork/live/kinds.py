"""Kinds of documents: what of them may change, and the options that hold for all their items."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Annotated, Any, ClassVar, Literal, TypeAlias, final, get_args

import numpy as np
from pydantic import BeforeValidator, Field, ValidationError, field_validator

from packwork.arrays import IntArray
from packwork.errors import RecipeError, ShapeError
from packwork.forces.spec import ForceTexts, checked_forces, parse_force
from packwork.geometry.outline import Outline
from packwork.geometry.overlay import buffered
from packwork.metrics.certificate import Promise
from packwork.options import Options, SizeMode
from packwork.readers.words.options import Along
from packwork.recipe.piles import PileOptions, parse_emitter
from packwork.recipe.rules import Rotation, known_rotation
from packwork.scene.container import Container

MODES: Mapping[str, SizeMode] = {
    "free": "free", "shared": "shared", "fixed": "fixed", "graded": "free", "auto": "shared"
}  # fmt: skip
"""How sizes vary, by how a recipe says it: those that gave way may go on to."""


class LiveOptions(Options):
    """Gap, sizes and turns that flow and settle keep to."""

    padding: Annotated[float, Field(ge=0, allow_inf_nan=False)] = 0.0
    """Gap between items and to the container's edge, canvas units."""

    sizes: SizeMode = "free"
    """free: each item finds its size; shared: all stay in proportion; fixed: none changes."""

    size_ratio: Annotated[float, Field(ge=1, le=100)] = 2.0
    """With free sizes: 2 lets an item be half to twice as large as the typical one."""

    rotate: Annotated[str, BeforeValidator(known_rotation)] = "free"
    """free, none, or 30 (within 30 degrees of upright), as in recipes."""

    evenness: Annotated[float, Field(ge=0, le=100, allow_inf_nan=False)] = 0.0
    """Weight of even gaps against filling, while items flow."""

    force: ForceTexts = None
    """What items fall to at their sizes, as in recipes; none that reads a file."""

    @field_validator("force")
    @classmethod
    def _reads_no_file(cls, force: tuple[str, ...] | None) -> tuple[str, ...] | None:
        if any(parse_force(text).file is not None for text in force or ()):
            raise RecipeError("force", "takes no file in a session; give points, X,Y X,Y")
        return force

    @classmethod
    def from_manifest(cls, manifest: Mapping[str, Any]) -> LiveOptions:
        """Options that the run of a manifest had; the usual ones where it tells of none.

        Examples
        --------
        >>> LiveOptions.from_manifest({"recipe": {"sizes": "graded", "rotate": "30"}}).rotate
        '30'
        """
        recipe = manifest.get("recipe")
        options = recipe if isinstance(recipe, Mapping) else {}
        promise = Promise.of(manifest) or Promise()
        asked = {name: options.get(name) for name in ("size_ratio", "rotate")}
        found = {name: value for name, value in asked.items() if value is not None}
        found["force"] = _without_files(options.get("force"))
        sizes = MODES.get(str(options.get("sizes")), "free")
        found["sizes"] = "shared" if promise.areas_in_shares else sizes
        found |= kind_of(manifest).options
        edited = manifest.get("edited")
        if isinstance(edited, Mapping):
            found = {**found, **edited}
        try:
            return cls.model_validate({**found, "padding": promise.gap})
        except ValidationError:
            # What a file says of its run is worth nothing where it has no meaning.
            return cls(padding=promise.gap)

    @property
    def rotation(self) -> Rotation:
        """Range in which items may turn."""
        return Rotation.parse(self.rotate)

    @property
    def turns(self) -> bool:
        """Whether items may turn by themselves; where only some angles are allowed they do not."""
        return not self.rotation.is_still and self.rotation.choices is None


def _without_files(force: object) -> tuple[str, ...] | None:
    """Forces of a recipe that a session has too."""
    try:
        texts: Any = checked_forces(force)
    except (RecipeError, ValueError):
        return None
    return tuple(text for text in texts or () if parse_force(text).file is None) or None


KindName: TypeAlias = Literal["collage", "nest", "chart", "pile", "tile", "lines"]

LineWay: TypeAlias = Along
"""Lines of a container that words follow, as pages ask for them."""


@dataclass(frozen=True)
class Kind:
    """A collage, which changes in any way; other kinds say in what they differ.

    ``own_angles``: numbers, from 1, of items that keep the angles they have.
    """

    name: ClassVar[KindName] = "collage"
    called: ClassVar[str] = "a collage"
    """The same in a sentence."""
    sizes: ClassVar[SizeMode | None] = None
    """The only way in which sizes vary; None for any."""
    refusal: ClassVar[str] = ""
    """Sentence about sizes that are not for the hand; empty where they are."""
    stays: ClassVar[str] = ""
    """Sentence about places that are not for the hand; empty where they are."""
    shows_shape: ClassVar[bool] = True
    """Whether items are to tell the container's shape."""
    keeps_all: ClassVar[bool] = False
    """Whether a gesture for which there is no room at these sizes is taken back."""
    has_parts: ClassVar[bool] = False
    """Whether items are parts of true size, which separation takes apart."""

    own_angles: frozenset[int] = frozenset()

    @property
    def options(self) -> dict[str, Any]:
        """Options that a document of this kind has whatever its run had."""
        return {} if self.sizes is None else {"sizes": self.sizes}

    def ground(self, container: Container, gap: float) -> Container:
        """Container in which items lie at that gap."""
        del gap
        return container

    def begun(self, manifest: Mapping[str, Any], gap: float) -> Mapping[str, Any]:
        """Manifest that a document of a layout begins with."""
        del gap
        return manifest

    def stated(self, manifest: Mapping[str, Any], ids: IntArray) -> Mapping[str, Any]:
        """Manifest of a layout in which items of these numbers are left."""
        del ids
        return manifest

    def turned_over(self, manifest: Mapping[str, Any], ids: Sequence[int]) -> Mapping[str, Any]:
        """Manifest once items of these numbers are turned over."""
        del ids
        return manifest


@final
@dataclass(frozen=True)
class NestKind(Kind):
    """Parts of true size, at allowed angles, off the sheet's edge.

    ``rotate``: angles of most parts, as options say them.
    ``mirrored``: numbers, from 1, of parts that are turned over.
    ``margin``: least distance from the sheet's edge, canvas units.
    """

    name = "nest"
    called = "a nest"
    sizes = "fixed"
    refusal = "parts of a nest keep their true size"
    shows_shape = False
    has_parts = True

    rotate: str = "none"
    mirrored: frozenset[int] = frozenset()
    margin: float = 0.0

    @classmethod
    def stated_in(cls, said: Mapping[str, Any]) -> NestKind:
        """Rules that a manifest, which may hold anything, states.

        Examples
        --------
        >>> NestKind.stated_in({"rotate": "0,180", "mirrored": [2, "x"]})
        NestKind(own_angles=frozenset(), rotate='0,180', mirrored=frozenset({2}), margin=0.0)
        >>> NestKind.stated_in({"rotate": "up", "margin": -1}) == NestKind()
        True
        """
        rotate, margin = said.get("rotate"), said.get("margin")
        try:
            Rotation.parse(str(rotate))
        except (RecipeError, ValueError):
            rotate = "none"
        is_length = isinstance(margin, int | float) and 0 < margin < math.inf
        own, mirrored = (_numbers(said.get(name)) for name in ("own_angles", "mirrored"))
        margin = float(str(margin)) if is_length else 0.0
        return cls(own_angles=own, rotate=str(rotate), mirrored=mirrored, margin=margin)

    @property
    def options(self) -> dict[str, Any]:
        """True sizes, and the angles of most parts."""
        return {**super().options, "rotate": self.rotate}

    def ground(self, container: Container, gap: float) -> Container:
        """The container less what the margin keeps free beyond the gap."""
        if self.margin <= gap:
            return container
        region = buffered(container.outline.region, gap - self.margin, join_style="mitre")
        try:
            return replace(container, outline=Outline.from_region(region))
        except ShapeError:
            return container

    def begun(self, manifest: Mapping[str, Any], gap: float) -> Mapping[str, Any]:
        """With the margin that the container's ground has from then on."""
        return {**manifest, "nest": {**manifest["nest"], "margin": gap}}

    def stated(self, manifest: Mapping[str, Any], ids: IntArray) -> Mapping[str, Any]:
        """With the parts' numbers as rows, from 1."""
        known = {"own_angles": self.own_angles, "mirrored": self.mirrored}
        rows = {
            name: (np.flatnonzero(np.isin(ids + 1, list(one))) + 1).tolist()
            for name, one in known.items()
        }
        return {**manifest, "nest": {**manifest["nest"], **rows}}

    def turned_over(self, manifest: Mapping[str, Any], ids: Sequence[int]) -> Mapping[str, Any]:
        """With the parts noted that are seen from below."""
        mirrored = sorted(self.mirrored ^ {number + 1 for number in ids})
        return {**manifest, "nest": {**manifest["nest"], "mirrored": mirrored}}


@final
@dataclass(frozen=True)
class ChartKind(Kind):
    """Marks that are as large as their numbers say, with keys beside them."""

    name = "chart"
    called = "a chart"
    sizes = "shared"
    refusal = "marks of a chart are as large as their numbers say; change those"
    shows_shape = False
    keeps_all = True


@final
@dataclass(frozen=True)
class PileKind(Kind):
    """Items of given sizes that forces have heaped up.

    ``pouring``: how they come in, as recipes say it: ``open``, ``emit`` and ``release``.
    """

    name = "pile"
    called = "a pile"
    shows_shape = False
    keeps_all = True

    pouring: Mapping[str, Any] = field(default_factory=dict)

    @classmethod
    def stated_in(cls, said: Mapping[str, Any]) -> PileKind:
        """Kind of what a manifest, which may hold anything, says; no file of it is read again.

        Examples
        --------
        >>> PileKind.stated_in({"open": ["top"], "emit": "top", "size": "9%"}).pouring
        {'open': ('top',), 'emit': 'top', 'release': 0}
        >>> PileKind.stated_in({"emit": "curve.svg"}).pouring
        {}
        """
        try:
            asked = PileOptions.model_validate({k: said.get(k) for k in POURING if said.get(k)})
            emitter = None if asked.emit is None else parse_emitter(asked.emit)
        except (RecipeError, ValueError):
            return cls()
        if emitter is not None and (emitter.file or emitter.region):
            return cls()
        return cls(pouring={name: getattr(asked, name) for name in POURING})


@final
@dataclass(frozen=True)
class LineKind(Kind):
    """Words that follow lines, set anew after each change.

    ``along``, ``ring`` and ``palette`` as options of words have them.
    """

    name = "lines"
    called = "words on lines"
    refusal = "words on lines are as large as these have room for; change how often they are there"
    stays = "words on lines lie where these have room for them; change the words, or the lines"
    shows_shape = False

    along: Along | None = None
    ring: tuple[str, ...] = ()
    palette: str | None = None

    @classmethod
    def stated_in(cls, said: Mapping[str, Any]) -> LineKind | None:
        """Kind of words that a manifest, which may hold anything, says; None of those on no lines.

        Examples
        --------
        >>> LineKind.stated_in({"ring": ["CIDER", 3]}), LineKind.stated_in({"along": "x"})
        (LineKind(own_angles=frozenset(), along=None, ring=('CIDER',), palette=None), None)
        """
        along, ring, palette = (said.get(name) for name in ("along", "ring", "palette"))
        listed = ring if isinstance(ring, list | tuple) else ()
        texts = tuple(one for one in listed if isinstance(one, str))[:2]
        known = along if along in get_args(Along) else None
        if known is None and not texts:
            return None
        return cls(along=known, ring=texts, palette=palette if isinstance(palette, str) else None)


@final
@dataclass(frozen=True)
class TileKind(Kind):
    """Items on a canvas that repeats without a seam."""

    name = "tile"
    called = "a tile"
    shows_shape = False


POURING = ("open", "emit", "release")
"""Options of a pile that say how its items come in."""

COLLAGE = Kind()


def kind_of(
    manifest: Mapping[str, Any], *, has_numbers: bool = False, repeats: bool = False
) -> Kind:
    """Kind of the document that a manifest, which may hold anything, is of.

    ``has_numbers``: whether its items stand for numbers, as keys beside them say; ``repeats``:
    whether its canvas does.

    Examples
    --------
    >>> kind_of({"nest": {}}).name, kind_of({}, has_numbers=True).name, kind_of({}).name
    ('nest', 'chart', 'collage')
    """
    if repeats:
        return TileKind()
    recipe = manifest.get("recipe")
    if isinstance(said := manifest.get("nest"), Mapping):
        return NestKind.stated_in(said)
    if has_numbers:
        return ChartKind()
    if isinstance(recipe, Mapping) and isinstance(heaped := recipe.get("pile"), Mapping):
        return PileKind.stated_in(heaped)
    said = manifest.get("lines") if "lines" in manifest else _words_of(recipe)
    return (LineKind.stated_in(said) if isinstance(said, Mapping) else None) or COLLAGE


def _words_of(recipe: object) -> object:
    """Words of a recipe, which may be anything, as it says them, and their palette."""
    if not isinstance(recipe, Mapping) or not isinstance(said := recipe.get("words"), Mapping):
        return None
    return {**said, "palette": recipe.get("palette")}


def _numbers(said: object) -> frozenset[int]:
    found = said if isinstance(said, list | tuple) else ()
    return frozenset(one for one in found if isinstance(one, int))
