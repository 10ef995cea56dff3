"""Draws the gallery anew: ``python examples/draw.py [NAME...]``.

Runs the commands of each example's README in a copy of its folder and keeps their PNGs, at
most 800 px long and in 256 colours: the one of the last command as ``expected.png``, others
under their own names; films as they are.
"""

from __future__ import annotations

import contextlib
import re
import runpy
import shlex
import shutil
import sys
import tempfile
from itertools import pairwise
from pathlib import Path

import pypdfium2 as pdfium
from PIL import Image

from packwork.cli import app

HERE = Path(__file__).resolve().parent
COLOURS = 256
LONGEST_PX = 800
MOST_BYTES = 150_000
STARTS = (
    "packwork fill ",
    "packwork words ",
    "packwork chart ",
    "packwork photos ",
    "packwork pile ",
    "packwork run ",
    "packwork nest ",
)


def commands(folder: Path) -> list[list[str]]:
    """Arguments of each command in a README's blocks that makes a layout."""
    text = (folder / "README.md").read_text(encoding="utf-8").replace("\\\n", " ")
    blocks = re.findall(r"```sh\n(.*?)```", text, flags=re.DOTALL)
    lines = [line for block in blocks for line in block.splitlines()]
    return [shlex.split(line)[1:] for line in lines if line.startswith(STARTS)]


def scripts(folder: Path) -> list[str]:
    """Scripts that draw what the commands read: a block begins with them."""
    text = (folder / "README.md").read_text(encoding="utf-8")
    return re.findall(r"```sh\npython (\S+)\npackwork", text)


def pictures(arguments: list[str], flag: str = "-o") -> list[str]:
    """PNGs that a command writes for a flag, else its PDFs."""
    written = [value for given, value in pairwise(arguments) if given == flag]
    pngs = [name for name in written if name.endswith(".png")]
    return pngs or [name for name in written if name.endswith(".pdf")]


def films(arguments: list[str]) -> list[str]:
    """Films that a command writes."""
    return [value for flag, value in pairwise(arguments) if flag == "--film"]


def draw(folder: Path) -> None:
    """Run an example's commands and keep their pictures."""
    lines = commands(folder)
    if not lines:
        raise SystemExit(f"{folder.name}: its README has no command that makes a layout")
    with tempfile.TemporaryDirectory() as place:
        copy = Path(shutil.copytree(folder, Path(place) / folder.name))
        for script in scripts(folder):
            runpy.run_path(str(copy / script), run_name="__main__")
        for arguments in lines:
            with contextlib.chdir(copy):
                run(arguments)
            kept = "expected.png" if arguments is lines[-1] else None
            for name in pictures(arguments):
                keep(copy / name, folder / (kept or name))
            for name in pictures(arguments, "--show-saliency"):
                keep(copy / name, folder / name)
            for name in pictures(arguments, "--contact-sheet"):
                keep(copy / name, folder / (kept or name))
            for name in films(arguments):
                shutil.copy(copy / name, folder / name)


def run(arguments: list[str]) -> None:
    """Run a command; one that fails ends the drawing, but for layouts that are rough on purpose."""
    is_rough = ("--finish", "none") in pairwise(arguments)
    try:
        app([*arguments, "-q"])
    except SystemExit as end:
        if end.code not in ((0, 1, None) if is_rough else (0, None)):
            raise


def opened(picture: Path) -> Image.Image:
    """A picture, or the first page of a PDF, on white and larger than it is kept."""
    if picture.suffix != ".pdf":
        return Image.open(picture)
    page = pdfium.PdfDocument(picture)[0]
    image: Image.Image = page.render(scale=2 * LONGEST_PX / max(page.get_size())).to_pil()
    return image


def keep(picture: Path, target: Path) -> None:
    """Save a picture small: in fewer pixels where it is full of detail, as photographs are."""
    with opened(picture) as image:
        is_opaque = image.mode == "RGB" or image.getchannel("A").getextrema()[0] == 255
        plain = image.convert("RGB") if is_opaque else image
        for longest in range(LONGEST_PX, 100, -50):
            plain.thumbnail((longest, longest), Image.Resampling.LANCZOS)
            plain.quantize(COLOURS, dither=Image.Dither.NONE).save(target, optimize=True)
            if target.stat().st_size <= MOST_BYTES:
                break
    sys.stdout.write(f"{target.relative_to(HERE)}  {target.stat().st_size / 1e3:.0f} kB\n")


if __name__ == "__main__":
    asked = sys.argv[1:] or sorted(page.parent.name for page in HERE.glob("*/README.md"))
    for example in asked:
        draw(HERE / example)
