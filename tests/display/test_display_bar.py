"""Progress on show: when there is a bar, and what it says."""

from __future__ import annotations

import io
import subprocess
import sys
import time
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from rich.console import Console

from packwork.api.verbs import fill
from packwork.display import bar as bars
from packwork.display.bar import Bar, BarAndObserver, NotebookBar, TerminalBar, bar_for, shown
from packwork.progress import Step
from packwork.scene.pose import Poses

NONE = np.zeros(0)
HALF_WAY = Step(
    1, 3, 200, 40, 0.5, Poses(NONE, NONE, NONE, NONE), lambda: (0.25, 0.125, 0.0), is_last=True
)


class Page:
    """Stand-in for a notebook's page: what was put on it, in order."""

    def __init__(self) -> None:
        self.seen: list[str] = []
        self.said: list[str] = []

    def display(self, thing: Any, *, display_id: bool) -> Page:
        assert display_id
        self.update(thing)
        return self

    def update(self, thing: Any) -> None:
        self.seen.append(thing._repr_html_())
        self.said.append(repr(thing))


@pytest.fixture
def page(monkeypatch: pytest.MonkeyPatch) -> Page:
    """Notebook that this test seems to run in."""
    page = Page()
    shell = SimpleNamespace(kernel=object())
    monkeypatch.setitem(sys.modules, "IPython", SimpleNamespace(get_ipython=lambda: shell))
    display = SimpleNamespace(display=page.display)
    monkeypatch.setitem(sys.modules, "IPython.display", display)
    return page


def test_no_bar_in_a_script_unless_asked_for() -> None:
    assert bar_for(None) is None
    assert bar_for(False) is None
    assert isinstance(bar_for(True), TerminalBar)


def test_ipython_on_a_terminal_is_no_notebook(monkeypatch: pytest.MonkeyPatch) -> None:
    for shell in (None, SimpleNamespace()):
        ipython = SimpleNamespace(get_ipython=lambda shell=shell: shell)
        monkeypatch.setitem(sys.modules, "IPython", ipython)
        assert bar_for(None) is None


@pytest.mark.usefixtures("page")
def test_a_bar_in_a_notebook_unless_forbidden() -> None:
    assert isinstance(bar_for(None), NotebookBar)
    assert isinstance(bar_for(True), NotebookBar)
    assert bar_for(False) is None


def test_a_notebook_sees_the_run_and_then_nothing_of_it(
    page: Page, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(bars, "SECONDS_BETWEEN", 0.0)
    bar = NotebookBar()
    with bar.showing():
        bar.on_step(HALF_WAY)
    first, half, last = page.seen
    assert "starting" in first
    assert 'value="0.500"' in half
    assert "level 2/3 (200 px), covered 25.0 %, overlap 12.50 %" in half
    assert last == ""
    assert page.said[1:] == ["50 %: level 2/3 (200 px), covered 25.0 %, overlap 12.50 %", ""]


def test_a_notebook_is_not_flooded(page: Page, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bars, "SECONDS_BETWEEN", 1e9)
    bar = NotebookBar()
    with bar.showing():
        for _ in range(100):
            bar.on_step(HALF_WAY)
    assert len(page.seen) == 2


def test_a_failed_run_leaves_no_bar_behind(page: Page) -> None:
    with pytest.raises(ZeroDivisionError), NotebookBar().showing():
        raise ZeroDivisionError
    assert page.seen[-1] == ""


class Diary:
    """Observer that keeps what it is told."""

    every = 7

    def __init__(self) -> None:
        self.steps: list[Step] = []

    def on_step(self, step: Step) -> None:
        self.steps.append(step)


def test_an_observer_is_told_as_often_as_without_a_bar(page: Page) -> None:
    alone, beside = Diary(), Diary()
    run: dict[str, Any] = {"count": 2, "epochs": 30, "levels": "16"}
    plain = fill("circle", "star", observer=alone, progress=False, **run)
    watched = fill("circle", "star", observer=beside, **run)
    assert [step.epoch for step in beside.steps] == [step.epoch for step in alone.steps]
    np.testing.assert_array_equal(plain.poses.x, watched.poses.x)
    assert len(page.seen) >= 2


def test_together_is_a_bar() -> None:
    diary = Diary()
    both: Bar = BarAndObserver(TerminalBar(), diary)
    with shown(both):
        both.on_step(HALF_WAY)
    assert diary.steps == [HALF_WAY]


def test_a_file_in_place_of_the_terminal_stays_clean() -> None:
    # Which test compiles the first kernel, and logs that, is chance.
    code = (
        "import sys, packwork as pw, packwork.compiled, packwork.display.bar as bars\n"
        "pw.compiled.listeners._tell_once = lambda: None\n"
        "for seconds in (1e9, 0.0):\n"
        "    bars.SECONDS_BEFORE_LINE = seconds\n"
        "    pw.fill('circle', 'star', count=2, epochs=30, levels='16', progress=True)\n"
        "    print('run', file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True)
    assert done.stdout == b""
    silent, *lines, last = done.stderr.decode().splitlines()
    assert (silent, last) == ("run", "run")
    shares = [int(line.removeprefix("packwork: ").partition(" %: ")[0]) for line in lines]
    assert shares == sorted(shares)
    assert len(shares) >= 2


def test_a_bar_never_goes_backwards(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(bars, "SECONDS_BEFORE_LINE", 0.0)
        bar = TerminalBar()
        bar.tell(0.5, "this")
        bar.tell(0.2, "that")
    assert capsys.readouterr().err == "packwork: 50 %: this\npackwork: 50 %: that\n"
    # A short run leaves nothing in a log, a long one ever fewer lines.
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(bars, "SECONDS_BEFORE_LINE", 4.0)
        patient, now = TerminalBar(), time.monotonic()
        for later in (1.0, 3.0, 5.0, 12.0, 14.0, 28.0, 31.0):
            patch.setattr(time, "monotonic", lambda later=later: now + later)
            patient.tell(later / 50, "on")
    assert capsys.readouterr().err == "".join(f"packwork: {k} %: on\n" for k in (10, 28, 62))
    quiet = TerminalBar(is_quiet=True)
    with quiet.showing():
        quiet.tell(0.5, "this")
    assert capsys.readouterr() == ("", "")


def test_shares_that_nobody_is_told_are_not_measured(monkeypatch: pytest.MonkeyPatch) -> None:
    measured: list[int] = []

    def shares() -> tuple[float, float, float]:
        measured.append(1)
        return (0.25, 0.125, 0.0)

    step = Step(1, 3, 200, 40, 0.5, Poses(NONE, NONE, NONE, NONE), shares)
    monkeypatch.setattr(bars, "SECONDS_BETWEEN", 1e9)
    monkeypatch.setattr(bars, "SECONDS_BEFORE_LINE", 1e9)
    for console in (None, Console(force_terminal=True, file=io.StringIO())):
        TerminalBar(console).on_step(step)
    assert not measured


def test_a_silent_run_loads_no_bar_and_no_notebook() -> None:
    code = (
        "import sys, packwork as pw\n"
        "pw.fill('circle', 'star', count=2, epochs=1, levels='16')\n"
        "sys.exit(any(m.split('.')[0] in {'rich', 'IPython'} for m in sys.modules))"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
