"""What all tests share: how hypothesis searches, a seeded generator, machines with their fonts."""

from __future__ import annotations

import contextlib
import functools
import gc
import os
import time
from collections.abc import Callable, Iterator

import numpy as np
import pytest
import typer.testing
from hypothesis import HealthCheck, settings

import packwork
from made_fonts import make_font_folders
from packwork import compiled, precompile
from packwork.display import bar
from packwork.fonts import FOLDERS
from packwork.live import local_solver
from packwork.metrics import pixel
from packwork.readers import cache

# Kernels compile on their first call, and run uncompiled under NUMBA_DISABLE_JIT=1, a hundred
# times slower: no example may fail for being slow, and there a few do, for indices out of bounds
# show in each. Search wider with `--hypothesis-profile=explore`.
_PATIENT = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
_EXAMPLES = 8 if os.environ.get("NUMBA_DISABLE_JIT") == "1" else 40
settings.register_profile("check", _PATIENT, max_examples=_EXAMPLES, derandomize=True)
settings.register_profile("explore", _PATIENT, max_examples=2_000)
settings.load_profile("check")

# Thousands of tests are collected, and looked through for garbage again and again.
gc.set_threshold(50_000)

SECONDS_BETWEEN = 0.2
"""Time between two looks whether the kernels are compiled. Chosen."""

MOST_SECONDS = 180.0
"""Time that is waited for them, for who compiles them may have been killed. Chosen: several times
what it takes on two processors."""

MEASURING = {"metrics", "batches"}
"""Rooms of tests that look at measures, or compare runs of this process with those of others."""

POLISHING = {"live", "batches"}
"""Rooms of tests that look at what sessions win back after an edit, or compare as above."""


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_auto_num_workers() -> int:
    """One more than there are processors, for many tests wait: for a browser, for processes."""
    return (os.cpu_count() or 1) + 1


def pytest_collection_finish() -> None:
    """What was collected stays, and is no garbage."""
    gc.collect()
    gc.freeze()


COMPILING: tuple[dict[str, Callable[[], object]], ...] = (
    {"most": precompile.warm_up_once},
    {
        "words": lambda: packwork.words("heart", {"owl": 2, "fox": 1}, effort="draft"),
        "pile": lambda: packwork.pile("square", "circle", count=2, size="30%"),
        "discs": lambda: packwork.fill(
            "circle", "circle", count=60, sizes="shared", effort="draft"
        ),
        "nest": lambda: packwork.nest("100mm", ["star", "moon"], passes=9),
        "lattice": lambda: packwork.nest("200x100mm", {"star": 9}, passes=9),
    },
)
"""What needs kernels that tests of many rooms need: first those that all runs have."""


@pytest.fixture(scope="session", autouse=True)
def _kernels(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Kernels of runs, each compiled by one worker for all; the first with a second process."""
    if "PYTEST_XDIST_WORKER" not in os.environ or os.environ.get("NUMBA_DISABLE_JIT") == "1":
        return
    for parts in COMPILING:
        claims = {tmp_path_factory.getbasetemp().parent / f"of-{name}": name for name in parts}
        for claim, name in claims.items():
            with contextlib.suppress(FileExistsError):
                claim.mkdir()
                try:
                    parts[name]()
                finally:
                    (claim / "done").touch()
        end = time.monotonic() + MOST_SECONDS
        while time.monotonic() < end and not all((claim / "done").exists() for claim in claims):
            time.sleep(SECONDS_BETWEEN)


class _OfThisSession(dict[str, bytes]):
    """What these tests read."""

    put = dict.__setitem__


@pytest.fixture(scope="session", autouse=True)
def _nothing_by_chance() -> Iterator[None]:
    """What a test sees is not decided by time, by the order of tests or by other runs."""
    with pytest.MonkeyPatch.context() as patch:
        # Lines of progress come with time.
        patch.setattr(bar, "SECONDS_BEFORE_LINE", float("inf"))
        # Which test compiles the first kernel, and logs that, is chance.
        patch.setattr(compiled.listeners, "_tell_once", lambda: None)
        patch.setattr(cache, "DRAWINGS", _OfThisSession())
        patch.setattr(cache, "GLYPHS", _OfThisSession())
        # Files of tests need not outlive the machine's next failure.
        patch.setattr(os, "fsync", lambda _: None)
        yield


@pytest.fixture(scope="module", autouse=True)
def _coarse_measures(request: pytest.FixtureRequest) -> Iterator[None]:
    """Whole runs, of which tests look at other things, are measured by fewer pixels.

    Sessions win back less after an edit.
    """
    with pytest.MonkeyPatch.context() as patch:
        if request.path.parent.name not in MEASURING:
            patch.setattr(pixel, "RESOLUTION", 300)
            patch.setattr(pixel, "SHAPE_RESOLUTION", 200)
        if request.path.parent.name not in POLISHING:
            patch.setattr(local_solver, "ENOUGH", 1)
        yield


@pytest.fixture(scope="session", autouse=True)
def _one_command_line() -> Iterator[None]:
    """The command line is put together once, as in a process of its own, not at each call."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(typer.testing, "_get_command", functools.cache(typer.testing._get_command))
        yield


@pytest.fixture
def rng() -> np.random.Generator:
    """Generator with a fixed seed, new for each test."""
    return np.random.default_rng(20_250_711)


@pytest.fixture(scope="session")
def font_folders(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """Machines by name (no fonts, DejaVu only, many fonts), each with its font folders."""
    return make_font_folders(tmp_path_factory.mktemp("machines"))


@pytest.fixture(params=["no fonts", "DejaVu only", "many fonts"])
def machine(request, font_folders, monkeypatch) -> str:
    """Each kind of machine in turn: its name, fonts looked for in its folders alone."""
    monkeypatch.setenv(FOLDERS, font_folders[request.param])
    return request.param
