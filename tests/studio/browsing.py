"""A studio in a process of its own, and a browser that is there already."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from urllib.parse import urljoin

import pytest

WIDE = {"width": 1440, "height": 900}
PHONE = {"width": 390, "height": 844}

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")

PATIENCE_SECONDS = 120.0
"""A first run compiles kernels, beside other tests."""

WAITING = """() => new Promise((done, fail) => {
  let isOver = false;
  const end = (isSo) => { isOver = true; done(isSo); };
  const look = async () => {
    try {
      if (await (%s)) end(true);
      else if (!isOver) setTimeout(look, 10);
    } catch (error) { fail(error); }
  };
  setTimeout(end, 1000, false);
  look();
})"""
"""Waits on the page until an expression, or what it promises, is true, a second at most: cheaper
than to ask for it."""

AS_NEW = {
    "media": "null", "color_scheme": "light", "reduced_motion": "no-preference",
    "forced_colors": "none", "contrast": "no-preference",
}  # fmt: skip
"""What a new page is told of screen and person, as Playwright has it."""


def browser_path() -> str | None:
    """The Chromium of this machine; None if it has none."""
    return next((path for name in NAMES if (path := shutil.which(name))), None)


in_browser = [
    pytest.mark.skipif(browser_path() is None, reason="no Chromium on this machine"),
    # One browser and one server do for all.
    pytest.mark.xdist_group("browser"),
]
"""Marks of modules whose tests drive a browser."""


_DOCUMENTS = TemporaryDirectory()

STUDIO = """
import os, sys
os.environ["OPENBLAS_NUM_THREADS"] = "1"
from packwork.__main__ import main
from packwork.live import local_solver, owner
from packwork.metrics import pixel
local_solver.ENOUGH = 1
owner.QUIET_SECONDS = 0.1
pixel.RESOLUTION, pixel.SHAPE_RESOLUTION = 300, 200
sys.argv[0] = "packwork"
main()
"""
"""The program, which wins back less and measures by fewer pixels: tests of the page look at other
things, and wait until all lies."""

QUICK, AS_IT_IS = ("-c", STUDIO), ("-m", "packwork")
"""What Python runs for a studio."""


class Server:
    """``packwork studio`` in a process.

    Parameters
    ----------
    inputs
        As on the command line.
    program
        What Python runs, by default :data:`QUICK`.
    """

    def __init__(self, *inputs: str, program: tuple[str, str] = QUICK) -> None:
        self.inputs, self.program = inputs, program
        self.address = ""
        self.process: subprocess.Popen[str] | None = None

    def start(self) -> Server:
        line = [sys.executable, *self.program, "studio", "--no-browser", *self.inputs]
        # What the developer has in the studio stays out of it, and is not written over.
        env = {"XDG_DATA_HOME": _DOCUMENTS.name, **os.environ}
        self.process = subprocess.Popen(line, stdout=subprocess.PIPE, text=True, env=env)
        assert self.process.stdout is not None
        self.address = re.search(r"http://\S+", self.process.stdout.readline())[0]
        return self

    @property
    def port(self) -> str:
        return re.search(r":(\d+)/", self.address)[1]

    def kill(self) -> None:
        """End it as a crash would."""
        if self.process is not None:
            self.process.kill()
            self.process.wait()
            assert self.process.stdout is not None
            self.process.stdout.close()

    def stop(self) -> None:
        """End it as Ctrl-C would."""
        if self.process is not None and self.process.poll() is None:
            self.process.terminate()
            try:
                self.process.wait(10)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()
            assert self.process.stdout is not None
            self.process.stdout.close()


@contextmanager
def chromium() -> Iterator[Any]:
    """A browser without a window."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as driver:
        path, options = browser_path(), ["--no-sandbox", "--force-prefers-reduced-motion"]
        browser = driver.chromium.launch(executable_path=path, args=options)
        yield browser
        browser.close()


def new_page(browser: Any, size: dict[str, int], **more: Any) -> Any:
    """One person's page, which remembers nothing."""
    context = browser.new_context(viewport=size, accept_downloads=True, **more)
    # What is left for an empty page has no storage.
    context.add_init_script("try { localStorage.setItem('person', 'ann'); } catch {}")
    return context.new_page()


def as_new(page: Any) -> None:
    """Have a used page as a new one for the place where it goes next, which ends what is here."""
    page.evaluate("() => { localStorage.clear(); sessionStorage.clear(); }")
    page.set_viewport_size(WIDE)
    page.emulate_media(**AS_NEW)
    page.context.clear_permissions()
    for other in page.context.pages:
        if other is not page:
            other.close()


def let_go(page: Any) -> None:
    """Have a page let go of its studio, before that stops or others look at it."""
    # A picture of the studio's own, for each page of another place has a process of its own.
    if not page.is_closed() and page.url.startswith("http") and not page.url.endswith(NOTHING):
        page.goto(urljoin(page.url, NOTHING))


NOTHING = "/static/icon.svg"


