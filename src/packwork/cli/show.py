"""Notices and closing tables on the terminal."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from rich.console import Console
from rich.table import Table

from packwork.errors import PackworkError, WriteError
from packwork.phrasing import number_of

if TYPE_CHECKING:
    from packwork.verify.preflight import Check


class Paper(Console):
    """Standard output, brackets and all; a reader that went away is an error as any other there."""

    def __init__(self, quiet: bool = False) -> None:
        super().__init__(quiet=quiet, highlight=False, markup=False)

    def print(self, *shown: Any, **how: Any) -> None:
        """Print, unless quiet: then nothing is laid out for nobody."""
        if not self.quiet:
            super().print(*shown, **how)

    def on_broken_pipe(self) -> None:
        """Leave it to :func:`printing`."""
        raise


@contextmanager
def printing() -> Iterator[None]:
    """Tell a standard output that takes nothing more: a full disk, a closed pipe.

    What is printed after the WriteError about it goes nowhere.
    """
    try:
        yield
    except PackworkError:
        raise
    except OSError as error:
        # What is still held back would fail once more when the program ends.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        raise WriteError("standard output", f"cannot be written to: {error.strerror}") from None


def show_results(
    results: Mapping[str, Any], written: Sequence[str], console: Console, unit: str
) -> None:
    """Print what came of a run: its measures, its seconds, its certificate, its files."""
    console.print(metrics_table(results["metrics"], unit))
    seconds = ", ".join(f"{part} {value:.2f} s" for part, value in results["seconds"].items())
    console.print(
        f"{results['placed']} of {number_of(results['items'], 'item')} placed; {seconds}",
        style="dim",
        soft_wrap=True,
    )
    words = results["words"]
    if words is not None and words["found"] > words["asked"]:
        line = (
            f"the {words['asked']:,} largest of {words['found']:,} different words; -n takes more"
        )
        console.print(line, style="dim")
    for remark in results["remarks"]:
        console.print(remark, style="dim", soft_wrap=True)
    if results["beside"] is not None:
        pairs = number_of(results["beside"], "pair of one kind lies", "pairs of one kind lie")
        console.print(f"{pairs} side by side", style="dim")
    if results["filling"] is not None:
        console.print(filling_line(results["filling"]), style="dim")
    if results["pile"] is not None:
        console.print(pile_line(results["pile"]), style="dim")
    promised, certified = results["promised"], results["certified"]
    console.print(certificate_line(promised, certified, broken=results["broken"]))
    tell_advice(results["advice"], console)
    console.print(f"wrote {', '.join(written)}", soft_wrap=True)


def tell_advice(advice: Sequence[str], console: Console) -> None:
    """Print what is poor and what would do, as a part of what came of a run."""
    for sentence in advice:
        console.print(f"but {sentence}", soft_wrap=True)


def metrics_table(metrics: Mapping[str, Any], unit: str = "px") -> Table:
    """Measures, one a row: by pixels beside exact ones, and the paper's names for them."""
    exact = metrics.get("exact", {})
    table = Table(box=None, pad_edge=False, header_style="dim")
    for heading in ("of the container", "pixels", "exact"):
        table.add_column(heading, justify="left" if heading == "of the container" else "right")
    table.add_column("", style="dim")
    table.add_row("covered", _percent(metrics["LC"]), _percent(exact.get("LC")), "LC")
    if "LC_ink" in metrics:
        table.add_row("covered by what is drawn", "", _percent(metrics["LC_ink"]), "LC ink")
    table.add_row("covered twice", _percent(metrics["OO"]), _percent(exact.get("OO")), "OO")
    table.add_row("outside", _percent(metrics["EA"]), _percent(exact.get("EA")), "EA")
    table.add_row("unevenness of the gaps, px²", f"{metrics['LnU']:.1f}", "", "L-nU")
    if "shape" in metrics:
        table.add_row("its shape shows to", _percent(metrics["shape"]), "", "shape")
        table.add_row("empty places", _percent(metrics["bare"]), "", "bare")
    gap = exact.get("min_gap")
    table.add_row(f"smallest gap, {unit}", "", "" if gap is None else f"{gap:.3g}", "")
    return table


def preflight_table(name: str, checks: Sequence[Check]) -> Table:
    """Lines of a preflight; what is to be looked at has a mark."""
    table = Table(box=None, pad_edge=False, header_style="dim")
    for heading in ("", f"before {name} is printed", "met"):
        table.add_column(heading)
    for one in checks:
        table.add_row("" if one.is_well else "!", one.about, one.found)
    return table


def certificate_line(
    was_promised: bool, certified: bool, *, changed: bool = False, broken: Sequence[str] = ()
) -> str:
    """Certificate of a layout on one line; of a file that was changed, that it was.

    Examples
    --------
    >>> certificate_line(True, True)
    'certified: nothing overlaps, nothing sticks out'
    >>> certificate_line(True, False, broken=["a.svg: what is written cannot be read back: ..."])
    'not certified: what is written cannot be read back'
    """
    if not was_promised:
        return "not certified: there was no exact finish"
    if changed:
        return "not certified: the file was changed since it was written"
    if broken:
        # Loaded by then; the help can do without.
        from packwork.verify import UNREADABLE

        if all(UNREADABLE in fault for fault in broken):
            return f"not certified: {UNREADABLE}"
    if not certified:
        return "not certified: items overlap, stick out or lie nearer than asked"
    return "certified: nothing overlaps, nothing sticks out"


def _percent(share: float | None) -> str:
    if share is None:
        return ""
    return f"{100 * share:.2f} %" if share >= 1e-3 or share == 0 else f"{100 * share:.4f} %"


def filling_line(filling: Mapping[str, Any]) -> str:
    """Items that were put into voids, and why no more.

    Examples
    --------
    >>> filling_line({"added": 2, "covered": 0.9, "target": 0.94, "ending": "no void is left"})
    '2 smaller items fill voids; 90.00 % covered, not 94 %: no void is left'
    """
    covered, target = filling["covered"], filling["target"]
    short = f", not {100 * target:g} %" if target is not None and covered < target else ""
    return (
        f"{filling['added']} smaller items fill voids; "
        f"{100 * covered:.2f} % covered{short}: {filling['ending']}"
    )


def pile_line(pile: Mapping[str, Any]) -> str:
    """End of a heap's settling, and how tight it is if that was asked."""
    ending = "stopped" if "stopped" in pile else "at rest"
    line = f"{ending} after {number_of(pile['rounds'], 'round')}"
    if "compact" not in pile:
        return line
    shares = [f"{_percent(share)} of its {name}" for name, share in pile["compact"].items()]
    return f"{line}; covers {', '.join(shares)}"
