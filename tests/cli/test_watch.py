"""Ctrl-C while the program is in a call that knows nothing of it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from packwork.cli import failure

PROGRAM = """
import hashlib, signal, sys, threading
from packwork.cli.failure import WATCH

def be_deaf():
    # One call into C, for hours, that lets go of Python's lock as those of renderers do.
    hashlib.pbkdf2_hmac("sha256", b"", b"", 2_000_000_000)

with WATCH.listening():
    {before}
    # Said once the call is under way: before it, Ctrl-C is Python's own.
    threading.Timer(0.4, print, ["ready"], {{"flush": True}}).start()
    {wait}
"""

NEEDS_SIGNALS = pytest.mark.skipif(os.name == "nt", reason="Ctrl-C goes to groups there")


@contextmanager
def running(before: str, wait: str) -> Iterator[subprocess.Popen[str]]:
    """A program that is ready to be stopped."""
    program = PROGRAM.format(before=before, wait=wait)
    with subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as run:
        try:
            assert run.stdout is not None
            assert run.stdout.readline() == "ready\n"
            yield run
        finally:
            run.kill()


@NEEDS_SIGNALS
def test_a_long_call_before_the_run_is_left_at_once() -> None:
    with running("pass", "be_deaf()") as run:
        run.send_signal(signal.SIGINT)
        _, err = run.communicate(timeout=100)
    assert (run.returncode, err) == (130, f"packwork: {failure.ENDED}\n")


@NEEDS_SIGNALS
def test_a_long_call_in_a_run_is_left_at_the_second_time() -> None:
    before = "WATCH.keeps_results = True; signal.signal(signal.SIGINT, lambda *_: None)"
    with running(before, "be_deaf()") as run:
        assert run.stderr is not None
        run.send_signal(signal.SIGINT)
        assert run.stderr.readline() == f"packwork: {failure.STOPPING}\n"
        run.send_signal(signal.SIGINT)
        _, err = run.communicate(timeout=100)
    assert (run.returncode, err) == (130, f"packwork: {failure.ENDED}\n")


@NEEDS_SIGNALS
def test_a_ctrl_c_that_something_swallows_is_answered_all_the_same() -> None:
    swallow = """
    import time
    while True:
        try:
            time.sleep(0.01)
        except KeyboardInterrupt:
            WATCH.keeps_results = True
"""
    with running("pass", swallow) as run:
        run.send_signal(signal.SIGINT)
        _, err = run.communicate(timeout=100)
    assert (run.returncode, err) == (130, f"packwork: {failure.ENDED}\n")


@NEEDS_SIGNALS
def test_a_program_that_answers_is_left_to_end_by_itself() -> None:
    with running("pass", "\n    while True: pass") as run:
        run.send_signal(signal.SIGINT)
        _, err = run.communicate(timeout=100)
    assert "KeyboardInterrupt" in err
    assert failure.ENDED not in err


def test_after_all_is_written_nothing_is_said(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    mine = failure.InterruptListener()
    monkeypatch.setattr(mine, "end", lambda: pytest.fail("must not end"))
    mine.finish()
    mine.press()
    assert capsys.readouterr().err == ""


def test_memory_that_is_not_there_is_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from typer.testing import CliRunner

    from packwork.cli import app

    def starved(*_: object, **__: object) -> None:
        raise MemoryError

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("packwork.pipeline.run", starved)
    result = CliRunner().invoke(app, ["fill", "circle", "star", "-n", "2", "-o", "out.svg"])
    assert result.exit_code == 2
    assert result.stderr.count("\n") == 1
    assert "not enough memory" in result.stderr
    assert not (tmp_path / "out.svg").exists()
