"""Words beside the ``wordcloud`` package: ``packwork bench words [SECTION...] [examples=PATH]``.

Sections: fat, thin, default, thousand; all without a word. ``examples=PATH`` runs the peer's own
examples by either package, ``pairs=PATH`` makes the page of pictures of them; PATH is the peer's
source distribution, unpacked (``pip download --no-binary :all: --no-deps wordcloud``). ``short``
only prints, with fewer words, shapes and rounds. The peer, and what its examples import but for
jieba, comes with ``pip install '.[bench]'``. Writes docs/manifests/words.json, whose other sections
stay as they were, and the page.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")

from benchmarks.kit.manifests import Manifest, known, write_manifest, write_text
from benchmarks.kit.measuring import machine
from benchmarks.words import clouds, drop_in, examples, pairs
from benchmarks.words.thin_shapes import thin_shapes
from benchmarks.words.words_page import page
from packwork import precompile

FAT = ("bird", "bear", "dragon", "cat", "heart")
COUNTS = (100, 400)
THOUSAND = 1_000
FEW = 20
"""Words of a short run."""


def fat(*, is_short: bool) -> Manifest:
    """Containers with much room, ours and the peer's ways of sizes."""
    programs = (
        clouds.ours, clouds.our_graded, clouds.our_free, clouds.peer, clouds.proportional_peer
    )  # fmt: skip
    names, counts = (FAT[:1], (FEW,)) if is_short else (FAT, COUNTS)
    return {"rows": [row for count in counts for row in clouds.records(names, count, programs)]}


def thin(*, is_short: bool) -> Manifest:
    """Containers with little."""
    shapes = thin_shapes()[:2] if is_short else thin_shapes()
    programs = (clouds.our_choice, clouds.peer)
    return {"rows": clouds.records(shapes, FEW if is_short else COUNTS[0], programs)}


def default(*, is_short: bool) -> Manifest:
    """The cloud that most programs make, in turn in this process."""
    import wordcloud
    from packwork import wordcloud as ours

    few = {"rounds": 1, "count": FEW} if is_short else {}
    return drop_in.default_cloud(wordcloud, ours, **few)


def thousand(*, is_short: bool) -> Manifest:
    """Many words at once."""
    programs = (clouds.our_graded, clouds.ours)
    return {"rows": clouds.records(["heart"], FEW if is_short else THOUSAND, programs)}


SECTIONS: dict[str, Callable[..., Manifest]] = {
    "fat": fat, "thin": thin, "default": default, "thousand": thousand,
}  # fmt: skip


def main(words: list[str]) -> None:
    """Measure, print, write the manifest and the page after each section."""
    paths = dict(word.split("=", 1) for word in words if "=" in word)
    asked = [word for word in words if "=" not in word and word != "short"]
    _check({*asked, *paths})
    is_short = "short" in words
    print(machine(), flush=True)
    precompile.warm_up()
    for name in asked or ([] if paths else list(SECTIONS)):
        _keep(name, SECTIONS[name](is_short=is_short), is_short)
    if "examples" in paths:
        found = examples.all_examples(Path(paths["examples"]), 1 if is_short else examples.ROUNDS)
        _keep("examples", found, is_short)
    if "pairs" in paths:
        pairs.write(Path(paths["pairs"]))


def _check(asked: set[str]) -> None:
    unknown = asked - {*SECTIONS, "examples", "pairs"}
    if unknown:
        sys.exit(f"packwork: bench words: {', '.join(sorted(unknown))}: no such section; there are "
                 f"{', '.join(SECTIONS)}, examples=PATH, pairs=PATH")  # fmt: skip
    if examples.peer_version() is None:
        sys.exit("packwork: bench words: wordcloud is not installed; pip install '.[bench]'")


def _keep(name: str, found: Manifest, is_short: bool) -> None:
    """A section into the manifest, the others as they were measured before; or printed."""
    measured = {name: {**examples.stamped(), "peer": examples.peer_version(), **found}}
    if is_short:
        print(page({"sections": measured}))
        return
    earlier = known().get("words", {}).get("sections", {})
    manifest = write_manifest("words", {"sections": {**earlier, **measured}})
    write_text("words.md", page(manifest))


if __name__ == "__main__":
    main(sys.argv[1:])
