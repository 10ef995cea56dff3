"""The same work given to what people use today: ``packwork bench peers [SECTION...]``.

Sections: icons, words, circles, apart, raster; all without a word. ``install`` fetches the peers
in JavaScript into build/peers; those in Python come with ``pip install packwork[bench,torch]``.
What is not there is a line "not installed". ``short`` only prints, with fewer items and runs.
Writes docs/manifests/peers.json, whose other sections stay as they were, and the page.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable

os.environ.setdefault("OMP_NUM_THREADS", "1")

from benchmarks.kit import node
from benchmarks.kit.manifests import Manifest, known, stamp, write_manifest, write_text
from benchmarks.kit.measuring import machine
from benchmarks.pages import overview
from benchmarks.peers import peer_circles, peer_icons, peer_penrose, peer_raster, peer_words
from benchmarks.peers.peer_pages import page

SECTIONS: dict[str, Callable[[], list[Manifest]]] = {
    "words": peer_words.measure,
    "circles": peer_circles.measure,
    "apart": peer_penrose.measure,
    "raster": peer_raster.measure,
    "icons": peer_icons.measure,
}

SHORT: dict[str, Callable[[], list[Manifest]]] = {
    "words": peer_words.measure,
    "circles": lambda: peer_circles.measure((10, 100)),
    "apart": lambda: peer_penrose.measure({"circles": (10, 20), "polygons": (5,)}, (10, 40)),
    "raster": lambda: peer_raster.measure((10, 100), (50, 200)),
    "icons": lambda: peer_icons.measure(5, 1),
}


def main(words: list[str]) -> None:
    """Measure, print, write the manifest and the page after each section."""
    if "install" in words:
        node.install()
        return
    unknown = set(words) - {*SECTIONS, "short"}
    if unknown:
        sys.exit(f"packwork: bench peers: {', '.join(sorted(unknown))}: no such section; "
                 f"there are {', '.join(SECTIONS)}")  # fmt: skip
    print(machine(), flush=True)
    is_short = "short" in words
    measured: Manifest = {}
    for name in [name for name in SECTIONS if name in words] or list(SECTIONS):
        measure = (SHORT if is_short else SECTIONS)[name]
        measured[name] = {**stamp(), "runs": measure()}
        if not is_short:
            # A section that is not asked for now stays as it was measured before.
            earlier = known().get("peers", {"sections": {}})["sections"]
            manifest = write_manifest("peers", {"sections": {**earlier, **measured}})
            write_text("peers.md", page(manifest))
    if is_short:
        print(page({"sections": measured}))
    else:
        overview.write()


if __name__ == "__main__":
    main(sys.argv[1:])
