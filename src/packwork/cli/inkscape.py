"""``packwork inkscape``: the extensions of Inkscape, put where it looks for them."""

from __future__ import annotations

import shutil
import subprocess
import sys
from importlib import resources
from pathlib import Path
from typing import Annotated, Literal

import typer

from packwork.cli.failure import clear_errors
from packwork.cli.terminal import say
from packwork.errors import ReadError, WriteError

PYTHON = "packwork_python.txt"
"""File beside the extensions that names the Python they call."""


def inkscape(
    action: Annotated[Literal["install", "remove"], typer.Argument(help="install or remove.")],
    folder: Annotated[
        Path | None,
        typer.Option("--into", help="Folder of user extensions. Default: where Inkscape says."),
    ] = None,
) -> None:
    """Put three extensions into Inkscape: fill a shape, words in one, nest.

    [bold]packwork inkscape install[/]  then start Inkscape: Extensions > Arrange
    """
    with clear_errors():
        place = folder or _user_extensions()
        files = sorted(
            (f for f in (resources.files("packwork") / "inkscape" / "extension").iterdir()
             if f.name.startswith("packwork_")),
            key=lambda f: f.name,
        )  # fmt: skip
        try:
            if action == "install":
                place.mkdir(parents=True, exist_ok=True)
                for file in files:
                    (place / file.name).write_bytes(file.read_bytes())
                (place / PYTHON).write_text(f"{sys.executable}\n", encoding="utf-8")
            else:
                for name in (PYTHON, *(file.name for file in files)):
                    (place / name).unlink(missing_ok=True)
        except OSError as error:
            raise WriteError(str(place), f"cannot be written: {error.strerror}") from error
        said = "are in" if action == "install" else "are gone from"
        say(f"the extensions {said} {place}; start Inkscape anew: Extensions > Arrange")


def _user_extensions() -> Path:
    """Folder in which Inkscape looks for a person's extensions."""
    program = shutil.which("inkscape")
    if program is None:
        raise ReadError("inkscape", "is not found; install it, or say --into FOLDER")
    told = subprocess.run(  # noqa: S603 - the program itself
        [program, "--user-data-directory"], capture_output=True, text=True, check=False, timeout=60
    ).stdout.strip()
    if not told or not Path(told).is_absolute():
        raise ReadError("inkscape", "does not say where its extensions lie; say --into FOLDER")
    return Path(told) / "extensions"
