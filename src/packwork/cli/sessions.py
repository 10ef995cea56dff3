"""Session files among the outputs of a run."""

from __future__ import annotations

import contextlib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from packwork.readers.layouts.read import is_session
from packwork.scene.colour import hex_colour, parse_colour
from packwork.scene.layout import Layout
from packwork.writers.options import GONE_ON_WITH


def told(layout: Layout, background: str | None, drawing: Mapping[str, Any]) -> Layout:
    """The layout, its manifest saying how it is drawn, for files that are gone on with."""
    asked = {key: drawing[key] for key in GONE_ON_WITH if drawing.get(key)}
    said = {} if background is None else {"ground": hex_colour(parse_colour("", background))}
    if not asked and not said:
        return layout
    return replace(layout, manifest={**layout.manifest, **said, "drawing": asked})


@contextlib.contextmanager
def saving(layout: Layout, files: Iterable[Path]) -> Iterator[list[tuple[Path, bytes]]]:
    """Session files among outputs, and their bytes, for the block to write."""
    paths = [path for path in files if is_session(path)]
    if not paths:
        yield []
        return
    # Only what is asked for loads all of a session.
    from packwork.live.file.disk import saving as saving_them

    with saving_them(layout, paths) as written:
        yield written
