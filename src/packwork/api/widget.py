"""The studio's canvas in a notebook: a widget without a server, from the same modules and wire."""

from __future__ import annotations

import functools
import importlib
import json
import re
import uuid
from collections.abc import Callable, Mapping
from importlib import resources
from typing import Any

from packwork.api.layout import Layout
from packwork.api.session import Session
from packwork.display.extras import import_extra
from packwork.display.picture import still_html
from packwork.errors import PackworkError
from packwork.live.commands.together import COMMANDS
from packwork.live.document import Document
from packwork.studio.view import Scenes, View
from packwork.studio.wire import frame_bytes

FLOW_MS = 15.0
"""Time in which items make room before a frame is shown: half of it is left for the way of thirty
frames a second. Chosen."""

MOST_ROUNDS = 150
"""Frames of a flow after the hand has let go at most. More wait longer for what swings. Chosen."""

_IMPORT = re.compile(r'from "\./(\w+)\.js"')

_LOADER = """const urls = {};
for (const [name, text] of Object.entries(%s)) {
  const linked = text.replace(/from "\\.\\/(\\w+)\\.js"/g, (_, other) => `from "${urls[other]}"`);
  urls[name] = URL.createObjectURL(new Blob([linked], { type: "text/javascript" }));
}
const { render } = await import(urls.widget);
export default { render };
"""

STYLE = """.packwork { --desk: #efece6; --paper: #fffdf9; --edge: #cfc8bb; --mark: #2457e6;
  --hover: #2457e6b3; --wrong: #cf3434; --pin: #23272e; --on-pin: #fff; --handle: #fff;
  --marquee: #2457e61f; --free: #ffd08a; --taken: #0b1c5c; }
.packwork canvas { display: block; width: 100%; touch-action: none; border-radius: 8px; }
.packwork div { display: flex; gap: 6px; align-items: center; flex-wrap: wrap; padding: 6px 0; }
.packwork button { min-height: 44px; padding: 0 14px; border: 1px solid var(--edge);
  border-radius: 6px; background: var(--paper); color: #23272e; cursor: pointer; }
.packwork button:focus-visible { outline: 2px solid var(--mark); outline-offset: 2px; }
"""


def page_modules(first: str = "widget") -> dict[str, str]:
    """Texts of a module of the page and of all that it needs, each after those that it imports."""
    folder = resources.files("packwork.studio") / "static"
    found: dict[str, str] = {}

    def take(name: str) -> None:
        text = (folder / f"{name}.js").read_text(encoding="utf-8")
        for other in _IMPORT.findall(text):
            if other not in found:
                take(other)
        found.setdefault(name, text)

    take(first)
    return found


def module_text(first: str = "widget") -> str:
    """One module of the page's modules, as notebooks load it."""
    return _LOADER % json.dumps(page_modules(first))


class Desk:
    """A session that a page of a notebook works on: what it is shown, and what it asks for."""

    def __init__(self, session: Session) -> None:
        self.session, self._scenes, self._shown, self._done = session, Scenes(), 0, 0
        self._version = 0

    def present(self, said: str = "") -> dict[str, Any]:
        """Values of the page that have changed, by name; ``said`` in place of how things stand."""
        session = self.session
        self._shown += 1
        view = View.of_document(session.document)
        scene = self._scenes.of(view)
        is_moving = session.is_grabbed or not session.is_at_rest
        told = "moving" if is_moving else "certified" if session.is_certified else "not certified"
        state = {"covered": view.covered, "told": said or told, "is": told}
        frame = frame_bytes(self._shown, scene.version, self._done, is_moving, view.numbers)
        changed: dict[str, Any] = {"frame": frame, "state": json.dumps(state)}
        if scene.version == self._version:
            return changed
        self._version = scene.version
        shapes = [self._scenes.shapes[key].model_dump() for key in scene.shapes]
        return {"shapes": json.dumps(shapes), "scene": scene.model_dump_json(), **changed}

    def hear(self, message: Mapping[str, Any], show: Callable[[str], object]) -> None:
        """Do what a message of the page asks for, and show it, on its way too."""
        said = ""
        try:
            self._done = int(message["n"])
            self._do(message, show)
        except (KeyError, PackworkError, ValueError) as error:
            said = str(error)
        show(said)

    def _do(self, message: Mapping[str, Any], show: Callable[[str], object]) -> None:
        session = self.session
        if message["type"] == "undo":
            session.undo()
        elif message["type"] == "redo":
            session.redo()
        elif message["type"] == "settle":
            session.finish()
        else:
            session.apply(COMMANDS.validate_python(message["command"]))
            session.flow(milliseconds=FLOW_MS)
            if not session.is_grabbed:
                self._come_to_rest(show)

    def _come_to_rest(self, show: Callable[[str], object]) -> None:
        """Let items make room while the page looks on, then settle them."""
        for _ in range(MOST_ROUNDS):
            if self.session.is_at_rest:
                break
            show("")
            self.session.flow(milliseconds=FLOW_MS)
        self.session.settle()


