"""Templates: what a new document can begin with, of bundled art or of files that were given."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from packwork import uses
from packwork.errors import ReadError
from packwork.live.document import Document
from packwork.live.face.opening import Opening, opening_of
from packwork.readers.builtin import builtin_item
from packwork.recipe import make_recipe
from packwork.separation.strip import WorkBound
from packwork.uses.nested import Sheet, SheetPart
from packwork.uses.nesting import nest

WORDS: Mapping[str, float] = {
    "garden": 20, "rain": 14, "seed": 12, "bloom": 11, "moss": 9, "fern": 9, "root": 8, "petal": 8,
    "meadow": 7, "dew": 7, "thistle": 6, "willow": 6, "honey": 6, "bee": 6, "clover": 5, "poppy": 5,
    "sage": 5, "ivy": 5, "leaf": 5, "stem": 4, "bud": 4, "soil": 4, "sun": 4, "shade": 4,
    "lavender": 4, "mint": 4, "thyme": 3, "acorn": 3, "bark": 3, "wren": 3, "robin": 3, "pond": 3,
    "reed": 3, "lily": 3, "rose": 3, "briar": 2, "nettle": 2, "spring": 2, "autumn": 2, "breeze": 2,
}  # fmt: skip
"""Words of the cloud, and how much each weighs."""

CUT = ("leaf", "fish", "moon", "bird", "key", "boat", "cat", "anchor", "tree", "whale")
"""Icons that are nested on a sheet."""

CUT_MM, SHEET_MM, APART_MM = 44.0, (300.0, 200.0), 2.0
"""Longer side of each, the sheet, and the distance of parts."""

PASSES = 60
"""Passes of the nest. More lay denser and take longer. Chosen."""

IN_JAR, JAR_SIZE = 64, "10%"
"""Icons that are heaped up in a jar, and the longer side of each. Chosen."""

RELEASE = 2
"""Rounds between one icon that comes in from above and the next. Chosen."""

NAMES = (
    "Ada", "Amélie", "Anouk", "Aras", "Björn", "Chloé", "Cosmin", "Dilan", "Emre", "Farah", "Freya",
    "Greta", "Hugo", "Ines", "Ivo", "Jakub", "Jun", "Kemal", "Lena", "Lionel", "Maja", "Mateo",
    "Mina", "Nadia", "Noah", "Olga", "Omar", "Paula", "Quinn", "Rosa", "Sanne", "Søren", "Tariq",
    "Thea", "Uma", "Vera", "Wanda", "Yara", "Zoë",
)  # fmt: skip
"""Names on the wall."""

WALL = "360x240mm"

ON_PAPER, IN_TILE = ("leaf", "flower", "mushroom", "bird", "snail"), 28
"""Icons of wrapping paper, and how many one cell of it has. Chosen."""

IN_PICTURE = 240
"""Icons that show a picture. Chosen."""


def _cut() -> Opening:
    parts = [
        SheetPart(item=item, count=2, angles=None, scale=CUT_MM / item.outline.extent)
        for item in map(builtin_item, CUT)
    ]
    sheet = Sheet(length=SHEET_MM[0], height=SHEET_MM[1], unit="mm", count=1, name="sheet")
    found = nest(parts, [sheet], gap=APART_MM, work=WorkBound(passes=PASSES))
    return Opening(document=Document.from_layout(found.sheets[0].layout))


def _letters() -> Opening:
    items = ["builtin:icons"]
    return Opening(
        recipe=make_recipe(container="text:HELLO", items=items, count=110, effort="draft")
    )


def _words() -> Opening:
    recipe = uses.words_recipe("builtin:bird", dict(WORDS), effort="draft", palette="ink")
    return Opening(recipe=recipe)


def _jar() -> Opening:
    recipe = uses.pile_recipe(
        "jar",
        ["builtin:icons"],
        count=IN_JAR,
        size=JAR_SIZE,
        open="top",
        emit="top",
        release=RELEASE,
    )
    return Opening(recipe=recipe)


def _names() -> Opening:
    """Names of three sizes, so that none stands out."""
    weights = {name: float(2 + k % 3) for k, name in enumerate(NAMES)}
    recipe = uses.words_recipe("page", weights, canvas=WALL, palette="ink", effort="draft")
    return Opening(recipe=recipe, title="names")


def _badge() -> Opening:
    recipe = uses.words_recipe(
        "circle", dict(WORDS), ring=("THE SECRET GARDEN", "OPEN ALL YEAR"), effort="draft",
        palette="ink",
    )  # fmt: skip
    return Opening(recipe=recipe, title="badge")


def _paper() -> Opening:
    recipe = make_recipe(
        container="page", items=list(ON_PAPER), count=IN_TILE, tile="half-drop", padding="0.7%",
        effort="draft",
    )  # fmt: skip
    return Opening(recipe=recipe, title="wrapping paper")


def _mosaic(folder: Path) -> Opening:
    picture = str(next(folder.iterdir()))
    recipe = make_recipe(
        container="circle", items=["builtin:icons"], picture=picture, count=IN_PICTURE,
        effort="draft",
    )  # fmt: skip
    return Opening(recipe=recipe)


_OWN: Mapping[str, Callable[[], Opening]] = {
    "icons": lambda: opening_of([]), "letters": _letters, "words": _words, "names": _names,
    "badge": _badge, "paper": _paper, "jar": _jar, "nest": _cut
}  # fmt: skip

_OF_FILES: Mapping[str, Callable[[Path], Opening]] = {
    "photos": lambda folder: Opening(
        recipe=uses.photos_recipe("heart", [str(folder)], effort="draft")
    ),
    "mosaic": _mosaic,
}

TEMPLATES = (*_OWN, *_OF_FILES)
"""Names of all templates."""


def template(name: str, folder: Path | None = None) -> Opening:
    """Opening of a template.

    ``folder``: files for those that take some.

    Examples
    --------
    >>> template("letters").recipe.container
    'text:HELLO'
    """
    if name in _OWN:
        return _OWN[name]()
    if folder is None or not any(folder.iterdir()):
        raise ReadError(name, "takes files of yours; choose some")
    return _OF_FILES[name](folder)
