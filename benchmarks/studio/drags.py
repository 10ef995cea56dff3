"""What a browser sees of the studio: a first layout, drags, a reload."""

from __future__ import annotations

import random
import statistics
import time
from typing import Any

Row = list[str]

SECONDS = 1.2
"""Length of a drag."""

FIRST_LAYOUTS = 3

LATE_MS = {100: "50 ms", 300: "50 ms", 1_000: "80 ms"}
"""When neighbours are to be drawn anew after the pointer has moved, by the count of items."""

WATCH = """() => {
  const seen = globalThis.seen = { drawn: [], frames: [], asked: new Map(), late: [] };
  const { connection } = studio;
  const [act, draw] = [connection.do.bind(connection), studio.draw.bind(studio)];
  const frame = connection.hears.frame;
  connection.do = (command) => {
    const n = act(command);
    if (command.kind === "move") seen.asked.set(n, seen.pointer);
    return n;
  };
  let fresh = [];
  connection.hears.frame = (one) => {
    seen.frames.push(performance.now());
    for (const [n, when] of seen.asked) {
      if (n > one.done) continue;
      fresh.push(when);
      seen.asked.delete(n);
    }
    frame(one);
  };
  studio.draw = (now) => {
    draw(now);
    const end = performance.now();
    seen.drawn.push(end);
    seen.late.push(...fresh.map((when) => end - when));
    fresh = [];
  };
}"""

DRAG = """([x, y, toX, toY, seconds]) => new Promise((done) => {
  const began = performance.now();
  let count = 0;
  const step = () => {
    const share = Math.min((performance.now() - began) / 1000 / seconds, 1);
    const [clientX, clientY] = [x + share * (toX - x), y + share * (toY - y)];
    const at = { clientX, clientY, pointerId: 1, bubbles: true };
    seen.pointer = performance.now();
    studio.canvas.dispatchEvent(new PointerEvent("pointermove", { ...at, pointerType: "mouse" }));
    const next = began + (++count * 1000) / 60 - performance.now();
    if (share < 1) setTimeout(step, Math.max(next, 0));
    else done((performance.now() - began) / 1000);
  };
  step();
})"""


def opened(browser: Any, *inputs: str) -> tuple[Any, Any]:
    """A server and a page of it, all settled."""
    from studio.browsing import WIDE, Desk, Server

    server = Server(*inputs).start()
    desk = Desk(browser.new_page(viewport=WIDE), server.address)
    desk.settled()
    return server, desk


def first_layout(browser: Any) -> Row:
    """Seconds from the command to items on the page, the browser being open."""
    from studio.browsing import WIDE, Desk, Server

    taken = []
    for _ in range(FIRST_LAYOUTS):
        page = browser.new_page(viewport=WIDE)
        began = time.perf_counter()
        server = Server("heart", "builtin:icons", "-n", "60").start()
        desk = Desk(page, server.address)
        desk.until("Boolean(globalThis.studio?.collage.hasPoses)")
        taken.append(time.perf_counter() - began)
        page.close()
        server.stop()
    return [
        "command to items that flow on the page, kernels compiled",
        f"{statistics.median(taken):.1f} s ({min(taken):.1f} to {max(taken):.1f})",
        "2.5 s",
    ]


def dragging(browser: Any, count: int, drags: int) -> tuple[list[Row], dict[str, float]]:
    """Rows of frames, answers and certificates over random drags; frames a second by name."""
    server, desk = opened(browser, "heart", "builtin:icons", "-n", str(count))
    rng = random.Random(3)
    desk.page.evaluate(WATCH)
    drawn, frames, seconds, settled = 0, 0, 0.0, []
    for _ in range(drags):
        start, end = (desk.place(rng.randrange(count)) for _ in range(2))
        desk.page.mouse.move(*start)
        desk.page.mouse.down()
        desk.page.evaluate("() => { seen.drawn = []; seen.frames = []; }")
        seconds += desk.page.evaluate(DRAG, [*start, *end, SECONDS])
        drawn += desk.look("seen.drawn.length")
        frames += desk.look("seen.frames.length")
        desk.page.mouse.up()
        began = time.perf_counter()
        desk.certified()
        settled.append(time.perf_counter() - began)
    rows = _rows(count, drawn / seconds, frames / seconds, desk.look("seen.late"), settled)
    if count == 1_000:
        rows.append(reload(desk))
    desk.page.close()
    server.stop()
    return rows, {f"drawn, {count}": drawn / seconds, f"poses, {count}": frames / seconds}


def reload(desk: Any) -> Row:
    """How long until a page that is opened anew has drawn all."""
    began = time.perf_counter()
    desk.page.reload()
    desk.until("Boolean(globalThis.studio?.stage.backdrop.isWhole)")
    taken = time.perf_counter() - began
    return ["reload with 1,000 items until all is drawn", f"{taken:.2f} s", "1 s"]


def _rows(
    count: int, drawn: float, frames: float, late: list[float], settled: list[float]
) -> list[Row]:
    few = count == 100
    return [
        [
            f"frames on screen while dragging, {count:,} items",
            f"{drawn:.0f} a second",
            "55" if few else "30",
        ],
        [
            f"poses from the solver while dragging, {count:,} items",
            f"{frames:.0f} a second",
            "30" if few else "-",
        ],
        [
            f"pointer event to redrawn neighbours, {count:,} items, p95",
            f"{high(late):.0f} ms (median {statistics.median(late):.0f})",
            LATE_MS[count],
        ],
        [
            f"certified after a drop, {count:,} items, p95",
            f"{high(settled):.2f} s (median {statistics.median(settled):.2f})",
            "0.6 s" if few else "-",
        ],
    ]


def high(values: list[float]) -> float:
    """The value below which 95 of 100 lie."""
    return sorted(values)[min(int(0.95 * len(values)), len(values) - 1)]