class OfSession:
    """Properties of a widget that Python reads."""

    _desk: Desk

    def __repr__(self) -> str:
        return repr(self.session).replace("Session", "Widget")

    @property
    def session(self) -> Session:
        """The session that the hand works on."""
        return self._desk.session

    @property
    def layout(self) -> Layout:
        """The layout as it is now."""
        return self.session.layout


def widget_of(session: Session) -> Any:
    """Widget of a session; ``PackworkError`` if anywidget is not installed."""
    return _widgets()(session)


@functools.cache
def _widgets() -> Any:
    """Class of the widgets, made once anywidget is there."""
    anywidget: Any = import_extra("anywidget", "edit the session by its verbs")
    traitlets: Any = import_extra("traitlets", "edit the session by its verbs")
    display: Any = importlib.import_module("IPython.display")

    class Widget(OfSession, anywidget.AnyWidget):  # type: ignore[misc]
        """A session under the hand in a notebook.

        ``layout`` is the layout as it is now, ``session`` what has more verbs; ``show`` shows what
        they have done. A picture, hidden while the hand is there, is saved with the notebook.
        """

        _esm = module_text()
        _css = STYLE
        scene = traitlets.Unicode().tag(sync=True)
        shapes = traitlets.Unicode().tag(sync=True)
        frame = traitlets.Bytes().tag(sync=True)
        state = traitlets.Unicode().tag(sync=True)
        still = traitlets.Unicode().tag(sync=True)

        def __init__(self, session: Session) -> None:
            self._desk = Desk(session)
            self._kept: Document | None = None
            super().__init__(still=f"packwork-{uuid.uuid4().hex}", **self._desk.present())
            self.on_msg(lambda _, message, __: self._heard(message))

        def show(self) -> None:
            """Have the page show the session as it is."""
            self._present()
            self._keep()

        def _heard(self, message: Mapping[str, Any]) -> None:
            self._desk.hear(message, self._present)
            self._keep()

        def _present(self, said: str = "") -> None:
            with self.hold_sync():
                for name, value in self._desk.present(said).items():
                    setattr(self, name, value)

        def _keep(self) -> None:
            """Have the picture that the notebook is saved with as the layout is."""
            is_old = self._kept is not None and self._kept is not self.session.document
            if is_old and not self.session.is_grabbed:
                self._draw(display.update_display)

        def _draw(self, put: Callable[..., object]) -> None:
            self._kept = self.session.document
            put({"text/html": still_html(self.layout, self.still)}, raw=True, display_id=self.still)

        def _ipython_display_(self) -> None:
            # A widget that is closed has no such method, and one without a view no answer.
            shown = self._repr_mimebundle_() if self._repr_mimebundle_ else None
            data, metadata = shown if isinstance(shown, tuple) else (shown, None)
            if data:
                display.display(data, metadata=metadata, raw=True)
            self._draw(display.display)

    return Widget
