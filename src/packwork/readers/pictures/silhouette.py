"""Pictures to items: does transparency shape them, background removal, the object's silhouette."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import shapely

from packwork.arrays import BoolArray, FloatArray
from packwork.geometry import affine
from packwork.geometry.polygon import Region
from packwork.readers.options import HALF, ReadOptions
from packwork.readers.pages import PageFate, Read
from packwork.readers.pictures.contours import contour_region
from packwork.readers.pictures.decode import (
    MAX_PICTURE_BYTES,
    Pixels,
    decode_picture,
    png_of_pixels,
)
from packwork.readers.reading import UnfitError, notice, read_bytes, reading_file, stem
from packwork.readers.regions import Holes, centred, clean_union
from packwork.scene.item import Item, PictureArt

LEAST_WHITE = 240
"""Each channel of white, of 255, at least, in pictures and of sheets behind SVGs. Smaller takes
pale tiles for paper, larger keeps ivory paper. Chosen."""

MOST_WHITE = 1 / 3
"""Share of what is painted that white patches are holes up to. More are the body of a drawing
in outlines. Chosen."""


def without_enclosed_white(pixels: Pixels, solid: FloatArray) -> FloatArray:
    """Opacities 0..1, those of white patches that other paint surrounds brought to nothing.

    >>> seal = np.zeros((9, 9, 4), np.uint8); seal[1:8, 1:8, 3] = 255; seal[4, 4, :3] = 255
    >>> float(without_enclosed_white(seal, seal[:, :, 3] / 255).sum())
    48.0
    """
    from scipy.ndimage import binary_dilation, label, maximum_filter

    least = pixels[:, :, :3].min(axis=2)
    painted = solid >= 0.5
    white = painted & (least >= LEAST_WHITE)
    if not white.any():
        return solid
    labels, count = label(white, np.ones((3, 3)))
    beside = np.pad(~painted, 1, constant_values=True)
    near_clear = binary_dilation(beside, np.ones((3, 3)))[1:-1, 1:-1]
    is_open = np.zeros(count + 1, dtype=bool)
    is_open[np.unique(labels[near_clear])] = True
    holes = white & ~is_open[labels]
    if not 0 < np.count_nonzero(holes) <= MOST_WHITE * np.count_nonzero(painted):
        return solid
    result = np.where(holes, 0.0, solid)
    # The pixels of the edge mix white and the paint beside it.
    edge = binary_dilation(holes, np.ones((3, 3))) & ~holes
    distance = 255.0 - least
    result[edge] *= distance[edge] / np.maximum(maximum_filter(distance, 3)[edge], 1.0)
    return result


LEAST_CLEAR_OF_ITEM = 0.001
"""Share of an item's picture that is clear where its transparency decides. Larger takes the
rounded corners of a playing card, 0.15 % of it, for an accident; smaller lets a few translucent
pixels keep the paper round a drawing. Chosen."""

LEAST_CLEAR_OF_MASK = 0.01
"""The same of a mask. Larger passes over small windows in a plate; smaller lets the rounded
corners of a page hide what is painted on it. Chosen."""

FAINT_SHARE = 0.05
"""Painted area that is fainter than the threshold, edges left out, as a share of what is inside,
from which it is told. Larger is silent about shadows, smaller speaks of soft edges. Chosen."""

_FAINTEST = 1 / 255
_SEEN = 10 / 255
_EDGE_PX = 3


def solidity(pixels: Pixels) -> FloatArray:
    """Opacity 0..1 of RGBA pixels, the most opaque one taken for 1: a faint shape is a shape.

    >>> solidity(np.array([[[0, 0, 0, 100], [0, 0, 0, 50]]], np.uint8)).tolist()
    [[1.0, 0.5]]
    """
    alpha = pixels[:, :, 3].astype(np.float64)
    return np.asarray(alpha / max(float(alpha.max()), 255 * _FAINTEST))


def decides(solid: FloatArray, least_clear: float) -> bool:
    """Whether at least a share of the pixels is less than half as opaque as the most opaque one.

    >>> page = np.ones((20, 20)); page[0, 0] = 0
    >>> decides(page, LEAST_CLEAR_OF_ITEM), decides(page, LEAST_CLEAR_OF_MASK)
    (True, False)
    """
    return float(np.count_nonzero(solid < 0.5)) >= least_clear * solid.size


def raised(solid: FloatArray, threshold: float) -> FloatArray:
    """Opacities ``[row, col]`` with the threshold brought to one half, where contours run.

    >>> raised(np.array([0.0, 0.1, 0.2, 1.0]), 0.2).tolist()
    [0.0, 0.25, 0.5, 1.0]
    """
    if threshold == 0.5:
        return solid
    return np.interp(solid, [0.0, threshold, 1.0], [0.0, 0.5, 1.0])


def tell_what_is_faint(solid: FloatArray, threshold: float) -> None:
    """Notice that a real share of opacities ``[row, col]`` is fainter than the threshold."""
    from scipy.ndimage import binary_dilation

    inside = solid >= threshold
    faint = (solid > _SEEN) & ~inside
    if np.count_nonzero(faint) <= FAINT_SHARE * np.count_nonzero(inside):
        return
    faint &= ~binary_dilation(inside, np.ones((3, 3)), _EDGE_PX)
    share = float(np.count_nonzero(faint)) / max(1.0, float(np.count_nonzero(inside)))
    if share > FAINT_SHARE:
        notice(
            f"paints {share:.0%} of its area fainter than {threshold:g}, outside of its outline, "
            "as shadows are; a smaller --alpha-threshold takes it in"
        )


ART_PX = 2_048
"""Longer side of a picture that is kept, and at which a mask is traced. Larger shows only in prints
wider than a metre of a few items, and costs memory by its square. Chosen."""

BACKGROUND_TOLERANCE = 24
"""Steps of 255 within which a colour counts as the background's: JPEG noise stays below.
Larger eats pale objects, smaller leaves halos. Chosen."""

PLAIN_SHARE = 0.75
"""Share of the border that has the background's colour when there is a background: the
rest may be where the object runs out of the picture. Chosen."""

SPECK = 1e-4
"""Share of the area below which a part of a picture counts as dust. Chosen."""

SIMPLIFY_PX = 0.2
"""Largest distance of the outline from the traced contour, in pixels. Chosen."""


def read_picture(
    path: str | Path, holes: Holes = "fill", reading: ReadOptions | None = None
) -> Read:
    """Item of a PNG, JPEG, WebP, AVIF, GIF, BMP or TIFF file, its units the file's pixels.

    Where a real share of the picture is clear, that decides; else a plain background is taken
    away, flooding from the border; else the whole rectangle is the item, as for photos.
    """
    data, options = read_bytes(path, MAX_PICTURE_BYTES), reading or ReadOptions()
    read = _read(data, stem(path), str(path), holes, options)
    if options.keep_page is not None:
        return replace(read, page=PageFate.NONE)

    def again() -> Item:
        return _read(data, stem(path), str(path), holes, replace(options, keep_page=True)).item

    return replace(read, again=again)


def item_of_picture(data: bytes, name: str, source: str, holes: Holes = "fill") -> Item:
    """Item of a picture's bytes."""
    return _read(data, name, source, holes, ReadOptions()).item


