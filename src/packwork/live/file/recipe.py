"""A session as a recipe: a folder from which a run goes on where the session is.

Everything is in it: the container and the drawings as SVG, the layout as GeoJSON. What is held in
any way has a drawing with a name of its own, so that rules speak of it alone.
"""

from __future__ import annotations

import contextlib
import re
import shlex
import tempfile
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from packwork.live.document import Document
from packwork.live.file.disk import Disk
from packwork.live.file.values import LONGEST_PRINT
from packwork.live.relayout import pin_of
from packwork.live.session import Session
from packwork.recipe import make_recipe
from packwork.scene.container import Container
from packwork.scene.item import FlatArt, Item, PhotoArt
from packwork.scene.notation import path_data
from packwork.writers import encoded, recipe_bytes, write_all, write_options

KEPT = ("seed", "effort", "holes", "stretch", "apart")
"""Options of the run that made the layout that hold for the next one too."""

_NO_LETTER = re.compile(r"[^\w .()-]")


@dataclass(frozen=True)
class SessionRecipe:
    """Recipe of a session: where it lies, and how it is run."""

    file: Path
    command: str
    python: str


def write_recipe(session: Session, folder: str | Path) -> SessionRecipe:
    """Write a folder with a recipe whose run starts from a session's layout."""
    document, into = session.document, Path(folder)
    names = _names(document)
    drawings = dict(zip(names, document.items, strict=True))
    renamed = tuple(
        replace(item, name=name) for name, item in zip(names, document.items, strict=True)
    )
    layout = replace(session.layout, items=renamed)
    options = _options(document, names)
    recipe = make_recipe(**options)
    file = into / "recipe.toml"
    written = [(into / "items" / f"{name}.svg", _drawing(item)) for name, item in drawings.items()]
    write_all(
        [
            *written,
            (into / "container.svg", _outlined(document.container)),
            (into / "layout.geojson", encoded(layout, Path("layout.geojson"), write_options())),
            (file, recipe_bytes(recipe.plain(), Path())),
        ]
    )
    out = into.name + ".svg"
    command = shlex.join(["packwork", "run", str(file), "-o", out])
    python = f"packwork.run({str(file)!r}).save({out!r})"
    return SessionRecipe(file, command, python)


@contextlib.contextmanager
def recipe_of_session(path: str | Path) -> Iterator[Path]:
    """A recipe that goes on from a session's file, there for the block."""
    with tempfile.TemporaryDirectory(prefix="packwork-session-") as folder:
        session = Disk(path, is_journaled=False).opened(Session)
        yield write_recipe(session, folder).file


def _options(document: Document, names: list[str]) -> dict[str, Any]:
    container, numbers = document.container, document.options
    before = document.manifest.get("recipe")
    known = before if isinstance(before, Mapping) else {}
    size = f"{container.width:.17g}x{container.height:.17g}{container.unit}"
    # A tile's items have no places to begin at or to stay at.
    ground: dict[str, Any]
    ground = {"container": "container.svg", "start": "layout.geojson", "stay": True}
    if container.lattice is not None:
        ground = {"container": "page", "tile": container.lattice.kind}
    return {
        **{name: known[name] for name in KEPT if known.get(name) is not None},
        **ground,
        "items": ["items"],
        "canvas": size,
        "padding": f"{numbers.padding:.17g}{container.unit}",
        "sizes": numbers.sizes,
        "size_ratio": numbers.size_ratio,
        "rotate": numbers.rotate,
        "force": numbers.force,
        "weights": _weights(document, names),
        "rules": _rules(document, names),
    }


def _weights(document: Document, names: list[str]) -> dict[str, float] | None:
    """Shares of area by name, unless all are one."""
    found = {name: float(weight) for name, weight in zip(names, document.weights, strict=True)}
    return found if np.ptp(document.weights) > 0 else None


def _rules(document: Document, names: list[str]) -> list[dict[str, Any]]:
    """Rules for the number of each name, and for the places of held items."""
    rules: list[dict[str, Any]] = []
    for name, count in Counter(names).items():
        rule: dict[str, Any] = {"items": [name], "count": count}
        k = names.index(name)
        if document.held[k].any() and document.container.lattice is None:
            rule["pin"] = pin_of(document, k)
        if rule != {"items": [name], "count": 1}:
            rules.append(rule)
    return rules


def _names(document: Document) -> list[str]:
    """Names of the drawings: one for each that differs, one of its own for what is held."""
    known: dict[object, str] = {}
    taken: set[str] = set()
    names = []
    for k, item in enumerate(document.items):
        key: object = ("held", k) if document.held[k].any() else item
        if key not in known:
            plain = _NO_LETTER.sub("_", item.name).strip(" .")[:60] or "item"
            number, name = 1, plain
            while name.lower() in taken:
                number += 1
                name = f"{plain} {number}"
            taken.add(name.lower())
            known[key] = name
        names.append(known[key])
    return names


def _drawing(item: Item) -> bytes:
    """An item as an SVG of its own, a unit of it one px."""
    art = item.art
    if isinstance(art, PhotoArt):
        art = art.original.printed(min(1.0, LONGEST_PRINT / item.outline.extent))
    if isinstance(art, FlatArt):
        inside = f'<path fill="{art.fill}" fill-rule="evenodd" d="{path_data(item.ink, 9)}"/>'
    else:
        matrix = " ".join(f"{value:.17g}" for value in art.matrix.T.ravel())
        inside = f'<g transform="matrix({matrix})">{art.markup}</g>'
    return _document(inside, item.outline.bounds)


def _outlined(container: Container) -> bytes:
    shown = f'<path fill-rule="evenodd" d="{path_data(container.outline, 12)}"/>'
    return _document(shown, (0.0, 0.0, container.width, container.height), container.unit)


def _document(inside: str, bounds: tuple[float, float, float, float], unit: str = "px") -> bytes:
    left, top, right, bottom = bounds
    width, height = right - left, bottom - top
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
        f' width="{width:.17g}{unit}" height="{height:.17g}{unit}"'
        f' viewBox="{left:.17g} {top:.17g} {width:.17g} {height:.17g}">{inside}</svg>'
    ).encode()
