"""Wrong use is one line on standard error and exit code 2."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from typer.testing import Result

Command = Callable[..., Result]


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("fill", "missing argument 'CONTAINER'"),
        ("fill heart --sizes huge", "'huge' is not one of 'free', 'shared', 'fixed'"),
        ("fill heart --preset papper", "'papper' is not one of 'default', 'paper'"),
        ("fill heart --cuont 3", "no such option: --cuont"),
        ("fill heart -n", "requires an argument"),
        ("fill heart -n many", "invalid value for '-n' / '--count'"),
        ("fil heart", "no such command 'fil'"),
        ("measure", "missing argument"),
    ],
)
def test_wrong_use_is_one_line(packwork: Command, line: str, said: str) -> None:
    result = packwork(line)
    assert result.exit_code == 2
    assert said in result.stderr
    assert result.stderr.startswith("packwork: ")
    assert result.stderr.count("\n") == 1
    assert "--help" in result.stderr


def test_no_command_shows_the_help(packwork: Command) -> None:
    assert "Usage: packwork" in packwork("").output
