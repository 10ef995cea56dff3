"""``packwork bench``: a thin runner over ``benchmarks/*/NAME.py`` of a checkout."""

from __future__ import annotations

import runpy
import sys
from pathlib import Path
from typing import Annotated

import typer

from packwork.cli.failure import clear_errors


def bench(
    name: Annotated[
        str, typer.Argument(metavar="NAME", help="engine, quality, outlines, starts ...")
    ],
    arguments: Annotated[
        list[str] | None, typer.Argument(metavar="[ARGUMENT...]", help="Handed on as they are.")
    ] = None,
) -> None:
    """Run a benchmark of a checkout of the project and print its table.

    [bold]packwork bench engine[/]
    """
    with clear_errors():
        script = _find(name)
        sys.argv = [str(script), *(arguments or [])]
        sys.path.insert(0, str(script.parents[2]))
        runpy.run_path(str(script), run_name="__main__")


def _find(name: str) -> Path:
    """Script of that name in ``benchmarks`` of this folder or one above it."""
    from packwork.errors import ReadError

    for folder in (Path.cwd(), *Path.cwd().parents):
        benchmarks = folder / "benchmarks"
        if (folder / "src" / "packwork").is_dir() and benchmarks.is_dir():
            known = {p.stem: p for p in sorted(benchmarks.glob("*/*.py")) if _is_script(p)}
            if name in known:
                return known[name]
            raise ReadError(name, f"no such benchmark; there are {', '.join(known)}")
    raise ReadError(name, "benchmarks live in a checkout of the project; go to its folder")


def _is_script(path: Path) -> bool:
    return '__name__ == "__main__"' in path.read_text(encoding="utf-8")
