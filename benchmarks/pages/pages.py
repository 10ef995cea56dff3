"""Pages of figures anew from their manifests, without measuring: ``packwork bench pages``."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import partial

os.environ.setdefault("OMP_NUM_THREADS", "1")

from benchmarks.batch import batch
from benchmarks.engine import colour, engine, film, live, outlines, scaling_page, speed_page
from benchmarks.kit.manifests import Manifest, known, of_parts, write_text
from benchmarks.nest import nest
from benchmarks.pages import overview
from benchmarks.paper import paper, resolution
from benchmarks.peers import peer_pages
from benchmarks.quality import (
    arranging,
    charts,
    embeddings,
    evenness,
    forces,
    meaning,
    mosaics,
    parts,
    photos,
    quality,
    tiles,
)
from benchmarks.robustness import files_page, robustness
from benchmarks.studio import studio
from benchmarks.words import pairs_page, words_page

PAGES: dict[str, Callable[[Manifest], str]] = {
    "evenness": evenness.page,
    "paper": paper.page,
    "peers": peer_pages.page,
    "resolution": resolution.page,
    "scaling": scaling_page.page,
    "speed": speed_page.page,
    "words": words_page.page,
    "words-pairs": pairs_page.page,
    **{
        name: partial(of_parts, module.PAGE)
        for name, module in {
            "arranging": arranging, "batch": batch, "embeddings": embeddings,
            "charts": charts, "colour": colour, "engine": engine, "files": files_page,
            "films": film, "forces": forces, "live": live, "meaning": meaning,
            "mosaics": mosaics, "nesting": nest, "outlines": outlines, "parts": parts,
            "photos": photos, "quality": quality, "robustness": robustness, "studio": studio,
            "tiles": tiles,
        }.items()
    },
}  # fmt: skip
"""By the manifest's name."""


def rendered() -> dict[str, str]:
    """Every page of which something was measured, by its file's name; the overview last."""
    manifests = known()
    found = {f"{name}.md": text for name, one in manifests.items() if (text := PAGES[name](one))}
    return {**found, "README.md": overview.page(manifests)}


def main() -> None:
    """Write them."""
    for name, text in rendered().items():
        write_text(name, text)


if __name__ == "__main__":
    main()
