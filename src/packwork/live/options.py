"""Numbers of a document that hold for all its items."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import BeforeValidator, Field, ValidationError, field_validator

from packwork.errors import RecipeError
from packwork.forces.spec import ForceTexts, checked_forces, parse_force
from packwork.live.kinds import kind_of
from packwork.metrics.certificate import Promise
from packwork.options import Options, SizeMode
from packwork.recipe.rules import Rotation, known_rotation

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
