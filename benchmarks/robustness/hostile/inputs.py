"""Ten thousand inputs, and what the program is asked to make of each."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np
from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st

from benchmarks.robustness.hostile.made_up import DRAWINGS, LAYOUTS, RECIPES, TABLES
from benchmarks.robustness.hostile.mutations import (
    MOST_BYTES,
    Mutate,
    by_bytes,
    by_chunks,
    by_font_tables,
    by_json,
    by_toml,
    by_words,
)
from benchmarks.robustness.hostile.originals import Original, originals

MADE_UP_SHARE = 0.3
"""Share of the inputs that hypothesis makes up, where it can; the others are mutations."""


@dataclass(frozen=True)
class Kind:
    """Inputs of one sort.

    Parameters
    ----------
    files
        What they are mutations of.
    share
        Of all inputs.
    mutations
        Ways to change one, equally often.
    uses
        What they are read as, in turn.
    made_up
        What hypothesis makes of them.
    ending
        Of files that are made up.
    """

    files: str
    share: float
    mutations: tuple[Mutate, ...]
    uses: tuple[str, ...]
    made_up: st.SearchStrategy[bytes] | None = None
    ending: str = ""


KINDS = {
    "drawings": Kind("drawing", 0.3, (by_bytes, by_words, by_words), ("item", "item", "container"),
                     DRAWINGS, ".svg"),
    "pictures": Kind("picture", 0.15, (by_bytes, by_chunks),
                     ("item", "container", "photo", "around")),
    "fonts": Kind("font", 0.1, (by_bytes, by_font_tables, by_font_tables), ("letters", "words")),
    "tables": Kind("table", 0.1, (by_bytes, by_words), ("words", "chart", "weights"),
                   TABLES, ".csv"),
    "texts": Kind("text", 0.05, (by_bytes, by_words), ("words",)),
    "recipes": Kind("recipe", 0.1, (by_words, by_toml, by_toml), ("recipe",), RECIPES, ".toml"),
    "layouts": Kind("layout", 0.1, (by_bytes, by_words, by_json, by_json), ("layout",),
                    LAYOUTS, ".geojson"),
    "written files": Kind("written", 0.1, (by_bytes, by_words), ("layout",)),
}  # fmt: skip


@dataclass(frozen=True)
class Input:
    """One file, and what it is read as."""

    number: int
    kind: str
    use: str
    name: str
    data: bytes = field(repr=False)


def inputs(count: int, number: int, kinds: Sequence[str] = ()) -> Iterator[Input]:
    """``count`` inputs, the same ones for the same number of the lot; all kinds if none."""
    rng = np.random.default_rng(number)
    chosen = {name: kind for name, kind in KINDS.items() if name in kinds or not kinds}
    whole = sum(kind.share for kind in chosen.values())
    done = 0
    for name, kind in chosen.items():
        for file, use in _of_kind(kind, round(count * kind.share / whole), rng):
            yield Input(done, name, use, file.name, file.data)
            done += 1


def _of_kind(kind: Kind, count: int, rng: np.random.Generator) -> Iterator[tuple[Original, str]]:
    made = [] if kind.made_up is None else _made_up(kind, round(MADE_UP_SHARE * count), rng)
    known = originals(kind.files)
    for k in range(count):
        use = kind.uses[k % len(kind.uses)]
        if k < len(made):
            yield Original(f"made-up{kind.ending}", made[k]), use
            continue
        file = known[int(rng.integers(len(known)))]
        yield Original(file.name, _mutated(file, kind.mutations, rng)), use


def _mutated(file: Original, ways: tuple[Mutate, ...], rng: np.random.Generator) -> bytes:
    is_tree = {by_json: ".json", by_chunks: ".png"}
    way = ways[int(rng.integers(len(ways)))]
    if way in is_tree and not file.name.endswith((is_tree[way], ".geojson")):
        way = by_bytes
    return way(file.data, rng)[:MOST_BYTES]


def _made_up(kind: Kind, count: int, rng: np.random.Generator) -> list[bytes]:
    assert kind.made_up is not None
    made: list[bytes] = []

    @seed(int(rng.integers(2**32)))
    @settings(
        max_examples=max(count, 1), database=None, deadline=None, phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )  # fmt: skip
    @given(kind.made_up)
    def keep(data: bytes) -> None:
        made.append(data)

    keep()
    return made[:count]
