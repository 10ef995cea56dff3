"""Photographs in Python: :func:`packwork.fill`, told what to read."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from packwork.api.layout import Layout
from packwork.api.signatures import of_verb
from packwork.api.verbs import fill
from packwork.offers import Verbs
from packwork.progress import Observer, Stop, never
from packwork.scene.container import Container
from packwork.uses.photos.recipe import photo_choices


@of_verb(Verbs.PHOTOS)
def photos(
    container: str | Path | Container,
    sources: str | Path | Sequence[str | Path],
    *,
    add: str | Path | Sequence[str | Path] = (),
    observer: Observer | None = None,
    stop: Stop = never,
    progress: bool | None = None,
    **options: Any,
) -> Layout:
    """Fill a container with photographs.

    Parameters
    ----------
    container
        As for :func:`packwork.fill`.
    sources
        Photos (JPEG, PNG, WebP), folders of them or patterns.
    add
        Items that are placed among the photos: files, folders or built-in names.
    observer, stop, progress
        As for :func:`packwork.fill`.
    options
        As on the command line, by the names in the signature.

    Raises
    ------
    ReadError
        If a photo cannot be used.
    RecipeError
        If an option has no meaning.

    Examples
    --------
    >>> import tempfile
    >>> from PIL import Image
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     for name in ("sea", "sky"):
    ...         Image.new("RGB", (300, 200), "teal").save(f"{folder}/{name}.jpg")
    ...     layout = photos("heart", folder, effort="draft", levels="50")
    ...     layout.save(f"{folder}/heart.jpg", dpi=300)
    >>> [item.name for item in layout.items]
    ['sea', 'sky']
    """
    chosen = photo_choices(sources, **options)
    return fill(container, add, observer=observer, stop=stop, progress=progress, **chosen)
