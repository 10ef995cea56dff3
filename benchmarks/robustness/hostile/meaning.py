"""Command lines and recipes that are right in form and odd in what they mean.

Tiny and huge canvases, one to three items, paddings that leave no room, wishes that cannot be
met together, outputs of every format, terminals of every encoding.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence

from benchmarks.robustness.hostile.running import Line

ENCODINGS = ("utf-8", "ascii", "cp932", "cp936", "cp1251", "latin-1")

_HAIR = "".join(f"M{k} 0h.01V30h-.01z" for k in range(30))
_TURNS = ((1, -1), (1, 1), (-1, 1), (-1, -1))
_SPIRAL = " ".join(
    f"{15 + k / 30 * _TURNS[k % 4][0]:.2f} {15 + k / 30 * _TURNS[k % 4][1]:.2f}" for k in range(400)
)
DRAWINGS: Mapping[str, str] = {
    "two.svg": '<circle cx="6" cy="6" r="5"/><circle cx="24" cy="24" r="4" fill="red"/>',
    "hair.svg": f'<path d="{_HAIR}"/>',
    "spiral.svg": f'<path fill="none" stroke="#000" stroke-width=".2" d="M{_SPIRAL}"/>',
    "speck.svg": '<path d="M15 15h.001v.001h-.001z"/>',
    "ring.svg": '<path fill-rule="evenodd" d="M0 0h30v30H0zM1 1v28h28V1z"/>',
    "Bär².svg": '<path d="M0 30L15 0 30 30z" fill="#abc"/>',
}
TABLES: Mapping[str, str] = {
    "t.csv": "name,n,kind\na,1,x\nb,1000000,y\nc,0.001,x\n",
    "one.csv": "name,n,kind\nonly,1,x\n",
    "words.csv": "word,weight\nbear,1\nB²,1000\nو,3\n",
}

FILES: Mapping[str, bytes] = {
    **{
        name: f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 30 30">{inside}</svg>'.encode()
        for name, inside in DRAWINGS.items()
    },
    **{name: text.encode() for name, text in TABLES.items()},
}

_CANVASES = ("0.5mm", "0.01mm", "1x1000", "600", "20000in", "A6", "3px", "7x5cm")
_LENGTHS = ("0", "0.1mm", "1%", "20%", "50%", "99%", "1e6")
_ITEMS = ("star", "circle", "stripe:6", *(name for name in DRAWINGS if name != "speck.svg"))
_CONTAINERS = ("circle", "cross", "text:A", "islands", "square", *DRAWINGS)
_COMMON: Mapping[str, Sequence[str]] = {
    "--canvas": _CANVASES,
    "--padding": _LENGTHS,
    "--seed": ("0", "9223372036854775807"),
    "--rotate": ("none", "free", "0.001", "0,90", "mixed"),
    "--palette": ("okabe-ito", "#fff,#000"),
    "--holes": ("keep", "fill"),
    "--background": ("none", "ivory", "#0008"),
    "--cut": ("outlines", "silhouette"),
    "--kiss-cut": ("0.1mm", "5%"),
    "--pixels": ("1", "40"),
}
_SOLVED: Mapping[str, Sequence[str]] = {
    "--finish": ("exact", "none"),
    "--levels": ("8", "16,32", "24:1,48:3"),
    "--epochs": ("1", "20"),
    "--start": ("scatter", "distance-field", "medial-axis", "first-fit"),
    "--loss": ("evenness=5", "area-shares=1e9", "overlap=0"),
    "--size-ratio": ("1", "100"),
    "--sizes": ("free", "shared", "fixed"),
    "--hero": ("star=90%", "circle@0%,0%=1%", "star@50%,50%"),
    "--force": ("down", "balance horizontal", "together", "away 50%,50% strength=1000"),
    "--target-coverage": ("1%", "0.999"),
    "--max-items": ("1", "30"),
    "--smallest": ("0.1%", "30%", "99%"),
    "--filler": ("star", "two.svg", "*.svg", "hair.svg"),
}
_OWN: Mapping[str, Mapping[str, Sequence[str]]] = {
    "fill": {
        **_SOLVED,
        "--stretch": ("1", "1.2", "3"),
        "--apart": ("",),
        "--preset": ("paper",),
        "--show-container": ("",),
        "--flatten": ("",),
    },
    "words": {
        **{key: _SOLVED[key] for key in ("--finish", "--levels", "--epochs", "--force")},
        "--largest": ("1%", "90%", "5pt"),
        "--smallest": ("0.1%", "40%"),
        "--weight-is": ("area", "ink", "height"),
        "--add": ("star", "two.svg"),
        "--text": ("live", "outlines"),
        "--case": ("upper", "lower"),
        "--contrast": ("1", "21"),
    },
    "chart": {
        **{key: _SOLVED[key] for key in ("--finish", "--levels", "--epochs")},
        "--size-by": ("n",),
        "--unit": ("1", "1e5"),
        "--label-by": ("name",),
        "--color-by": ("kind", "n"),
        "--by": ("kind",),
        "--title": ("T²", "long " * 60),
        "--mark": ("star", "two.svg", "hair.svg"),
        "--no-legend": ("",),
    },
    "pile": {
        "--size": ("0.1%", "10%", "95%", "3mm"),
        "--open": ("top", "left"),
        "--emit": ("top", "50%,50%", "in circle"),
        "--compact": ("",),
        "--force": ("down", "up", "towards centre", "inward"),
    },
}
_SMALL = {"--levels": "16,32", "--epochs": "15"}
"""What is asked for where nothing else is: runs are many, and odd, not long."""

_OUTPUTS = ("a.svg", "a.png", "a.geojson", "a.dxf", "a.pdf", "ä².svg")
_KEYS = ("container", "items", "count", "padding", "rules", "words", "chart", "pile", "photos",
         "film", "losses", "levels", "share", "force", "font", "keep_clear", "nothing")  # fmt: skip


def lines(count: int, seed: int) -> Iterator[Line]:
    """So many runs, the same for the same seed: one in four is a recipe."""
    for number in range(count):
        dice = random.Random(f"{seed} {number}")  # noqa: S311 - nothing secret
        encoding = dice.choice(ENCODINGS)
        if number % 4 == 3:
            recipe = "\n".join(_recipe(dice))
            words: tuple[str, ...] = ("run", "r.toml", "--effort", "draft", "-o", "a.svg",
                                      "--report", "report.out")  # fmt: skip
            yield Line(number, "recipes", words, {**FILES, "r.toml": recipe.encode()}, encoding)
        else:
            yield Line(number, "command lines", tuple(_words(dice)), FILES, encoding)


def _words(dice: random.Random) -> Iterator[str]:
    verb = dice.choice(("fill", "fill", "words", "chart", "pile"))
    yield from (verb, dice.choice(_CONTAINERS))
    if verb == "words":
        yield dice.choice(("words.csv", "bears and bees and bears", "B² و 熊 熊"))
    elif verb == "chart":
        yield dice.choice(("t.csv", "one.csv"))
    else:
        yield from dice.sample(_ITEMS, dice.randint(1, 3))
    if verb != "chart":
        yield from ("-n", dice.choice(("1", "2", "3", "12")))
    choices = {**_COMMON, **_OWN[verb]}
    chosen = dice.sample(sorted(choices), dice.randint(0, 7))
    for option in chosen:
        value = dice.choice(choices[option])
        yield option
        if value:
            yield value
    if verb != "pile" and dice.random() < 0.9:
        yield from ("--effort", "draft")
    for option, value in _SMALL.items():
        if option in choices and option not in chosen:
            yield from (option, value)
    if {"--filler", "--target-coverage"} & {*chosen} and "--max-items" not in chosen:
        yield from ("--max-items", "30")
    for output in dice.sample(_OUTPUTS, dice.randint(1, 2)):
        yield from ("-o", output)
    yield from ("--report", "report.out")
    if dice.random() < 0.3:
        yield from ("--save-recipe", "save-recipe.out")


def _recipe(dice: random.Random) -> Iterator[str]:
    """Lines of a recipe: half of them sound, the rest of any type, nested or not."""
    yield 'container = "circle"'
    yield 'items = ["star"]'
    yield f"count = {dice.choice((1, 2, 3))}"
    for key in dice.sample(_KEYS[3:], dice.randint(0, 3)):
        yield f"{key} = {_toml(dice, dice.randint(0, 4))}"


def _toml(dice: random.Random, depth: int) -> str:
    plain = ("1", "-1", "0.5", "nan", "inf", "true", '""', '"star"', '"50%"', '"²"', "1979-05-27",
             "9" * 400, '"%s"' % ("x" * 3_000), "[]", "{}")  # fmt: skip
    if depth == 0:
        return dice.choice(plain)
    inside = [_toml(dice, depth - 1) for _ in range(dice.randint(1, 3))]
    if dice.random() < 0.5:
        return f"[{', '.join(inside)}]"
    keys = dice.sample((*_KEYS, "x", "y", "size", "pin", "source", "data", "sources"), len(inside))
    return (
        "{" + ", ".join(f"{key} = {value}" for key, value in zip(keys, inside, strict=True)) + "}"
    )
