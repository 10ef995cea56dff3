"""Long documents are drawn by a process of their own, so that Ctrl-C is heard meanwhile."""

from __future__ import annotations

import signal
import subprocess
import threading
from typing import Any

import pytest

from packwork.raster import drawing
from packwork.raster.drawing import drawn_png

SVG = '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9">{}</svg>'
DISC = SVG.format('<circle cx="4" cy="4" r="3" fill="#e53"/><text y="8" font-size="5">ä1</text>')


def test_the_picture_is_the_same_wherever_it_is_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    here = drawn_png(DISC)
    monkeypatch.setattr(drawing, "LONG", 0)
    assert drawn_png(DISC) == here


def test_what_cannot_be_drawn_is_said_alike(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(ValueError, match=r".") as here:
        drawn_png("<svg")
    monkeypatch.setattr(drawing, "LONG", 0)
    with pytest.raises(ValueError, match=r".") as elsewhere:
        drawn_png("<svg")
    assert str(here.value) == str(elsewhere.value)


def test_only_long_documents_start_a_process(monkeypatch: pytest.MonkeyPatch) -> None:
    started: list[Any] = []
    start = subprocess.Popen

    def counted(*args: Any, **options: Any) -> Any:
        started.append(args)
        return start(*args, **options)

    monkeypatch.setattr(subprocess, "Popen", counted)
    drawn_png(DISC)
    assert not started
    drawn_png(SVG.format("<g/>" * (drawing.LONG // 4)))
    assert len(started) == 1


def test_without_a_process_it_is_drawn_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    here = drawn_png(DISC)

    def refuses(*args: Any, **options: Any) -> Any:
        raise PermissionError

    monkeypatch.setattr(drawing, "LONG", 0)
    monkeypatch.setattr(subprocess, "Popen", refuses)
    assert drawn_png(DISC) == here


@pytest.mark.skipif(not hasattr(signal, "pthread_kill"), reason="signals as POSIX has them")
def test_ctrl_c_ends_the_wait_for_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """The process would go on for a minute: it is ended too."""
    monkeypatch.setattr(drawing, "LONG", 0)
    monkeypatch.setattr(drawing, "_WORK", "import time; time.sleep(60)")
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    here = threading.get_ident()
    press = threading.Timer(0.5, signal.pthread_kill, (here, signal.SIGINT))
    try:
        press.start()
        with pytest.raises(KeyboardInterrupt):
            drawn_png(DISC)
    finally:
        press.join()
        signal.signal(signal.SIGINT, before)
