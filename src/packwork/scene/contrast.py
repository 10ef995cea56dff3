"""Light, perceived lightness (Oklab) and contrast of colours."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from packwork.arrays import FloatArray
from packwork.scene.colour import css_colour


def light_of(channels: FloatArray) -> FloatArray:
    """Red, green and blue as light, of channels 0..1 as screens have them (IEC 61966-2-1, sRGB).

    Examples
    --------
    >>> light_of(np.array([0.0, 0.5, 1.0])).round(3).tolist()
    [0.0, 0.214, 1.0]
    """
    low, high = channels / 12.92, ((channels + 0.055) / 1.055) ** 2.4
    return np.where(channels <= 0.04045, low, high)


def channels_of(light: FloatArray) -> FloatArray:
    """Channels as screens have them, of light; what is out of range is clamped.

    Examples
    --------
    >>> channels_of(light_of(np.array([0.0, 0.5, 1.0]))).round(9).tolist()
    [0.0, 0.5, 1.0]
    """
    held = np.clip(light, 0.0, 1.0)
    return np.where(held <= 0.0031308, 12.92 * held, 1.055 * held ** (1 / 2.4) - 0.055)


# Ottosson 2020, "A perceptual color space for image processing" (Oklab).
CONES_OF_LIGHT = np.array(
    [
        [0.4122214708, 0.5363325363, 0.0514459929],
        [0.2119034982, 0.6806995451, 0.1073969566],
        [0.0883024619, 0.2817188376, 0.6299787005],
    ]
)
LAB_OF_CONES = np.array(
    [
        [0.2104542553, 0.7936177850, -0.0040720468],
        [1.9779984951, -2.4285922050, 0.4505937099],
        [0.0259040371, 0.7827717662, -0.8086757660],
    ]
)
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
"""Of red, green and blue light (ITU-R BT.709)."""
_STEPS = 40
_LIGHTS = 101


def contrast(first: str, second: str) -> float:
    """WCAG 2 contrast of two colours, opacity aside: 1 for the same, 21 for black on white.

    Examples
    --------
    >>> round(contrast("black", "white"), 1), contrast("red", "red")
    (21.0, 1.0)
    """
    bright, dark = sorted((_luminance(_linear(c)) for c in (first, second)), reverse=True)
    return (bright + 0.05) / (dark + 0.05)


def contrast_over(colour: str, darkest: float, brightest: float) -> float:
    """Least contrast of a colour with grounds between two luminances, as WCAG counts it.

    Examples
    --------
    >>> round(contrast_over("white", 0.0, 0.05), 1), contrast_over("#808080", 0.0, 1.0)
    (10.5, 1.0)
    """
    own = _luminance(_linear(colour))
    if darkest <= own <= brightest:
        return 1.0
    near = brightest if own > brightest else darkest
    return (max(own, near) + 0.05) / (min(own, near) + 0.05)


def readable_over(colour: str, darkest: float, brightest: float, least: float) -> str | None:
    """Colour of that contrast with all grounds between two luminances; None if there is none.

    The colour itself if it has it, else the nearest darker or lighter one, its hue kept.

    Examples
    --------
    >>> readable_over("#004488", 0.5, 1.0, 4.5), readable_over("#004488", 0.0, 1.0, 4.5)
    ('#004488', None)
    >>> contrast_over(readable_over("#004488", 0.0, 0.1, 4.5), 0.0, 0.1) >= 4.5
    True
    """
    lab = LAB_OF_CONES @ np.cbrt(CONES_OF_LIGHT @ _linear(colour))
    lights = np.concatenate([lab[:1], np.linspace(0.0, 1.0, _LIGHTS)])
    nearest_first = lights[np.argsort(np.abs(lights - lab[0]), kind="stable")]
    shades = (colour if light == lab[0] else _hex(_at(lab, light)) for light in nearest_first)
    enough = (c for c in shades if contrast_over(c, darkest, brightest) >= least)
    return next(enough, None)


def luminances(rgb: FloatArray) -> FloatArray:
    """Relative luminance of colours, as WCAG defines it.

    ``rgb``: ``(..., 3)``, 0..1, as screens have them.

    Examples
    --------
    >>> luminances(np.array([[1.0, 1.0, 1.0], [0.0, 0.0, 0.0]])).round(6).tolist()
    [1.0, 0.0]
    """
    linear = light_of(rgb)
    return np.asarray(linear @ LUMINANCE)


def readable(colour: str, background: str, least: float) -> str:
    """Colour of that contrast on a background: itself if it has it, else darker or lighter.

    Hue stays, in Oklab; colourfulness as far as screens can show it. Where neither black
    nor white would do, the better of the two.

    Examples
    --------
    >>> readable("#004488", "white", 3.0), readable("#ffff00", "white", 3.0)
    ('#004488', '#999a1b')
    """
    if contrast(colour, background) >= least:
        return colour
    lab = LAB_OF_CONES @ np.cbrt(CONES_OF_LIGHT @ _linear(colour))
    end = max((0.0, 1.0), key=lambda light: contrast(_hex(_at(lab, light)), background))
    near, far = float(lab[0]), end
    for _ in range(_STEPS):
        middle = (near + far) / 2
        enough = contrast(_hex(_at(lab, middle)), background) >= least
        near, far = (near, middle) if enough else (middle, far)
    return _hex(_at(lab, far))


def between(colours: tuple[str, ...], share: float) -> str:
    """Colour at a share of the way through several, evenly spaced, mixed in Oklab.

    Examples
    --------
    >>> between(("#000000", "#ffffff"), 0.0), between(("#ff0000", "#ff0000"), 0.3)
    ('#000000', '#ff0000')
    """
    labs = _oklabs_of(colours)
    place = np.clip(share, 0.0, 1.0) * (len(colours) - 1)
    at = np.arange(len(colours))
    return _hex(_rgb(np.array([np.interp(place, at, labs[:, k]) for k in range(3)])))


@lru_cache(16)
def _oklabs_of(colours: tuple[str, ...]) -> FloatArray:
    return np.array([oklab(colour) for colour in colours])


def oklab(colour: str) -> FloatArray:
    """Lightness, green to red and blue to yellow of a colour (Ottosson 2020).

    Examples
    --------
    >>> abs(oklab("white")).round(3).tolist()
    [1.0, 0.0, 0.0]
    """
    return np.asarray(LAB_OF_CONES @ np.cbrt(CONES_OF_LIGHT @ _linear(colour)))


def oklabs(rgb: FloatArray) -> FloatArray:
    """The same of many colours: ``(n, 3)`` of channels 0..1 as screens have them.

    Examples
    --------
    >>> oklabs(np.array([[1.0, 0.0, 0.0]])).round(3).tolist() == [oklab("red").round(3).tolist()]
    True
    """
    return oklabs_of_light(light_of(rgb))


def oklabs_of_light(light: FloatArray) -> FloatArray:
    """The same of light, ``(n, 3)``, 0..1."""
    return np.asarray(np.cbrt(light @ CONES_OF_LIGHT.T) @ LAB_OF_CONES.T)


def shade(colour: str, light: float) -> FloatArray:
    """Red, green and blue, 0..1, of a colour's hue at another lightness.

    Lighter ones are paler by as much, as if white were mixed in; darker ones stay colourful for
    long.

    Examples
    --------
    >>> [abs(shade("#ff0000", light)).round(2).tolist() for light in (1.0, 0.0)]
    [[1.0, 1.0, 1.0], [0.0, 0.0, 0.0]]
    """
    lab = oklab(colour)
    paler = (1.0 - light) / (1.0 - lab[0]) if light > lab[0] else np.sqrt(light / max(lab[0], 1e-9))
    return channels_of(_at(np.array([lab[0], *(paler * lab[1:])]), light))


def _linear(colour: str) -> FloatArray:
    return light_of(np.array(css_colour(colour)[:3]) / 255)


def _luminance(linear: FloatArray) -> float:
    return float(LUMINANCE @ linear)


def _rgb(lab: FloatArray) -> FloatArray:
    return np.asarray(np.linalg.solve(CONES_OF_LIGHT, np.linalg.solve(LAB_OF_CONES, lab) ** 3))


def _at(lab: FloatArray, light: float) -> FloatArray:
    """Light of a colour of another lightness; less colourful where screens cannot show it."""
    for chroma in np.linspace(1.0, 0.0, 21):
        linear = _rgb(np.array([light, *(chroma * lab[1:])]))
        if (linear >= -1e-3).all() and (linear <= 1 + 1e-3).all():
            break
    return np.clip(linear, 0.0, 1.0)


def _hex(linear: FloatArray) -> str:
    return "#{:02x}{:02x}{:02x}".format(*(round(float(255 * c)) for c in channels_of(linear)))
