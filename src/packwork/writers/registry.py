"""Formats by file ending. A new format is one file and one line of ``WRITERS``."""

from __future__ import annotations

import importlib.util
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any, TypeAlias

from packwork.errors import RecipeError, WriteError
from packwork.installed import command_to_install
from packwork.phrasing import meant
from packwork.scene.container import Container
from packwork.scene.layout import Layout
from packwork.scene.palette import spot_inks_in
from packwork.writers.atomic import check_writable, write_atomic
from packwork.writers.bitmaps import (
    ON_WHITE,
    check_webp_side,
    jpeg_bytes,
    png_bytes,
    tiff_bytes,
    webp_bytes,
)
from packwork.writers.cutting import CutOptions
from packwork.writers.dxf import dxf_bytes
from packwork.writers.frame import check_side, picture_frame, side_at
from packwork.writers.geojson import geojson_text
from packwork.writers.halos import haloed
from packwork.writers.options import DrawingOptions, HaloChoice
from packwork.writers.pdf import drawing_text, pdf_bytes
from packwork.writers.pictures import DPI, SPARE, with_fine_photos, with_photos_for_paper
from packwork.writers.prepress.options import PrintOptions, spot_inks
from packwork.writers.prepress.sheet import bleed_pt
from packwork.writers.promise import is_nest
from packwork.writers.svg import SvgOptions, svg_text

MOST_DPI = 2_400
"""Pixels to the inch at most: what the finest printers set. Chosen."""


@dataclass(frozen=True, kw_only=True)
class WriteOptions:
    """Options of every format; each reads its own.

    ``svg`` says how SVG and PDF are drawn, ``png`` how pictures of pixels are. ``dpi`` are pixels
    to the inch, of photos in SVG and PDF (300 if None) and, if given, of PNG and JPEG in place of
    ``png_side_px``; ``printing`` is what a print shop asks of a PDF.
    Without ``takes_ground`` another background was asked for than the ground of the layout.
    """

    svg: SvgOptions = field(default_factory=SvgOptions)
    png: SvgOptions = ON_WHITE
    png_side_px: int = 1600
    dpi: float | None = None
    printing: PrintOptions = field(default_factory=PrintOptions)
    halo: HaloChoice = "none"
    takes_ground: bool = True

    def __post_init__(self) -> None:
        check_side(self.png_side_px)
        if self.dpi is not None and not 1 <= self.dpi <= MOST_DPI:
            raise RecipeError("dpi", f"use 1 to {MOST_DPI}, not {self.dpi:g}")

    def on_ground(self, layout: Layout) -> WriteOptions:
        """The same on the ground that a layout is to be seen on, if no background was asked for.

        A nest is drawn as lines for a machine, unless other lines are to be cut; in pixels, with
        the edges of its parts, which may touch.
        """
        is_cut = self.svg.cut is not None and self.svg.cut.is_asked
        lines = is_nest(layout) and not is_cut
        png = replace(self.png, edges=is_nest(layout))
        own = replace(self, svg=replace(self.svg, lines=lines), png=png)
        if not layout.ground or not self.takes_ground:
            return own
        svg = replace(own.svg, background=layout.ground)
        return replace(own, svg=svg, png=replace(own.png, background=layout.ground))

    def side_px(self, layout: Layout) -> int:
        """Longer side of a PNG or JPEG of a layout."""
        return self.png_side_px if self.dpi is None else side_at(layout.container, self.dpi)

    def on_paper(self, layout: Layout) -> Layout:
        """Layout whose photos are as fine as paper needs, with halos."""
        seen = haloed(layout, self.halo, self.svg.background)
        return with_photos_for_paper(seen, self.dpi or DPI)

    def on_screen(self, layout: Layout) -> Layout:
        """Layout whose photos are as fine as a PNG or JPEG needs, with halos."""
        seen = haloed(layout, self.halo, self.png.background)
        return with_fine_photos(seen, SPARE * self.side_px(layout) / layout.container.side)


Encoder: TypeAlias = Callable[[Layout, WriteOptions], bytes]


def _svg(layout: Layout, options: WriteOptions) -> bytes:
    return svg_text(options.on_paper(layout), options.svg).encode()


def _pixels(
    encode: Callable[[Layout, int, SvgOptions | None], bytes],
) -> Encoder:
    """Encoder of a format of pixels, of which all are drawn alike."""

    def encoder(layout: Layout, options: WriteOptions) -> bytes:
        return encode(options.on_screen(layout), options.side_px(layout), options.png)

    return encoder


def _pdf(layout: Layout, options: WriteOptions) -> bytes:
    recipe = layout.manifest.get("recipe") or {}
    spots = {**spot_inks_in(recipe.get("palette")), **options.printing.spots}
    printing = replace(options.printing, spots=spots)
    return pdf_bytes(options.on_paper(layout), options.svg, printing)


def _dxf(layout: Layout, options: WriteOptions) -> bytes:
    return dxf_bytes(layout, options.svg.cut)


def _geojson(layout: Layout, _: WriteOptions) -> bytes:
    return geojson_text(layout).encode()


WRITERS: Mapping[str, Encoder] = MappingProxyType(
    {
        ".svg": _svg,
        ".png": _pixels(png_bytes),
        ".jpg": _pixels(jpeg_bytes),
        ".jpeg": _pixels(jpeg_bytes),
        ".webp": _pixels(webp_bytes),
        ".tif": _pixels(tiff_bytes),
        ".tiff": _pixels(tiff_bytes),
        ".pdf": _pdf,
        ".dxf": _dxf,
        ".geojson": _geojson,
        ".json": _geojson,
    }
)
"""File ending, in lower case, to the function that makes the file's bytes."""

