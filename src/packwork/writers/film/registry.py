"""Formats of films by file ending. A new format is one file and one line of ``FILMS``."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import TypeAlias

from packwork.errors import WriteError
from packwork.phrasing import meant
from packwork.writers.atomic import check_writable
from packwork.writers.film.animated_svg import animated_svg_bytes
from packwork.writers.film.film import Film, Tell, in_frame, tell_nobody
from packwork.writers.film.gif import gif_bytes
from packwork.writers.film.lottie import lottie_bytes
from packwork.writers.film.video import mp4_bytes, webm_bytes
from packwork.writers.film.webp import webp_bytes
from packwork.writers.registry import check_extra

FilmEncoder: TypeAlias = Callable[[Film, Tell], bytes]

FILMS: Mapping[str, FilmEncoder] = MappingProxyType(
    {
        ".svg": animated_svg_bytes,
        ".gif": gif_bytes,
        ".webp": webp_bytes,
        ".mp4": mp4_bytes,
        ".webm": webm_bytes,
        ".json": lottie_bytes,
    }
)
"""File ending, in lower case, to the function that makes the film's bytes."""


def check_film(path: str | Path) -> None:
    """Refuse, before a run, a path that no film could be written to after it.

    Examples
    --------
    >>> check_film("way.png")
    Traceback (most recent call last):
    packwork.errors.WriteError: way.png: the ending '.png' is none of a film; use one of .svg,
    .gif, .webp, .mp4, .webm, .json
    """
    _encoder(path)
    check_writable(path)


def film_bytes(film: Film, path: str | Path, tell: Tell = tell_nobody) -> bytes:
    """Bytes of a film in the format that a path's ending names."""
    # Labels on items would stay where the items end.
    beside = tuple(note for note in film.layout.notes if not note.is_on_item)
    bare = replace(film, layout=replace(film.layout, notes=beside))
    return _encoder(path)(in_frame(bare), tell)


def _encoder(path: str | Path) -> FilmEncoder:
    ending = Path(path).suffix.lower()
    if ending not in FILMS:
        met = f"the ending {ending!r} is none of a film" if ending else "the name has no ending"
        near = meant(ending, FILMS)
        raise WriteError(path, f"{met}; {near}{' ' if near else ''}use one of {', '.join(FILMS)}")
    check_extra(path)
    return FILMS[ending]
