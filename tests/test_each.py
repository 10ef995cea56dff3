"""One test over many cases: all that fails is named, whatever way it fails."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from each import for_each


def fail() -> None:
    pytest.fail("no star")


def skip() -> None:
    pytest.skip("no font")


def divide() -> None:
    _ = 1 / 0


def succeed() -> None:
    pass


def test_each_case_that_fails_or_is_skipped_is_named() -> None:
    cases = [fail, succeed, skip, divide]

    @for_each(cases, name=lambda case: case.__name__)
    def check(case: Callable[[], None]) -> None:
        case()

    with pytest.raises(pytest.fail.Exception) as caught:
        check()
    assert str(caught.value).splitlines() == [
        "fail: Failed: no star",
        "skip: was skipped, which one case cannot be: no font",
        "divide: ZeroDivisionError: division by zero",
    ]


def test_a_coroutine_function_is_refused() -> None:
    async def check(case: int) -> None:
        assert case

    with pytest.raises(AssertionError, match="coroutine"):
        for_each([1])(check)  # type: ignore[arg-type]
