"""Photographs in Python: :func:`packwork.fill`, told what to read."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Unpack

from packwork.api.handing import handed_over, with_names
from packwork.api.keywords import PhotosKeywords
from packwork.api.layout import Layout
from packwork.api.signatures import of_verb
from packwork.api.verbs import fill
from packwork.offers import Verbs
from packwork.progress import Listener, Stop, never
from packwork.readers.memory.values import Value
from packwork.uses.photos.recipe import photo_choices


@of_verb(Verbs.PHOTOS)
def photos(
    container: Value,
    sources: Value | Iterable[Value],
    *,
    add: Value | Iterable[Value] = (),
    y_up: bool | None = None,
    observer: Listener | None = None,
    stop: Stop = never,
    progress: bool | None = None,
    record: bool = False,
    history: bool | int = False,
    **options: Unpack[PhotosKeywords],
) -> Layout:
    """Fill a container with photographs.

    Parameters that :func:`packwork.fill` has too mean the same here.

    Parameters
    ----------
    sources
        Photos (JPEG, PNG, WebP), folders of them or patterns; pictures, arrays and bytes too.
    add
        Items that are placed among the photos, as for :func:`packwork.fill`.
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
    with handed_over(y_up) as handed:
        named = with_names(options, handed)
        chosen = photo_choices(handed.names_of(sources, "sources"), **named)
        return fill(
            container, add, observer=observer, stop=stop, progress=progress, record=record,
            history=history, **chosen,
        )  # fmt: skip