def _read(data: bytes, name: str, source: str, holes: Holes, options: ReadOptions) -> Read:
    threshold = options.alpha_threshold
    with reading_file(source):
        picture = decode_picture(data, ART_PX)
        whole = picture.pixels
        object_ = whole if options.keep_page else cut_out(whole)
        pixels, (left, top) = _cropped(object_)
        tell_what_is_faint(solidity(pixels), threshold)
        # Of the very pixels that are written: read again they give this outline.
        ink = outline_of_cut_out(pixels, threshold)
        unit = picture.unit
        to_units = affine.similarity(left * unit, top * unit, 0.0, unit)
        scaled = shapely.transform(ink, lambda points: affine.apply(to_units, points))
        outline, centred_ink, place = centred(scaled, holes)
        art = _art(pixels, affine.compose(place, to_units), is_traced=threshold != HALF)
    item = Item(name, source, outline, centred_ink, art)
    if object_ is not whole:
        return Read(item, source, PageFate.CUT_AWAY)
    is_whole = ink.area >= pixels.shape[0] * pixels.shape[1] - HALF
    return Read(item, source, PageFate.FILLED if is_whole else PageFate.NONE)


def outline_of_cut_out(pixels: Pixels, threshold: float = HALF) -> Region:
    """Region, in pixels, that a picture shows whose opacity says what is its object.

    Clear borders may be off. From ``threshold``, a share of the most opaque one's opacity, a
    pixel is inside.
    """
    alpha = pixels[:, :, 3].astype(np.float64)
    if not alpha.any():
        raise UnfitError("is clear all over: nothing of it would be seen")
    is_even = np.ptp(alpha) <= BACKGROUND_TOLERANCE
    opaque = np.ones_like(alpha) if is_even else solidity(pixels)
    return clean_union(outline_of_coverage(raised(opaque, threshold)), speck=SPECK)


