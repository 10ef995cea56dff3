"""Files as they come out: ``packwork bench files`` prints this table below its own.

A thousand copies of twenty icons as SVG: how many bytes, and whether a browser shows the
picture that our PNG holds. A sheet of 200 x 150 mm as SVG, PDF and DXF: how large each
says it is, and how far the items that come back out of the PDF (by PDFium) and the DXF
are off the outlines that were measured.
"""

from __future__ import annotations

import io
import math
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import fields, replace
from pathlib import Path

import ezdxf
import numpy as np
import shapely
from PIL import Image

import packwork as pw
from benchmarks.kit.measuring import DOCS, markdown_table
from packwork.arrays import FloatArray
from packwork.geometry.polygon import Region, region, silhouette
from packwork.readers.svg.resvg import iou
from packwork.scene.item import Item
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.writers.bitmaps import png_bytes
from packwork.writers.dxf import dxf_bytes
from packwork.writers.pdf import pdf_bytes
from packwork.writers.svg import SvgOptions, svg_text

sys.path.append(str(DOCS.parent / "tests"))
from printed import read_pdf

COPIES, ICONS, CANVAS_PX = 1_000, 20, 1_000
PICTURE_PX = 3_200
"""Longer side of the pictures that are compared: twice that of our PNGs by default. Of a
thousand items on fewer pixels the soft edges of two renderers alone differ by a hundredth."""

SHEET = "200x150mm"
SHEET_SIZE = (200.0, 150.0)

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome")
BROWSER_SECONDS = 120
ROOM_PX = 200
"""Window below the picture: some browsers count their own bars as part of it."""

EXAMPLES, WORDS = Path(__file__).parents[2] / "examples", 60
CLOUDS = {
    "Latin": ("words-bird/raven.txt", None),
    "Arabic": ("words-arabic/words.csv", "words-arabic/NotoNaskhArabic-Bold.ttf"),
    "Hindi": ("words-hindi/words.csv", "words-hindi/NotoSansDevanagari-Bold.ttf"),
    "Chinese": ("words-chinese/words.csv", "words-chinese/NotoSerifSC-Bold.otf"),
}

HEADER = ["what", "measured", "target"]


def outputs_table(icons: Sequence[Item]) -> str:
    """The table, of ``ICONS`` icons; fewer are taken as they are."""
    crowd = pw.fill(
        "circle", list(icons[:ICONS]), count=COPIES, canvas=CANVAS_PX, effort="draft", seed=0
    )
    sheet = pw.fill("cloud", "builtin:icons", count=ICONS, canvas=SHEET, effort="draft", seed=0)
    return markdown_table(
        HEADER,
        [
            *_crowd_rows(crowd),
            *_text_rows(),
            _sizes_row(sheet),
            _dxf_row(sheet),
            _pdf_row(sheet),
        ],
    )


def _text_rows() -> list[list[str]]:
    """Live text against our PNG, whose words are outlines."""
    rows = []
    for script, (source, font) in CLOUDS.items():
        fonts = None if font is None else [str(EXAMPLES / font)]
        layout = pw.words(
            "circle", str(EXAMPLES / source), fonts=fonts, count=WORDS, rotate="20",
            canvas=CANVAS_PX, effort="draft", seed=0,
        )  # fmt: skip
        found = _in_browser(layout, svg_text(layout, SvgOptions(text="live")))
        what = f"{WORDS} words as text in a browser and our PNG, {script}"
        rows.append([what, found, "IoU >= 0.99"])
    return rows


def _crowd_rows(layout: Layout) -> list[list[str]]:
    text = svg_text(layout)
    kinds = len({id(item) for item in layout.items})
    what = f"SVG of {len(layout.items):,} copies of {kinds} icons"
    embedded = text.count("data:image")
    return [
        [what, f"{len(text.encode()) / 1e3:.0f} kB, {embedded} pictures in it", "400 kB, none"],
        [
            f"the same in a browser and as our PNG, {PICTURE_PX:,} px",
            _in_browser(layout, text),
            "IoU >= 0.99",
        ],
    ]


