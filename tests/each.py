"""One test over many cases of one kind, which names those that fail."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Iterable
from typing import Any

import pytest


def for_each(cases: Iterable[Any], name: Callable[[Any], str] = str) -> Callable[..., Any]:
    """Run a test for each case; a case fills its first parameter, a tuple its first ones.

    For checks that take no fixture which a case before could have changed. A case that is skipped
    counts as failed: the others would hide that it was not checked.
    """
    all_cases = list(cases)
    assert all_cases

    def decorated(check: Callable[..., None]) -> Callable[..., None]:
        assert not inspect.iscoroutinefunction(check), "a coroutine function would not be run"

        @functools.wraps(check)
        def test(**fixtures: Any) -> None:
            failed = []
            for case in all_cases:
                try:
                    check(*(case if isinstance(case, tuple) else (case,)), **fixtures)
                except pytest.skip.Exception as skip:
                    failed.append(f"{name(case)}: was skipped, which one case cannot be: {skip}")
                except (Exception, pytest.fail.Exception) as error:  # noqa: BLE001 - each is named below
                    failed.append(f"{name(case)}: {type(error).__name__}: {error}")
            if failed:
                pytest.fail("\n".join(failed), pytrace=False)

        width = len(all_cases[0]) if isinstance(all_cases[0], tuple) else 1
        signature = inspect.signature(check)
        left = list(signature.parameters.values())[width:]
        test.__signature__ = signature.replace(parameters=left)  # type: ignore[attr-defined]
        return test

    return decorated
