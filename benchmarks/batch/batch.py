"""Many at once: ``packwork bench batch`` prints and writes docs/benchmarks/batch.md.

``packwork bench batch rates kills`` measures some of its parts, all of them where none is named;
the page keeps the others as they were measured last. ``rows=N`` for the rates, ``times=N`` kills,
``table=N`` rows of a dry run, ``makes=N`` of a run.
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

sys.path.append(str(Path(__file__).parents[2] / "tests"))

from benchmarks.batch.choices import bad_rows, best_of, series
from benchmarks.batch.kills import kills
from benchmarks.batch.rates import rates
from benchmarks.kit.manifests import (
    FOLDER,
    Manifest,
    of_parts,
    read_manifest,
    stamp,
    write_manifest,
    write_text,
)

Row = list[str]

ASKED = {"rows": 1_000, "times": 30, "table": 10_000, "makes": 1_000}

PAGE = """# Many at once

Made by `packwork bench batch`, part by part.
{machine}.

{table}

Rows of the wall are containers of four kinds, each filled with 60 bundled icons by the defaults of
`packwork fill`. Workers are processes of one thread each. The cluster is a scheduler of Dask and
two workers, all started by hand on the same machine, which the sender and the scheduler share with
them: posters travel to it and back by content. Sixty-four workers are none that were there: the
seconds that rows took are dealt in turn to whichever worker is free, one after the other, each
taking as much time as the busier of sender and scheduler took of the processor for a row more.
Efficiency is the share of the workers' time that is work.

Words of the series are made of chance, with lognormal weights that each wander from step to step by
a factor of 1.16 (a standard deviation), the 100 heaviest of 160 in each step, as shares, so that
each step has about as much to set; sizes by area.

## Circumstances

{circumstances}
"""


def main() -> None:
    """Measure, print, write."""
    asked = {**ASKED, **{k: int(v) for k, _, v in (w.partition("=") for w in sys.argv[1:]) if v}}
    named = [word for word in sys.argv[1:] if "=" not in word]
    with tempfile.TemporaryDirectory() as folder:
        home = Path(folder)
        parts: dict[str, Callable[[], list[Row]]] = {
            "rates": lambda: rates(home / "rates", asked["rows"]),
            "kills": lambda: [kills(home / "kills", asked["times"])],
            "tables": lambda: bad_rows(home / "tables", asked["table"], asked["makes"]),
            "best": lambda: best_of(home / "best"),
            "series": series,
        }
        known = read_manifest("batch") if (FOLDER / "batch.json").exists() else {"measured": {}}
        for name in named or parts:
            circumstances = stamp()
            rows = parts[name]()
            known["measured"][name] = {"rows": rows, **circumstances}
            print(*("  |  ".join(row) for row in rows), sep="\n", flush=True)
            # Each part is kept as soon as it is there: all take an hour.
            manifest = {
                **stamp(),
                "measured": known["measured"],
                "parts": _parts(known["measured"]),
            }
            write_text("batch.md", of_parts(PAGE, write_manifest("batch", manifest)))


def _parts(measured: dict[str, Manifest]) -> Manifest:
    """Tables of the page."""
    rows = [row for part in measured.values() for row in part["rows"]]
    circumstances = [
        [name, part["date"], f"{part['load'][0]:.1f}", str(part["cores"]), f"`{part['command']}`"]
        for name, part in measured.items()
    ]
    said = ["part", "date", "load at its beginning", "cores", "command"]
    return {
        "table": [{"columns": ["what", "measured", "to reach"], "rows": rows}],
        "circumstances": [{"columns": said, "rows": circumstances}],
    }


if __name__ == "__main__":
    main()
