"""Sessions: ``packwork bench live`` prints and writes docs/benchmarks/live.md.

Random gestures on a layout of icons, each a grab, thirty moves of the pointer with flow between
them, a drop, a settle and a polish: how many frames a second, how long a settle takes, what moves
that was far away, what becomes of the coverage; one item more; replay and undo to the last bit;
memory. ``gestures=N`` and ``items=N,N`` measure other numbers.
"""

from __future__ import annotations

import io
import sys
import time
import tracemalloc
from dataclasses import dataclass, field

import numpy as np
import shapely

import packwork as pw
from benchmarks.kit.manifests import write_page
from benchmarks.kit.measuring import machine, markdown_table
from packwork.arrays import FloatArray
from packwork.live.commands.gestures import Drop, Grab
from packwork.live.commands.placing import Move
from packwork.live.document import Document
from packwork.live.log import Log, read_entries
from packwork.live.session import Session
from packwork.scene.pose import Poses

GESTURES, COUNTS = 200, (100, 1_000)
EVENTS, FRAME_MS = 30, 10.0
POLISH = 60
"""Turns that are tried after each settle, as in moments in which nobody touches anything."""

NEAR = 0.5
"""Share of the gestures that go a quarter of the way only."""

MANY = 400
"""Short gestures over which memory is measured."""

PAGE = """# Sessions

Made by `packwork bench live` on {date}.
{machine}.

{gestures} random gestures on icons in `builtin:bear`, canvas 600 px: an item is taken, moved to
a random place inside (every other time a quarter of the way there) in {events} moves of the
pointer, {frame_ms} ms of flow at each, dropped, settled; {polish} turns are tried after it, as in
moments in which nobody touches anything. A frame is a command and the flow; far is farther than
three diameters of the usual item from the way of the gesture.

{gesture_table}

## One item more, replay, memory

{other_table}
"""


@dataclass
class Gestures:
    """What random gestures took and did."""

    frames: list[float] = field(default_factory=list)
    settles: list[float] = field(default_factory=list)
    polishes: list[float] = field(default_factory=list)
    far: list[tuple[int, int]] = field(default_factory=list)
    covered: list[float] = field(default_factory=list)
    uncertified: int = 0


def main() -> None:
    asked = dict(argument.split("=", 1) for argument in sys.argv[1:])
    gestures = int(asked.get("gestures", GESTURES))
    counts = [int(n) for n in asked.get("items", ",".join(map(str, COUNTS))).split(",")]
    print(machine(), flush=True)
    layouts = {n: pw.fill("bear", count=n, seed=0, effort="normal") for n in counts}
    warm_up(layouts[counts[0]])
    found = {n: measured(layout, gestures) for n, layout in layouts.items()}
    tables = {"gesture_table": gesture_table(found), "other_table": other_table(layouts[counts[0]])}
    print(*tables.values(), sep="\n\n")
    write_page(
        "live.md", PAGE, gestures=str(gestures), events=str(EVENTS),
        frame_ms=f"{FRAME_MS:g}", polish=str(POLISH), **tables,
    )  # fmt: skip


def warm_up(layout: pw.Layout) -> None:
    """Compile what a gesture needs."""
    session = Session(Document.from_layout(layout))
    rng = np.random.default_rng(1)
    gesture(session, rng, Gestures())


def measured(layout: pw.Layout, gestures: int) -> Gestures:
    session = Session(Document.from_layout(layout))
    rng, found = np.random.default_rng(0), Gestures()
    found.covered.append(covered(session))
    for _ in range(gestures):
        gesture(session, rng, found)
    print(f"{len(layout)} icons: {gestures} gestures", flush=True)
    return found


def gesture(session: Session, rng: np.random.Generator, found: Gestures) -> None:
    """One random gesture, measured."""
    document = session.document
    before, item = document.poses, int(rng.integers(len(document)))
    begin, end = way(document, item, rng)
    session.apply(Grab(items=(int(document.ids[item]),)))
    for share in np.linspace(0, 1, EVENTS + 1)[1:]:
        x, y = begin + share * (end - begin)
        began = time.perf_counter()
        session.apply(Move(item=int(document.ids[item]), x=float(x), y=float(y)))
        session.flow(milliseconds=FRAME_MS)
        found.frames.append(time.perf_counter() - began)
    session.apply(Drop())
    began = time.perf_counter()
    settled = session.settle()
    found.settles.append(time.perf_counter() - began)
    began = time.perf_counter()
    session.polish(POLISH)
    found.polishes.append(time.perf_counter() - began)
    found.uncertified += not (settled.certified and session.is_certified)
    found.far.append(far_moves(document, before, session.document.poses, begin, end))
    found.covered.append(covered(session))


def way(document: Document, item: int, rng: np.random.Generator) -> tuple[FloatArray, FloatArray]:
    """From where an item is to a random place inside, or a quarter of the way."""
    container, poses = document.container, document.poses
    begin = np.array([poses.x[item], poses.y[item]])
    while True:
        end = rng.uniform(0, [container.width, container.height])
        if rng.random() < NEAR:
            end = begin + (end - begin) / 4
        if shapely.contains_xy(container.outline.region, *end):
            return begin, end


