"""Whole files that inputs are made of: those of the project, and what it writes of them."""

from __future__ import annotations

import io
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib import resources
from pathlib import Path

from fontTools import subset
from fontTools.ttLib import TTFont
from PIL import Image

import packwork as pw
from benchmarks.robustness.wild import wild_files
from packwork import writers

ROOT = Path(__file__).resolve().parents[3]
EXAMPLES = ROOT / "examples"

PICTURE_PX = 128
"""Longest side of pictures: enough to be traced, small enough to be tried by the thousand."""

LETTERS = "abß ونك नमस्ते"
"""What small fonts hold; those who read a font ask for some of it."""

RECIPES = (
    'container = "heart"\nitems = ["star", "circle"]\ncount = 4\nlevels = [16]\nepochs = 2\n',
    'container = "circle"\nitems = ["star", "drop"]\ncount = 5\npadding = "1%"\napart = true\n'
    'levels = [16]\nepochs = 2\nhero = "star@50%,45%=35%"\npalette = "okabe-ito"\n'
    '[[rules]]\nitems = "star"\nregion = [0, 0, "100%", "70%"]\nrotate = 20\nscale = [0.5, 1.5]\n',
    'container = "square"\ncanvas = "200x150mm"\nitems = ["circle"]\ncount = 3\nsizes = "shared"\n'
    'rotate = "none"\nforce = ["down:0.2"]\nlevels = [16]\nepochs = 2\n[losses]\nevenness = 0.5\n',
    'container = "moon"\nlevels = [16]\nepochs = 2\n[words]\nsource = "words.csv"\ncount = 5\n',
    'container = "none"\nlevels = [16]\nepochs = 2\nsizes = "shared"\nrotate = "none"\n'
    '[chart]\ndata = "table.csv"\nsize_by = "weight"\nlabel_by = "word"\n'
    "unit = 5\n",
    'container = "heart"\nlevels = [16]\nepochs = 2\n[photos]\nsources = ["photo.jpg"]\n'
    'shape = "rounded:20%"\nborder = "4%"\n',
)
"""Small ones of each use; those of the examples ask for too much to be run by the thousand."""

TABLE = "word,weight,colour,group\nbear,3,#c33,a\nfox,2.5,navy,b\nowl,1e2,teal,a\nhoney bee,7,,b\n"
TABLE_JSON = '[{"word": "bear", "weight": 3}, {"word": "fox", "weight": 2.5, "group": "a"}]'


@dataclass(frozen=True)
class Original:
    """A file that can be read as it stands."""

    name: str
    data: bytes


@cache
def originals(kind: str) -> tuple[Original, ...]:
    """Files of a kind: drawing, picture, font, table, text, recipe, layout or written."""
    return tuple(_MAKERS[kind]())


def _drawings() -> Iterator[Original]:
    for folder in ("icons", "containers"):
        for file in sorted(resources.files("packwork.bundled").joinpath(folder).iterdir(), key=str):
            yield Original(file.name, file.read_bytes())
    for path in sorted(EXAMPLES.glob("*/*.svg")) + sorted(EXAMPLES.glob("*/*/*.svg")):
        if path.stat().st_size < 100_000:
            yield Original(path.name, path.read_bytes())
    for name, text in wild_files(60, seed=0):
        yield Original(f"{name.split(':')[0]}.svg", text.encode())


def _pictures() -> Iterator[Original]:
    paths = [
        *(EXAMPLES / name for name in ("collage/bear.png", "words-photo/autumn.png")),
        *(EXAMPLES / name for name in ("words-quiet/rocket.jpg", "morph/heart.png")),
        *sorted(EXAMPLES.glob("photos-moon/album/*.jpg"))[:4],
    ]
    for path in paths:
        with Image.open(path) as picture:
            picture.thumbnail((PICTURE_PX, PICTURE_PX))
            for form in ("PNG", "JPEG", "WEBP"):
                shown = picture.convert("RGB") if form == "JPEG" else picture
                ending = "jpg" if form == "JPEG" else form.lower()
                yield Original(f"{path.stem}.{ending}", _saved(shown, form))
            yield Original(f"{path.stem}-p.png", _saved(picture.convert("P"), "PNG"))


def _saved(picture: Image.Image, form: str) -> bytes:
    file = io.BytesIO()
    picture.save(file, form)
    return file.getvalue()


def _fonts() -> Iterator[Original]:
    bundled = resources.files("packwork.bundled").joinpath("fonts/InterDisplay-Black.otf")
    yield from _whole_and_small("inter.otf", bundled.read_bytes())
    for path in sorted(EXAMPLES.glob("words-*/*.ttf")) + sorted(EXAMPLES.glob("words-*/*.otf")):
        yield from _whole_and_small(path.name, path.read_bytes())


def _whole_and_small(name: str, data: bytes) -> Iterator[Original]:
    yield Original(name, data)
    font = TTFont(io.BytesIO(data))
    options = subset.Options(layout_features=["*"], notdef_outline=True)
    small = subset.Subsetter(options)
    small.populate(text=LETTERS)
    small.subset(font)
    file = io.BytesIO()
    font.save(file)
    yield Original(f"small-{name}", file.getvalue())


def _tables() -> Iterator[Original]:
    yield Original("table.csv", TABLE.encode())
    yield Original("table.tsv", TABLE.replace(",", "\t").encode())
    yield Original("table.json", TABLE_JSON.encode())
    for path in sorted(EXAMPLES.glob("*/*.csv")):
        yield Original(path.name, path.read_bytes())


def _texts() -> Iterator[Original]:
    english = resources.files("packwork.bundled").joinpath("words/english.txt")
    yield Original("english.txt", english.read_bytes()[:4_000])
    yield Original("raven.txt", (EXAMPLES / "words-bird" / "raven.txt").read_bytes()[:4_000])
    yield Original(
        "scripts.txt", ("पानी और हवा। 水と空気 ماء وهواء น้ำและอากาศ water, eau! " * 9).encode()
    )


def _recipes() -> Iterator[Original]:
    for number, text in enumerate(RECIPES, start=1):
        yield Original(f"recipe-{number}.toml", text.encode())


@cache
def _layouts() -> tuple[pw.Layout, ...]:
    quick = {"levels": "16", "epochs": 2, "progress": False}
    icons = pw.fill("heart", ["owl", "star", "cat"], count=4, **quick)
    words = pw.words("circle", {"bear": 3, "bee": 2}, **quick)
    return icons, words


def _saved_layouts() -> Iterator[Original]:
    for layout, name in zip(_layouts(), ("icons", "words"), strict=True):
        yield Original(f"{name}.geojson", writers.geojson_text(layout).encode())


def _written() -> Iterator[Original]:
    options = writers.write_options()
    for layout, name in zip(_layouts(), ("icons", "words"), strict=True):
        for ending in (".svg", ".dxf"):
            yield Original(name + ending, writers.encoded(layout, Path(name + ending), options))


_MAKERS = {
    "drawing": _drawings,
    "picture": _pictures,
    "font": _fonts,
    "table": _tables,
    "text": _texts,
    "recipe": _recipes,
    "layout": _saved_layouts,
    "written": _written,
}
