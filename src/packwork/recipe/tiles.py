"""Option of a tile: a canvas without walls, which repeats without a seam."""

from __future__ import annotations

from typing import Annotated, Any, Literal, TypeAlias

from pydantic import model_validator

from packwork.errors import RecipeError
from packwork.options import Group, Offer, Options, Verbs

TileKind: TypeAlias = Literal["square", "half-drop", "hexagon"]
"""Ways in which a tile repeats."""

_PLACES = "says where items lie, and a tile has no places"
_WALLS = "needs a container's edge, and a tile has none"
_VOIDS = "goes by the room in a container with an edge"
_NEIGHBOURS = "looks at neighbours as if the canvas ended at its edge"

NOT_OF_TILES = {
    "force": _PLACES, "hero": _PLACES, "arrange": _PLACES, "embeddings": _PLACES,
    "picture": _PLACES, "start": _PLACES, "apart": _NEIGHBOURS, "target_coverage": _VOIDS,
    "max_items": _VOIDS, "filler": _VOIDS, "smallest": _VOIDS, "pile": _WALLS,
    "margin": _WALLS, "chart": _WALLS,
}  # fmt: skip
"""Options that have no meaning in a tile, and why."""

NOT_OF_WORDS = {"repeat": _VOIDS, "largest": _VOIDS, "along": _WALLS, "ring": _WALLS}
"""The same of words."""


class TileOptions(Options):
    """Options of a tile."""

    offers = Offer(group=Group.PLACED)

    tile: Annotated[TileKind | None, Offer(verbs=Verbs.COLLAGES, after="canvas")] = None
    """A canvas that repeats without a seam: items pass over its edge and come in again on the other
    side. square: in rows and columns; half-drop: every other column half a tile lower; hexagon: the
    same in a honeycomb, on a canvas of the height that this needs. Either way the file repeats by
    itself, side by side. The container is page or square."""

    @model_validator(mode="after")
    def _tile_has_no_walls(self) -> Any:
        if self.tile is None:
            return self
        for key, why in NOT_OF_TILES.items():
            if getattr(self, key) != type(self).model_fields[key].default:
                raise RecipeError(key, f"{why}; leave it out, or --tile")
        words = self.words  # type: ignore[attr-defined]
        for key, why in NOT_OF_WORDS.items():
            if words is not None and getattr(words, key) not in {None, "none", ()}:
                raise RecipeError(key, f"{why}; leave it out, or --tile")
        if any(rule.pin or rule.region for rule in self.rules):  # type: ignore[attr-defined]
            raise RecipeError("rules", f"pin and region: {_PLACES}; leave them out, or tile")
        return self
