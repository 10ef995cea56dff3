"""Regular expressions given by users, matched in a process of their own that can be ended.

Python's matching tries one way after the other and knows no limit: ``(a+)+$`` takes longer
than the world is old on forty letters, and no look at a pattern tells all of its kind. What
cannot be known beforehand is stopped.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections.abc import Sequence
from typing import Any

from packwork.errors import RecipeError
from packwork.offspring import END_WITH_PARENT

MOST_SECONDS = 20.0
"""After which a match is given up. A plain pattern goes through a long novel in a tenth of one.
Chosen: what a person waits for before they think that it hangs."""

_WORK = f"""{END_WITH_PARENT}
import json, re
try:
    import resource
    # Elsewhere than on Linux too, a match that takes long is not left behind.
    resource.setrlimit(resource.RLIMIT_CPU, (2 * {MOST_SECONDS:.0f}, 2 * {MOST_SECONDS:.0f}))
except (ImportError, ValueError, OSError):
    pass
asked = json.loads(sys.stdin.buffer.read())
known = re.compile(asked["pattern"])
found = [known.findall(text) if asked["groups"] else [m.group() for m in known.finditer(text)]
         for text in asked["texts"]]
sys.stdout.buffer.write(json.dumps(found).encode())
"""


def found_in(pattern: str, texts: Sequence[str], *, groups: bool = False) -> list[list[Any]]:
    r"""All that a regular expression finds in each text.

    Parameters
    ----------
    pattern
        Known to compile.
    groups
        As ``re.findall`` has it: groups, where the pattern has some, in place of the whole.

    Raises
    ------
    RecipeError
        If that takes more than ``MOST_SECONDS``.

    Examples
    --------
    >>> found_in(r"#\w+", ["a #bear and", "#honey"])
    [['#bear'], ['#honey']]
    >>> found_in(r"(\w)(\w)", ["ox"], groups=True)
    [[['o', 'x']]]
    """
    if not sys.executable:  # a program that holds Python in it
        known = re.compile(pattern)
        return [
            known.findall(text) if groups else [match.group() for match in known.finditer(text)]
            for text in texts
        ]
    asked = {"pattern": pattern, "texts": list(texts), "groups": groups}
    try:
        done = subprocess.run(  # noqa: S603 - our own words, the pattern comes as data
            [sys.executable, "-I", "-c", _WORK],
            input=json.dumps(asked).encode(),
            capture_output=True,
            timeout=MOST_SECONDS,
            check=True,
        )
    except subprocess.TimeoutExpired:
        raise RecipeError(
            "regexp",
            f"takes more than {MOST_SECONDS:g} s on this text; use a plainer one, with no "
            "repeat of what repeats",
        ) from None
    except (OSError, subprocess.CalledProcessError) as error:
        raise RecipeError("regexp", f"cannot be matched ({type(error).__name__})") from None
    found: list[list[Any]] = json.loads(done.stdout)
    return found
