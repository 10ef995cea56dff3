"""The workspace: one session, the runs that fill it, and the pages that look at it.

The session lives in a thread of its own (:class:`packwork.live.owner.Owner`), runs in another; what
is here is called from the event loop, posts and looks, and never waits for either.
"""

from __future__ import annotations

import asyncio
import threading
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import Any, TypeAlias

import numpy as np

from packwork.arrays import IntArray
from packwork.errors import PackworkError
from packwork.live.commands.command import Command, Library
from packwork.live.commands.gestures import Cancel, Drop, Grab
from packwork.live.commands.together import Together
from packwork.live.face.lines import put_anew
from packwork.live.face.opening import Keeper, Opening, begun_with, kept_in
from packwork.live.macros import prepared
from packwork.live.other_items import in_place, poured_into
from packwork.live.owner import Frame, Leap, Owner
from packwork.live.relayout import Moment, poured_again
from packwork.live.session import Session
from packwork.studio.clipboard import Clipboard
from packwork.studio.kept_workspaces import Shelf
from packwork.studio.view import Scenes, Shown, View, left_out_of
from packwork.studio.wire import LeftOut, Line, Scene, State, Variant
from packwork.studio.wording import for_page

News = Line | Variant
"""What all pages are told beside what there is to be seen."""

Make: TypeAlias = Callable[[Session], Sequence[Command]]
"""What a session is to do before a run."""

VARIANTS = 6
"""How many are tried when more are asked for. Chosen."""

MOST_LINES = 32
"""Lines that wait for a page at most. Chosen."""

QUIET_SECONDS = 2.0
"""How long nothing has to move until the session's file may be written anew. Chosen."""

NOT_YET = "the first layout is still on its way; try it again in a moment"


