"""Films as MP4 (H.264) and WebM (VP9), by PyAV: the extra ``video``."""

from __future__ import annotations

import io
import logging
import platform
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np

from packwork.errors import WriteError
from packwork.raster.overlay import Picture
from packwork.writers.film.film import PAPER, Film, Tell, delays, tell_nobody
from packwork.writers.film.projector import Projector

_LOG = logging.getLogger(__name__)

_INSTRUCTIONS = "asm=SSE2" if platform.machine() in {"x86_64", "AMD64"} else "no-asm=1"
"""Those of AVX2 read memory at some widths that nobody has written, where x264 looks how long each
block lasts (``mbtree``), and then equal films are not equal files. These are no slower, and write
what plain C writes; without ``mbtree`` files are 1.7 times as large, and a frame that is held
changes more. Tried."""

MP4 = {
    "format": "mp4",
    "codec": "libx264",
    "options": {
        "crf": "18",
        "preset": "veryfast",
        "tune": "animation",
        "x264-params": _INSTRUCTIONS,
    },
}
"""Lower crf: larger files and cleaner edges; 18 is what people cannot tell from the picture.
Slower presets made no smaller files of drawings. Tried. Every player knows this codec and its
4:2:0 colours."""

WEBM = {
    "format": "webm",
    "codec": "libvpx-vp9",
    "options": {"crf": "24", "b": "0", "cpu-used": "6", "row-mt": "1", "deadline": "realtime"},
}
"""As above. The deadline "good" takes four times as long for files a fifth smaller. Tried."""

_ALIKE = {"fflags": "+bitexact"}
"""No number drawn at random names the file, so that equal films are equal files."""

BT709 = 1
"""Number of the colours that every screen and player of today expects, in FFmpeg's lists."""


def mp4_bytes(film: Film, tell: Tell = tell_nobody) -> bytes:
    """MP4 file of a film."""
    return _encoded(film, MP4, tell)


def webm_bytes(film: Film, tell: Tell = tell_nobody) -> bytes:
    """WebM file of a film."""
    return _encoded(film, WEBM, tell)


def _encoded(film: Film, kind: dict[str, Any], tell: Tell) -> bytes:
    import av

    film = _on_paper(film)
    projector = Projector(film, is_even=True)
    _notice_odd(film, projector, kind["format"])
    rate = Fraction(film.options.fps).limit_denominator(1_001)
    out = io.BytesIO()
    try:
        with av.open(out, "w", format=kind["format"], options=_ALIKE) as container:
            stream: Any = container.add_stream(kind["codec"], rate=rate, options=kind["options"])
            stream.width, stream.height = projector.frame.columns, projector.frame.rows
            stream.pix_fmt = "yuv420p"
            context = stream.codec_context
            context.colorspace = context.color_primaries = context.color_trc = BT709
            for number, picture in enumerate(_held(projector, film, tell)):
                plain = av.VideoFrame.from_ndarray(picture, format="rgb24")
                frame = plain.reformat(format="yuv420p", dst_colorspace="ITU709")
                frame.pts, frame.time_base = number, 1 / rate
                container.mux(stream.encode(frame))
            container.mux(stream.encode(None))
    except av.error.FFmpegError as error:
        raise WriteError(kind["format"].upper(), f"it cannot be encoded ({error})") from error
    return out.getvalue()


def _on_paper(film: Film) -> Film:
    """Film on something that video can show: it knows nothing clear."""
    if film.is_opaque:
        return film
    _LOG.warning("MP4 and WebM know no clear background: it is white")
    return replace(film, background=PAPER)


def _notice_odd(film: Film, projector: Projector, name: str) -> None:
    asked, columns, rows = film.options.film_pixels, projector.frame.columns, projector.frame.rows
    if asked % 2:
        _LOG.warning(
            "%s needs even sides: %d x %d px instead of %d", name.upper(), columns, rows, asked
        )


def _held(projector: Projector, film: Film, tell: Tell) -> Iterator[Picture]:
    """RGB of each frame, again and again for as long as it is held."""
    counts = iter(delays(film.seconds, film.options.fps))
    for picture in projector.pictures(tell):
        plain = np.ascontiguousarray(picture[:, :, :3])
        for _ in range(next(counts)):
            yield plain
