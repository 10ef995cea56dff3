"""What all tests share: how hypothesis searches, a seeded generator, machines with their fonts."""

from __future__ import annotations

import os

import numpy as np
import pytest
from hypothesis import HealthCheck, settings

from made_fonts import make_font_folders
from packwork import compiled
from packwork.display import bar
from packwork.fonts import FOLDERS
from packwork.readers import cache

# Kernels compile on their first call, and run uncompiled under NUMBA_DISABLE_JIT=1, a hundred
# times slower: no example may fail for being slow, and there a few do, for indices out of bounds
# show in each. Search wider with `--hypothesis-profile=explore`.
_PATIENT = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
_EXAMPLES = 8 if os.environ.get("NUMBA_DISABLE_JIT") == "1" else 40
settings.register_profile("check", _PATIENT, max_examples=_EXAMPLES, derandomize=True)
settings.register_profile("explore", _PATIENT, max_examples=2_000)
settings.load_profile("check")


@pytest.fixture(autouse=True)
def _no_lines_of_slow_machines(monkeypatch: pytest.MonkeyPatch) -> None:
    """Lines of progress come with time; what a test sees may not."""
    monkeypatch.setattr(bar, "SECONDS_BETWEEN_LINES", float("inf"))


@pytest.fixture(autouse=True)
def _no_notice_of_kernels(monkeypatch: pytest.MonkeyPatch) -> None:
    """Which test compiles the first kernel, and logs that, is chance."""
    monkeypatch.setattr(compiled.listeners, "_tell_once", lambda: None)


class _OfThisSession(dict[str, bytes]):
    """What these tests read: what other runs left on this machine decides nothing."""

    put = dict.__setitem__


_DRAWINGS, _GLYPHS = _OfThisSession(), _OfThisSession()


@pytest.fixture(autouse=True)
def _no_drawings_of_other_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "DRAWINGS", _DRAWINGS)
    monkeypatch.setattr(cache, "GLYPHS", _GLYPHS)


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
