"""A session's layout in the formats of the command line, in memory."""

from __future__ import annotations

import zipfile
from collections.abc import Mapping
from dataclasses import replace
from io import BytesIO
from typing import Any

from pydantic import ValidationError

from packwork.errors import RecipeError, WriteError
from packwork.live.document import Document
from packwork.live.file.disk import ENDING
from packwork.live.file.recipe import write_recipe
from packwork.live.file.session_file import session_bytes
from packwork.live.file.things import Things
from packwork.live.ground import covering, sheet_box
from packwork.live.history import SessionState
from packwork.live.session import Session
from packwork.recipe.verbs import film_options
from packwork.scene.item import Item
from packwork.scene.layout import Layout, framed
from packwork.temporary import TemporaryFolder
from packwork.units import parse_share
from packwork.writers import Film, WriteOptions, encoded, film_bytes, write_options
from packwork.writers.film.film import in_frame
from packwork.writers.film.options import CANVAS, FilmOptions
from packwork.writers.registry import check_extra

FORMATS: Mapping[str, str] = {
    "svg": "image/svg+xml",
    "pdf": "application/pdf",
    "dxf": "image/vnd.dxf",
    "png": "image/png",
    "jpg": "image/jpeg",
    "webp": "image/webp",
    "tif": "image/tiff",
    "geojson": "application/geo+json",
}
"""Formats of layouts, and what browsers call them."""


FILM = "film."
"""What formats of films begin with here: some endings are drawings too."""

FILM_FORMATS: Mapping[str, str] = {
    "film.svg": "image/svg+xml",
    "film.gif": "image/gif",
    "film.webp": "image/webp",
    "film.mp4": "video/mp4",
    "film.webm": "video/webm",
    "film.json": "application/json",
}
"""Formats of films, and what browsers call them."""

RECIPE = "recipe"
"""What a recipe is asked for by."""

LINES = (
    "In this folder, on the command line:",
    "    packwork run recipe.toml -o collage.svg",
    "In Python:",
    '    import packwork; packwork.run("recipe.toml").save("collage.svg")',
)
"""How a recipe is run."""


def layout_bytes(
    layout: Layout, kind: str, options: Mapping[str, Any], behind: Item | None = None
) -> bytes:
    """A layout in a format.

    Parameters
    ----------
    kind
        One of :data:`FORMATS`.
    options
        Of drawings, as on the command line, and ``margin``: a free edge all round, as a share of
        the canvas' longer side.
    behind
        Picture or gradient that covers the canvas, with its free edge.
    """
    if kind not in FORMATS:
        raise WriteError(kind[:20], f"is no format; use one of {', '.join(FORMATS)}")
    drawing, margin = _drawing(options), _margin(options)
    if margin:
        layout = framed(layout, (margin * layout.container.side,) * 4)
        layout = _covered(layout, behind)
    return encoded(layout, f"layout.{kind}", drawing)


def _covered(layout: Layout, behind: Item | None) -> Layout:
    if behind is None:
        return layout
    cover = covering(behind, sheet_box(layout.container))
    return replace(layout, container=replace(layout.container, backdrop=cover))


def film_of(
    layout: Layout, kind: str, options: Mapping[str, Any], behind: Item | None = None
) -> bytes:
    """A film of how the items of a layout came where they are.

    Parameters
    ----------
    kind
        One of :data:`FILM_FORMATS`.
    options
        Of films, as on the command line, and ``background`` and ``show_container``.
    behind
        Picture or gradient that covers the whole frame.
    """
    if kind not in FILM_FORMATS:
        raise WriteError(kind[:20], f"is no film; use one of {', '.join(FILM_FORMATS)}")
    film = in_frame(Film(layout, *_filming(options)))
    # The frame is there: a film of its ratio has no other one about it.
    settings = film.options.model_copy(update={"film_ratio": CANVAS})
    film = replace(film, layout=_covered(film.layout, behind), options=settings)
    return film_bytes(film, f"layout.{kind.removeprefix(FILM)}")


def check(kind: str, options: Mapping[str, Any]) -> None:
    """Refuse options that a layout's format or a film's does not have."""
    if kind in FILM_FORMATS:
        _filming(options)
    else:
        _drawing(options)
        _margin(options)


def _filming(options: Mapping[str, Any]) -> tuple[FilmOptions, str, bool | None]:
    drawn: dict[str, Any] = {"background": "white", "show_container": None}
    drawn |= {name: options[name] for name in drawn if name in options}
    _drawing(drawn)
    settings = film_options(**{name: value for name, value in options.items() if name not in drawn})
    return settings, str(drawn["background"]), drawn["show_container"]


def missing() -> dict[str, str]:
    """Formats whose packages are not installed, each with a line that says what to install."""
    found = {}
    for kind in (*FORMATS, *FILM_FORMATS):
        try:
            check_extra(f"layout.{kind}")
        except WriteError as error:
            found[kind] = str(error).partition(": ")[2]
    return found


def recipe_zip(document: Document, name: str) -> bytes:
    """A document as a recipe: a folder in a ZIP file, with a text that tells how to run it."""
    made, known = BytesIO(), "".join(c for c in name if c.isalnum() or c in " -_")[:60].strip()
    with (
        TemporaryFolder("recipe") as place,
        zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as packed,
    ):
        folder = place.path / (known or "collage")
        write_recipe(Session(document), folder)
        for file in sorted(folder.rglob("*")):
            if file.is_file():
                packed.write(file, file.relative_to(place.path))
        packed.writestr(f"{folder.name}/README.txt", "\n".join((*LINES, "")))
    return made.getvalue()


def _drawing(options: Mapping[str, Any]) -> WriteOptions:
    """Options of drawings, or a refusal that names the first that is wrong."""
    if isinstance(options.get("icc"), str):
        raise RecipeError(
            "icc", "names a file of this machine; save the layout and use --icc of packwork edit"
        )
    try:
        return write_options(**{k: v for k, v in options.items() if k != "margin"})
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        key = ".".join(str(part) for part in first["loc"])
        raise RecipeError(key[:40], first["msg"]) from None


def _margin(options: Mapping[str, Any]) -> float:
    margin = parse_share(options.get("margin", 0.0))
    if isinstance(margin, bool) or not isinstance(margin, int | float) or not 0 <= margin <= 1:
        raise RecipeError("margin", f"must be a share from 0 to 100%, not {str(margin)[:40]!r}")
    return float(margin)


def kept_bytes(kept: SessionState) -> bytes:
    """A session's file, ``.packwork``, with all that undo and redo lead to."""
    return session_bytes(kept, Things())


SESSION = ENDING.removeprefix(".")
"""Ending of session files, without the dot."""
