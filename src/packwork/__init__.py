"""Packwork arranges shapes so that they fill a container of any form.

>>> import packwork as pw
>>> layout = pw.fill("heart", ["circle"], count=2, effort="draft", levels="50", seed=0)
>>> len(layout.items)
2
"""

from __future__ import annotations

import importlib
import sys

from packwork.readers import layouts as _layouts

# Not from ``typing``: its import takes ten milliseconds in which Ctrl-C would be a traceback.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from pathlib import Path
    from typing import Any

    from packwork.scene import layout as scene


_HOMES = {
    "packwork.api.batches": ("Batch", "batch"),
    "packwork.api.history": ("History",),
    "packwork.api.inputs": ("Container", "Item", "read_container", "read_items"),
    "packwork.api.judging": ("finish", "measure"),
    "packwork.api.layout": ("Layout",),
    "packwork.api.nesting": ("Nest", "nest"),
    "packwork.api.parts": ("Placement",),
    "packwork.api.series": ("Series", "chart_series", "series"),
    "packwork.api.session": ("Session",),
    "packwork.api.verbs": ("chart", "fill", "photos", "pile", "run", "words"),
    "packwork.errors": ("PackworkError", "ReadError", "RecipeError", "ShapeError", "WriteError"),
    "packwork.fit.fitted": ("FittedOutline", "fit_outline"),
    "packwork.geometry.outline": ("Outline",),
    "packwork.losses.term": ("ImageLoss", "PoseTerm", "PosedItems", "Term"),
    "packwork.metrics.measure": ("Metrics",),
    "packwork.progress": ("Step",),
    "packwork.raster.colour": ("render_colour", "render_colour_pullback"),
    "packwork.raster.coverage": ("render", "render_pullback"),
    "packwork.recipe.typed": ("Anchor", "Force", "Hero"),
    "packwork.scene.item": ("FlatArt",),
    "packwork.scene.pose": ("Poses",),
}
"""Public names by the modules that they are taken from."""

_OTHERWISE = {"render": "coverage", "render_pullback": "coverage_pullback"}
"""Names of these there, where they are others."""

_HOME_OF = {name: module for module, names in _HOMES.items() for name in names}

__all__ = sorted(["__version__", *_HOME_OF])


def __getattr__(name: str) -> Any:
    """Load a public name when it is first used, so that importing stays cheap."""
    if name == "__version__":
        return importlib.import_module("importlib.metadata").version("packwork")
    if name not in _HOME_OF:
        raise AttributeError(f"module 'packwork' has no attribute {name!r}")
    module = importlib.import_module(_HOME_OF[name])
    return getattr(module, _OTHERWISE.get(name, name))


def _layout_of_session(path: str | Path) -> scene.Layout:
    """Layout in a session's file: readers lie below sessions, so theirs is handed to them."""
    from packwork.live.file.disk import layout_in

    return layout_in(path)


_layouts.HANDED_IN[".packwork"] = _layout_of_session


def __dir__() -> list[str]:
    return __all__


class _Package(type(sys)):  # type: ignore[misc]
    """The package, in which :func:`finish` is the verb and not the stage of that name.

    Whoever imports from the package ``packwork.finish`` still finds it.
    """

    def __setattr__(self, name: str, value: Any) -> None:
        if not (name == "finish" and isinstance(value, type(sys))):
            super().__setattr__(name, value)

    def __reduce__(self) -> tuple[Any, ...]:
        # Functions sent to other processes name it, and cloudpickle knows plain modules alone.
        return importlib.import_module, (__name__,)


sys.modules[__name__].__class__ = _Package
