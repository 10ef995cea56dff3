"""One example of the peer's, run unchanged by either package in turn, in one process."""

from __future__ import annotations

import contextlib
import json
import logging
import os
import runpy
import sys
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import numpy.typing as npt

from benchmarks.kit.manifests import Manifest
from benchmarks.words.composition import composition
from benchmarks.words.standing_in import Watched, standing_in, warm_up, watching

SHOWN = 128
"""Grey, of 255, from which a pixel of white words on black is drawn on."""


def measured(
    script: Path, packages: dict[str, ModuleType], rounds: int, pictures: Path | None = None
) -> dict[str, Manifest]:
    """Seconds of each round and what the first drew, by package; or why there is nothing.

    Parameters
    ----------
    script
        The example; it runs in its own folder, and may write there.
    packages
        That are run in turn.
    rounds
        How often each.
    pictures
        Folder for what the first round drew, one PNG per cloud.
    """
    found: dict[str, Manifest] = {name: {"seconds": []} for name in packages}
    folder = None if pictures is None else pictures.absolute()
    for turn in range(rounds):
        for name, module in packages.items():
            if found[name].keys() & {"lacks", "fails"}:
                continue
            try:
                with _in_its_folder(script):
                    watched = _run(script, module)
                    # Fonts that an example names may lie in its folder.
                    if turn == 0 and folder is not None:
                        _draw(watched.clouds, folder, f"{script.stem}-{name}")
                    if turn == 0:
                        found[name]["clouds"] = [figures(cloud) for cloud in watched.clouds]
                found[name]["seconds"].append(watched.seconds)
            except ImportError as error:
                found[name] = {"lacks": error.name or str(error)}
            except Exception as error:  # noqa: BLE001 (whatever a program may raise is its result)
                found[name] = {"fails": f"{type(error).__name__}: {error}".splitlines()[0][:160]}
    return found


@contextlib.contextmanager
def _in_its_folder(script: Path) -> Iterator[None]:
    """The folder, arguments and path of modules that a script is started with."""
    here, arguments, path = Path.cwd(), sys.argv, list(sys.path)
    os.chdir(script.parent)
    sys.argv, sys.path = [str(script)], [str(script.parent), *path]
    try:
        yield
    finally:
        os.chdir(here)
        sys.argv, sys.path = arguments, path


def _run(script: Path, module: ModuleType) -> Watched:
    """As a program, its output and warnings left out."""
    try:
        with (
            standing_in(module),
            watching(module) as watched,
            contextlib.redirect_stdout(sys.stderr),
            warnings.catch_warnings(),
        ):
            warnings.simplefilter("ignore")
            runpy.run_path(str(script), run_name="__main__")
    finally:
        if "matplotlib.pyplot" in sys.modules:
            sys.modules["matplotlib.pyplot"].close("all")
    return watched


def _draw(clouds: list[Any], folder: Path, name: str) -> None:
    for number, cloud in enumerate(clouds):
        cloud.to_image().save(folder / f"{name}-{number}.png")


def figures(cloud: Any) -> Manifest:
    """Words, sizes, ink and composition of a cloud; its colours and contour are lost."""
    sizes = np.array([entry[1] for entry in cloud.layout_], dtype=np.float64)
    cloud.contour_width, cloud.background_color, cloud.mode = 0, "black", "RGB"
    shown = _grey(cloud, lambda *_, **__: "white") >= SHOWN
    largest = float(sizes.max())
    # Edges of letters are blended with the black behind them, which lessens their weight only.
    heights = _grey(cloud, lambda *_, font_size, **__: (round(255 * font_size / largest),) * 3)
    free = free_pixels(cloud.mask, shown.shape)
    return {
        "words": len(sizes),
        "largest": largest,
        "median": float(np.median(sizes)),
        "ink": float(shown.sum() / free.sum()),
        **composition(shown, heights, free),
    }


def _grey(cloud: Any, color_func: Callable[..., Any]) -> npt.NDArray[np.float64]:
    """Pixels of a cloud in other colours, 0 to 255."""
    cloud.recolor(color_func=color_func)
    return np.asarray(cloud.to_image().convert("L"), dtype=np.float64)


def free_pixels(mask: Any, shape: tuple[int, ...]) -> npt.NDArray[np.bool_]:
    """Pixels of a picture of that shape that words may lie on: all where a mask is not white.

    >>> free_pixels(np.array([[0, 255], [255, 254]]), (2, 2)).tolist()
    [[True, False], [False, True]]
    """
    if mask is None:
        return np.ones(shape[:2], dtype=np.bool_)
    white = mask == 255 if mask.ndim == 2 else (mask[:, :, :3] == 255).all(axis=-1)
    if white.all():
        return np.ones(shape[:2], dtype=np.bool_)
    rows, columns = (np.arange(n) * m // n for n, m in zip(shape, white.shape, strict=False))
    return np.asarray(~white[np.ix_(rows, columns)])


def main(script: str, rounds: str, pictures: str, result: str) -> None:
    """Both packages, in a process of their own: the result as JSON into a file."""
    import wordcloud
    from packwork import wordcloud as ours

    logging.getLogger("packwork").setLevel(logging.ERROR)
    packages = {"wordcloud": wordcloud, "packwork": ours}
    for module in packages.values():
        warm_up(module)
    found = measured(Path(script), packages, int(rounds), Path(pictures) if pictures else None)
    Path(result).write_text(json.dumps(found), encoding="utf-8")
