"""Recipes of tables in tables: deep, long, of many parts, and sound ones that nest by right."""

from __future__ import annotations

import json
import random
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from benchmarks.robustness.hostile.running import Line

BEGUN = 'container = "circle"\nitems = ["star"]\n'
OPTIONS = ("count", "padding", "losses", "rules", "words", "chart", "photos", "pile", "film", "x",
           "share", "force", "hero", "levels", "weights", "palette", "filler")  # fmt: skip


def lines(count: int, seed: int) -> Iterator[Line]:
    """So many runs of a recipe."""
    for number in range(count):
        dice = random.Random(f"nested {seed} {number}")  # noqa: S311 - nothing secret
        sort = sorted(_RECIPES)[number % len(_RECIPES)]
        words = ("run", "r.toml", "--effort", "draft", "-o", "a.svg", "--report", "report.out")
        yield Line(number, "nested recipes", words, {"r.toml": _RECIPES[sort](dice).encode()})


def deep_list(dice: random.Random) -> str:
    """Lists in lists."""
    depth = _depth(dice)
    return f"{BEGUN}{dice.choice(OPTIONS)} = {'[' * depth}1{']' * depth}\n"


def deep_table(dice: random.Random) -> str:
    """Tables in tables, in braces, of known names and others."""
    depth = _depth(dice)
    names = [dice.choice(OPTIONS) for _ in range(depth)]
    inside = "".join(f"{{{name} = " for name in names)
    return f"{BEGUN}{dice.choice(OPTIONS)} = {inside}1{'}' * depth}\n"


def long_key(dice: random.Random) -> str:
    """One key, or one heading, of very many parts."""
    key = ".".join([dice.choice(OPTIONS)] + ["a"] * dice.choice((2, 30, 500, 100_000)))
    return BEGUN + dice.choice((f"{key} = 1\n", f"[{key}]\nb = 1\n", f"[[{key}]]\nb = 1\n"))


def long_number(dice: random.Random) -> str:
    """Numbers of very many digits."""
    digits = dice.choice((19, 400, 4_301, 5_000, 100_000))
    said = dice.choice((
        "9" * digits, "-" + "9" * digits, "0x" + "f" * digits, f"0.{'3' * digits}", f"1e{'9' * 9}",
        f'"{"9" * digits}"', f'"{"9" * digits}%"',
    ))  # fmt: skip
    return f"{BEGUN}{dice.choice(OPTIONS)} = {said}\n"


def many(dice: random.Random) -> str:
    """Very many values, keys or rules."""
    count = dice.choice((10, 1_000, 30_000))
    return BEGUN + dice.choice((
        f"{dice.choice(OPTIONS)} = [{'1, ' * count}]\n",
        "".join(f"k{k} = 1\n" for k in range(count)),
        "".join(f'[[rules]]\nitems = "star"\nsize = "{k % 90}%"\n' for k in range(count // 10)),
        f"losses = {{{', '.join(f'a{k} = 1' for k in range(count))}}}\n",
        f"weights = [{', '.join(['1'] * count)}]\n",
    ))  # fmt: skip


def of_parts(dice: random.Random) -> str:
    """Parts that belong to other commands, nested as they are written, with odd values."""
    parts = {
        "words": {"source": "bears and bees", "smallest": _odd(dice), "fonts": [_odd(dice)]},
        "chart": {"data": "t.csv", "size_by": _odd(dice), "paper": _odd(dice)},
        "pile": {"open": _odd(dice), "size": _odd(dice), "emit": [_odd(dice)]},
        "photos": {"sources": [_odd(dice)], "border": _odd(dice)},
        "film": {"seconds": _odd(dice), "easing": _odd(dice)},
        "rules": [{"items": "star", "pin": {"x": _odd(dice), "y": "50%"}, "size": _odd(dice)}],
        "losses": {"evenness": _odd(dice), "overlap": 1},
        "levels": [{"resolution": _odd(dice), "epochs": 2}],
    }
    chosen = dice.sample(sorted(parts), dice.randint(1, 3))
    return BEGUN + "".join(f"{name} = {_toml(parts[name])}\n" for name in chosen)


def spoilt(dice: random.Random) -> str:
    """Names given twice, ends that are missing, signs that are none."""
    return BEGUN + dice.choice((
        "count = 1\ncount = 2\n", "[rules]\n[[rules]]\n", "a = {b = 1, b = 2}\n", 'x = "\n',
        "[" * 9_999, "x = [1, \n" * 400, 'x = """' + "\u0000" * 3, "\ufeffcount = 1\n",
        "count = 3 # " + "x" * 1_000_000 + "\n", '"" = 1\n', '"a\\u001b[31m" = 1\n',
        'items = ["star\\u0000"]\n', "x = 1979-99-99\n", '[rules."\\n".x]\ny = 1\n',
    ))  # fmt: skip


_RECIPES: Mapping[str, Callable[[random.Random], str]] = {
    make.__name__: make
    for make in (deep_list, deep_table, long_key, long_number, many, of_parts, spoilt)
}


def _depth(dice: random.Random) -> int:
    return dice.choice((3, 31, 33, 60, 500, 1_100, 50_000))


def _odd(dice: random.Random) -> Any:
    return dice.choice((
        1, -1, 0.5, 1e308, float("inf"), float("nan"), True, "", "x", "50%", "1e308%", "star", "²",
        [], [[]], {}, {"x": 1}, [{"a": [{"b": []}]}], "9" * 400, 10**18,
    ))  # fmt: skip


def _toml(value: Any) -> str:
    """A value as TOML writes it within a line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {_toml(one)}" for key, one in value.items()) + "}"
    if isinstance(value, list):
        return f"[{', '.join(map(_toml, value))}]"
    if isinstance(value, float):
        return repr(value)
    return json.dumps(value, ensure_ascii=False)
