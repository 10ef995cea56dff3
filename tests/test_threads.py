"""Calls that are made at once: their order, and what may go wrong."""

from __future__ import annotations

import multiprocessing
import threading
import time

import pytest

from packwork import threads
from packwork.errors import RecipeError
from packwork.recipe import make_recipe


def test_results_come_in_the_order_of_calls() -> None:
    with threads.using(8):
        found = threads.at_once(lambda k: (k, threading.get_ident()), [(k,) for k in range(100)])
    assert [k for k, _ in found] == list(range(100))


def test_one_thread_calls_by_itself() -> None:
    with threads.using(1):
        found = threads.at_once(threading.get_ident, [()] * 5)
    assert set(found) == {threading.get_ident()}


def test_what_fails_at_once_fails() -> None:
    def fail(k: int) -> None:
        if k == 7:
            raise ValueError("seven")

    with threads.using(4), pytest.raises(ValueError, match="seven"):
        threads.at_once(fail, [(k,) for k in range(20)])


def test_calls_are_made_at_once() -> None:
    both = threading.Barrier(2, timeout=30)
    with threads.using(2):
        threads.at_once(both.wait, [(), ()])


def test_after_a_failure_no_call_begins() -> None:
    made: list[int] = []

    def fail(k: int) -> None:
        made.append(k)
        raise ValueError(k)

    with threads.using(2), pytest.raises(ValueError, match=r"\d"):
        threads.at_once(fail, [(k,) for k in range(50)])
    assert len(made) <= 2


def test_without_more_threads_one_makes_all(monkeypatch: pytest.MonkeyPatch) -> None:
    def none_left(*_: object) -> None:
        raise RuntimeError("can't start new thread")

    monkeypatch.setattr(threading.Thread, "start", none_left)
    monkeypatch.setattr(threads, "_pools", {})
    with threads.using(4):
        assert threads.at_once(abs, [(-k,) for k in range(9)]) == list(range(9))


def test_threads_are_kept_and_no_more_than_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(threads, "_pools", {})
    before = threading.active_count()
    with threads.using(4):
        for count in range(2, 12):
            threads.at_once(time.sleep, [(0.001,)] * count)
    assert threading.active_count() - before <= 3


def _forked() -> None:
    with threads.using(4):
        assert threads.at_once(abs, [(-1,)] * 9) == [1] * 9


@pytest.mark.skipif("fork" not in multiprocessing.get_all_start_methods(), reason="no fork")
@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
def test_a_forked_process_has_threads_of_its_own() -> None:
    _forked()
    process = multiprocessing.get_context("fork").Process(target=_forked)
    process.start()
    process.join(30)
    assert process.exitcode == 0


def test_a_number_of_threads_is_one_at_least() -> None:
    with pytest.raises(RecipeError, match="threads"):
        make_recipe(container="heart", threads=0)


def test_no_file_says_how_many_threads_there_were() -> None:
    assert "threads" not in make_recipe(container="heart", threads=3).plain()
