"""Names and files in every encoding: terminals that lack letters, files that do not say theirs."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Mapping

from benchmarks.robustness.hostile.running import Content, Line

TERMINALS = ("cp932", "cp936", "cp1251", "ascii", "latin-1", "utf-8")
FILES = ("utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-32", "cp1251", "cp932", "cp936",
         "latin-1", "cp437", "utf-7", "ascii")  # fmt: skip
NAMES = (
    "Bär²",
    "мёд",
    "熊",
    "ﷺ\u202e",
    "\x1b[31mred",
    "naïve±",
    "👩\u200d👩\u200d👧",
    "\ufeff",
    "½",
)
DRAWN = '<path d="M0 30L15 0 30 30z" fill="#abc"/>'


def lines(count: int, seed: int) -> Iterator[Line]:
    """So many runs: terminals and inputs are drawn anew for each."""
    for number in range(count):
        dice = random.Random(f"encodings {seed} {number}")  # noqa: S311 - nothing secret
        sort = sorted(_RUNS)[number % len(_RUNS)]
        words, files = _RUNS[sort](dice)
        given = {name: content for name, content in files.items() if "\x00" not in name}
        outputs = ("-o", dice.choice(("a.svg", "a.dxf", "мёд².svg", "a.geojson")))
        report = ("--report", "report.out")
        yield Line(number, "encodings", (*words, *outputs, *report), given, dice.choice(TERMINALS))


Made = tuple[tuple[str, ...], dict[str, Content]]


def drawings(dice: random.Random) -> Made:
    """SVGs that name one encoding and are in another, and have names of other scripts."""
    name = f"{dice.choice(NAMES)}.svg"
    named = dice.choice((*FILES, "x-no"))
    said = dice.choice(("", f'<?xml version="1.0" encoding="{named}"?>'))
    label = dice.choice(NAMES).replace("\x1b", "")
    text = (
        f'{said}<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 30 30"><title>{label}</title>'
        f"{DRAWN}</svg>"
    )
    files: dict[str, Content] = {name: _encoded(text, dice)}
    return ("fill", "circle", name, "star", "-n", "2", *_SMALL), files


def tables(dice: random.Random) -> Made:
    """Tables of names and numbers."""
    first, second = dice.sample(NAMES, 2)
    text = f"name,n\n{first},1\n{second},2\nplain,3\n".replace(",", dice.choice((",", ";", "\t")))
    name = dice.choice(("t.csv", "мёд.csv", "t.tsv"))
    words = ("chart", "circle", name, "--size-by", "n", "--label-by", "name", *_asked(dice))
    return (*words, *_SMALL), {name: _encoded(text, dice)}


def texts(dice: random.Random) -> Made:
    """Words of a text or of a table."""
    chosen = dice.choice((" ".join(NAMES * 3), "word,weight\n" + ",2\n".join(NAMES) + ",1\n"))
    name = dice.choice(("t.txt", "t.csv"))
    words = ("words", "circle", name, "-n", "6", *_asked(dice), *_SMALL)
    return words, {name: _encoded(chosen, dice)}


def typed(dice: random.Random) -> Made:
    """Words, titles and names of files on the command line itself."""
    first, second = dice.choice(NAMES), dice.choice(NAMES)
    words = dice.choice((
        ("words", "circle", f"{first} {second} ab", *_SMALL),
        ("fill", f"text:{first}", "star", "-n", "2", *_SMALL),
        ("fill", "circle", f"{first}.svg", "-n", "2", *_SMALL),
        ("chart", "circle", "t.csv", "--size-by", first, *_SMALL),
        ("chart", "circle", "t.csv", "--size-by", "n", "--title", f"{first} {second}", *_SMALL),
        ("fill", "circle", "star", "-n", "2", "--padding", first, *_SMALL),
        ("fill", "circle", "star", "-n", "2", "--hero", f"{first}=20%", *_SMALL),
    ))  # fmt: skip
    return words, {"t.csv": b"name,n\na,1\nb,2\n"}


def recipes(dice: random.Random) -> Made:
    """Recipes, which are UTF-8 by right."""
    name = dice.choice(NAMES).replace("\x1b", "")
    text = f'container = "circle"\nitems = ["star"]\ncount = 2\n# {name}\n'
    text += dice.choice(("", f'words = {{source = "{name} ab"}}\n', f'"{name}" = 1\n'))
    return ("run", "r.toml", *_SMALL), {"r.toml": _encoded(text, dice)}


_RUNS: Mapping[str, Callable[[random.Random], Made]] = {
    make.__name__: make for make in (drawings, tables, texts, typed, recipes)
}
_SMALL = ("--effort", "draft", "--levels", "16,32")


def _encoded(text: str, dice: random.Random) -> bytes:
    return text.encode(dice.choice(FILES), errors="replace")


def _asked(dice: random.Random) -> tuple[str, ...]:
    if dice.random() < 0.6:
        return ()
    return ("--encoding", dice.choice((*FILES, "x-no", "base64", "rot13", "")))
