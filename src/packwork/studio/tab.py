"""One page that looks at the workspace: what it is sent, and what it asks for."""

from __future__ import annotations

import asyncio
import time
from collections import deque
from collections.abc import Sequence
from itertools import islice
from typing import Protocol

from packwork.errors import PackworkError
from packwork.live.commands.command import Command
from packwork.live.owner import MAKING_ROOM, Leap, Owner
from packwork.scene.pose import Poses
from packwork.studio.files import Importer
from packwork.studio.messages import read
from packwork.studio.view import View
from packwork.studio.wire import Line, Said, Scene, Shapes, State, frame_bytes
from packwork.studio.workspace import MOST_LINES, News, Workspace

STATE_SECONDS = 0.1
"""Time between two states of which only the covered share differs. Chosen."""

MOST_AHEAD = 3
"""Frames that a page has not heard of yet at most. With 1 a page that draws gets the next one only
once it has answered; more are older where the network is slow. Tried."""

MOST_KEPT = 1_000
"""Looks that a page keeps of items that are not there any more: undo may bring them back. More
take memory, of fewer more is sent again. Chosen."""


class Wire(Protocol):
    """Carrier of messages to a page."""

    async def send_text(self, data: str) -> None:
        """Send a message."""

    async def send_bytes(self, data: bytes) -> None:
        """Send a frame."""


class Tab:
    """A page."""

    def __init__(self, workspace: Workspace, carrier: Wire, importer: Importer) -> None:
        self.workspace, self.importer, self._carrier = workspace, importer, carrier
        self._woken = asyncio.Event()
        self._lines: deque[News] = deque(maxlen=MOST_LINES)
        self._known: dict[str, None] = {}
        self._scene: Scene | None = None
        self._state: State | None = None
        self._state_at = 0.0
        self._frame = self._acked = 0
        self._seen: tuple[Poses, int] | None = None
        self._owner: Owner | None = None
        self._posted: deque[tuple[int, int]] = deque()
        self._newest = 0

    def wake(self, line: News | None = None) -> None:
        """Have the page told what is new, and a line if there is one."""
        if line is not None:
            self._lines.append(line)
        self._woken.set()

    async def send(self) -> None:
        """Send what is new, for as long as the page is there."""
        self.workspace.listen(self, self.wake)
        self.wake()
        try:
            while True:
                await self._woken.wait()
                self._woken.clear()
                await self._send_news()
        finally:
            self.workspace.forget(self)

    async def _send_news(self) -> None:
        while self._lines:
            await self._say(self._lines.popleft())
        shown = self.workspace.shown
        if shown is None:
            return
        self._follow(self.workspace.owner)
        view, state = shown.view, shown.state
        scene = await self.workspace.scene(view)
        if self._scene is None or scene.version != self._scene.version:
            if self._scene is not None:
                # What was said of the scene before does not hold of this one.
                await self._send_state(_unsettled(state))
            if not await self._send_scene(scene):
                self.wake()
                return
            self._seen = None
        is_late = await self._send_frame(view, shown.done, scene.version, state.moving)
        # What is said of a layout waits until that layout is what the page shows. Where coverage is
        # won back, what was said of the one before it still holds.
        if not (is_late and state.polishing):
            await self._send_state(_unsettled(state) if is_late else state)

    async def _send_frame(self, view: View, done: int, version: int, moving: bool) -> bool:
        """Send where items are, if the page does not know; whether that has to wait."""
        if view.poses is None or self._is_seen(view.poses, done):
            return False
        if self._frame - self._acked >= MOST_AHEAD:
            return True
        self._frame += 1
        self._seen = (view.poses, done)
        known = self._done(done)
        data = frame_bytes(self._frame, version, known, moving, view.numbers)
        await self._carrier.send_bytes(data)
        return False

    def _is_seen(self, poses: Poses, done: int) -> bool:
        return self._seen is not None and self._seen[0] is poses and self._seen[1] == done

    async def _send_scene(self, scene: Scene) -> bool:
        """Send a scene, and what it shows first; False where a newer one has taken its place."""
        known = self.workspace.shapes.shapes
        keys = [key for key in scene.shapes if key not in self._known]
        if any(key not in known for key in keys):
            # While an older message was on its way, others drew two scenes more.
            return False
        if keys:
            await self._say(Shapes(shapes=tuple(known[key] for key in keys)))
        self._scene = scene
        await self._say(scene)
        await self._forget(scene.shapes)
        return True

    async def _forget(self, shown: Sequence[str]) -> None:
        """Have the page forget looks that were shown longest ago, all but some."""
        latest = dict.fromkeys(shown)
        self._known = {key: None for key in self._known if key not in latest} | latest
        many = len(self._known) - len(latest) - MOST_KEPT
        if gone := tuple(islice(self._known, max(many, 0))):
            self._known = dict(islice(self._known.items(), many, None))
            await self._say(Shapes(gone=gone))

    async def _send_state(self, state: State) -> None:
        before, now = self._state, time.monotonic()
        if state == before:
            return
        is_alike = before is not None and state.moving and _apart(state) == _apart(before)
        if is_alike and now - self._state_at < STATE_SECONDS:
            return
        self._state, self._state_at = state, now
        await self._say(state)

    async def _say(self, message: Said) -> None:
        await self._carrier.send_text(message.model_dump_json())

    def _follow(self, owner: Owner | None) -> None:
        """Count anew where another session is on the desk: the last one answers no more."""
        if owner is not self._owner:
            self._owner = owner
            self._newest = self._posted[-1][1] if self._posted else self._newest
            self._posted.clear()

    def _done(self, done: int) -> int:
        """Newest of this page's commands that a frame of the session knows."""
        while self._posted and self._posted[0][0] <= done:
            self._newest = self._posted.popleft()[1]
        return self._newest

    def receive(self, text: str) -> None:
        """Do what the page asks for; what means nothing is answered by a line."""
        try:
            read(text).act(self)
        except PackworkError as error:
            self.wake(Line(text=str(error)))

    def ack(self, frame: int) -> None:
        """Note that a frame has come: the next may."""
        if self._acked < frame <= self._frame:
            self._acked = frame
            self._woken.set()

    def post(self, posted: Command | Leap, number: int) -> None:
        """Have a command or a leap done, of that number in the page's count."""
        self._follow(self.workspace.owner)
        self._posted.append((self.workspace.post(posted, self), number))


def _unsettled(state: State) -> State:
    """A state of a layout that is not there yet."""
    unlike = {
        "moving": True,
        "certified": False,
        "entangled": (),
        "busy": state.busy or MAKING_ROOM,
        "polishing": False,
    }
    return state.model_copy(update=unlike)


def _apart(state: State) -> State:
    return state.model_copy(update={"covered": 0.0, "progress": 0.0})
