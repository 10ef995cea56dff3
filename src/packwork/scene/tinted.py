"""Drawings and photographs under a thin coat of one colour."""

from __future__ import annotations

from dataclasses import dataclass, replace

from packwork.geometry import affine
from packwork.geometry.outline import Outline
from packwork.scene.item import Item, Original, PhotoArt, VectorArt
from packwork.scene.notation import matrix_text


@dataclass(frozen=True, eq=False)
class TintedOriginal:
    """A photograph on disk under a coat of colour, opened anew each time it is printed.

    Parameters
    ----------
    ink
        What is coated, item units.
    colour, share
        ``#rrggbb``, and its opacity.
    """

    original: Original
    ink: Outline
    colour: str
    share: float

    def printed(self, px_per_unit: float) -> VectorArt:
        """The photograph with that many pixels per item unit, coated."""
        return coated(self.original.printed(px_per_unit), self.ink, self.colour, self.share)


def tinted_photo(item: Item, colour: str, share: float) -> Item:
    """A photograph under a coat of ``colour`` of that opacity; what is no photograph as it is."""
    art = item.art
    if not isinstance(art, PhotoArt):
        return item
    preview = coated(art.preview, item.ink, colour, share)
    return replace(
        item, art=PhotoArt(preview, TintedOriginal(art.original, item.ink, colour, share))
    )


def coated(art: VectorArt, ink: Outline, colour: str, share: float) -> VectorArt:
    """A drawing with ``ink`` (item units) in a colour of that opacity over it."""
    rings = "".join(
        "M" + " ".join(f"{v:.6g}" for v in ring.ravel().tolist()) + "Z" for ring in ink.rings
    )
    back = matrix_text(affine.inverse(art.matrix))
    coat = (
        f'<path transform="{back}" fill="{colour}" fill-opacity="{share:.3g}"'
        f' fill-rule="evenodd" d="{rings}"/>'
    )
    return replace(art, markup=art.markup + coat)
