"""What a PDF paints, read back by PDFium: regions, sizes and pixels."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator
from contextlib import closing
from dataclasses import dataclass
from typing import Any

import numpy as np
import pypdfium2 as pdfium
import pypdfium2.raw as raw
import shapely

from packwork.arrays import FloatArray
from packwork.geometry import affine
from packwork.geometry.bezier import flatten_cubic
from packwork.geometry.polygon import Region, region

FLATTENING = 1e-7
"""Largest distance of a curve from its chords, as a share of the page's longer side."""

CAPS = {0: "flat", 1: "round", 2: "square"}
JOINS = {0: "mitre", 1: "round", 2: "bevel"}


@dataclass(frozen=True)
class Printed:
    """A page in mm, y down: its size and what each painted path covers, in painting order."""

    width: float
    height: float
    regions: list[Region]


def read_pdf(pdf: bytes) -> Printed:
    """Paths of the first page; pictures are passed over."""
    with closing(pdfium.PdfDocument(pdf)) as document:
        page = document[0]
        width, height = page.get_size()
        tolerance = FLATTENING * max(width, height)
        top = (raw.FPDFPage_GetObject(page, k) for k in range(raw.FPDFPage_CountObjects(page)))
        found = [r for one in top for r in painted(one, affine.identity(), tolerance)]
    mm = 25.4 / 72
    to_mm = np.array([[mm, 0.0, 0.0], [0.0, -mm, mm * height]])
    regions = [shapely.transform(r, lambda p: affine.apply(to_mm, p)) for r in found]
    return Printed(mm * width, mm * height, regions)


def pdf_pixels(pdf: bytes, width_px: int) -> FloatArray:
    """Picture of the first page, ``[row, col, RGB]``, on white."""
    with closing(pdfium.PdfDocument(pdf)) as document:
        page = document[0]
        picture = page.render(scale=width_px / page.get_width()).to_pil().convert("RGB")
        return np.asarray(picture, dtype=np.float64)


def painted(element: Any, outer: FloatArray, tolerance: float) -> Iterator[Region]:
    """What an object and those inside it cover, points of the page, y up."""
    matrix = affine.compose(outer, own_matrix(element))
    kind = raw.FPDFPageObj_GetType(element)
    if kind == raw.FPDF_PAGEOBJ_FORM:
        for k in range(raw.FPDFFormObj_CountObjects(element)):
            yield from painted(raw.FPDFFormObj_GetObject(element, k), matrix, tolerance)
    elif kind == raw.FPDF_PAGEOBJ_PATH:
        own = covered(element, tolerance / float(np.linalg.norm(matrix[:, :2], 2)))
        yield shapely.transform(own, lambda points: affine.apply(matrix, points))


def own_matrix(element: Any) -> FloatArray:
    m = raw.FS_MATRIX()
    raw.FPDFPageObj_GetMatrix(element, m)
    return np.array([[m.a, m.c, m.e], [m.b, m.d, m.f]])


def covered(path: Any, tolerance: float) -> Region:
    """Fill and stroke of a path in its own units."""
    fill, stroke = ctypes.c_int(), ctypes.c_int()
    raw.FPDFPath_GetDrawMode(path, fill, stroke)
    lines = subpaths(path, tolerance)
    inked = []
    if fill.value:
        rule = "evenodd" if fill.value == raw.FPDF_FILLMODE_ALTERNATE else "nonzero"
        inked.append(region([line for line, _ in lines], rule))
    if stroke.value:
        inked += [stroked(path, line, is_closed) for line, is_closed in lines]
    return shapely.union_all(inked)


def stroked(path: Any, line: FloatArray, is_closed: bool) -> Region:
    width = ctypes.c_float()
    raw.FPDFPageObj_GetStrokeWidth(path, width)
    centre = shapely.LinearRing(line) if is_closed else shapely.LineString(line)
    return centre.buffer(
        width.value / 2,
        quad_segs=256,
        cap_style=CAPS[raw.FPDFPageObj_GetLineCap(path)],
        join_style=JOINS[raw.FPDFPageObj_GetLineJoin(path)],
    )


def subpaths(path: Any, tolerance: float) -> list[tuple[FloatArray, bool]]:
    """Flattened pieces and whether each is closed."""
    pieces: list[tuple[list[FloatArray], list[bool]]] = []
    handles: list[FloatArray] = []
    for k in range(raw.FPDFPath_CountSegments(path)):
        segment = raw.FPDFPath_GetPathSegment(path, k)
        point, kind = point_of(segment), raw.FPDFPathSegment_GetType(segment)
        if kind == raw.FPDF_SEGMENT_MOVETO:
            pieces.append(([point[None]], []))
        elif kind == raw.FPDF_SEGMENT_LINETO:
            pieces[-1][0].append(point[None])
        else:
            handles.append(point)
        if len(handles) == 3:
            here = pieces[-1][0][-1][-1]
            pieces[-1][0].append(flatten_cubic(here, *handles, tolerance))
            handles = []
        if raw.FPDFPathSegment_GetClose(segment):
            pieces[-1][1].append(True)
    return [(np.concatenate(points), bool(closed)) for points, closed in pieces]


def point_of(segment: Any) -> FloatArray:
    x, y = ctypes.c_float(), ctypes.c_float()
    raw.FPDFPathSegment_GetPoint(segment, x, y)
    return np.array([x.value, y.value])