def far_moves(
    document: Document, before: Poses, after: Poses, begin: FloatArray, end: FloatArray
) -> tuple[int, int]:
    """How many far items have moved by more than 1 % of the canvas, and how many are far."""
    extents = np.array([item.outline.extent for item in document.items]) * before.scale
    line = shapely.LineString([begin, end])
    away = shapely.distance(line, shapely.points(before.x, before.y))
    far = away > 3 * float(np.median(extents))
    moved = np.hypot(after.x - before.x, after.y - before.y) > 0.01 * document.container.side
    return int((moved & far).sum()), int(far.sum())


def covered(session: Session) -> float:
    document = session.document
    areas = document.own_areas * document.poses.scale**2
    return float(areas.sum() / document.container.outline.area)


def gesture_table(found: dict[int, Gestures]) -> str:
    targets = {
        "frames a second, median": {100: "40", 1_000: "12"},
        "command to frame, 95 %": {100: "30 ms", 1_000: "100 ms"},
        "settle, 95 %": {100: "0.4 s", 1_000: "0.6 s"},
    }
    columns = [f"{n} icons" for n in found]
    rows = []
    shown = {
        "frames a second, median": lambda g: f"{1 / np.median(g.frames):.0f}",
        "command to frame, 95 %": lambda g: f"{1e3 * np.percentile(g.frames, 95):.0f} ms",
        "settle, median": lambda g: f"{np.median(g.settles):.2f} s",
        "settle, 95 %": lambda g: f"{np.percentile(g.settles, 95):.2f} s",
        "polish, median": lambda g: f"{np.median(g.polishes):.2f} s",
        "far items that moved by over 1 %": lambda g: f"{far_share(g):.1f} %",
        "covered before": lambda g: f"{g.covered[0]:.3f}",
        "covered after, least on the way": lambda g: f"{g.covered[-1]:.3f}, {min(g.covered):.3f}",
        "mean of the last quarter": lambda g: f"{np.mean(g.covered[-len(g.covered) // 4 :]):.3f}",
        "not certified": lambda g: f"{g.uncertified}",
    }
    fixed = {
        "far items that moved by over 1 %": "under 5 %",
        "covered after, least on the way": "within .015",
        "not certified": "0",
    }
    for name, show in shown.items():
        aims = ", ".join(targets[name].values()) if name in targets else fixed.get(name, "")
        rows.append([name, *(show(one) for one in found.values()), aims])
    return markdown_table(["what", *columns, "target"], rows)


def far_share(found: Gestures) -> float:
    moved, far = np.array(found.far).sum(axis=0)
    return 100.0 * moved / max(far, 1)


def other_table(layout: pw.Layout) -> str:
    more, jumped, before = one_more(layout)
    rows = [
        ["one item more: covered before, after", f"{before:.3f}, {more:.3f}", "within .01"],
        ["items that moved by more than a diameter", f"{jumped:.1f} %", "under 10 %"],
        ["replay; undo to the start, redo to the end", repeats(layout), "equal bytes"],
        [f"memory after {MANY // 2:,} and {MANY:,} gestures", memory(layout), "flat"],
    ]
    return markdown_table(["what", "measured", "target"], rows)


def one_more(layout: pw.Layout) -> tuple[float, float, float]:
    """Covered share after, share of items that jumped in percent, covered share before."""
    session = layout.edit()
    before, start = session.document.poses, covered(session)
    session.add("star")
    session.finish()
    after = session.document.poses
    diameters = np.array([item.outline.extent for item in layout.items]) * before.scale
    count = len(layout)
    moved = np.hypot(after.x[:count] - before.x, after.y[:count] - before.y)
    return covered(session), 100.0 * float((moved > diameters).mean()), start


def repeats(layout: pw.Layout, gestures: int = 12) -> str:
    """Whether a replay, and undo and redo of everything, end at equal bytes."""
    start = Document.from_layout(layout)
    stream = io.StringIO()
    session, rng = Session(start, log=Log(stream)), np.random.default_rng(5)
    for _ in range(gestures):
        gesture(session, rng, Gestures())
    end = session.document
    entries = read_entries(iter(stream.getvalue().splitlines()), "the log")
    again = Session.replay(start, entries)
    equal = [same(again.document.poses, end.poses)]
    while session.history.can_undo:
        session.undo()
    equal.append(same(session.document.poses, start.poses))
    while session.history.can_redo:
        session.redo()
    equal.append(same(session.document.poses, end.poses))
    return f"equal at both ends ({gestures} gestures)" if all(equal) else f"NOT EQUAL: {equal}"


def same(one: Poses, other: Poses) -> bool:
    names = ("x", "y", "angle", "scale", "stretch")
    return all(getattr(one, n).tobytes() == getattr(other, n).tobytes() for n in names)


def memory(layout: pw.Layout) -> str:
    """Python's memory of a session in the middle and at the end of many short gestures."""
    session, rng = Session(Document.from_layout(layout)), np.random.default_rng(0)
    tracemalloc.start()
    seen = []
    for number in range(1, MANY + 1):
        poses, k = session.document.poses, int(rng.integers(len(layout)))
        x, y = float(poses.x[k]), float(poses.y[k])
        session.apply(Move(item=int(session.document.ids[k]), x=x + 1, y=y))
        session.apply(Move(item=int(session.document.ids[k]), x=x, y=y))
        if number in {MANY // 2, MANY}:
            seen.append(tracemalloc.get_traced_memory()[0])
    tracemalloc.stop()
    return " and ".join(f"{one / 1e6:.1f} MB" for one in seen)


if __name__ == "__main__":
    main()