def outline_of_coverage(coverage: FloatArray) -> Region:
    """Region, in pixels, that a picture of opacities 0..1 covers."""
    if coverage.min() > 0.5:
        return shapely.box(0, 0, coverage.shape[1], coverage.shape[0])
    traced = contour_region(coverage, SIMPLIFY_PX)
    if traced.is_empty:
        raise UnfitError("shows a shape of a few pixels only; give a larger picture of it")
    return traced


def cut_out(pixels: Pixels) -> Pixels:
    """Picture with all but its object made transparent.

    >>> paper = np.full((9, 9, 4), 255, np.uint8); paper[3:6, 3:6, :3] = 0
    >>> int(np.count_nonzero(cut_out(paper)[:, :, 3]))
    9
    """
    alpha = pixels[:, :, 3]
    if alpha.max() == 0:
        raise UnfitError("is fully transparent; give a picture that shows something")
    if decides(solidity(pixels), LEAST_CLEAR_OF_ITEM):
        return pixels
    colour = _plain_background(pixels)
    if colour is None:
        return pixels
    opaque = _foreground(np.abs(pixels[:, :, :3] - colour).max(axis=2))
    if opaque.max() == 0:
        raise UnfitError("is all of one colour; give a picture that shows something")
    return _without_background(pixels, colour, opaque)


def _plain_background(pixels: Pixels) -> FloatArray | None:
    """Colour of the border, if most of the border has it."""
    rgb = pixels[:, :, :3].astype(np.float64)
    border = np.concatenate([rgb[0], rgb[-1], rgb[:, 0], rgb[:, -1]])
    colour = np.median(border, axis=0)
    is_near = np.abs(border - colour).max(axis=1) <= BACKGROUND_TOLERANCE
    return colour if is_near.mean() >= PLAIN_SHARE else None


def _foreground(distance: FloatArray) -> FloatArray:
    """Opacity from each pixel's distance to the background's colour."""
    from scipy.ndimage import binary_dilation, maximum_filter

    background = _flooded(distance <= BACKGROUND_TOLERANCE)
    opaque = np.where(background, 0.0, 1.0)
    # The pixels of the edge mix both colours: their share is that of the distance.
    edge = binary_dilation(background, np.ones((3, 3))) & ~background
    opaque[edge] = distance[edge] / maximum_filter(distance, 3)[edge]
    return opaque


def _flooded(is_near: BoolArray) -> BoolArray:
    """Part of ``is_near`` that hangs together with the picture's border."""
    from scipy.ndimage import label

    labels, _ = label(is_near)
    border = np.concatenate([labels[0], labels[-1], labels[:, 0], labels[:, -1]])
    return np.asarray(is_near & np.isin(labels, border))


def _without_background(pixels: Pixels, colour: FloatArray, opaque: FloatArray) -> Pixels:
    """Picture with the background transparent and its tint taken off the edges."""
    share = opaque[:, :, None]
    own = (pixels[:, :, :3] - (1 - share) * colour) / np.maximum(share, 1 / 255)
    result = pixels.copy()
    result[:, :, :3] = np.clip(np.where(share > 0, own, 0), 0, 255).round()
    result[:, :, 3] = np.round(pixels[:, :, 3] * opaque)
    return result


def _cropped(pixels: Pixels) -> tuple[Pixels, tuple[int, int]]:
    """Part of a picture that is not clear, and its left and top."""
    visible = pixels[:, :, 3] > 0
    rows, columns = np.flatnonzero(visible.any(axis=1)), np.flatnonzero(visible.any(axis=0))
    top, left = int(rows[0]), int(columns[0])
    return pixels[top : rows[-1] + 1, left : columns[-1] + 1], (left, top)


def _art(pixels: Pixels, matrix: FloatArray, *, is_traced: bool) -> PictureArt:
    height, width = pixels.shape[:2]
    return PictureArt(png_of_pixels(pixels), width, height, matrix, is_traced)