class Desk:
    """The page as a person has it: what is on it, and a hand.

    Parameters
    ----------
    page
        Of the browser.
    """

    def __init__(self, page: Any, address: str) -> None:
        self.page = page
        self.faults: list[str] = []
        # Questions for files are the test's from the start: a key is faster than asking for them.
        self._listeners = {
            "pageerror": lambda error: self.faults.append(str(error)),
            "console": self._hear,
            "filechooser": lambda _: None,
        }
        for event, listener in self._listeners.items():
            page.on(event, listener)
        is_there = page.url == address
        page.goto(address, timeout=1000 * PATIENCE_SECONDS)
        if is_there:
            page.reload(timeout=1000 * PATIENCE_SECONDS)
        # What was pressed on the page before would be dropped there if it were let go of sooner.
        page.mouse.up()
        for key in ("Shift", "Control", "Alt", "Meta"):
            page.keyboard.up(key)

    def _hear(self, message: Any) -> None:
        # That a server is gone while it is started anew is what is tested; browsers look for an
        # icon of the picture that a page was left for.
        said = f"{message.text} {message.location['url']}"
        if message.type == "error" and not re.search("ERR_CONNECTION|/favicon.ico$", said):
            self.faults.append(said)

    def leave(self) -> None:
        """Hear nothing more; the page stays until it goes elsewhere."""
        for event, listener in self._listeners.items():
            self.page.remove_listener(event, listener)
        if not self.page.is_closed():
            self.page.unroute_all()
            self.page.context.unroute_all()

    def look(self, script: str) -> Any:
        """Value of an expression on the page; nothing there is ever made of text."""
        return self.page.evaluate(f"() => {script}")

    def until(self, script: str) -> None:
        """Wait until an expression is true; the page looks by itself, also after it was left."""
        from playwright.sync_api import Error

        end, is_so = time.monotonic() + PATIENCE_SECONDS, False
        while not is_so:
            assert time.monotonic() < end, (
                f"waited for {script}: {self.look('studio.collage.state')}"
            )
            try:
                is_so = self.page.evaluate(WAITING % script)
            except Error as error:
                if "Execution context was destroyed" not in error.message:
                    raise

    def resize(self, size: dict[str, int]) -> None:
        """Have a window of another size, and what lies in it drawn anew."""
        self.page.set_viewport_size(size)
        self.until(
            f"innerWidth === {size['width']} && innerHeight === {size['height']} && (box => "
            "studio.view.size.width === box.width && studio.view.size.height === box.height)"
            "(studio.canvas.getBoundingClientRect())"
        )

    def settled(self) -> None:
        """Wait until all lies, certified, and nothing is won back any more."""
        self.until(
            "Boolean(globalThis.studio?.collage.state?.certified && !studio.collage.state.busy "
            "&& !studio.collage.state.polishing && studio.collage.hasPoses "
            "&& studio.collage.hand.size === 0 && !studio.isEasing)"
        )

    def answered(self) -> None:
        """Wait until all that was asked is done and lies, however soon it came to rest."""
        self.until("studio.collage.done >= studio.connection.count")
        self.settled()

    def certified(self) -> None:
        """Wait until the badge says that all that was asked is done, certified."""
        self.until(
            "studio.collage.done >= studio.connection.count "
            "&& document.getElementById('badge').dataset.is === 'certified'"
        )

    def rested(self) -> str:
        """Wait until all lies; where that is."""
        self.settled()
        return self.look("JSON.stringify([...studio.collage.poses])")

    def pour(self, ask: Callable[[], object]) -> None:
        """Ask for a filling anew, and wait until it lies, elsewhere than what was there.

        That it is at work may be over before it is looked for.
        """
        poses = "JSON.stringify([...studio.collage.poses])"
        before = self.rested()
        ask()
        self.until(f"{poses} !== {before!r}")
        self.settled()

    def undo_all(self) -> None:
        """Have the document as it began, for the next that use it."""
        self.settled()
        while self.look("studio.collage.state.can_undo"):
            self.look("studio.connection.leap('undo')")
            self.answered()

    def place(self, item: int) -> tuple[float, float]:
        """Where an item is on the window."""
        x, y = self.look(
            f"(() => {{ const p = studio.collage.pose({item});"
            " const s = studio.view.toScreen(p.x, p.y);"
            " const r = studio.canvas.getBoundingClientRect();"
            " return [s.x + r.left, s.y + r.top]; })()"
        )
        return x, y

    def drag(self, start: tuple[float, float], end: tuple[float, float], steps: int = 8) -> None:
        """Press, move, let go."""
        mouse = self.page.mouse
        mouse.move(*start)
        mouse.down()
        mouse.move(*end, steps=steps)
        mouse.up()

    def take_handle(self, number: int, item: int) -> None:
        """Press on a handle of an item; anew where it was moved away meanwhile, as a polish may."""
        at = f"studio.stage.handles()[{number}].at"
        for _ in range(20):
            self.page.mouse.click(*self.place(item))
            x, y = self.look(at)
            left, top = self.look("(r => [r.left, r.top])(studio.canvas.getBoundingClientRect())")
            self.page.mouse.move(x + left, y + top)
            self.page.mouse.down()
            if self.look("studio.gestures.doing?.act") in ("turn", "scale"):
                return
            self.page.mouse.up()
        raise AssertionError(f"handle {number} of item {item} cannot be taken")

    def picture(self, name: str) -> None:
        """Keep what it looks like, if that is asked for."""
        folder = os.environ.get("PACKWORK_STUDIO_PICTURES")
        if folder:
            Path(folder).mkdir(parents=True, exist_ok=True)
            self.page.screenshot(path=str(Path(folder) / f"{name}.png"))
