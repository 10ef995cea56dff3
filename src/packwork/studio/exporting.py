"""Export of a desk's layout, as a file for the person who asks."""

from __future__ import annotations

import asyncio
from typing import Any

from packwork.errors import PackworkError, RecipeError
from packwork.live.face.exporting import (
    FILM_FORMATS,
    FORMATS,
    RECIPE,
    SESSION,
    film_of,
    kept_bytes,
    layout_bytes,
    recipe_zip,
)
from packwork.studio.desk import NOT_YET, Desk

BINARY = "application/octet-stream"

PATIENCE_SECONDS = 20.0
"""How long an export waits for what moves. Chosen."""


class Exporter:
    """Writes what the desk has."""

    def __init__(self, desk: Desk) -> None:
        self._desk = desk

    async def file(self, asked: Any) -> tuple[bytes, str]:
        """Bytes of a file, and what browsers call its format.

        Parameters
        ----------
        asked
            ``format``, and ``options`` of drawings by name.

        Raises
        ------
        PackworkError
            If it cannot be written so.
        """
        if not isinstance(asked, dict) or set(asked) - {"format", "options"}:
            raise RecipeError("export", "takes a format and options")
        kind, options = asked.get("format"), asked.get("options", {})
        if not isinstance(kind, str) or not isinstance(options, dict):
            raise RecipeError("export", "takes a format and options")
        if kind not in (*FORMATS, *FILM_FORMATS, SESSION, RECIPE):
            raise RecipeError("export", f"is not made as {kind[:20]!r}")
        owner = self._desk.owner
        if owner is None:
            raise PackworkError(NOT_YET)
        await self._at_rest()
        if kind == SESSION:
            kept = await asyncio.wrap_future(owner.call(lambda session: session.kept()))
            return await asyncio.to_thread(kept_bytes, kept), BINARY
        if kind == RECIPE:
            document = await asyncio.wrap_future(owner.call(lambda session: session.document))
            made = await asyncio.to_thread(recipe_zip, document, document.container.name)
            return made, "application/zip"
        layout = await asyncio.wrap_future(owner.call(lambda session: session.layout))
        if kind in FILM_FORMATS:
            return await asyncio.to_thread(film_of, layout, kind, options), FILM_FORMATS[kind]
        data = await asyncio.to_thread(layout_bytes, layout, kind, options)
        return data, FORMATS[kind]

    async def _at_rest(self) -> None:
        """Wait until nothing moves, for a while."""
        news = asyncio.Event()
        self._desk.listen(news, lambda _: news.set())
        try:
            async with asyncio.timeout(PATIENCE_SECONDS):
                while (shown := self._desk.shown) is None or shown.state.moving:
                    news.clear()
                    await news.wait()
        except TimeoutError:
            return
        finally:
            self._desk.forget(news)
