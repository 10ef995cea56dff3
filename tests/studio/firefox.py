"""Firefox without a window, driven by WebDriver BiDi over its websocket."""

from __future__ import annotations

import base64
import json
import os
import re
import shutil
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from websockets.sync.client import ClientConnection, connect

from studio.browsing import PATIENCE_SECONDS, WIDE

NAMES = ("firefox-esr", "firefox")
LARGEST = 64_000_000
"""Bytes of an answer, such as a screenshot, at most."""


def firefox_path() -> str | None:
    """The Firefox of this machine; None if it has none."""
    return next((path for name in NAMES if (path := shutil.which(name))), None)


class Firefox:
    """A page of Firefox, with a hand."""

    def __init__(self, line: ClientConnection) -> None:
        self._line, self._count = line, 0
        self.faults: list[str] = []
        self._ask("session.new", capabilities={})
        self._ask("session.subscribe", events=["log.entryAdded"])
        tree = self._ask("browsingContext.getTree")
        self._page = tree["contexts"][0]["context"]
        self._ask("browsingContext.setViewport", context=self._page, viewport=WIDE)

    def _ask(self, method: str, **params: Any) -> Any:
        self._count += 1
        self._line.send(json.dumps({"id": self._count, "method": method, "params": params}))
        while True:
            said = json.loads(self._line.recv(PATIENCE_SECONDS))
            if said.get("method") == "log.entryAdded" and said["params"]["level"] == "error":
                self.faults.append(str(said["params"]["text"]))
            if said.get("id") == self._count:
                assert said["type"] == "success", (method, said)
                return said["result"]

    def goto(self, address: str) -> None:
        """Open a page."""
        self._ask("browsingContext.navigate", context=self._page, url=address, wait="complete")

    def look(self, script: str) -> Any:
        """Value of an expression on the page, or of what it promises."""
        text = f"(async () => JSON.stringify((await ({script})) ?? null))()"
        found = self._ask(
            "script.evaluate", expression=text, target={"context": self._page}, awaitPromise=True
        )
        assert found["type"] == "success", (script, found)
        return json.loads(found["result"]["value"])

    def until(self, script: str) -> None:
        """Wait until an expression is true."""
        end = time.monotonic() + PATIENCE_SECONDS
        while not self.look(f"Boolean({script})"):
            assert time.monotonic() < end, f"waited for {script}"
            time.sleep(0.05)

    def settled(self) -> None:
        """Wait until all lies, certified."""
        self.until(
            "Boolean(globalThis.studio?.collage.state?.certified && !studio.collage.state.busy "
            "&& !studio.collage.state.polishing && studio.collage.hasPoses "
            "&& studio.collage.hand.size === 0 && !studio.isEasing)"
        )

    def _act(self, kind: str, actions: list[dict[str, Any]]) -> None:
        source = {"type": kind, "id": kind, "actions": actions}
        self._ask("input.performActions", context=self._page, actions=[source])

    def drag(self, *places: tuple[float, float]) -> None:
        """Press at the first place, move over the others and let go; of one place a click."""
        moves = [
            {"type": "pointerMove", "x": round(x), "y": round(y), "duration": 60} for x, y in places
        ]
        down, up = ({"type": f"pointer{way}", "button": 0} for way in ("Down", "Up"))
        self._act("pointer", [moves[0], down, *moves[1:], up])

    def click(self, selector: str) -> None:
        """Click an element."""
        box = f"document.querySelector({selector!r}).getBoundingClientRect()"
        self.look(f"document.querySelector({selector!r}).scrollIntoView({{ block: 'nearest' }})")
        x, y = self.look(f"(box => [box.x + box.width / 2, box.y + box.height / 2])({box})")
        self.drag((x, y))

    def type(self, text: str) -> None:
        """Press keys one after another."""
        ways = ("keyDown", "keyUp")
        self._act("key", [{"type": way, "value": key} for key in text for way in ways])

    def downloaded(self, selector: str, file: Path) -> bytes:
        """Bytes of a file that a click hands to the person."""
        self.click(selector)
        end = time.monotonic() + PATIENCE_SECONDS
        # What is on its way is beside it, under another name.
        while not file.exists() or any(file.parent.glob("*.part")):
            assert time.monotonic() < end, f"waited for {file.name}"
            time.sleep(0.05)
        return file.read_bytes()

    def send_file(self, selector: str, file: Path) -> None:
        """Give a file to a field."""
        found = self._ask(
            "browsingContext.locateNodes",
            context=self._page,
            locator={"type": "css", "value": selector},
        )
        element = {"sharedId": found["nodes"][0]["sharedId"]}
        self._ask("input.setFiles", context=self._page, element=element, files=[str(file)])

    def picture(self, name: str) -> None:
        """Keep what it looks like, if that is asked for."""
        if folder := os.environ.get("PACKWORK_STUDIO_PICTURES"):
            data = self._ask("browsingContext.captureScreenshot", context=self._page)["data"]
            Path(folder, f"{name}.png").write_bytes(base64.b64decode(data))


@contextmanager
def firefox(profile: Path) -> Iterator[Firefox]:
    """A Firefox that knows nothing, with its profile and what it downloads in a folder."""
    prefs = {"folderList": 2, "dir": str(profile)}
    lines = [f'user_pref("browser.download.{one}", {json.dumps(to)});' for one, to in prefs.items()]
    (profile / "user.js").write_text("\n".join(lines), encoding="utf-8")
    asked = ["--headless", "--no-remote", "--profile", str(profile), "--remote-debugging-port", "0"]
    env = {**os.environ, "HOME": str(profile), "MOZ_DISABLE_CONTENT_SANDBOX": "1"}
    program = subprocess.Popen(
        [str(firefox_path()), *asked, "about:blank"], stderr=subprocess.PIPE, text=True, env=env
    )
    try:
        assert program.stderr is not None
        found = None
        for line in program.stderr:
            if found := re.search(r"BiDi listening on (ws://\S+)", line):
                break
        assert found is not None, "Firefox has ended"
        with connect(f"{found[1]}/session", max_size=LARGEST, ping_interval=None) as wire:
            yield Firefox(wire)
    finally:
        program.kill()
        program.communicate()
