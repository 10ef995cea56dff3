"""Kernels compiled before a run, by two processes at once, and counted.

Each part exercises some kernels on next to nothing, so that they are compiled for the very types
that a run uses. Where none is kept yet, a second process takes parts from the other end of the
list; what it compiles comes back by way of the cache. A run of one thread has no second process.
"""

from __future__ import annotations

import contextlib
import functools
import gc
import json
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from packwork import compiled, threads
from packwork.compaction.arrangement import Arrangement
from packwork.compaction.kernels import (
    broad_phase,
    interior_point,
    outer_simplify,
    steps,
)
from packwork.compaction.kernels.contacts import rows_of
from packwork.compaction.kernels.steps import Objective
from packwork.compaction.kernels.trials import (
    Rounds,
    Trial,
    allocate_batch,
    attempt,
    choose_disjoint,
)
from packwork.fields.distance_transform import distance_to, label_components
from packwork.geometry.affine import similarity
from packwork.geometry.distance import clearance
from packwork.geometry.outline import Outline, joined
from packwork.losses.image import Windows
from packwork.offspring import END_WITH_PARENT
from packwork.pipeline.result import find_unplaced
from packwork.raster.membership import centre_count
from packwork.scene.container import Container
from packwork.scene.item import FlatArt, Item
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.solve.options import SolveOptions
from packwork.solve.solver import solve
from packwork.temporary import TemporaryFolder

KERNELS = 32
"""Kernels that all parts compile; a test counts them."""

MODULES = (
    "packwork.compaction.kernels.broad_phase",
    "packwork.compaction.kernels.contacts",
    "packwork.compaction.kernels.distances",
    "packwork.compaction.kernels.interior_point",
    "packwork.compaction.kernels.outer_simplify",
    "packwork.compaction.kernels.steps",
    "packwork.compaction.kernels.trials",
    "packwork.fields._kernels",
    "packwork.geometry._kernels",
    "packwork.losses._kernels",
    "packwork.raster.kernels.coverage",
    "packwork.raster.kernels.membership",
    "packwork.solve._kernels",
)
"""Modules of these kernels; a test compares them. Once all are kept, no second process is started,
whatever else a verb has loaded."""

SECONDS_BETWEEN = 0.05
"""Time between two looks at the second process. Chosen."""

Part = Callable[[], None]
"""Compiles some kernels, or loads them."""

Counted = Callable[[int], None]
"""Told how many kernels are compiled or loaded."""

_ready = functools.cache(lambda part: part())
"""Does a part once: then this process has its kernels."""

_HELPER = (
    END_WITH_PARENT + "import json; sys.path[:] = json.loads(sys.argv[1])\n"
    "from packwork.precompile import help_out; help_out(sys.argv[2])"
)


def warm_up(counted: Counted | None = None, second: bool = False) -> None:
    """Load the compiled kernels, or compile them on the first run ever on a machine.

    Parameters
    ----------
    counted
        Told of each kernel that is compiled, by how many there are until then.
    second
        Whether a second process may be started to help; one that ends with this one.
    """
    done = 0
    lock = threading.Lock()

    def one_more() -> None:
        nonlocal done
        with lock:
            done += 1
            if counted is not None:
                counted(min(done, KERNELS))

    def tell(kernel: str, is_done: bool) -> None:
        if is_done:
            one_more()

    with contextlib.ExitStack() as stack:
        if counted is not None:
            stack.enter_context(compiled.listening(tell))
        mark = _missing() if second else None
        if mark is not None:
            # Where no process can be started, this one does all.
            with contextlib.suppress(OSError), helped(one_more) as (claims, helper):
                share(PARTS, claims)
                while helper.poll() is None:
                    time.sleep(SECONDS_BETWEEN)
            stack.callback(compiled.STORE.put, mark, b"")
        # What another process has compiled is loaded; what is left is compiled.
        for part in PARTS:
            _ready(part)


def warm_up_once() -> None:
    """Compile what no earlier run has, if two processes may; what a script does before a run.

    Else kernels are compiled, or loaded, when they are called.
    """
    if _missing() is not None:
        warm_up(second=True)


