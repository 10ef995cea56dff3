"""SVG documents to pictures, by resvg: the one place that calls it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

_DPI = 96
_LONGEST_REASON = 160


@dataclass(frozen=True, kw_only=True)
class Fonts:
    """What the letters of a document may be set in.

    Parameters
    ----------
    files
        Font files to choose from.
    serif, sans_serif, monospace
        Families that the generic names stand for; ``serif`` also stands in for a family
        that is not there.
    with_installed
        Whether letters that none of the files has may come from any installed font.
    """

    files: tuple[str, ...]
    serif: str
    sans_serif: str
    monospace: str
    with_installed: bool = False


def drawn_png(document: str, fonts: Fonts | None = None) -> bytes:
    """PNG of an SVG document at its own size; it must be one of ours or a cleaned one.

    Parameters
    ----------
    document
        Complete, as text.
    fonts
        For its letters; the installed ones if none are given.

    Raises
    ------
    ValueError
        If resvg gives up; the message is one line.

    Examples
    --------
    >>> drawn_png('<svg xmlns="http://www.w3.org/2000/svg" width="2" height="2"/>')[1:4]
    b'PNG'
    """
    import resvg_py

    # Fonts are looked up only where text is drawn: that takes longer than the rest.
    plain: dict[str, Any] = {"skip_system_fonts": "<text" not in document}
    try:
        options = plain if fonts is None else _font_options(fonts)
        picture = resvg_py.svg_to_bytes(svg_string=document, dpi=_DPI, **options)
    except BaseException as error:
        # A panic of the native library is no Exception, and no reason to end the program.
        if not isinstance(error, ValueError) and type(error).__name__ != "PanicException":
            raise
        raise ValueError(" ".join(str(error).split())[:_LONGEST_REASON]) from None
    return bytes(picture)


def _font_options(fonts: Fonts) -> dict[str, Any]:
    return {
        "skip_system_fonts": not fonts.with_installed,
        "font_files": list(fonts.files),
        "font_family": fonts.serif,
        "serif_family": fonts.serif,
        "sans_serif_family": fonts.sans_serif,
        "monospace_family": fonts.monospace,
        "cursive_family": fonts.sans_serif,
        "fantasy_family": fonts.sans_serif,
    }
