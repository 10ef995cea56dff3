"""Errors survive the way between processes, and are what Python's own errors are."""

from __future__ import annotations

import copy
import inspect
import multiprocessing
import pickle
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from itertools import product
from pathlib import Path

import pytest

import packwork as pw
from each import for_each
from packwork import errors
from packwork.errors import PackworkError, ReadError, RecipeError, RowsLostError, WriteError
from packwork.readers.pictures.decode import opened
from packwork.readers.reading import read_bytes
from packwork.recipe import Recipe, make_recipe
from packwork.recipe.refusals import validated
from packwork.writers.atomic import write_atomic

ALL = [
    kind
    for name, kind in inspect.getmembers(errors, inspect.isclass)
    if issubclass(kind, PackworkError) and not name.startswith("_")
]


def _made(kind: type[PackworkError]) -> PackworkError:
    two = issubclass(kind, (ReadError, WriteError, RecipeError))
    error = kind("a.svg", "is empty; give another") if two else kind("is empty; give another")
    error.add_note("row 3")
    return error


@for_each(product(ALL, range(pickle.HIGHEST_PROTOCOL + 1)))
def test_errors_are_pickled(kind: type[PackworkError], protocol: int) -> None:
    error = _made(kind)
    again = pickle.loads(pickle.dumps(error, protocol))  # noqa: S301
    assert type(again) is kind
    assert (str(again), again.args, vars(again)) == (str(error), error.args, vars(error))


@for_each(product(ALL, [copy.copy, copy.deepcopy]))
def test_errors_are_copied(kind: type[PackworkError], copied: Callable) -> None:
    error = _made(kind)
    again = copied(error)
    assert type(again) is kind
    assert (str(again), again.args, vars(again)) == (str(error), error.args, vars(error))


class OwnError(ReadError):
    """Of a user, made of something else."""

    def __init__(self, row: int, *, column: str) -> None:
        super().__init__("t.csv", f"row {row} has no {column}")
        self.row = row


def test_an_error_made_of_something_else_is_pickled() -> None:
    again = pickle.loads(pickle.dumps(OwnError(3, column="kg")))  # noqa: S301
    assert (again.row, str(again)) == (3, "t.csv: row 3 has no kg")


@pytest.mark.parametrize(
    ("kind", "base"),
    [
        (ReadError, OSError),
        (RowsLostError, OSError),
        (WriteError, OSError),
        (RecipeError, ValueError),
        (errors.ShapeError, ValueError),
    ],
)
def test_errors_are_what_pythons_own_are(kind: type[PackworkError], base: type[Exception]) -> None:
    assert issubclass(kind, base)
    assert str(_made(kind)).endswith("is empty; give another")


def test_an_error_about_a_file_tells_of_no_call_of_the_system() -> None:
    error = ReadError(Path("a.svg"), "is empty")
    assert (error.file, error.problem, error.errno) == ("a.svg", "is empty", None)


def _area(name: str) -> float:
    return round(pw.read_container(name).outline.area)


@pytest.mark.parametrize("start", ["spawn"])
def test_a_bad_name_in_a_pool_leaves_the_other_results(start: str) -> None:
    context = multiprocessing.get_context(start)
    with ProcessPoolExecutor(1, mp_context=context) as pool:
        square, none, again = (pool.submit(_area, name) for name in ("square", "sqare", "square"))
        with pytest.raises(ReadError, match=r"^sqare: there is no such file") as met:
            none.result(timeout=120)
        assert met.value.file == "sqare"
        assert square.result(timeout=120) == again.result(timeout=120) > 0