PICTURES = frozenset({".png", ".jpg", ".jpeg", ".webp", ".tif", ".tiff"})
"""Endings of pictures of pixels."""

INSTEAD: Mapping[str, str] = MappingProxyType(
    {
        ".ai": ".pdf or .svg",
        ".eps": ".pdf",
        ".ps": ".pdf",
        ".cdr": ".pdf or .svg",
        ".plt": ".dxf",
        ".dwg": ".dxf",
        ".psd": ".tif",
        ".bmp": ".png",
        ".heic": ".jpg",
        ".html": ".svg",
    }
)
"""Endings that people ask for, and what the programs that want them read too."""

ONLY_FILMS = frozenset({".gif", ".mp4", ".webm"})
"""Endings of pictures that move, which a layout alone is not."""


def check_output(path: str | Path, *others: str) -> None:
    """Refuse, before a run, a path that :func:`write` would refuse after it.

    ``others`` are endings to name beside those of layouts: of what the caller writes itself.
    """
    _encoder(path, *others)
    check_writable(path)


def check_picture_size(path: str | Path, container: Container, options: WriteOptions) -> None:
    """Refuse, before a run, pixels that no picture of a canvas may have."""
    ending = Path(path).suffix.lower()
    if ending not in PICTURES:
        return
    side = options.png_side_px if options.dpi is None else side_at(container, options.dpi)
    picture_frame(container, side)
    if ending == ".webp":
        check_webp_side(side)


def write(layout: Layout, path: str | Path, options: WriteOptions | None = None) -> None:
    """Write a layout in the format that the path's ending names."""
    write_atomic(path, encoded(layout, path, options))


def encoded(layout: Layout, path: str | Path, options: WriteOptions | None = None) -> bytes:
    """Bytes that :func:`write` would write: several files can be drawn before the first is.

    Examples
    --------
    >>> from packwork.scene.layout import blank
    >>> encoded(blank(), "out.png")[1:4]
    b'PNG'
    """
    encoder = _encoder(path)
    return encoder(layout, (options or WriteOptions()).on_ground(layout))


def pdf_drawing(layout: Layout, options: WriteOptions | None = None) -> tuple[str, float]:
    """SVG that :func:`encoded` puts on a PDF's page, and the bleed around it in points.

    Cut lines are among it; photos are their small copies.
    """
    options = (options or WriteOptions()).on_ground(layout)
    seen = haloed(layout, options.halo, options.svg.background)
    bleed = options.printing.bleed
    beyond = 0.0 if bleed is None else bleed_pt(bleed, layout.container)
    return drawing_text(seen, options.svg), beyond


def _encoder(path: str | Path, *others: str) -> Encoder:
    ending = Path(path).suffix.lower()
    if ending not in WRITERS:
        known = ", ".join((*WRITERS, *others))
        if ending in ONLY_FILMS:
            raise WriteError(path, "is a film; give it to --film (in Python to save_film)")
        met = f"the ending {ending!r} is not known" if ending else "the name has no ending"
        if ending in INSTEAD:
            raise WriteError(path, f"{met}; {INSTEAD[ending]} does for the same; all are {known}")
        near = meant(ending, WRITERS)
        raise WriteError(path, f"{met}; {near}{' ' if near else ''}use one of {known}")
    check_extra(path)
    return WRITERS[ending]


def write_options(**options: Any) -> WriteOptions:
    """Options of every format from the few that people give, fields of ``DrawingOptions``.

    A pydantic.ValidationError if there is no such option or its value is of another type, a
    RecipeError if a value has no meaning.

    Examples
    --------
    >>> write_options(background="none").png.background is None
    True
    """
    asked = DrawingOptions.model_validate(options)
    background, kiss = asked.background, asked.kiss_cut
    colour = None if background in {None, "none", "transparent"} else background
    png = replace(ON_WHITE, show_container=asked.show_container, tiles=asked.tiles)
    return WriteOptions(
        svg=SvgOptions(
            background=colour,
            show_container=asked.show_container,
            flatten=asked.flatten,
            text=asked.text,
            tiles=asked.tiles,
            cut=CutOptions(line=asked.cut, kiss=None if kiss is None else str(kiss)),
        ),
        png=png if background is None else replace(png, background=colour),
        png_side_px=asked.pixels,
        dpi=asked.dpi,
        printing=_printing(asked),
        halo=asked.halo,
        takes_ground=background is None,
    )


def _printing(asked: DrawingOptions) -> PrintOptions:
    bleed, press = asked.bleed, None
    if asked.icc is not None:
        # Loads the library of colour profiles, which only files for a press need.
        from packwork.writers.prepress.profile import read_press_profile

        press = read_press_profile(asked.icc)
    return PrintOptions(
        bleed=None if bleed is None else str(bleed),
        marks=asked.marks,
        press=press,
        spots=spot_inks(asked.spot),
    )


PACKAGES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {".pdf": ("typst", "pikepdf"), ".dxf": ("ezdxf",), ".mp4": ("av",), ".webm": ("av",)}
)
"""File ending to the packages it needs."""


def check_extra(path: str | Path) -> None:
    """Refuse a path whose format needs packages that are not installed."""
    needed = PACKAGES.get(Path(path).suffix.lower(), ())
    missing = [package for package in needed if importlib.util.find_spec(package) is None]
    if missing:
        packages, them = ("package", "it") if len(missing) == 1 else ("packages", "them")
        raise WriteError(
            path,
            f"needs the {packages} {' and '.join(missing)}; install {them}: "
            f"{command_to_install(missing)}",
        )
