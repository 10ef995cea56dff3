"""Renders small SVGs in Chromium, once: ``python tools/render_in_browser.py FOLDER``.

For each ``name.svg`` of the folder, 100 px wide and high, ``name.png`` becomes a mask of one
bit a pixel: where the browser paints. Tests hold what is read of the file against it. Text is
to be in the bundled font, which Chromium is told of; every other font depends on the machine.
"""

from __future__ import annotations

import argparse
import math
import os
import subprocess
import tempfile
from collections.abc import Sequence
from importlib import resources
from pathlib import Path

import numpy as np
import numpy.typing as npt
from PIL import Image

SIDE_PX = 100
"""Side of a drawing, and of its mask."""

ZOOM = 4
"""Pixels of the browser to a side of a pixel of the mask, which goes with the most of them."""

FAINTEST = 5
"""Opacity of 255 from which something counts as painted: less is rounding."""

_FONTS = """<?xml version="1.0"?><!DOCTYPE fontconfig SYSTEM "fonts.dtd"><fontconfig>
<dir>{}</dir><dir>/usr/share/fonts</dir><cachedir>{}</cachedir></fontconfig>"""

Mask = npt.NDArray[np.bool_]
"""(rows, columns): what is painted."""


def masks(files: Sequence[Path], browser: str = "chromium") -> list[Mask]:
    """Where a browser paints in each of several drawings, ``SIDE_PX`` wide and high.

    Parameters
    ----------
    files
        SVGs that state that size.
    browser
        Name or path of Chromium, or of a browser with the same options.
    """
    across = math.ceil(math.sqrt(len(files)))
    down = math.ceil(len(files) / across)
    cells = "".join(
        f'<img src="{file.resolve().as_uri()}" style="position:absolute;'
        f'left:{k % across * SIDE_PX}px;top:{k // across * SIDE_PX}px"/>'
        for k, file in enumerate(files)
    )
    with tempfile.TemporaryDirectory() as folder:
        page, picture = Path(folder, "page.html"), Path(folder, "page.png")
        page.write_text(f"<!DOCTYPE html><body style='margin:0'>{cells}", encoding="utf-8")
        fonts = Path(folder, "fonts.conf")
        fonts.write_text(
            _FONTS.format(resources.files("packwork.bundled") / "fonts", folder), encoding="utf-8"
        )
        options = ["--headless", "--no-sandbox", "--hide-scrollbars", f"--user-data-dir={folder}"]
        options += [f"--screenshot={picture}", "--default-background-color=00000000"]
        options += [f"--force-device-scale-factor={ZOOM}", "--virtual-time-budget=3000"]
        options.append(f"--window-size={across * SIDE_PX},{down * SIDE_PX}")
        environment = {**os.environ, "FONTCONFIG_FILE": str(fonts)}
        command = [browser, *options, page.as_uri()]
        subprocess.run(  # noqa: S603 - the browser that was asked for, and our own page
            command, check=True, env=environment, capture_output=True, timeout=300
        )
        shown = np.asarray(Image.open(picture).convert("RGBA"))[:, :, 3] >= FAINTEST
    side = SIDE_PX * ZOOM
    places = [divmod(k, across) for k in range(len(files))]
    parts = [shown[r * side : (r + 1) * side, c * side : (c + 1) * side] for r, c in places]
    blocks = [part.reshape(SIDE_PX, ZOOM, SIDE_PX, ZOOM).mean(axis=(1, 3)) for part in parts]
    return [np.asarray(block > 1 / 2) for block in blocks]


def main() -> None:
    """Write a mask beside every drawing of a folder."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--browser", default="chromium")
    words = parser.parse_args()
    files = sorted(words.folder.glob("*.svg"))
    for file, mask in zip(files, masks(files, words.browser), strict=True):
        Image.fromarray(mask).save(file.with_suffix(".png"), optimize=True)


if __name__ == "__main__":
    main()