def test_a_bad_name_ends_the_map_of_a_pool() -> None:
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        with pytest.raises(ReadError, match=r"^sqare: there is no such file"):
            pool.map_async(_area, ["square", "sqare"], chunksize=1).get(timeout=120)
        assert pool.map_async(_area, ["square"]).get(timeout=120)[0] > 0


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"canvas": "no", "count": 0}, "canvas: use"),
        ({"count": 0, "canvas": "no"}, "canvas: use"),
        ({"share": {"a": "x"}}, "share: "),
        ({"hero": "bear@1"}, "hero: use NAME"),
        ({"rotate": "round"}, "rotate: use free"),
        ({"rules": 3}, "rules: must be a list"),
        ({"rules": [{"items": "a", "scale": 2}], "sizes": "shared"}, "rules: rule 1: scale"),
        ({"stay": True}, "stay: needs an earlier layout"),
        ({"words": {"source": "a b", "regexp": "("}}, "regexp: is no regular expression"),
    ],
)
def test_what_validators_say_reaches_the_user(options: dict, said: str) -> None:
    with pytest.raises(RecipeError) as met:
        make_recipe(container="heart", **options)
    assert str(met.value).startswith(said)
    with pytest.raises(ValueError, match=r"^\w+: "):
        validated(Recipe, {"container": "heart", **options})


@pytest.mark.parametrize("asked", [{"close_gaps": "no"}, {"alpha_threshold": 3}])
def test_reading_refuses_options_in_one_line(asked: dict) -> None:
    with pytest.raises(RecipeError, match=rf"^{next(iter(asked))}: "):
        pw.read_container("heart", **asked)


def test_reading_items_refuses_options_in_one_line() -> None:
    with pytest.raises(RecipeError, match=r"^alpha_threshold: "):
        pw.read_items("star", alpha_threshold=3)


def test_what_is_no_file_keeps_its_reason(tmp_path: Path) -> None:
    pipe = Path("/dev/null")
    if not pipe.exists():
        pytest.skip("there are no devices here")
    with pytest.raises(ReadError, match="is a pipe or a device"):
        read_bytes(pipe, 9)
    with pytest.raises(WriteError) as met:
        write_atomic("a\0b", b"")
    assert "cannot be written" not in str(met.value)


def test_a_block_that_reads_a_picture_keeps_its_own_error() -> None:
    from io import BytesIO

    from PIL import Image

    file = BytesIO()
    Image.new("L", (3, 2)).save(file, "PNG")
    with (
        pytest.raises(ReadError, match=r"^b\.svg: is empty$"),
        opened(file.getvalue()),
    ):
        raise ReadError("b.svg", "is empty")


class Watch:
    """An observer that asks to be told every so many epochs."""

    def __init__(self, every: object) -> None:
        self.every = every

    def on_step(self, step: pw.Step) -> None:
        """Hear nothing."""


@pytest.mark.parametrize("every", [0, -3, "3", 2.5, None])
def test_an_observer_that_is_told_at_no_time_is_one_line(every: object) -> None:
    with pytest.raises(RecipeError, match=r"^observer: every must be a whole number"):
        pw.fill("heart", "star", count=1, observer=Watch(every))  # type: ignore[arg-type]


@pytest.mark.parametrize("stop", [None, 3])
def test_what_cannot_be_asked_to_stop_is_one_line(stop: object) -> None:
    with pytest.raises(RecipeError, match=r"^stop: must be a function"):
        pw.fill("heart", "star", count=1, stop=stop)  # type: ignore[arg-type]


@pytest.mark.parametrize("art", [None, 3, object()])
def test_an_item_without_art_is_one_line(art: object) -> None:
    with pytest.raises(errors.ShapeError, match=r"^the art of the item 'tile' must be a colour"):
        pw.Item("tile", outline=[(0, 0), (4, 0), (4, 2)], art=art)  # type: ignore[arg-type]


@pytest.mark.parametrize("words", ["", " \n", {}, {" ": 1}, {"\u200b": 1}])
def test_words_that_are_none_are_one_line(words: object) -> None:
    with pytest.raises(ReadError) as met:
        pw.words("heart", words)
    assert "\n" not in str(met.value)


@pytest.mark.parametrize("container", [None, 3, [], {"a": 1}, set(), object(), True])
def test_a_container_of_an_odd_type_is_one_line(container: object) -> None:
    with pytest.raises(RecipeError, match=r"^container: is \w+, which cannot be read"):
        pw.fill(container, "star")  # type: ignore[arg-type]
