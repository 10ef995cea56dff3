"""Errors to one line and an exit code; Ctrl-C to a stop that keeps what there is."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType

import typer

from packwork.cli.terminal import say
from packwork.cli.watch import INTERRUPTED as INTERRUPTED
from packwork.cli.watch import WATCH
from packwork.errors import PackworkError, RecipeError

SHORTFALL = 1
"""Ran and wrote what it has, but something asked was not met."""
BAD_INPUT = 2
"""One clear line was printed; nothing was written."""


@contextmanager
def clear_errors(recipe: Path | None = None) -> Iterator[None]:
    """Turn the package's errors into one line on standard error and exit code 2.

    Parameters
    ----------
    recipe
        The file that options come from; None if they were typed.
    """
    try:
        yield
    except PackworkError as error:
        line = " ".join(str(error).split())
        if isinstance(error, RecipeError) and recipe is not None:
            line = f"{recipe}: {line}"
        elif isinstance(error, RecipeError) and error.key not in {"container", "items", "rules"}:
            line = _flag(error.key) + line.removeprefix(error.key)
        say(line)
        raise typer.Exit(BAD_INPUT) from None
    except MemoryError:
        say(
            "there is not enough memory for this; try fewer or smaller files, "
            "fewer items or fewer pixels"
        )
        raise typer.Exit(BAD_INPUT) from None
    except KeyboardInterrupt as stop:
        said = str(stop) or "stopped before there was anything to write"
        say(said)
        raise typer.Exit(INTERRUPTED) from None


def _flag(key: str) -> str:
    """Flag of an option, or its key in recipe files if it has none."""
    from packwork.recipe.verbs import VERBS, options_of

    known = {option.name: option for verb in VERBS for option in options_of(verb)}
    if key not in known:
        return f"--{key.replace('_', '-')}"
    return known[key].flag if known[key].offer.is_flag else key


class Interrupt:
    """Tells the solver, which asks before every epoch, whether Ctrl-C was pressed.

    The first Ctrl-C ends the run with what it has; a second one ends it at once. Once all is
    written, which the writer says by ``is_over``, there is nothing left to stop.
    """

    def __init__(self) -> None:
        self.pressed = False
        self.is_over = False

    def __call__(self) -> bool:
        """Whether to stop."""
        return self.pressed

    @contextmanager
    def listening(self) -> Iterator[None]:
        """Catch Ctrl-C while the block runs."""
        before = signal.signal(signal.SIGINT, self._press)
        WATCH.keeps_results = True
        try:
            yield
        finally:
            WATCH.keeps_results = False
            signal.signal(signal.SIGINT, before)

    def _press(self, number: int, frame: FrameType | None) -> None:
        if self.is_over:
            return
        if self.pressed:
            raise KeyboardInterrupt("stopped by a second Ctrl-C; nothing was written")
        self.pressed = True
