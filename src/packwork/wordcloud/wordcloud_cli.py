"""The other package's command line, under its names, so that scripts written for it run.

``packwork words`` has options of its own, one name for one meaning in all commands; what
this one takes and writes is what ``wordcloud_cli`` takes and writes.
"""

from __future__ import annotations

import argparse
import io
import re
import sys
from collections.abc import Sequence
from importlib import metadata
from pathlib import Path
from typing import IO, Any

import numpy as np
import numpy.typing as npt
from PIL import Image

import packwork.wordcloud as wc
from packwork.errors import PackworkError, WriteError
from packwork.sources import note_input, noting_inputs
from packwork.wordcloud.colours import (
    ImageColorGenerator,
    get_single_color_func,
    random_color_func,
)
from packwork.writers.atomic import check_writable, write_atomic

STANDARD = "-"
"""Stands for standard input and output."""

_VALUES: Sequence[tuple[str, type, Any, str]] = (
    ("contour_width", float, 0, "width of the mask's line; 0 draws none"),
    ("contour_color", str, "black", "colour of that line"),
    ("relative_scaling", float, 0, "how far sizes follow frequencies, 0 to 1"),
    ("margin", int, 2, "least distance of two words"),
    ("width", int, 400, "of the picture"),
    ("height", int, 200, "of the picture"),
    ("min_word_length", int, 0, "letters that a word has at least"),
    ("prefer_horizontal", float, 0.9, "share of words that are not turned"),
    ("scale", float, 1, "pixels of the picture for each of the canvas"),
    ("colormap", str, "viridis", "palette of ours, or colour map of matplotlib"),
    ("mode", str, "RGB", "RGB, or RGBA for a clear background"),
    ("max_words", int, 200, "words at most"),
    ("min_font_size", int, 4, "smallest size of a word"),
    ("max_font_size", int, None, "largest size of a word"),
    ("font_step", int, 1, "least difference of the sizes tried"),
    ("random_state", int, None, "seed"),
)
"""Options that go to the class as they are: name, kind, default, help."""


def make_parser() -> argparse.ArgumentParser:
    """Parser of the other package's options."""
    parser = argparse.ArgumentParser(
        prog=_own_name(),
        description="A simple command line for word clouds, with the options of wordcloud_cli.",
    )
    file: dict[str, Any] = {"metavar": "FILE"}
    parser.add_argument("--text", default=STANDARD, help="text; default: standard input", **file)
    parser.add_argument("--regexp", type=_pattern, help="what counts as a word")
    parser.add_argument("--stopwords", help="words to leave out, one a line", **file)
    parser.add_argument(
        "--imagefile", default=STANDARD, help="PNG to write; default: standard output", **file
    )
    parser.add_argument("--fontfile", dest="font_path", help="font", **file)
    parser.add_argument("--mask", help="picture to fill: all that is not white", **file)
    parser.add_argument("--colormask", help="picture that colours the words", **file)
    parser.add_argument("--color", help="one colour for all words, in changing brightness")
    parser.add_argument("--background", default="black", dest="background_color", help="colour")
    for name, kind, default, told in _VALUES:
        parser.add_argument(f"--{name}", type=kind, default=default, help=told)
    for name in ("collocations", "normalize_plurals"):
        parser.add_argument(
            f"--no_{name}", action="store_false", dest=name, help=f"switch off {name}"
        )
    for name in ("include_numbers", "repeat"):
        parser.add_argument(f"--{name}", action="store_true", help=f"switch on {name}")
    parser.add_argument("--version", action="version", version=metadata.version("packwork"))
    return parser