class Workspace:
    """Workspace that pages look at and work on."""

    def __init__(self, opening: Opening, shelf: Shelf | None = None) -> None:
        self._opening, self.shelf = opening, shelf
        self._is_fresh = opening.is_bare
        self._loop: asyncio.AbstractEventLoop | None = None
        self._worker = ThreadPoolExecutor(1, "studio")
        self._drawer = ThreadPoolExecutor(1, "drawing")
        self._scenes = Scenes()
        self._stop = threading.Event()
        self.is_stopped = self._stop.is_set
        self._moment: View | None = None
        self._busy, self._progress, self._number = "", 0.0, 0
        self._desk: tuple[Owner, Keeper | None] | None = None
        self._unplaced: tuple[IntArray, tuple[LeftOut, ...]] | None = None
        self.clipboard = Clipboard()
        self._unheard: deque[News] = deque(maxlen=MOST_LINES)
        self._dragging: object = None
        self._tidying: asyncio.Task[None] | None = None
        self._listeners: dict[object, Callable[[News | None], object]] = {}

    async def begin(self) -> None:
        """Begin with what was given; returns at once."""
        self._loop = asyncio.get_running_loop()
        self.work("Pouring", partial(self._open, self._opening, lambda: self._opening.kept_in))
        self._tidying = asyncio.create_task(self._tidy())

    def close(self) -> None:
        """End all threads; what is in the workspace is kept, if it is kept anywhere."""
        if self._tidying is not None and self._loop is not None:
            self._loop.call_soon_threadsafe(self._tidying.cancel)
        self._stop.set()
        self._worker.shutdown(cancel_futures=True)
        self._drawer.shutdown(cancel_futures=True)
        self._end(self._desk)

    @staticmethod
    def _end(desk: tuple[Owner, Keeper | None] | None) -> None:
        """End a session's thread; what was done is kept, if it is kept anywhere."""
        if desk is not None:
            owner, keeper = desk
            if keeper is not None:
                owner.call(keeper.end)
            owner.__exit__(None, None, None)

    @property
    def owner(self) -> Owner | None:
        """The thread that owns the session; None until there is one."""
        return None if self._desk is None else self._desk[0]

    def listen(self, who: object, on_news: Callable[[News | None], object]) -> None:
        """Have somebody told, in the event loop, that something has changed, or a line."""
        self._listeners[who] = on_news
        for line in self._unheard:
            on_news(line)
        self._unheard.clear()

    def forget(self, who: object) -> None:
        """Tell somebody nothing more; what they drag is let go."""
        self._listeners.pop(who, None)
        if self._dragging is who and self.owner is not None:
            self._dragging = None
            self.owner.post(Drop())

    @property
    def shown(self) -> Shown | None:
        """View as of now, all of one moment; None before anything is."""
        # Both are replaced by other threads: each is looked at once.
        moment, owner = self._moment, self.owner
        frame = None if owner is None else owner.frame
        work = "" if owner is None or frame is None else owner.work(frame)
        if moment is not None:
            view = moment
        elif frame is not None:
            view = View.of_document(frame.document)
        else:
            return None
        state = self._state(view, frame, work, is_run=moment is not None)
        return Shown(view, state, 0 if frame is None else frame.done)

    @property
    def canvas(self) -> str | None:
        """Longer side of the canvas, as options say it; None before there is one."""
        if self.owner is None:
            return None
        container = self.owner.frame.document.container
        return f"{container.side:.17g}{container.unit}"

    async def scene(self, view: View) -> Scene:
        """Scene of a view; drawn aside, for new drawings take time."""
        if (known := self._scenes.known(view)) is not None:
            return known
        loop = asyncio.get_running_loop()
        return await loop.run_in_executor(self._drawer, self._scenes.of, view)

    @property
    def shapes(self) -> Scenes:
        """Shapes of the items."""
        return self._scenes

    def _state(self, view: View, frame: Frame | None, work: str, *, is_run: bool) -> State:
        is_moving = is_run or frame is None or bool(work)
        in_the_way = () if frame is None or frame.in_the_way is None else frame.in_the_way
        unmet = {} if frame is None or is_moving else frame.unmet
        return State(
            covered=view.covered,
            moving=is_moving,
            certified=not is_moving and not in_the_way and len(view.items) > 0,
            in_the_way=tuple(map(for_page, in_the_way[:20])),
            entangled=() if frame is None or is_moving else frame.entangled,
            unplaced=self._left_out(view),
            advice=() if frame is None or is_moving else tuple(map(for_page, frame.advice)),
            unmet={k: for_page(line) for k, line in unmet.items()},
            can_undo=frame is not None and frame.can_undo,
            can_redo=frame is not None and frame.can_redo,
            busy=self._busy or work,
            polishing=not is_moving and frame is not None and frame.is_rough,
            progress=self._progress if self._busy else 0.0,
            can_stop=bool(self._busy),
            saved=self._desk is not None and self._desk[1] is not None,
            clip=self.clipboard.token,
            document=self._number,
            fresh=self._is_fresh and not (frame is not None and frame.can_undo),
        )

    def _left_out(self, view: View) -> tuple[LeftOut, ...]:
        """Items that found no place, of those of which some are there."""
        if self._unplaced is None or not np.isin(view.ids, self._unplaced[0]).any():
            return ()
        return self._unplaced[1]

    def work(self, what: str, job: Callable[[], object]) -> None:
        """Have something done that takes long, after all that was begun before."""
        self._stop.clear()
        self._worker.submit(self._done, what, job)

    def stop(self) -> None:
        """End what takes long, with what there is."""
        self._stop.set()

    def post(self, posted: Command | Leap, who: object) -> int:
        """Have a command or a leap of somebody done; its number in the owner's count.

        Raises
        ------
        PackworkError
            If it cannot be now: one drags at a time.
        """
        if self.owner is None:
            raise PackworkError(NOT_YET)
        is_drag = isinstance(posted, Grab | Drop | Cancel)
        if is_drag and self._dragging not in (None, who):
            raise PackworkError("another page is dragging something; let go of it there first")
        if not self.owner.post(posted):
            raise PackworkError("too much is waiting to be done; that was left out")
        if is_drag:
            self._dragging = who if isinstance(posted, Grab) else None
        self._wake()
        return self.owner.posted

    def change(self, act: Callable[[Session], object], work: str) -> None:
        """Have something done to the session in its thread, after a run that is on its way.

        What is refused is told. ``work``: what it is called meanwhile.
        """
        if self._moment is not None:
            self.work(work, partial(self.change, act, work))
            return
        if self.owner is None:
            self.say(NOT_YET)
            return
        called = self.owner.call(act, work)
        self._wake()
        called.add_done_callback(lambda done: self._tell_of(done.exception()))

    def pour(self, seed: int, make: Make = lambda _: (), *, keeps_hand: bool = False) -> None:
        """Fill the container anew, after some commands; all of it is one step of the history.

        ``keeps_hand``: whether items stay where a hand has put them.
        """
        if self.owner is None:
            self.say(NOT_YET)
        else:
            pour = partial(self._pour, self.owner, seed, make, keeps_hand=keeps_hand)
            self.work("Pouring", pour)

    def pour_now(self, asked: Mapping[str, Any]) -> None:
        """Fill the container anew, in the worker that calls this.

        ``asked``: where items are to lie, as :func:`packwork.live.relayout.poured_again` has it.
        """
        if self.owner is None:
            raise PackworkError(NOT_YET)
        self._pour(self.owner, 0, lambda _: (), asked)

    def fill(self, use: str, source: str, options: Mapping[str, Any]) -> None:
        """Fill the container with other items, in the worker that calls this."""
        if self.owner is None:
            raise PackworkError(NOT_YET)
        document = self.owner.frame.document

        def show(moment: Moment) -> None:
            self._see(View.of_moment(moment), moment)

        layout = poured_into(document, use, source, options, show, self._stop.is_set)

        def act(session: Session) -> None:
            commands = in_place(session.document, session.library, layout)
            session.apply(Together(commands=tuple(commands)))  # type: ignore[arg-type]
            self._unplaced = (session.document.ids, left_out_of(layout.manifest))

        self.owner.call(act).result()

    def try_more(self, seed: int) -> None:
        """Have other places tried for the same items, each told when it is there."""
        if self.owner is None:
            self.say(NOT_YET)
        else:
            self.work("Trying others", partial(self._try_more, self.owner, seed))

    def _try_more(self, owner: Owner, seed: int) -> None:
        document = owner.frame.document
        for number in range(seed, seed + VARIANTS):
            if self._stop.is_set():
                return
            self._progress = (number - seed) / VARIANTS
            found = poured_again(document, number, lambda _: None, self._stop.is_set)
            placed = View.of_document(found.applied(document, Library()))
            self._wake(Variant(seed=number, covered=placed.covered, command=found))

    def open_another(self, opening: Opening) -> None:
        """Have another document on the desk, in the worker that calls this.

        The one that is there stays, and stays kept, until the other one lies.
        """
        before, self._is_fresh = self._desk, False
        self._open(opening, lambda: None if self.shelf is None else self.shelf.new_file())
        self._end(before)

    def _open(self, opening: Opening, new_file: Callable[[], Path | None]) -> None:
        begun = begun_with(opening, lambda moment: self._see(View.of_moment(moment), moment))
        if begun is None:
            return
        session, keeper = begun
        left_out = () if opening.file is not None else left_out_of(session.document.manifest)
        self._unplaced = (session.document.ids, left_out)
        if keeper is None and (file := new_file()) is not None:
            keeper = self._kept(file, session)
        elif keeper is not None and keeper.missed:
            self.say(keeper.missed)
        session.begin_film()
        owner = Owner(session, self._follow, polishes=True)
        owner.__enter__()
        self._desk, self._number = (owner, keeper), self._number + 1
        owner.call(Session.make_ready)

    def _kept(self, file: Path, session: Session) -> Keeper | None:
        """Keeper of a session; None, and a line, if it cannot be kept."""
        try:
            return kept_in(file, session)
        except PackworkError as error:
            self._tell_of(error)
            return None

    async def _tidy(self) -> None:
        """Write the session's file anew in quiet moments, so that a crash is soon made good."""
        seen = None
        while True:
            await asyncio.sleep(QUIET_SECONDS)
            if (desk := self._desk) is None or desk[1] is None:
                continue
            owner, keeper = desk
            before, seen = seen, owner.frame.document
            if seen is before and owner.waiting == 0 and keeper.is_long:
                tidied = owner.call(keeper.tidy)
                tidied.add_done_callback(lambda done: self._tell_of(done.exception()))

    def _pour(
        self,
        owner: Owner,
        seed: int,
        make: Make,
        asked: Mapping[str, Any] = MappingProxyType({}),
        *,
        keeps_hand: bool = False,
    ) -> None:
        """Run, in the worker, what is then put into the session."""
        asking = partial(prepared, make=make, keeps_hand=keeps_hand)
        commands, document = owner.call(asking).result()

        def show(moment: Moment) -> None:
            poses = moment.poses and replace(moment.poses, stretch=document.poses.stretch)
            self._see(View.of_document(document, poses), moment)

        put = put_anew(document, seed, show, self._stop.is_set, **asked)
        owner.call(lambda one: one.do_together((*commands, *put(one.library)))).result()

    def _see(self, view: View, moment: Moment) -> None:
        self._moment, self._progress = view, moment.progress
        self._wake()

    def _done(self, what: str, job: Callable[[], object]) -> None:
        self._busy, self._progress = what, 0.0
        self._wake()
        try:
            job()
        except Exception as error:  # noqa: BLE001
            self._tell_of(error)
        finally:
            self._busy, self._moment = "", None
            self._wake()

    def _follow(self) -> None:
        """Tell of a frame of the session, from its thread."""
        if self.owner is not None:
            for line in self.owner.frame.refused:
                self.say(line)
            if self.owner.failure is not None:
                self._tell_of(self.owner.failure)
        self._wake()

    def _tell_of(self, error: BaseException | None) -> None:
        """Tell of what went wrong: errors of ours as they are, others as a fault."""
        if isinstance(error, PackworkError):
            self.say(" ".join(str(error).split()))
        elif error is not None:
            self.say(f"this failed, by a fault of the program: {type(error).__name__}: {error}")

    def say(self, text: str, *, is_error: bool = True) -> None:
        """Tell all pages a line, from any thread."""
        self._wake(Line(text=for_page(text)[:500], is_error=is_error))

    def _wake(self, line: News | None = None) -> None:
        """Tell all who listen, from any thread."""
        if self._loop is not None and not self._loop.is_closed():
            self._loop.call_soon_threadsafe(self._tell, line)

    def _tell(self, line: News | None) -> None:
        if line is not None and not self._listeners:
            self._unheard.append(line)
        for on_news in tuple(self._listeners.values()):
            on_news(line)
