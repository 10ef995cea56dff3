"""Like things side by side: ``packwork bench embeddings``.

Icons of five planted clusters, and words of the project's own documents by which of them stand
together: what lies beside an item, and what that costs in coverage and time, beside the same run
without.
"""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np
from scipy.spatial import cKDTree

from benchmarks.kit.manifests import write_page
from benchmarks.kit.measuring import DOCS, markdown_table
from packwork import precompile, uses
from packwork.arrays import FloatArray, IntArray
from packwork.assignment.embedding import assigned
from packwork.pipeline.result import Run
from packwork.readers.container import read_container
from packwork.readers.words.cooccurrence import information, pairs_within, places_of
from packwork.readers.words.tokens import sentences
from packwork.recipe import make_recipe
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.start.first_poses import container_image
from packwork.start.places import stippled

COUNTS, KINDS, NEAREST = (100, 400), 5, 5
CONTAINERS = ("circle", "heart", "square")
WORDS, SEEDS = 100, (0, 1, 2)
SHAPES = ("circle", "heart")
CONSTITUTION = DOCS.parent / "examples" / "words-meaning" / "constitution.txt"

ICON_HEADER = ["container", "icons", "of its cluster", "without", "of discs", "covered", "without",
               "seconds over those without", "certified"]  # fmt: skip
WORD_HEADER = ["text", "container", "information shared", "without", "ratio", "ink", "without",
               "ratio", "certified"]  # fmt: skip

PAGE = """# Like things side by side

Made by `packwork bench embeddings` on {date}.
{machine}.

## Icons of five clusters

Vectors of 20 numbers about five centres, drawn by chance; icons of free sizes, all different to the
program. "Of its cluster": share of the {nearest} nearest icons, by their centres, that are of an
icon's own cluster. "Of discs": the same of as many even points in the container, assigned without
regard to any form; that icons have more is since unlike neighbours are drawn apart before the gaps
are made even. Covered is exact.

{icons}

## Words of a text

The {words} most frequent words of this project's own documents, and of the Constitution of the
United States; `--embeddings auto`, sizes in proportion; means of seeds {seeds}. "Information
shared": mean positive pointwise mutual information, in bits, of a word with its {nearest} nearest.
Ink: share of the container.

{clouds}
"""


def nearest(points: FloatArray) -> IntArray:
    return np.asarray(cKDTree(points).query(points, NEAREST + 1)[1][:, 1:])


def alike(points: FloatArray, kinds: IntArray) -> float:
    return float((kinds[nearest(points)] == kinds[:, None]).mean())


def centres(layout: Layout) -> FloatArray:
    return np.column_stack([layout.poses.x, layout.poses.y])


def of_discs(container: str, vectors: FloatArray, kinds: IntArray) -> float:
    """Share of an assignment to even points."""
    image, _ = container_image(read_container(container), 200)
    rng = np.random.default_rng(0)
    found = stippled(image, np.ones_like(image), len(kinds), rng)
    points = np.column_stack([found.x, found.y])
    return alike(points[assigned(vectors, points, rng)], kinds)


def icon_row(container: str, count: int, folder: Path) -> list[str]:
    rng, kinds = np.random.default_rng(0), np.arange(count) % KINDS
    vectors = rng.standard_normal((KINDS, 20))[kinds] + 0.3 * rng.standard_normal((count, 20))
    np.save(folder / "vectors.npy", vectors)
    recipe = make_recipe(container=container, count=count)
    drawn = uses.read(recipe).items
    items = [Item(f"item {k}", f"item {k}", item.outline, item.ink, item.art)
             for k, item in enumerate(drawn)]  # fmt: skip
    plain = uses.fill(recipe, items)
    with_vectors = recipe.model_copy(update={"embeddings": str(folder / "vectors.npy")})
    run = uses.fill(with_vectors, items)
    shares = [f"{alike(centres(one.layout), kinds):.2f}" for one in (run, plain)]
    covered = [f"{one.metrics.exact.coverage:.3f}" for one in (run, plain)]
    seconds = [sum(one.seconds.values()) for one in (run, plain)]
    return [container, str(count), *shares, f"{of_discs(container, vectors, kinds):.2f}", *covered,
            f"{seconds[0] / seconds[1]:.2f}", "yes" if run.certified else "no"]  # fmt: skip


def shared(layout: Layout, text: str) -> float:
    """Mean information that words share with their nearest."""
    names = [item.name for item in layout.items]
    bits = information(pairs_within(places_of(sentences(text), names), len(names)))
    return float(bits[np.arange(len(names))[:, None], nearest(centres(layout))].mean())


def ink(layout: Layout) -> float:
    pairs = zip(layout.items, layout.poses.scale, strict=True)
    drawn = sum(item.ink.area * scale**2 for item, scale in pairs)
    return float(drawn / layout.container.outline.area)


def word_row(shape: str, name: str, file: Path) -> list[str]:
    text = file.read_text(encoding="utf-8")

    def runs(embeddings: str | None) -> list[Run]:
        return [
            uses.fill(
                uses.words_recipe(
                    shape, str(file), count=WORDS, seed=seed, sizes="shared", embeddings=embeddings
                )
            )
            for seed in SEEDS
        ]

    with_text, plain = runs("auto"), runs(None)
    bits = [float(np.mean([shared(one.layout, text) for one in some]))
            for some in (with_text, plain)]  # fmt: skip
    inks = [float(np.mean([ink(one.layout) for one in some])) for some in (with_text, plain)]
    certified = "yes" if all(one.certified for one in (*with_text, *plain)) else "no"
    return [name, shape, *(f"{one:.2f}" for one in bits), f"{bits[0] / bits[1]:.2f}",
            *(f"{one:.3f}" for one in inks), f"{inks[0] / inks[1]:.3f}", certified]  # fmt: skip


def main() -> None:
    precompile.warm_up()
    icons, clouds = list[list[str]](), list[list[str]]()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for count in COUNTS:
            for container in CONTAINERS:
                icons.append(icon_row(container, count, folder))
                print("  ".join(icons[-1]), flush=True)
        text = folder / "documents.txt"
        pages = sorted([*DOCS.glob("*.md"), *(DOCS / "decisions").glob("*.md")])
        text.write_text("\n".join(page.read_text(encoding="utf-8") for page in pages), "utf-8")
        for called, file in (("documents", text), ("constitution", CONSTITUTION)):
            for shape in SHAPES:
                clouds.append(word_row(shape, called, file))
                print("  ".join(clouds[-1]), flush=True)
    write_page(
        "embeddings.md", PAGE, nearest=str(NEAREST), words=str(WORDS),
        seeds=", ".join(map(str, SEEDS)), icons=markdown_table(ICON_HEADER, icons),
        clouds=markdown_table(WORD_HEADER, clouds),
    )  # fmt: skip


if __name__ == "__main__":
    main()
