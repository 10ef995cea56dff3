"""Drawings of several colours in others: in the shades of one hue, or in a palette's colours."""

from __future__ import annotations

import base64
import binascii
import io
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TypeAlias

import numpy as np
from PIL import Image, UnidentifiedImageError

from packwork.arrays import FloatArray
from packwork.raster.drawing import encoded_picture
from packwork.scene.colour import ABSENT, css_colour, hex_colour
from packwork.scene.contrast import LUMINANCE, channels_of, light_of, oklab, oklabs, shade
from packwork.scene.item import Art, Item, PictureArt, VectorArt
from packwork.scene.notation import with_fresh_ids
from packwork.scene.recolour import has_one_colour, recoloured, tree_of
from packwork.scene.swatch import ShownLight, representative_colour

PAINTS = ("fill", "stroke", "color", "stop-color", "flood-color", "lighting-color")
"""Attributes that hold colours."""

APART = 0.07
"""Least difference in lightness (Oklab, 0..1) between two colours of a drawing that have become
shades of one hue: a leaf is to be seen on its apple. Larger changes the shading more. By eye."""

MOST_APART = 8
"""Colours of a drawing up to which they are held apart; what has more is shaded. Chosen."""

NEUTRAL, DARK, LIGHT = 0.045, 0.35, 0.9
"""Chroma below which a colour is grey, and the lightnesses (Oklab) below and above which grey is
left as it is: outlines, eyes and highlights, not a grey elephant. Chosen by eye."""

CONTRASTS, DIM, OFF = (0.55, 0.4, 0.25, 0.12, 0.0), 0.03, 0.012
"""Powers of luminance that are tried for the light and shade of a drawing of one mean colour, light
that is added to all, and how far the mean may be off, as channels on screens. Chosen by eye."""

_HREFS = ("{http://www.w3.org/1999/xlink}href", "href")
_PNG = "data:image/png;base64,"

Repaint: TypeAlias = Callable[[FloatArray], FloatArray]
"""New colours, ``(n, 3)`` of 0..1, of old ones."""


def in_shades_of(item: Item, colour: str) -> Item:
    """Item in one hue: its colours become tints and shades of it, by their lightness.

    What is as light as most of the drawing gets the colour itself; white and black stay.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> ink = Outline.from_rings([[[0, 0], [9, 0], [9, 9], [0, 9]]])
    >>> markup = '<path fill="#c00" d="M0 0h9v9H0z"/><path fill="#fff" d="M1 1h2v2z"/>'
    >>> item = Item("tile", "", ink, ink, VectorArt(markup, np.eye(2, 3)))
    >>> art = in_shades_of(item, "#0000ff").art
    >>> 'fill="#0000ff"' in art.markup, 'fill="#ffffff"' in art.markup
    (True, True)
    """
    if has_one_colour(item.art):
        return recoloured(item, colour)
    middle = oklab(representative_colour(item))[0]
    own = oklab(colour)[0]

    def lightness(old: FloatArray) -> FloatArray:
        held = min(max(float(middle), 0.02), 0.98)
        return np.asarray(np.interp(old, [0.0, held, 1.0], [0.0, own, 1.0]))

    def repaint(rgb: FloatArray) -> FloatArray:
        light = lightness(oklabs(rgb)[:, 0])
        if len(rgb) <= MOST_APART:
            light = _spread_lightness(light, own)
        return np.array([shade(colour, value) for value in light])

    return _with_paints(item, repaint, colour)


def in_palette(item: Item, palette: Sequence[str]) -> Item:
    """Item whose colours have each become the palette's nearest; dark and light grey ones stay."""
    targets = np.array([css_colour(colour)[:3] for colour in palette]) / 255
    labs = oklabs(targets)

    def repaint(rgb: FloatArray) -> FloatArray:
        own = oklabs(rgb)
        away = np.linalg.norm((own[:, None] - labs) * [0.5, 1.0, 1.0], axis=2)
        chroma = np.hypot(own[:, 1], own[:, 2])
        stays = (chroma < NEUTRAL) & ((own[:, 0] < DARK) | (own[:, 0] > LIGHT))
        return np.where(stays[:, None], rgb, targets[away.argmin(axis=1)])

    return _with_paints(item, repaint, palette[0])