def _in_browser(layout: Layout, text: str) -> str:
    program = next(filter(None, map(shutil.which, BROWSERS)), None)
    if program is None:
        return f"not measured: none of {', '.join(BROWSERS)} is installed"
    options = SvgOptions()
    ours = _channels(Image.open(io.BytesIO(png_bytes(layout, PICTURE_PX, options))))
    theirs = _channels(_screenshot(program, text))
    inked = np.minimum(ours[..., 3], theirs[..., 3]) > 0.5
    colour = np.abs(ours - theirs)[inked, :3].mean() * 255
    return f"IoU {iou(ours[..., 3], theirs[..., 3]):.4f}, colours off by {colour:.1f} of 255"


def _screenshot(program: str, text: str) -> Image.Image:
    """Top left of a page that is the SVG alone, on a clear ground."""
    with tempfile.TemporaryDirectory() as folder:
        page, shot = Path(folder, "layout.svg"), Path(folder, "shot.png")
        page.write_text(text, encoding="utf-8")
        size = f"--window-size={CANVAS_PX},{CANVAS_PX + ROOM_PX}"
        subprocess.run(  # noqa: S603
            [program, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", size,
             f"--force-device-scale-factor={PICTURE_PX / CANVAS_PX}",
             "--default-background-color=00000000",
             f"--user-data-dir={folder}/profile", f"--screenshot={shot}", page.as_uri()],
            check=True, capture_output=True, timeout=BROWSER_SECONDS,
        )  # fmt: skip
        with Image.open(shot) as picture:
            return picture.crop((0, 0, PICTURE_PX, PICTURE_PX))


def _channels(picture: Image.Image) -> FloatArray:
    return np.asarray(picture.convert("RGBA"), dtype=np.float64) / 255.0


def _sizes_row(layout: Layout) -> list[str]:
    root = ET.fromstring(svg_text(layout))  # noqa: S314
    page = read_pdf(pdf_bytes(layout))
    drawing = _opened(layout)
    limits = drawing.header["$LIMMAX"]
    unit = {4: "mm"}.get(drawing.header["$INSUNITS"], "?")
    found = (
        f"SVG {root.get('width')} x {root.get('height')}, "
        f"PDF {page.width:.3f} x {page.height:.3f} mm, "
        f"DXF {limits[0]:.9g} x {limits[1]:.9g} {unit}"
    )
    return [f"a sheet of {SHEET}", found, "200 x 150 mm"]


def _opened(layout: Layout) -> ezdxf.document.Drawing:
    return ezdxf.read(io.StringIO(dxf_bytes(layout).decode()))


def _dxf_row(layout: Layout) -> list[str]:
    """Items are the closed lines on the layer ``cut``, in the layout's order, y up."""
    lines = _opened(layout).modelspace().query('LWPOLYLINE[layer=="cut"]')
    rings = [np.array(line.get_points("xy")) * (1, -1) + (0, SHEET_SIZE[1]) for line in lines]
    seen = []
    for outline in layout.outlines:
        own, rings = rings[: len(outline.rings)], rings[len(outline.rings) :]
        seen.append(region(own))
    return ["items of the DXF, read back", _off(layout, seen), "0.01 %, 0.01 mm"]


def _pdf_row(layout: Layout) -> list[str]:
    pages = [read_pdf(pdf_bytes(_alone(layout, k))) for k in range(len(layout.items))]
    seen = [silhouette(shapely.union_all(page.regions)) for page in pages]
    return ["items of the PDF, read back", _off(layout, seen), "0.01 %, 0.01 mm"]


def _alone(layout: Layout, k: int) -> Layout:
    poses = Poses(*(getattr(layout.poses, field.name)[[k]] for field in fields(Poses)))
    return replace(layout, items=layout.items[k : k + 1], poses=poses, weights=layout.weights[[k]])


def _off(layout: Layout, seen: Sequence[Region]) -> str:
    """How far areas and centres are off at most."""
    area = position = 0.0
    for found, outline in zip(seen, layout.outlines, strict=True):
        area = max(area, abs(found.area / outline.area - 1))
        position = max(position, math.dist(_centre(found), _centre(outline.region)))
    return f"areas within {100 * area:.1e} %, positions within {position:.1e} mm"


def _centre(found: Region) -> tuple[float, float]:
    return found.centroid.x, found.centroid.y
