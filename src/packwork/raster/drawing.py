"""SVG documents to pictures, by resvg: the one place that calls it."""

from __future__ import annotations

from typing import Any

from packwork.fonts import FontChoice, fonts_of

_DPI = 96
_LONGEST_REASON = 160


def drawn_png(document: str) -> bytes:
    """PNG of an SVG document at its own size; it must be one of ours or a cleaned one.

    Its letters are set in fonts that we choose, from where we look for them.

    Parameters
    ----------
    document
        Complete, as text.

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
    fonts = fonts_of(document)
    options = font_options(fonts) if fonts else {}
    try:
        picture = resvg_py.svg_to_bytes(
            svg_string=document, dpi=_DPI, skip_system_fonts=True, **options
        )
    except BaseException as error:
        # A panic of the native library is no Exception, and no reason to end the program.
        if not isinstance(error, ValueError) and type(error).__name__ != "PanicException":
            raise
        raise ValueError(" ".join(str(error).split())[:_LONGEST_REASON]) from None
    return bytes(picture)


def font_options(fonts: FontChoice) -> dict[str, Any]:
    """The same, as resvg's options are called.

    Examples
    --------
    >>> from packwork.fonts import fonts_for
    >>> font_options(fonts_for([], "a"))["font_files"][-1]
    '...InterDisplay-Black.otf'
    """
    return {
        "font_files": list(fonts.files),
        "font_family": fonts.serif,
        "serif_family": fonts.serif,
        "sans_serif_family": fonts.sans_serif,
        "monospace_family": fonts.monospace,
        "cursive_family": fonts.sans_serif,
        "fantasy_family": fonts.sans_serif,
    }
