"""Calls that are made at once: their order, and what may go wrong."""

from __future__ import annotations

import multiprocessing
import threading

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