def help_out(claims: str) -> None:
    """Compile parts that are not claimed yet, last ones first; what a second process does."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # A tenth of the time goes into looking for garbage, of which there is little.
    gc.set_threshold(50_000)

    def follow() -> None:
        # The other end is closed when the parent process has ended, however that was.
        sys.stdin.buffer.read()
        os._exit(1)

    threading.Thread(target=follow, daemon=True).start()

    def tell(kernel: str, is_done: bool) -> None:
        if is_done:
            sys.stdout.write("\n")
            sys.stdout.flush()

    with compiled.listening(tell):
        share(PARTS[::-1], Path(claims))
    # The thread that waits would hold up an ordinary end.
    os._exit(0)


@contextlib.contextmanager
def helped(one_more: Callable[[], None]) -> Iterator[tuple[Path, Any]]:
    """A second process, which is ended with the block, and where parts are claimed."""
    with TemporaryFolder("claims") as folder:
        claims = folder.path
        # Not ``-m``, which would look for modules in the current folder.
        command = [sys.executable, "-P", "-c", _HELPER, json.dumps(sys.path), str(claims)]
        with subprocess.Popen(  # noqa: S603 - ourselves
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
        ) as helper:

            def count() -> None:
                for _ in helper.stdout or ():
                    one_more()

            counter = threading.Thread(target=count, daemon=True)
            counter.start()
            try:
                yield claims, helper
            finally:
                helper.kill()
                counter.join()


def share(parts: Sequence[Part], claims: Path) -> None:
    """Do all parts that no other process does."""
    for part in parts:
        try:
            (claims / part.__name__).touch(exist_ok=False)
        except FileExistsError:
            continue
        part()


def _missing() -> str | None:
    """Mark of all kernels, where it is not kept and a second process may help with them."""
    mark = _mark() if _may_have_help() else None
    return None if mark is None or compiled.STORE.get(mark) is not None else mark


def _may_have_help() -> bool:
    """Whether there is a second core, a Python to start, and a cache to meet in."""
    cores = min(threads.available(), threads.thread_count())
    # Of a program with Python inside it is that program.
    is_python = Path(sys.executable or "").stem.lower().startswith("python")
    is_ours = is_python and not getattr(sys, "frozen", False) and compiled.HAS_OWN_CACHE
    return is_ours and cores > 1 and compiled.STORE.folder is not None


def _mark() -> str | None:
    """Mark beside the kernels once all parts are there; None where texts are not to be had."""
    try:
        return compiled.mark_of(MODULES)
    except OSError:
        return None


def _square(half: float) -> Outline:
    return Outline.box(-half, -half, half, half)


def _container() -> Container:
    region = _square(1.0).mapped(similarity(4.0, 4.0, 0.0, 3.0))
    return Container("warm-up", "", region, 8.0, 8.0)


def _poses() -> Poses:
    return Poses(*(np.full(1, value) for value in (4.0, 4.0, 0.0, 1.0)))


def levels() -> None:
    """Losses, steps; the renderer's way back."""
    for evenness in (0.0, 1.0):
        options = SolveOptions(levels=(8,), epochs=1, losses={"evenness": evenness})
        solve(_container(), [_square(1.0)], _poses(), np.ones(1), options)


def evenness() -> None:
    """Windows of evenness."""
    image = np.ones((8, 8), np.float32)
    windows = Windows(image, 1)
    windows.derivative(windows.blocks(image))


def pairs() -> None:
    """Pairs of near items, simpler outlines."""
    near = _arrangement()
    near.pairs(1.0)
    broad_phase.pairs_of(near.board.boxes, np.arange(1), 1.0)
    steps.step_of(near.board, np.arange(1), np.zeros(4), 0.1)
    outer_simplify.simplify_outward(_square(1.0).rings[0], 0.01)


def images() -> None:
    """Renderer, then what measures are made of: they themselves look at a million pixels."""
    container = _container()
    item = Item("warm-up", "", _square(1.0), _square(1.0), FlatArt())
    layout = Layout(container, (item,), _poses(), np.ones(1))
    find_unplaced(layout)
    covered = centre_count(*joined(layout.outlines), (8, 8)) > 0
    distance_to(covered)
    label_components(covered)


def contacts() -> None:
    """Contacts, which keep items apart."""
    near = _arrangement()
    rows_of(near.board, np.arange(1), near.pairs(1.0), 0.1, 0.0, 0.01)


def programmes() -> None:
    """The best step."""
    rows = interior_point.Rows(
        np.zeros(1, np.int64), np.full(1, -1), np.zeros((1, 8)), np.ones(1)
    )  # fmt: skip
    interior_point.maximise(rows, np.ones(4), -np.ones(4), np.ones(4), 0.1)


def checks() -> None:
    """Distances, and what makes room."""
    near = _arrangement()
    them = near.pairs(1.0)
    near.distances(them, 1.0)
    steps.clear_by_shrinking(near.board, np.arange(1), them, 0.0, 0.1, 1)
    clearance(near.container.region, 1.0)


def trials() -> None:
    """Compaction, and trials of a finish, after what they are made of."""
    near = _arrangement()
    one, box = np.arange(1), np.array([[0.0, 0.0, 8.0, 8.0]])
    trial = Trial(one, near.places[None].copy(), one, one, box)
    rounds = Rounds(0.1, np.full(1, 0.1), np.full(1, np.inf))
    attempt(near.board, _objective(), trial, rounds, np.inf, -np.inf, 0.0, 0.01)


def neighbourhoods() -> None:
    """Neighbourhoods: trials that may be made at once."""
    near = _arrangement()
    broad_phase.nearby(near.board.boxes, np.arange(1), 1.0)
    moved, places = np.array([[0, -1]]), np.zeros((1, 2, 4))
    choose_disjoint(near.board, near.radii, moved, places, 6, 1.0, 1.0, allocate_batch(1, 6, 1))


PARTS: tuple[Part, ...] = (
    checks, pairs, neighbourhoods, trials, levels, evenness, images, contacts, programmes,
)  # fmt: skip
"""All parts, so that each process finds ready what its own are made of: trials need checks,
contacts and programmes, levels need images and evenness. The first process does about the first
five, the second the others from the end."""


def _arrangement() -> Arrangement:
    return Arrangement([_square(1.0)], _container().outline, np.array([[4.0, 4.0, 0.0, 0.0]]))


def _objective() -> Objective:
    free = np.full(1, 9.0)
    return Objective(-free, free, -free, free, np.ones(1), 2.0, np.zeros((1, 2)))
