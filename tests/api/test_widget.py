"""The canvas of notebooks: its modules in a browser, the hand of which works on a session."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

import packwork as pw
from packwork.api import widget
from packwork.api.widget import STYLE, Desk, module_text, page_modules
from packwork.display.picture import still_html
from studio.browsing import browser_path, chromium

pytestmark = pytest.mark.xdist_group("browser")

PAGE = """<!doctype html><div id="cell" style="width:500px"></div><script type="module">
  const held = {}, heard = {};
  window.put = (name, value) => {
    held[name] = name === "frame" ? new DataView(Uint8Array.from(value).buffer) : value;
    for (const one of heard["change:" + name] ?? []) one();
  };
  window.model = {
    get: (name) => held[name],
    on: (event, one) => (heard[event] ??= []).push(one),
    off: (event, one) => (heard[event] = heard[event].filter((other) => other !== one)),
    send: (message) => window.sent(JSON.stringify(message)),
  };
  window.heard = heard;
  const code = await (await fetch("http://notebook/widget.js")).text();
  document.head.append(Object.assign(document.createElement("style"), {textContent: STYLE}));
  const url = URL.createObjectURL(new Blob([code], {type: "text/javascript"}));
  window.widget = (await import(url)).default;
  window.ready = true;
</script>"""


class Notebook:
    """A page as a notebook has it, on which a widget of a session is shown."""

    def __init__(self, page: Any, session: pw.Session) -> None:
        self.page, self.desk = page, Desk(session)
        page.route("http://notebook/**", self._answer)
        page.expose_function("sent", self._heard)
        page.goto("http://notebook/")
        page.wait_for_function("window.ready")
        self.show()
        page.evaluate(
            "void (window.end = widget.render({model, el: document.getElementById('cell')}))"
        )
        page.wait_for_function("document.querySelector('canvas').dataset.drawn > 1")

    def _answer(self, route: Any) -> None:
        is_code = route.request.url.endswith("widget.js")
        text = PAGE.replace("STYLE", json.dumps(STYLE))
        kind = "text/javascript" if is_code else "text/html"
        route.fulfill(body=module_text() if is_code else text, content_type=kind)

    def _heard(self, message: str) -> None:
        self.desk.hear(json.loads(message), self.show)

    def show(self, said: str = "") -> None:
        for name, value in self.desk.present(said).items():
            self.page.evaluate(
                "([name, value]) => put(name, value)",
                [name, list(value) if isinstance(value, bytes) else value],
            )

    def at(self, k: int) -> tuple[float, float]:
        """Place of an item on the screen."""
        box = self.page.locator("canvas").bounding_box()
        layout = self.desk.session.layout
        width, height = layout.container.width, layout.container.height
        zoom = min((box["width"] - 16) / width, (box["height"] - 16) / height)
        left = box["x"] + (box["width"] - zoom * width) / 2
        top = box["y"] + (box["height"] - zoom * height) / 2
        return left + zoom * float(layout.poses.x[k]), top + zoom * float(layout.poses.y[k])

    def drag(self, k: int, x: float, y: float) -> None:
        """Drag an item by pixels."""
        left, top = self.at(k)
        self.page.mouse.move(left, top)
        self.page.mouse.down()
        for step in range(1, 6):
            self.page.mouse.move(left + x * step / 5, top + y * step / 5)
        self.page.mouse.up()
        self.page.wait_for_function("document.querySelector('canvas').dataset.is !== 'moving'")


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    if browser_path() is None:
        pytest.skip("no Chromium on this machine")
    with chromium() as found:
        yield found


@pytest.fixture(scope="module")
def dozen() -> pw.Layout:
    return pw.fill("circle", ["star", "heart"], count=12, effort="draft", levels="50")


@pytest.fixture
def notebook(browser: Any, dozen: pw.Layout) -> Iterator[Notebook]:
    page = browser.new_page()
    yield Notebook(page, dozen.edit())
    page.close()


def test_what_a_module_needs_comes_before_it() -> None:
    modules = list(page_modules())
    assert modules[-1] == "widget"
    assert modules.index("kinds") < modules.index("collage") < modules.index("stage")
    assert "studio" not in modules
    assert "gestures" not in modules


def test_messages_that_have_no_meaning_are_told() -> None:
    desk = Desk(pw.fill("circle", "star", count=3, effort="draft", levels="16").edit())
    told: list[str] = []
    desk.hear({"type": "do", "n": 1, "command": {"kind": "grab", "items": [99]}}, told.append)
    desk.hear({"type": "do", "n": 2, "command": {"kind": "fly"}}, told.append)
    desk.hear({"type": "do", "n": 3}, told.append)
    assert all(told)


def test_gestures_send_what_changed_and_no_shape_that_is_gone() -> None:
    desk = Desk(pw.fill("circle", "star", count=3, effort="draft", levels="16").edit())
    shown = [desk.present()]
    assert {"shapes", "scene"} <= shown[0].keys()

    def do(**command: Any) -> None:
        message = {"type": "do", "n": len(shown), "command": command}
        desk.hear(message, lambda said: shown.append(desk.present(said)))

    for turn in range(15):
        do(kind="move", item=turn % 3, x=300.0 + turn % 7, y=300.0)
    assert all(one.keys() == {"frame", "state"} for one in shown[1:])
    for turn in range(6):
        do(kind="recolour", items=[turn % 3], colour=f"#{turn:02x}4080")
    assert "scene" in shown[-1]
    assert len(json.loads(shown[-1]["shapes"])) == 3
    do(kind="background", colour="linear-gradient(#ff0000, #0000ff)")
    (behind,) = json.loads(shown[-1]["scene"])["under"]
    assert behind["shape"] in [one["key"] for one in json.loads(shown[-1]["shapes"])]


def test_an_item_is_dragged_and_undone(notebook: Notebook) -> None:
    before = notebook.desk.session.layout
    notebook.drag(0, 40, 30)
    after = notebook.desk.session.layout
    assert after.poses.x[0] > before.poses.x[0] + 20
    assert after.certified
    assert "certified" in notebook.page.locator("output").inner_text()
    notebook.page.get_by_role("button", name="Undo").click()
    assert (notebook.desk.session.layout.poses.x == before.poses.x).all()


def test_what_is_chosen_is_held(notebook: Notebook) -> None:
    notebook.page.mouse.click(*notebook.at(3))
    notebook.page.get_by_role("button", name="Hold").click()
    assert notebook.desk.session.document.held[3].all()


def test_keys_go_through_items_and_move_one(notebook: Notebook) -> None:
    before = notebook.desk.session.layout
    notebook.page.locator("canvas").focus()
    notebook.page.keyboard.press("ArrowRight")
    assert notebook.page.locator("output").inner_text() == before.items[0].name
    notebook.page.keyboard.press("Alt+ArrowRight")
    notebook.page.wait_for_function("document.querySelector('canvas').dataset.is !== 'moving'")
    assert notebook.desk.session.layout.poses.x[0] > before.poses.x[0]


def test_several_gestures_leave_nothing_behind(notebook: Notebook) -> None:
    for turn in range(4):
        notebook.drag(turn % 5, 6 if turn % 2 else -6, 4)
    assert notebook.page.evaluate("Object.values(heard).every((one) => one.length === 1)")
    notebook.page.evaluate("window.end()")
    assert notebook.page.evaluate("Object.values(heard).every((one) => one.length === 0)")


def test_a_widget_has_the_present_layout() -> None:
    pytest.importorskip("anywidget")
    layout = pw.fill("circle", "star", count=4, effort="draft", levels="16")
    one = layout.widget()
    assert one.layout == layout
    item = int(one.session.document.ids[0])
    for n, command in enumerate(
        [
            {"kind": "grab", "items": [item]},
            {"kind": "move", "item": item, "x": 300.0, "y": 300.0},
            {"kind": "drop"},
        ]
    ):
        one._handle_custom_msg({"type": "do", "n": n, "command": command}, [])
    assert one.layout.poses.x[0] == 300.0
    assert json.loads(one.state)["is"] == "certified"
    assert len(one.frame) == 16 + 4 * 4 * 4


class FakeWidget:
    """What a widget of anywidget does without a page."""

    def __init__(self, **values: Any) -> None:
        self.__dict__ |= values
        self.answer: Any = ({"text/plain": "widget"}, {})

    def on_msg(self, hear: Callable[..., object]) -> None:
        self.hear = hear

    def hold_sync(self) -> AbstractContextManager[None]:
        return nullcontext()

    def _repr_mimebundle_(self) -> Any:
        return self.answer

    def close(self) -> None:
        self._repr_mimebundle_ = None  # type: ignore[assignment,method-assign]


@pytest.fixture
def shown(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[tuple[str, dict[str, str]]]]:
    """What a notebook, which is not there, is shown: how, and the data by their types."""
    found: list[tuple[str, dict[str, str]]] = []
    trait = SimpleNamespace(tag=lambda **_: "")
    fakes = {
        "anywidget": {"AnyWidget": FakeWidget},
        "traitlets": {"Unicode": lambda: trait, "Bytes": lambda: trait},
        "IPython": {},
        "IPython.display": {
            "display": lambda data, **_: found.append(("new", data)),
            "update_display": lambda data, **_: found.append(("again", data)),
        },
    }
    for name, values in fakes.items():
        monkeypatch.setitem(sys.modules, name, SimpleNamespace(**values))  # type: ignore[arg-type]
    widget._widgets.cache_clear()
    yield found
    widget._widgets.cache_clear()


def test_the_picture_that_is_saved_is_of_the_layout_as_it_is(
    shown: list[tuple[str, dict[str, str]]], dozen: pw.Layout
) -> None:
    one = dozen.widget()
    one.show()
    assert not shown
    one._ipython_display_()
    assert shown[0] == ("new", {"text/plain": "widget"})
    assert shown[1] == ("new", {"text/html": still_html(dozen, one.still)})
    one.session.move(0, 300, 300)
    one.show()
    one.show()
    assert shown[2:] == [("again", {"text/html": still_html(one.layout, one.still)})]
    assert shown[2] != shown[1]


@pytest.mark.parametrize("answer", [None, {"text/plain": "widget"}, "closed"])
def test_a_widget_without_a_view_shows_its_picture(
    shown: list[tuple[str, dict[str, str]]], dozen: pw.Layout, answer: Any
) -> None:
    one = dozen.widget()
    one.answer = answer
    if answer == "closed":
        one.close()
    one._ipython_display_()
    pictures = [("new", {"text/html": still_html(dozen, one.still)})]
    assert shown == [("new", answer)] * isinstance(answer, dict) + pictures


def test_the_notebook_among_the_examples_runs() -> None:
    file = Path(__file__).parents[2] / "examples" / "python" / "notebook.ipynb"
    names: dict[str, Any] = {}
    for cell in json.loads(file.read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] == "code":
            exec(cell["source"], names)  # noqa: S102
    assert names["session"].layout.certified
