"""One input given to the program: what came of it."""

from __future__ import annotations

import contextlib
import logging
import signal
import time
import traceback
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import FrameType
from typing import Any

from benchmarks.robustness.hostile.inputs import Input
from benchmarks.robustness.hostile.originals import PICTURE_PX, TABLE, originals
from packwork import pipeline, uses, writers
from packwork.errors import PackworkError
from packwork.metrics.measure import measure
from packwork.readers.container import read_container
from packwork.readers.items import read_items
from packwork.readers.layouts.read import read_written
from packwork.readers.photo_options import PhotoOptions
from packwork.readers.photos import read_photos
from packwork.readers.recipe import read_recipe
from packwork.readers.svg.curve import walled_container
from packwork.readers.tables.pairs import read_weights
from packwork.readers.words.items import read_word_items
from packwork.recipe import make_recipe
from packwork.uses.charts.marks import read_chart
from packwork.uses.charts.recipe import chart_recipe
from packwork.uses.words.recipe import words_recipe

SECONDS_AT_MOST = 20.0
"""Of the processor, for one input: more is a hang, as a person would have given up."""

FEW = 12
"""Items up to which a recipe is run too, stopped at once; more take time by right."""

SUCCESS, CLEAR_ERROR, CRASH, HANG = "successes", "clear errors", "crashes", "hangs"


class TimeUpError(BaseException):
    """Raised by the alarm, past every ``except Exception``."""


@dataclass(frozen=True)
class Tried:
    """What came of one input, and in how many seconds of the processor."""

    number: int
    came: str
    seconds: float
    said: str = ""
    lost: int = 0


def attempt(one: Input, folder: Path) -> Tried:
    """Put an input into an empty folder and let the program read it."""
    path = folder / one.name
    path.write_bytes(one.data)
    beside = _company(one, folder)
    began = time.process_time()
    try:
        with _alarm(), warnings.catch_warnings(), contextlib.chdir(folder):
            warnings.simplefilter("error")
            _USES[one.use](path)
        came, said = SUCCESS, ""
    except PackworkError as error:
        came, said = CLEAR_ERROR, " ".join(str(error).split())
        if not said:
            came = CRASH
    except TimeUpError:
        came, said = HANG, traceback.format_exc(limit=-8)
    except BaseException:  # noqa: BLE001 - whatever else it is, it is what is looked for
        came, said = CRASH, traceback.format_exc(limit=-12)
    seconds = time.process_time() - began
    there = {file.name: file.read_bytes() for file in folder.iterdir()}
    expected = {one.name: one.data, **beside}
    lost = sum(there.get(name) != data for name, data in expected.items())
    lost += sum(name not in expected for name in there)
    for name in there:
        (folder / name).unlink()
    return Tried(one.number, came, seconds, said, lost)


def _company(one: Input, folder: Path) -> dict[str, bytes]:
    """Files that a recipe names."""
    if one.use != "recipe":
        return {}
    photo = next(file.data for file in originals("picture") if file.name.endswith(".jpg"))
    beside = {"words.csv": TABLE.encode(), "table.csv": TABLE.encode(), "photo.jpg": photo}
    for name, data in beside.items():
        (folder / name).write_bytes(data)
    return beside


@contextlib.contextmanager
def _alarm() -> Iterator[None]:
    def ring(number: int, frame: FrameType | None) -> None:
        raise TimeUpError

    before = signal.signal(signal.SIGPROF, ring)
    signal.setitimer(signal.ITIMER_PROF, SECONDS_AT_MOST)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def _item(path: Path) -> None:
    for holes in ("fill", "keep"):
        read_items([str(path)], holes=holes)


def _container(path: Path) -> None:
    read_container(path)
    if path.suffix == ".svg":
        walled_container(str(path), 100.0)


def _around(path: Path) -> None:
    read_container(f"around:{path}", float(PICTURE_PX))


def _photo(path: Path) -> None:
    read_photos(PhotoOptions(sources=(str(path),), border="4%", shape="rounded:10%"))


def _letters(path: Path) -> None:
    read_container("text:abß", 100.0, font=path)


def _words(path: Path) -> None:
    options: dict[str, Any] = {"count": 30}
    source: Any = str(path)
    if path.suffix in {".ttf", ".otf"}:
        source, options = {"ab": 2, "नमस्ते": 1, "ونك": 1}, {"font": str(path)}
        recipe = words_recipe("circle", source, fonts=[str(path)])
    else:
        recipe = words_recipe("circle", source, **options)
    assert recipe.words is not None
    read_word_items(recipe.words)


def _chart(path: Path) -> None:
    recipe = chart_recipe("circle", str(path), size_by="weight", color_by="group")
    assert recipe.chart is not None
    read_chart(recipe.chart)


def _weights(path: Path) -> None:
    if path.suffix == ".json":
        return _chart(path)
    read_weights(path)
    return None


def _recipe(path: Path) -> None:
    recipe = make_recipe(**read_recipe(path))
    job = uses.read(recipe)
    if len(job.items) > FEW:
        return
    layout = pipeline.run(job, stop=lambda: True).layout
    writers.encoded(layout, Path("layout.svg"))
    writers.recipe_bytes(recipe.plain(), path.parent)


def _layout(path: Path) -> None:
    layout = read_written(path)
    measure(layout)
    writers.encoded(layout, Path("layout.svg"))


_USES = {
    "item": _item,
    "container": _container,
    "around": _around,
    "photo": _photo,
    "letters": _letters,
    "words": _words,
    "chart": _chart,
    "weights": _weights,
    "recipe": _recipe,
    "layout": _layout,
}


def hush() -> None:
    """Let notices be put together, but shown to nobody."""
    logger = logging.getLogger("packwork")
    logger.addHandler(_Unheard())
    logger.propagate = False


class _Unheard(logging.Handler):
    def emit(self, record: logging.LogRecord) -> None:
        record.getMessage()
