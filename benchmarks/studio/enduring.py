"""What the studio endures: crashes among gestures, messages gone wrong, long work."""

from __future__ import annotations

import http.client
import json
import random
import re
import time
from pathlib import Path
from typing import Any

from benchmarks.studio.drags import opened
from packwork.studio.proof import Secret

Row = list[str]

KILLS = 10
MOST_MESSAGE = 3_000
"""Bytes of an upload gone wrong at most."""

TOLD = "studio.connection.count === 0 || studio.known >= studio.connection.count"

COVERED = "studio.collage.state.covered"

KNOWN = """() => {
  studio.known = 0;
  const frame = studio.connection.hears.frame;
  studio.connection.hears.frame = (one) => {
    studio.known = Math.max(studio.known, one.done);
    frame(one);
  };
}"""

LEDGER = """JSON.stringify(studio.collage.items.map(one => [one.id, one.held[0]]))"""
"""What is there, and what of it is held."""


def crashes(browser: Any, gestures: int) -> Row:
    """What is there after the server was killed at random moments."""
    from studio.browsing import Server

    rng = random.Random(5)
    server, desk = opened(browser, "heart", "builtin:icons", "-n", "40")
    lost = 0
    for _ in range(KILLS):
        desk.page.evaluate("() => { studio.connection.count = 0; }")
        desk.page.evaluate(KNOWN)
        before = now = desk.look(LEDGER)
        for _ in range(gestures // KILLS):
            before = now
            _gesture(desk, rng)
            now = desk.look(LEDGER)
        server.kill()
        server = Server("--again").start()
        desk.until("document.body.classList.contains('lost') === false && studio.collage.state")
        desk.until("!studio.collage.state.busy && studio.collage.hasPoses")
        lost += desk.look(LEDGER) not in (before, now)
    faults = len(desk.faults)
    desk.page.close()
    server.stop()
    return [
        f"{gestures:,} random gestures, server killed with -9 {KILLS} times among them",
        f"{lost} times more than the last gesture lost, {faults} errors on the page",
        "nothing but the last gesture, no error",
    ]


def _gesture(desk: Any, rng: random.Random) -> None:
    """Something that a person might do, known to the studio when this returns."""
    press = desk.page.keyboard.press
    count = desk.look("studio.collage.items.length")
    item = desk.look(f"studio.collage.items[{rng.randrange(count)}].id")
    desk.page.evaluate(f"() => studio.choice.set([{item}])")
    keys = ["ArrowRight", "ArrowUp", ".", "+", "-", "h", "Shift+H", "d", "x", "Control+z"]
    key = rng.choice(keys if count < 60 else [*keys, "Delete"])
    if key == "x":
        key = "Delete" if count > 30 else "d"
    press(key)
    desk.until(TOLD)


def density(browser: Any, drags: int) -> Row:
    """Share that is covered before and after drags across the layout, one once the last lies."""
    rng = random.Random(11)
    server, desk = opened(browser, "heart", "builtin:icons", "-n", "60")
    desk.rested()
    before = desk.look(COVERED)
    for _ in range(drags):
        desk.drag(desk.place(_any(desk, rng)), desk.place(_any(desk, rng)))
        desk.settled()
    desk.rested()
    after = desk.look(COVERED)
    desk.page.close()
    server.stop()
    return [
        f"covered before and after {drags} drags across the layout",
        f"{before:.3f}, {after:.3f}",
        "0.015 less at most",
    ]


def malformed(count: int) -> list[Row]:
    """Messages and uploads gone wrong: each answered by a line, the server as before."""
    from studio.browsing import Server

    server = Server("circle", "star", "-n", "5").start()
    address, secret = re.match(r"http://([^/]+)/#(.+)", server.address).groups()
    token = Secret(address, secret).token
    began = time.perf_counter()
    lines, longest = _messages(address, token, count)
    refused, uploads, odd = _uploads(address, token, count // 10)
    seconds = time.perf_counter() - began
    is_alive = server.process.poll() is None and _messages(address, token, 1)[0] >= 0
    server.stop()
    found = f"{0 if is_alive else 1} crashes, {seconds:.0f} s"
    return [
        [
            f"{count:,} malformed messages",
            f"{found}; {lines:,} lines of refusal, the longest of {longest} characters",
            "0 crashes, 0 hangs, each refused in one line",
        ],
        [
            f"{uploads:,} malformed uploads and requests",
            f"{refused:,} refused, {uploads - refused:,} taken as files; {odd} answers of more"
            " than a line",
            "as above",
        ],
    ]


def _messages(address: str, token: str, count: int) -> tuple[int, int]:
    """Send messages gone wrong; how many lines came, and how long the longest was."""
    from websockets.sync.client import connect

    rng = random.Random(1)
    command = {"kind": "move", "item": 0, "x": 1, "y": 2}
    good = json.dumps({"type": "do", "n": 1, "command": command})
    offered = ["packwork", f"token.{token}"]
    lines, longest = 0, 0
    with connect(
        f"ws://{address}/socket", origin=f"http://{address}", subprotocols=offered
    ) as socket:
        for number in range(count):
            text = list(good)
            for _ in range(rng.randint(1, 5)):
                text[rng.randrange(len(text))] = chr(rng.choice([0, 34, 44, 91, 123, 125, 233]))
            socket.send("".join(text) if number % 50 else rng.randbytes(60))
            # A page that does not listen would be left behind by a server that answers.
            if number % 20 == 0:
                lines, longest = _heard(socket, lines, longest, 0.01)
        lines, longest = _heard(socket, lines, longest, 2.0)
    return lines, longest


def _heard(socket: Any, lines: int, longest: int, patience: float) -> tuple[int, int]:
    end = time.monotonic() + 100 * patience
    while time.monotonic() < end:
        try:
            said = socket.recv(timeout=patience)
        except TimeoutError:
            break
        if isinstance(said, str) and '"line"' in said:
            lines, longest = lines + 1, max(longest, len(json.loads(said).get("text", "")))
    return lines, longest


def _uploads(address: str, token: str, count: int) -> tuple[int, int, int]:
    """Send files and exports gone wrong: how many were refused, of how many, and not in a line."""
    rng = random.Random(2)
    headers = {"x-packwork-token": token, "origin": f"http://{address}"}
    headers["sec-fetch-site"] = "same-origin"
    batch = _asked(address, "/files", headers, b"")[1]
    folder = json.loads(batch)["batch"]
    refused = odd = 0
    for number in range(count):
        path = rng.choice([f"/files/{folder}", "/files/..", "/files/0", "/export", "/export"])
        name = rng.choice(["a.svg", "../../b.png", "%00", "x" * 200, "c.exe", ""])
        data = rng.randbytes(rng.randrange(MOST_MESSAGE))
        if number % 3 == 0:
            data = b'{"format": ' + rng.choice([b'"exe"}', b"[[[", b'"svg", "options": 3}', b"1}"])
        code, said = _asked(address, path, {**headers, "x-name": name}, data)
        refused += code >= 400
        odd += code >= 500 or (code >= 400 and said.strip().count(b"\n") > 0)
    return refused, count, odd


def _asked(address: str, path: str, headers: dict[str, str], data: bytes) -> tuple[int, bytes]:
    wire = http.client.HTTPConnection(address, timeout=60)
    wire.request("POST", path, data, headers)
    answer = wire.getresponse()
    said = answer.status, answer.read()
    wire.close()
    return said


def memory(browser: Any, minutes: float) -> Row:
    """Memory of server and page over work that goes on without a pause."""
    rng = random.Random(7)
    server, desk = opened(browser, "heart", "builtin:icons", "-n", "60")
    desk.page.evaluate(KNOWN)
    marks: list[tuple[float, float]] = []
    began, gestures = time.monotonic(), 0
    while (passed := time.monotonic() - began) < 60 * minutes:
        start, end = desk.place(_any(desk, rng)), desk.place(_any(desk, rng))
        desk.drag(start, end)
        _gesture(desk, rng)
        gestures += 2
        if passed >= 60 * minutes * (len(marks) + 1) / 5:
            marks.append((_resident(server.process.pid), _heap(desk)))
    marks.append((_resident(server.process.pid), _heap(desk)))
    faults = len(desk.faults)
    desk.page.close()
    server.stop()
    ours, theirs = zip(*marks, strict=True)
    return [
        f"memory over {minutes:g} minutes of work, {gestures} gestures",
        f"server {_listed(ours)} MB, page's heap {_listed(theirs)} MB, {faults} errors",
        "flat (over an hour)",
    ]


def _any(desk: Any, rng: random.Random) -> int:
    count = desk.look("studio.collage.items.length")
    return int(desk.look(f"studio.collage.items[{rng.randrange(count)}].id"))


def _listed(values: tuple[float, ...]) -> str:
    return ", ".join(f"{value:.0f}" for value in values)


def _resident(process: int) -> float:
    """Megabytes that a process has in memory."""
    for line in Path(f"/proc/{process}/status").read_text(encoding="utf-8").splitlines():
        if line.startswith("VmRSS"):
            return int(line.split()[1]) / 1e3
    return 0.0


def _heap(desk: Any) -> float:
    """Megabytes of what the page has made, after what nobody needs is gone."""
    session = desk.page.context.new_cdp_session(desk.page)
    session.send("HeapProfiler.collectGarbage")
    used = float(session.send("Runtime.getHeapUsage")["usedSize"]) / 1e6
    session.detach()
    return used
