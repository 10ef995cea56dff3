"""Films: ``packwork bench film`` prints and writes docs/benchmarks/films.md.

What recording adds to a run, the two in turn; the memory of a long recording; how long each
format takes and how large it is; a frame as we lay it together against the renderer of our
PNGs; and an animated SVG in a browser against the film at three times.
"""

from __future__ import annotations

import io
import shutil
import subprocess
import tempfile
import time
import tracemalloc
from pathlib import Path

import numpy as np
from PIL import Image

import packwork as pw
from benchmarks.kit.manifests import write_page
from benchmarks.kit.measuring import machine, markdown_table, ranged, timed
from packwork.pipeline.recorder import Recorder
from packwork.scene.layout import Layout
from packwork.scene.pose import Poses
from packwork.writers.bitmaps import ON_WHITE, png_bytes
from packwork.writers.film.film import Film
from packwork.writers.film.options import FilmOptions
from packwork.writers.film.projector import Projector
from packwork.writers.film.registry import FILMS, film_bytes

ITEMS = 100
RUNS = {
    "finish none, 800 epochs": {"finish": "none", "epochs": 800},
    "effort draft": {"effort": "draft"},
    "effort normal": {},
}
ROUNDS = 5
LONG = (1_000, 200)
SIDES = 800
TIMES = (0.5, 2.0, 4.5)
BROWSERS = ("chromium", "chromium-browser", "google-chrome", "chrome")


PAGE = """# Films

Made by `packwork bench film` on {date}.
{machine}.

## Recording

Each run with and without, in turn, {rounds} seeds; time of the processor. The seeds' runs differ
by more than a recording adds, those of one seed by what else the machine does.

{recording}

## Formats

{items} icons in a heart, 5 s and 1 s of hold, 30 pictures a second, {side} px. Drawing of the
frames included.

{formats}

## Frames

{frames}

## An animated SVG in a browser

Headless, against the frame of the film at that time.

{browser}
"""


def main() -> None:
    print(machine(), flush=True)
    layout = pw.fill("heart", count=ITEMS, seed=0, record=True)
    film = Film(layout, FilmOptions())
    film_bytes(Film(layout, FilmOptions(seconds=0.1)), "warm-up.gif")
    tables = {
        "formats": formats_table(film),
        "frames": frames_table(film, layout),
        "browser": browser_table(film),
        "recording": recording_table(),
    }
    print(*tables.values(), sep="\n\n")
    write_page("films.md", PAGE, rounds=str(ROUNDS), items=str(ITEMS), side=str(SIDES), **tables)


def recording_table() -> str:
    rows = []
    for name, options in RUNS.items():
        plain, recorded = [], []
        for seed in range(ROUNDS + 1):
            plain.append(run_seconds(seed, False, options))
            recorded.append(run_seconds(seed, True, options))
        more = [100 * (b / a - 1) for a, b in zip(plain[1:], recorded[1:], strict=True)]
        rows.append([f"{ITEMS} icons, {name}: more time", f"{ranged(more, '.1f')} %", "10 %"])
    rows.append([f"memory, {LONG[0]:,} items x {LONG[1]} keyframes", megabytes(), "100 MB"])
    return markdown_table(["what", "measured", "target"], rows)


def run_seconds(seed: int, record: bool, options: dict[str, object]) -> float:
    began = time.process_time()
    pw.fill("heart", count=ITEMS, seed=seed, record=record, **options)
    return time.process_time() - began


def megabytes() -> str:
    """Most that a recorder and its track take together."""
    items, frames = LONG
    rng = np.random.default_rng(0)
    tracemalloc.start()
    recorder = Recorder()
    for _ in range(frames):
        recorder.keep(Poses(*rng.random((4, items))))
    track = recorder.track(Poses(*rng.random((4, items))))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return f"{peak / 1e6:.0f} MB while it is put together, {track.numbers.nbytes / 1e6:.0f} MB kept"


def formats_table(film: Film) -> str:
    rows = []
    for ending in FILMS:
        began, busy = time.perf_counter(), time.process_time()
        data = film_bytes(film, f"film{ending}")
        seconds, busy = time.perf_counter() - began, time.process_time() - busy
        target = "15 s" if ending in {".gif", ".mp4"} else ""
        rows.append([f"`{ending}`", f"{seconds:.1f}", f"{busy:.1f}", mega(len(data)), target])
    return markdown_table(["format", "s", "s of processors", "size", "target"], rows)


def mega(size: int) -> str:
    return f"{size / 1e6:.1f} MB"


def frames_table(film: Film, layout: Layout) -> str:
    projector, options = Projector(film), ON_WHITE
    ours = timed(lambda: projector.picture(film.frames[-1]))
    theirs = timed(lambda: png_bytes(layout, SIDES, options))
    drawn = rgb(png_bytes(layout, SIDES, options))
    off = np.abs(projector.picture(film.frames[-1])[:, :, :3] - drawn)
    return markdown_table(
        ["what", "measured"],
        [
            ["a frame laid together, ms", str(ours)],
            ["the same by the renderer of our PNGs, ms", str(theirs)],
            ["the two differ, of 255: mean, largest", f"{off.mean():.2f}, {off.max():.0f}"],
        ],
    )


def browser_table(film: Film) -> str:
    program = next(filter(None, map(shutil.which, BROWSERS)), None)
    if program is None:
        return f"Not measured: none of {', '.join(BROWSERS)} is installed.\n"
    svg = film_bytes(film, "film.svg").decode()
    projector, rows = Projector(film), []
    for seconds in TIMES:
        true = projector.picture(film.frames[round(seconds * film.options.fps)])[:, :, :3]
        shown = rgb(screenshot(program, svg, seconds))[: true.shape[0], : true.shape[1]]
        off = np.abs(shown - true.astype(float))
        other = (off.max(axis=2) > 64).mean()
        rows.append([f"{seconds:g} s", f"{off.mean():.2f}", f"{100 * other:.2f} %"])
    return markdown_table(
        ["time", "mean difference, of 255", "pixels that differ by more than 64"], rows
    )


def screenshot(program: str, svg: str, seconds: float) -> bytes:
    script = f"document.getAnimations().forEach(a=>{{a.pause();a.currentTime={1e3 * seconds}}})"
    with tempfile.TemporaryDirectory() as folder:
        page, picture = Path(folder, "page.html"), Path(folder, "page.png")
        body = f"<!doctype html><body style='margin:0'>{svg[svg.index('<svg') :]}"
        page.write_text(f"{body}<script>{script}</script>", encoding="utf-8")
        flags = (
            "--headless --no-sandbox --disable-gpu --hide-scrollbars "
            f"--window-size={SIDES},{SIDES + 200} --user-data-dir={folder}/profile"
        )
        command = [program, *flags.split(), f"--screenshot={picture}", str(page)]
        subprocess.run(command, check=True, capture_output=True, timeout=120)  # noqa: S603
        return picture.read_bytes()


def rgb(png: bytes) -> np.ndarray:
    with Image.open(io.BytesIO(png)) as picture:
        return np.asarray(picture.convert("RGB"), dtype=np.float64)


if __name__ == "__main__":
    main()
