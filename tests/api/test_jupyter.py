"""The canvas in a real JupyterLab: kernel, messages and cells are Jupyter's own."""

from __future__ import annotations

import base64
import importlib.util
import json
import os
import secrets
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from studio.browsing import PATIENCE_SECONDS, WIDE, chromium, in_browser

pytestmark = [
    *in_browser,
    pytest.mark.skipif(
        importlib.util.find_spec("jupyterlab") is None or not importlib.util.find_spec("anywidget"),
        reason="no JupyterLab with anywidget here; make setup-jupyter brings both",
    ),
]

CELLS = [
    'import packwork as pw\nlayout = pw.fill("circle", ["star", "heart"], count=12, seed=0,'
    ' effort="draft", levels="50")\none = layout.widget()\none',
    "session = layout.edit()\ntwo = session.widget()\ntwo",
    "import json\nplaces = [(w.layout.poses.x[0], w.layout.poses.y[0]) for w in (one, two)]\n"
    "print(json.dumps([places, [w.layout._repr_svg_() for w in (one, two)]]))",
]


class Lab:
    """A notebook that is open in JupyterLab, and a hand."""

    def __init__(self, page: Any, file: Path, address: str) -> None:
        self.page, self.file = page, file
        self.faults: list[str] = []
        page.on("pageerror", lambda error: self.faults.append(str(error)))
        page.goto(address)
        self.until("globalThis.jupyterapp?.shell.currentWidget?.content?.widgets?.length > 0")
        self.page.evaluate("() => jupyterapp.shell.currentWidget.sessionContext.ready")

    def until(self, script: str) -> None:
        self.page.wait_for_function(script, timeout=1000 * PATIENCE_SECONDS)

    def run(self, command: str) -> None:
        self.page.evaluate(f"() => jupyterapp.commands.execute({command!r})")

    def printed(self) -> tuple[list[list[float]], list[str]]:
        """Places of the first items and pictures, as the last cell prints them, run anew."""
        self.page.evaluate(
            "() => { const book = jupyterapp.shell.currentWidget.content;"
            " book.activeCellIndex = book.widgets.length - 1;"
            " book.widgets.at(-1).model.clearExecution();"
            " return jupyterapp.commands.execute('notebook:run-cell'); }"
        )
        text = self.page.evaluate(
            "() => jupyterapp.shell.currentWidget.content.widgets.at(-1)"
            ".model.outputs.get(0).toJSON().text"
        )
        places, pictures = json.loads("".join(text))
        return places, pictures

    def listeners(self) -> int:
        """How many listeners there are on the page, without what is garbage."""
        tools = self.page.context.new_cdp_session(self.page)
        tools.send("Performance.enable")
        tools.send("HeapProfiler.collectGarbage")
        found = tools.send("Performance.getMetrics")["metrics"]
        tools.detach()
        return {one["name"]: one["value"] for one in found}["JSEventListeners"]

    def drag(self, number: int, at: list[float], x: float, y: float) -> None:
        """Drag what lies at a place of a canvas of 600 units by pixels."""
        canvas = self.page.locator(".packwork canvas").nth(number)
        canvas.scroll_into_view_if_needed()
        box = canvas.bounding_box()
        zoom = (min(box["width"], box["height"]) - 16) / 600
        left = box["x"] + box["width"] / 2 + zoom * (at[0] - 300)
        top = box["y"] + box["height"] / 2 + zoom * (at[1] - 300)
        self.page.mouse.move(left, top)
        self.page.mouse.down()
        self.page.mouse.move(left + x, top + y, steps=4)
        self.page.mouse.up()
        self.rest(number)

    def rest(self, number: int) -> None:
        canvas = f"document.querySelectorAll('.packwork canvas')[{number}]"
        self.until(f"{canvas}?.dataset.drawn > 1 && {canvas}.dataset.is !== 'moving'")


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Lab]:
    home = tmp_path_factory.mktemp("jupyter")
    file = home / "two.ipynb"
    cells = [
        {"cell_type": "code", "id": f"c{k}", "metadata": {}, "outputs": [], "execution_count": None,
         "source": source} for k, source in enumerate(CELLS)
    ]  # fmt: skip
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    book = {"cells": cells, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}
    file.write_text(json.dumps(book), encoding="utf-8")
    token = secrets.token_hex(8)
    ways = ("CONFIG_DIR", "DATA_DIR", "RUNTIME_DIR")
    settings = {f"JUPYTER_{way}": str(home / way) for way in ways} | {"IPYTHONDIR": str(home / "i")}
    line = [
        sys.executable, "-m", "jupyterlab", "--no-browser", "--allow-root", "--ip=127.0.0.1",
        "--port=0", f"--IdentityProvider.token={token}", "--expose-app-in-browser",
        f"--ServerApp.root_dir={home}",
        "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate",
    ]  # fmt: skip
    process = subprocess.Popen(line, env={**os.environ, **settings}, stderr=subprocess.DEVNULL)
    try:
        address = _address(home / "RUNTIME_DIR", process)
        with chromium() as browser:
            page = browser.new_page(viewport=WIDE)
            yield Lab(page, file, f"{address}lab/tree/two.ipynb?token={token}")
    finally:
        process.terminate()
        process.wait(30)


PICTURES = "[...document.querySelectorAll('.jp-OutputArea img')].map((one) => one.offsetWidth > 99)"
"""Whether each of the pictures that are saved is seen."""


def _address(folder: Path, process: subprocess.Popen[bytes]) -> str:
    """Address of a server that notes it in a folder."""
    end = time.monotonic() + PATIENCE_SECONDS
    while time.monotonic() < end and process.poll() is None:
        for note in folder.glob("jpserver-*.json"):
            if text := note.read_text(encoding="utf-8"):
                return json.loads(text)["url"]
        time.sleep(0.1)
    raise AssertionError("JupyterLab has not started")


def test_two_widgets_of_a_notebook_are_worked_on_and_saved(lab: Lab) -> None:
    lab.run("notebook:run-all-cells")
    for number in range(2):
        lab.rest(number)
    (first, second), _ = lab.printed()
    assert first == second
    lab.drag(0, first, 40, 30)
    (moved, other), _ = lab.printed()
    assert moved[0] > first[0] + 20
    assert other == second
    lab.drag(1, second, -7, 5)
    before = lab.listeners()
    for turn in range(20):
        lab.drag(1, second, *((7, 5) if turn % 2 else (-7, -5)))
    assert lab.listeners() <= before
    assert lab.page.evaluate(PICTURES) == [False, False]
    (_, last), pictures = lab.printed()
    assert last != second
    lab.run("docmanager:save")
    cells = json.loads(lab.file.read_text(encoding="utf-8"))["cells"]
    for picture, cell in zip(pictures, cells[:2], strict=True):
        html = "".join(cell["outputs"][-1]["data"]["text/html"])
        assert base64.b64encode(picture.encode()).decode() in html
    lab.page.evaluate("() => jupyterapp.shell.currentWidget.sessionContext.shutdown()")
    lab.page.reload()
    lab.until(f"{PICTURES}.join() === 'true,true'")
    assert lab.faults == []
