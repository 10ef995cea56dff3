"""SVG documents to pictures, by resvg: the one place that calls it.

While resvg works no other thread of Python runs, and Ctrl-C is not heard. So what may take long
is drawn by a process of its own, which can be waited for, and ended.
"""

from __future__ import annotations

import io
import json
import os
import subprocess
import sys
from typing import TYPE_CHECKING, Any

from packwork.fonts import FontChoice, fonts_of, with_stand_ins
from packwork.offspring import END_WITH_PARENT

if TYPE_CHECKING:
    from PIL import Image

_DPI = 96
_LONGEST_REASON = 160

LONG = 100_000
"""Characters of a document from which a process of its own draws it: resvg takes up to a second for
them, a process 0.03 s to start. Larger leaves Ctrl-C unheard, smaller starts processes for icons.
Measured."""

_WORK = f"""{END_WITH_PARENT}
import json
asked = json.loads(sys.stdin.buffer.read())
sys.path[:] = asked["path"]
import resvg_py
try:
    picture = resvg_py.svg_to_bytes(**asked["options"])
except BaseException as error:
    if not isinstance(error, ValueError) and type(error).__name__ != "PanicException":
        raise
    sys.stdout.buffer.write(b"!" + str(error).encode(errors="replace"))
else:
    sys.stdout.buffer.write(b"=" + bytes(picture))
"""


def encoded_picture(picture: Image.Image, kind: str, **settings: Any) -> bytes:
    """File of a picture, as Pillow writes that kind."""
    file = io.BytesIO()
    picture.save(file, kind, **settings)
    return file.getvalue()


def drawn_png(document: str) -> bytes:
    """PNG of an SVG document, one of ours or a cleaned one, at its own size.

    Its letters are set in fonts that we choose. Raises ``ValueError`` if resvg gives up; the
    message is one line.

    >>> drawn_png('<svg xmlns="http://www.w3.org/2000/svg" width="2" height="2"/>')[1:4]
    b'PNG'
    """
    # Fonts are looked up only where text is drawn: that takes longer than the rest.
    fonts = fonts_of(document)
    document = with_stand_ins(document)
    options = {"svg_string": document, "dpi": _DPI, "skip_system_fonts": True}
    options |= font_options(fonts) if fonts else {}
    is_long = len(document) >= LONG and bool(sys.executable)
    return _drawn_elsewhere(options) if is_long else _drawn_here(options)


def _drawn_here(options: dict[str, Any]) -> bytes:
    import resvg_py

    try:
        return bytes(resvg_py.svg_to_bytes(**options))
    except BaseException as error:
        # A panic of the native library is no Exception, and no reason to end the program.
        if not isinstance(error, ValueError) and type(error).__name__ != "PanicException":
            raise
        raise ValueError(_reason(str(error))) from None


def _drawn_elsewhere(options: dict[str, Any]) -> bytes:
    """By a second process, which Ctrl-C at the terminal does not reach: it is ended from here."""
    asked = {"path": sys.path, "options": options}
    try:
        process = subprocess.Popen(  # noqa: S603 - our own words, the document comes as data
            [sys.executable, "-P", "-c", _WORK],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            **_APART,
        )
    except OSError:  # no process to be had
        return _drawn_here(options)
    try:
        answer: bytes = process.communicate(json.dumps(asked).encode(errors="replace"))[0]
    finally:
        process.kill()
        process.wait()
        for pipe in (process.stdin, process.stdout):
            if pipe is not None:
                pipe.close()
    if process.returncode:
        raise ValueError(f"resvg ended with {process.returncode}")
    said, rest = answer[:1], answer[1:]
    if said == b"=":
        return rest
    raise ValueError(_reason(rest.decode()))


def _reason(text: str) -> str:
    return " ".join(text.split())[:_LONGEST_REASON]


_APART: dict[str, Any] = (
    {"creationflags": getattr(subprocess, "CREATE_NEW_PROCESS_GROUP", 0)}
    if os.name == "nt"
    else {"start_new_session": True}
)


def font_options(fonts: FontChoice) -> dict[str, Any]:
    """The same, as resvg's options are called.

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