def with_mean_colour(item: Item, colour: str, shown: ShownLight | None) -> Item:
    """Item in lighter and darker colours of one, which is their mean as it is seen from afar.

    Examples
    --------
    >>> from packwork.geometry.outline import Outline
    >>> from packwork.scene.swatch import mean_light, shown_light
    >>> ink = Outline.from_rings([[[0, 0], [9, 0], [9, 9], [0, 9]]])
    >>> markup = '<path fill="#c00" d="M0 0h9v9H0z"/><path fill="#fff" d="M0 0h3v9H0z"/>'
    >>> tile = Item("tile", "", ink, ink, VectorArt(markup, np.eye(2, 3)))
    >>> item = with_mean_colour(tile, "#406080", shown_light(tile))
    >>> 'fill="#557da6"' in item.art.markup, mean_light(item).round(2).tolist()
    (True, [0.05, 0.12, 0.22])
    """
    if shown is None or has_one_colour(item.art):
        return recoloured(item, colour)
    bright, weights = shown[0] @ LUMINANCE, shown[1]
    aim = light_of(np.array(css_colour(colour)[:3]) / 255)
    # As much light and shade as leaves the mean where it is to be.
    for contrast in CONTRASTS:
        gain = (bright + DIM) ** contrast
        factor = 1 / np.average(gain, weights=weights)
        mean = np.average(np.minimum(aim * (factor * gain)[:, None], 1.0), axis=0, weights=weights)
        if np.abs(channels_of(mean) - channels_of(aim)).max() <= OFF:
            break

    def repaint(rgb: FloatArray) -> FloatArray:
        gain = factor * (light_of(rgb) @ LUMINANCE + DIM) ** contrast
        return channels_of(aim * gain[:, None])

    return _with_paints(item, repaint, colour)


def _with_paints(item: Item, repaint: Repaint, colour: str) -> Item:
    if isinstance(item.art, VectorArt):
        return replace(item, art=_vector(item.art, repaint, colour))
    if isinstance(item.art, PictureArt):
        return replace(item, art=replace(item.art, png=_picture(item.art.png, repaint)))
    return recoloured(item, colour)


def _vector(art: VectorArt, repaint: Repaint, colour: str) -> Art:
    root = tree_of(art.markup)
    # What says nothing of its own is black.
    root.attrib = {"fill": "#000000", "color": "#000000"} | root.attrib
    drawn = list(_drawn(root))
    new = _new_paints(drawn, repaint)
    for one in drawn:
        for paint in PAINTS:
            if one.get(paint) in new:
                one.set(paint, new[one.get(paint, "")])
        for href in _HREFS:
            if one.tag == "image" and one.get(href, "").startswith(_PNG):
                one.set(href, _PNG + _embedded(one.get(href, "")[len(_PNG) :], repaint))
    markup = ET.tostring(root, encoding="unicode")
    return replace(art, markup=with_fresh_ids(markup, f"-{colour[1:]}"))


def _drawn(element: ET.Element) -> Iterator[ET.Element]:
    """An element and all in it, but for masks: there colours are no colours."""
    yield element
    for child in element:
        if child.tag != "mask":
            yield from _drawn(child)


def _new_paints(drawn: Sequence[ET.Element], repaint: Repaint) -> Mapping[str, str]:
    """New text of each paint that is a colour."""
    old: dict[str, tuple[int, ...]] = {}
    for one in drawn:
        for paint in PAINTS:
            text = one.get(paint)
            if text is not None and text.strip().lower() not in ABSENT:
                try:
                    old[text] = css_colour(text)
                except ValueError:  # a reference, or the text's colour
                    continue
    if not old:
        return {}
    rgb, which = np.unique([channels[:3] for channels in old.values()], axis=0, return_inverse=True)
    new = np.rint(255 * repaint(rgb / 255))[which.ravel()].astype(int).tolist()
    return {
        text: hex_colour(tuple(colour)) + (f"{channels[3]:02x}" if channels[3] < 255 else "")
        for (text, channels), colour in zip(old.items(), new, strict=True)
    }


def _embedded(text: str, repaint: Repaint) -> str:
    try:
        return base64.b64encode(_picture(base64.b64decode(text), repaint)).decode("ascii")
    except (binascii.Error, ValueError):
        return text


def _picture(png: bytes, repaint: Repaint) -> bytes:
    """The same picture in other colours; as it is if it cannot be read."""
    try:
        with Image.open(io.BytesIO(png)) as picture:
            pixels = np.array(picture.convert("RGBA"))
    except (OSError, ValueError, UnidentifiedImageError, Image.DecompressionBombError):
        return png
    # A colour in sixteen steps a channel: more are not told apart, and take long.
    steps = pixels[..., :3] // 16
    keys = (steps.astype(np.int64) * [256, 16, 1]).sum(axis=2)
    known, which = np.unique(keys, return_inverse=True)
    middles = (np.stack([known // 256, known // 16 % 16, known % 16], axis=1) * 17) / 255
    pixels[..., :3] = np.rint(255 * repaint(middles))[which.reshape(keys.shape)]
    return encoded_picture(Image.fromarray(pixels), "PNG")


def _spread_lightness(light: FloatArray, own: float) -> FloatArray:
    """Lightnesses that differ by ``APART`` at least, as far as there is room; ``own`` stays."""
    order = np.argsort(light, kind="stable")
    spread = light[order].copy()
    fixed = int(np.argmin(np.abs(spread - own)))
    for k in range(fixed + 1, len(spread)):
        spread[k] = max(spread[k], min(spread[k - 1] + APART, 1.0))
    for k in range(fixed - 1, -1, -1):
        spread[k] = min(spread[k], max(spread[k + 1] - APART, 0.0))
    found = np.empty_like(light)
    found[order] = spread
    return found
