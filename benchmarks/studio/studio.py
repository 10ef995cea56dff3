"""The studio: ``packwork bench studio`` prints and writes docs/benchmarks-studio.md.

A server of its own and a Chromium without a window, in which drags are made: how long until a first
layout flows, how fast neighbours answer, how many frames are drawn, how soon it is certified; what
crashes of the server and messages gone wrong do. ``drags=N`` and ``messages=N`` measure other
numbers.
"""

from __future__ import annotations

import json
import random
import re
import statistics
import sys
import time
from pathlib import Path
from typing import Any

sys.path.append(str(Path(__file__).parents[2] / "tests"))

from benchmarks.kit.manifests import write_page
from benchmarks.kit.measuring import markdown_table

DRAGS, MESSAGES, KILLS = 12, 10_000, 4
SIZE = {"width": 1440, "height": 900}
SECONDS = 1.2
"""Length of a drag."""

PAGE = """# The studio

Made by `packwork bench studio` on {date}.
{machine}.

In Chromium without a window and without a graphics processor, 1,440 x 900 px: drawing and solving
share the processor's cores. A drag is {seconds} s long, its pointer moves at every frame of the
page.
What was reached on a machine that others used at the time says what can be, not what is usual.

{table}
"""

LIES = "Boolean(studio.collage.state && !studio.collage.state.moving)"
"""Whether nothing moves, certified or not: what is asked here is whether anything is lost."""

WATCH = """() => {
  const seen = globalThis.seen = { drawn: [], frames: [], asked: new Map(), late: [] };
  const { connection, collage } = studio;
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
  const step = () => {
    const share = Math.min((performance.now() - began) / 1000 / seconds, 1);
    const [clientX, clientY] = [x + share * (toX - x), y + share * (toY - y)];
    const at = { clientX, clientY, pointerId: 1, bubbles: true };
    seen.pointer = performance.now();
    studio.canvas.dispatchEvent(new PointerEvent("pointermove", { ...at, pointerType: "mouse" }));
    if (share < 1) requestAnimationFrame(step);
    else done((performance.now() - began) / 1000);
  };
  requestAnimationFrame(step);
})"""


def main() -> None:
    """Measure, print, write."""
    asked = dict(word.split("=") for word in sys.argv[1:])
    drags = int(asked.get("drags", DRAGS))
    from studio.browsing import chromium

    with chromium() as browser:
        rows = [
            first_layout(browser),
            *dragging(browser, 100, drags),
            *dragging(browser, 1_000, max(drags // 3, 2)),
            crashes(browser),
        ]
    rows.append(malformed(int(asked.get("messages", MESSAGES))))
    table = markdown_table(["what", "measured", "to reach"], rows)
    print(table)
    write_page("benchmarks-studio.md", PAGE, table=table, seconds=f"{SECONDS:g}")


def opened(browser: Any, *inputs: str) -> tuple[Any, Any]:
    """A server and a page of it, all settled."""
    from studio.browsing import Desk, Server

    server = Server(*inputs).start()
    desk = Desk(browser.new_page(viewport=SIZE), server.address)
    desk.settled()
    return server, desk


def first_layout(browser: Any) -> list[str]:
    """Seconds from the command to items on the page, the browser being open."""
    from studio.browsing import Desk, Server

    taken = []
    for _ in range(3):
        page = browser.new_page(viewport=SIZE)
        began = time.perf_counter()
        server = Server().start()
        desk = Desk(page, server.address)
        desk.until("Boolean(globalThis.studio?.collage.hasPoses)")
        taken.append(time.perf_counter() - began)
        page.close()
        server.stop()
    return [
        "command to items that flow on the page, kernels compiled",
        f"{min(taken):.1f} s, at worst {max(taken):.1f} s",
        "2.5 s",
    ]


def dragging(browser: Any, count: int, drags: int) -> list[list[str]]:
    """Frames, answers and certificates over random drags."""
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
        desk.settled()
        settled.append(time.perf_counter() - began)
    late = sorted(desk.look("seen.late"))
    rows = [
        [
            f"frames on screen while dragging, {count:,} items",
            f"{drawn / seconds:.0f} a second",
            "55" if count == 100 else "30",
        ],
        [
            f"poses from the solver while dragging, {count:,} items",
            f"{frames / seconds:.0f} a second",
            "30" if count == 100 else "-",
        ],
        [
            f"pointer event to redrawn neighbours, {count:,} items, p95",
            f"{late[int(0.95 * len(late))]:.0f} ms (median {statistics.median(late):.0f})",
            "50 ms" if count == 100 else "-",
        ],
        [
            f"certified after a drop, {count:,} items, p95",
            f"{sorted(settled)[int(0.95 * len(settled))]:.2f} s"
            f" (median {statistics.median(settled):.2f})",
            "0.6 s" if count == 100 else "-",
        ],
    ]
    if count == 1_000:
        began = time.perf_counter()
        desk.page.reload()
        desk.until("Boolean(globalThis.studio?.collage.hasPoses) && studio.sprites.left >= 0")
        rows.append(
            [
                "reload with 1,000 items until all is drawn",
                f"{time.perf_counter() - began:.2f} s",
                "1 s",
            ]
        )
    desk.page.close()
    server.stop()
    return rows


def crashes(browser: Any) -> list[str]:
    """What is there after the server was killed at random moments."""
    from studio.browsing import Server

    rng = random.Random(5)
    server, desk = opened(browser, "heart", "builtin:icons", "-n", "40")
    lost = 0
    for _ in range(KILLS):
        for _ in range(rng.randint(1, 4)):
            desk.page.keyboard.press("n")
            desk.page.keyboard.press("ArrowRight")
            desk.until(LIES)
        desk.page.keyboard.press("h")
        desk.until("studio.areHeld")
        before = desk.look("studio.collage.items.filter(item => item.held[0]).length")
        server.kill()
        server = Server("--again").start()
        desk.until(LIES)
        lost += before != desk.look("studio.collage.items.filter(item => item.held[0]).length")
    faults = len(desk.faults)
    desk.page.close()
    server.stop()
    return [
        f"server killed {KILLS} times among gestures",
        f"{lost} gestures lost, {faults} errors on the page",
        "the last gesture at most, no error",
    ]


def malformed(count: int) -> list[str]:
    """Messages gone wrong on a real socket: each answered by a line, the server as before."""
    from websockets.sync.client import connect

    from studio.browsing import Server

    server = Server("circle", "star", "-n", "5").start()
    address, token = re.match(r"http://([^/]+)/#(.+)", server.address).groups()
    rng = random.Random(1)
    good = json.dumps(
        {"type": "do", "n": 1, "command": {"kind": "move", "item": 0, "x": 1, "y": 2}}
    )
    offered = ["packwork", f"token.{token}"]
    with connect(
        f"ws://{address}/socket", origin=f"http://{address}", subprotocols=offered
    ) as socket:
        for _ in range(count):
            text = list(good)
            for _ in range(rng.randint(1, 5)):
                text[rng.randrange(len(text))] = chr(rng.choice([0, 34, 44, 91, 123, 125, 233]))
            socket.send("".join(text))
        while not _is_quiet(socket):
            pass
    alive = server.process.poll() is None
    server.stop()
    return [f"{count:,} malformed messages", f"{0 if alive else 1} crashes", "0 crashes, 0 hangs"]


def _is_quiet(socket: Any) -> bool:
    try:
        socket.recv(timeout=1.0)
    except TimeoutError:
        return True
    return False


if __name__ == "__main__":
    main()