def parse_args(arguments: Sequence[str]) -> tuple[dict[str, Any], str, IO[bytes]]:
    """Arguments of :class:`WordCloud`, the text, and the open file for the picture.

    Raises
    ------
    ValueError
        If words are to have two colours.
    SystemExit
        With one line on standard error, if a file or a value cannot be used.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     place = Path(folder, "speech.txt")
    ...     _ = place.write_text("a bear", encoding="utf-8")
    ...     made, text, image = parse_args(["--text", str(place), "--imagefile", f"{folder}/a"])
    ...     image.close()
    >>> made["max_words"], text
    (200, 'a bear')
    """
    parser = make_parser()
    values = vars(parser.parse_args(arguments))
    picture, colour = values.pop("colormask"), values.pop("color")
    if picture and colour:
        raise ValueError("specify either a color mask or a color function")
    try:
        text = _text(values.pop("text"))
        if values["stopwords"]:
            note_input(values["stopwords"])
            lines = Path(values["stopwords"]).read_text(encoding="utf-8").splitlines()
            values["stopwords"] = {line.strip() for line in lines}
        if values["mask"]:
            values["mask"] = _pixels(values["mask"])
        values["color_func"] = _colours(picture, colour)
        image = _opened(values.pop("imagefile"))
    except (OSError, UnicodeDecodeError) as error:
        parser.error(" ".join(str(error).split()))
    if values["background_color"] == "None":
        values["background_color"] = None
    return values, text, image


def main(args: dict[str, Any], text: str, imagefile: IO[bytes]) -> None:
    """Make the cloud and write it as PNG.

    Examples
    --------
    >>> import io
    >>> class Kept(io.BytesIO):
    ...     def close(self) -> None: ...
    >>> made = Kept()
    >>> main({"width": 90, "height": 60, "random_state": 0}, "bears and bees", made)
    >>> made.getvalue()[1:4]
    b'PNG'
    """
    try:
        with imagefile:
            image = wc.WordCloud(**args).generate(text).to_image()
            image.save(imagefile, format="png", optimize=True)
    except (PackworkError, ValueError) as error:
        raise SystemExit(f"packwork.wordcloud: {error}") from None
    except OSError as error:
        # Only standard output is written to as it comes.
        raise SystemExit(
            f"packwork.wordcloud: the picture cannot be written: {error.strerror}"
        ) from None


def run(arguments: Sequence[str]) -> None:
    """Do what a command line asks; what cannot be is one line on standard error.

    Examples
    --------
    >>> run(["--color", "red", "--colormask", "a.png"])
    Traceback (most recent call last):
    SystemExit: packwork.wordcloud: specify either a color mask or a color function
    """
    with noting_inputs():
        try:
            asked = parse_args(arguments)
        except ValueError as error:
            raise SystemExit(f"packwork.wordcloud: {error}") from None
        main(*asked)


def _pattern(text: str) -> str:
    try:
        re.compile(text)
    except re.error as error:
        raise argparse.ArgumentTypeError(f"Invalid regular expression: {error}") from None
    return text


def _text(file: str) -> str:
    if file == STANDARD:
        if sys.stdin is None:
            raise OSError("standard input is closed; give a --text FILE")
        return sys.stdin.buffer.read().decode("utf-8")
    note_input(file)
    return Path(file).read_text(encoding="utf-8")


class _PictureFile(io.BytesIO):
    """A file that comes to be as a whole, once all of it is there; until then an older stays."""

    def __init__(self, path: str) -> None:
        super().__init__()
        check_writable(path)
        self._path = path

    def __exit__(self, kind: type[BaseException] | None, *rest: Any) -> None:
        """Write what there is, unless something went wrong."""
        if kind is None:
            write_atomic(self._path, self.getvalue())
        super().__exit__(kind, *rest)


def _opened(file: str) -> IO[bytes]:
    try:
        return sys.stdout.buffer if file == STANDARD else _PictureFile(file)
    except WriteError as error:
        raise OSError(str(error)) from None


def _pixels(file: str) -> npt.NDArray[Any]:
    note_input(file)
    with Image.open(file) as picture:
        return np.array(picture)


def _colours(picture: str | None, colour: str | None) -> Any:
    if picture:
        return ImageColorGenerator(_pixels(picture))
    return get_single_color_func(colour) if colour else random_color_func


def _own_name() -> str:
    """Name that the command was called by: links to it may have other names."""
    called = Path(sys.argv[0]).name
    return "python -m packwork.wordcloud" if called in {"", "-c", "-m", "__main__.py"} else called


if __name__ == "__main__":
    sys.exit("To execute the CLI, use: python -m packwork.wordcloud")
