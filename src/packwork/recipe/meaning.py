"""What a run is asked about what items mean: a part of the recipe."""

from __future__ import annotations

from typing import Annotated

from packwork.offers import Group, Offer, Verbs
from packwork.options import Options

FROM_TEXT = "auto"
"""Stands for vectors that are made from the text of the words."""


class Meant(Options):
    """Which items are alike, and come to lie together."""

    offers = Offer(group=Group.PLACED, verbs=Verbs.COLLAGES)

    embeddings: Annotated[
        str | None, Offer(metavar="FILE|auto", after="arrange", flags="--embeddings")
    ] = None
    """Vectors of the items (.npy, .csv, .tsv, .json, .parquet; a row an item, or a first column of
    names): those with like ones come to lie together. auto: of words, by which of them stand near
    each other in the text."""
