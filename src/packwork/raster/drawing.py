"""SVG documents to pictures, by resvg: the one place that calls it."""

from __future__ import annotations

_DPI = 96
_LONGEST_REASON = 160


def drawn_png(document: str) -> bytes:
    """PNG of an SVG document at its own size; it must be one of ours or a cleaned one.

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

    try:
        # Fonts are looked up only where text is drawn: that takes longer than the rest.
        picture = resvg_py.svg_to_bytes(
            svg_string=document, dpi=_DPI, skip_system_fonts="<text" not in document
        )
    except BaseException as error:
        # A panic of the native library is no Exception, and no reason to end the program.
        if not isinstance(error, ValueError) and type(error).__name__ != "PanicException":
            raise
        raise ValueError(" ".join(str(error).split())[:_LONGEST_REASON]) from None
    return bytes(picture)
