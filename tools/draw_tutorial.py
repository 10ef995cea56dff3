"""Draws the pictures of docs/guide/tutorial.md: ``python tools/draw_tutorial.py``.

Runs the page's commands as they stand, in a folder that looks like a clone, and keeps their
PNGs and films under docs/pictures/tutorial/.
"""

from __future__ import annotations

import contextlib
import re
import shlex
import shutil
import sys
import tempfile
from pathlib import Path

from PIL import Image

from packwork.cli import app

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "guide" / "tutorial.md"
OUT = ROOT / "docs" / "pictures" / "tutorial"
COLOURS = 128


def main() -> None:
    """Run all commands of the page, keep what they draw."""
    text = PAGE.read_text(encoding="utf-8").replace("\\\n", " ")
    OUT.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as place, contextlib.chdir(place):
        Path("examples").symlink_to(ROOT / "examples")
        for name, code in re.findall(r"```\w+\n# (\S+\.\w+)\n(.*?)```", text, re.DOTALL):
            Path(name).write_text(code, encoding="utf-8")
        sys.path.insert(0, place)
        for line in re.findall(r"^packwork .*$", text, re.MULTILINE):
            app(shlex.split(line)[1:], standalone_mode=False)
        for drawn in sorted(Path().glob("*.png")):
            with Image.open(drawn) as picture:
                picture.convert("RGB").quantize(COLOURS).save(OUT / drawn.name, optimize=True)
        for film in sorted(Path().glob("*.gif")):
            shutil.copy(film, OUT / film.name)


if __name__ == "__main__":
    main()
