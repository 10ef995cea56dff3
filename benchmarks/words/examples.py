"""The peer's own examples, from its source distribution, by both packages."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from benchmarks.kit.manifests import Manifest, stamp
from benchmarks.peers.peering import version
from benchmarks.words.clouds import FONT
from packwork.errors import ReadError

EXAMPLES = (
    "masked", "a_new_hope", "colored", "parrot", "wordcloud_cn", "single_word", "simple",
    "arabic", "emoji", "colored_by_group", "frequency",
)  # fmt: skip

PROGRAMS = ("wordcloud", "packwork")
ROUNDS = 3
LIMIT = 600
"""Seconds after which an example is stopped."""

ROOT = Path(__file__).parents[2]
RUN = "import sys; from benchmarks.words.one_example import main; main(*sys.argv[1:])"


def peer_version() -> str | None:
    """Of the peer, and of what draws its letters; None if it is not there."""
    known = version("wordcloud")
    return known and f"{known}, Pillow {version('pillow')}"


def stamped() -> Manifest:
    """When, on what and by which command, without the folders of this machine."""
    made = stamp()
    return {**made, "command": re.sub(r"=\S*[/\\](?=\S)", "=", made["command"])}


@contextmanager
def copied(source: Path) -> Iterator[Path]:
    """A copy of the examples' folder, which they write into.

    Raises
    ------
    ReadError
        If the source distribution has no such folder.
    """
    examples = source / "examples"
    if not examples.is_dir():
        raise ReadError(str(source), "has no folder examples; unpack the peer's source archive")
    with tempfile.TemporaryDirectory() as folder:
        yield Path(shutil.copytree(examples, Path(folder, "examples")))


def example(
    folder: Path,
    name: str,
    rounds: int = ROUNDS,
    pictures: Path | None = None,
    font: Path | None = None,
) -> Manifest:
    """What both packages made of an example, in a process of its own.

    Parameters
    ----------
    folder
        The examples.
    name
        Of one of them.
    rounds
        How often each package runs it.
    pictures
        Folder for what the first round drew.
    font
        For what names none, instead of each package's default.
    """
    with tempfile.TemporaryDirectory() as temporary:
        result = Path(temporary, "result.json")
        given = [str(folder / f"{name}.py"), str(rounds), str(pictures or ""), str(result)]
        try:
            subprocess.run(  # noqa: S603 (our own module)
                [sys.executable, "-c", RUN, *given],
                env=_environment(font),
                timeout=LIMIT,
                check=True,
            )
        except subprocess.SubprocessError as error:
            found = {program: {"fails": _how_it_ended(error)} for program in PROGRAMS}
        else:
            found = dict(json.loads(result.read_text(encoding="utf-8")))
    print(name, found, flush=True)
    return found


def _how_it_ended(error: subprocess.SubprocessError) -> str:
    code = getattr(error, "returncode", None)
    return f"no end within {LIMIT} s" if code is None else f"exit code {code}"


def _environment(font: Path | None) -> dict[str, str]:
    path = [str(ROOT), *filter(None, [os.environ.get("PYTHONPATH")])]
    # Both packages take their default font from there.
    fonts = {} if font is None else {"FONT_PATH": str(font)}
    added = {
        **fonts,
        "MPLBACKEND": "Agg",
        "OMP_NUM_THREADS": "1",
        "PYTHONPATH": os.pathsep.join(path),
    }
    return {**os.environ, **added}


def all_examples(source: Path, rounds: int = ROUNDS) -> dict[str, Manifest]:
    """Every example by name: as it comes, and once with one font for both packages."""
    with copied(source) as folder:
        return {
            "examples": {name: example(folder, name, rounds) for name in EXAMPLES},
            "one_font": {name: example(folder, name, 1, font=FONT) for name in EXAMPLES},
        }
