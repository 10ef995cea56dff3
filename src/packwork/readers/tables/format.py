"""Options of text tables: delimiter, decimal sign, encoding."""

from __future__ import annotations

import codecs
from typing import Annotated, Literal

from pydantic import field_validator

from packwork.errors import RecipeError
from packwork.options import Group, Offer, Options, Verbs

NAMES = {"tab": "\t", "\\t": "\t", "comma": ",", "semicolon": ";", "space": " ", "pipe": "|"}
"""What people call characters that are hard to type."""


class TableFormat(Options):
    """Notation of tables of text. Nothing has to be said of what is plain from a file."""

    offers = Offer(group=Group.TABLES, verbs=Verbs.EVERY)

    delimiter: str | None = None
    """What parts the cells of a table: one character, such as ; or tab. Default: what parts all of
    its lines alike."""

    decimal: Literal[".", ","] | None = None
    """What parts the whole of a number from its fraction in tables and texts of cells: . or ,
    (the other one, spaces and apostrophes then group thousands). Default: as the numbers of
    the column show."""

    encoding: str | None = None
    """How the letters of a table or a text are stored, such as utf-8, cp1252 or cp1251. Default:
    UTF-8, UTF-16, or the Windows encoding that its letters show."""

    keep_totals: Annotated[bool, Offer(verbs=Verbs.CHART | Verbs.WORDS)] = False
    """Take rows that are totals of the others, such as one called Total or Sum, for rows like
    them. Default: they are left out and named."""

    @field_validator("delimiter", mode="before")
    @classmethod
    def _delimiter_is_one_character(cls, text: object) -> object:
        if text is None:
            return None
        found = NAMES.get(str(text).lower(), str(text))
        if len(found) != 1 or found in '"\r\n\0':
            raise RecipeError(
                "delimiter", f"use one character, such as ; or tab, not {str(text)[:40]!r}"
            )
        return found

    @field_validator("encoding")
    @classmethod
    def _encoding_is_known(cls, text: str | None) -> str | None:
        if text is None:
            return None
        try:
            # What turns bytes into bytes is no encoding of text.
            b"abcd".decode(codecs.lookup(text).name, errors="replace")
        except (LookupError, ValueError, TypeError):
            raise RecipeError(
                "encoding", f"use a name such as utf-8, cp1252 or cp1251, not {text[:40]!r}"
            ) from None
        return text
