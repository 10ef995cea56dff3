"""Draws the gallery anew: ``python examples/draw.py [NAME...]``.

Runs the commands of each example's README in a copy of its folder and keeps their PNGs, at
most 800 px long and in 256 colours: the one of the last command as ``expected.png``, others
under their own names.
"""

from __future__ import annotations

import contextlib
import re
import shlex
import shutil
import sys
import tempfile
from itertools import pairwise
from pathlib import Path

from PIL import Image

from packwork.cli import app

HERE = Path(__file__).resolve().parent
COLOURS = 256
LONGEST_PX = 800
STARTS = ("packwork fill ", "packwork words ", "packwork chart ", "packwork run ")


def commands(folder: Path) -> list[list[str]]:
    """Arguments of each ``packwork fill``, ``words``, ``chart`` or ``run`` in a README's blocks."""
    text = (folder / "README.md").read_text(encoding="utf-8").replace("\\\n", " ")
    blocks = re.findall(r"```sh\n(.*?)```", text, flags=re.DOTALL)
    lines = [line for block in blocks for line in block.splitlines()]
    return [shlex.split(line)[1:] for line in lines if line.startswith(STARTS)]


def pictures(arguments: list[str]) -> list[str]:
    """PNGs that a command writes."""
    written = [value for flag, value in pairwise(arguments) if flag == "-o"]
    return [name for name in written if name.endswith(".png")]


def draw(folder: Path) -> None:
    """Run an example's commands and keep their pictures."""
    lines = commands(folder)
    with tempfile.TemporaryDirectory() as place:
        copy = Path(shutil.copytree(folder, Path(place) / folder.name))
        for arguments in lines:
            with contextlib.chdir(copy), contextlib.suppress(SystemExit):
                app([*arguments, "-q"])
            kept = "expected.png" if arguments is lines[-1] else None
            for name in pictures(arguments):
                keep(copy / name, folder / (kept or name))


def keep(picture: Path, target: Path) -> None:
    """Save a picture small."""
    with Image.open(picture) as image:
        is_opaque = image.getchannel("A").getextrema()[0] == 255
        plain = image.convert("RGB") if is_opaque else image
        plain.thumbnail((LONGEST_PX, LONGEST_PX), Image.Resampling.LANCZOS)
        plain.quantize(COLOURS, dither=Image.Dither.NONE).save(target, optimize=True)
    sys.stdout.write(f"{target.relative_to(HERE)}  {target.stat().st_size / 1e3:.0f} kB\n")


if __name__ == "__main__":
    asked = sys.argv[1:] or sorted(page.parent.name for page in HERE.glob("*/README.md"))
    for example in asked:
        draw(HERE / example)
