"""Any sequence of commands: no crash, nothing lost, undo inverts, no false certificate."""

from __future__ import annotations

import functools
import io

import numpy as np
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule

import packwork as pw
from packwork.errors import RecipeError
from packwork.live.commands.command import Library
from packwork.live.commands.container import PlaceContainer, Reshape, SetOption
from packwork.live.commands.gestures import Cancel, Drop, Grab, Hold, Release
from packwork.live.commands.items import Add, Duplicate, Recolour, Remove, Rename, Replace, Weigh
from packwork.live.commands.look import Background, Paint
from packwork.live.commands.placing import Cover, Exchange, Move, Scale, Turn
from packwork.live.commands.together import COMMANDS, AnyCommand, Together
from packwork.live.document import PROPERTIES, Document
from packwork.live.log import Log, read_entries
from packwork.live.session import Session
from packwork.metrics.violations import violations


@functools.cache
def start() -> Document:
    """A small layout; made once a test needs it, for each process collects all tests."""
    made = pw.fill("circle", ["star", "heart"], count=7, epochs=60, levels="50")
    return Document.from_layout(made)


(HEXAGON,) = pw.read_items("hexagon")

items = st.integers(0, 9)
numbers = st.floats(0.2, 4)
places = st.floats(-50, 650)
rings = st.lists(st.tuples(places, places), min_size=3, max_size=5)
ends = st.lists(st.sampled_from(PROPERTIES), min_size=1, max_size=3).map(tuple)

commands = st.one_of(
    st.builds(Move, item=items, x=places, y=places),
    st.builds(Turn, item=items, angle=st.floats(-400, 400)),
    st.builds(Scale, item=items, factor=numbers),
    st.builds(Exchange, first=items, second=items),
    st.builds(Hold, items=st.tuples(items), properties=ends),
    st.builds(Release, items=st.tuples(items, items), properties=ends),
    st.builds(Duplicate, item=items),
    st.builds(Remove, items=st.tuples(items)),
    st.builds(Weigh, items=st.tuples(items), weight=numbers),
    st.builds(
        Rename,
        item=items,
        name=st.text(st.characters(exclude_categories=["Cc", "Cs"]), min_size=1, max_size=9),
    ),
    st.builds(Recolour, items=st.tuples(items), colour=st.sampled_from(["red", "#12", "teal"])),
    st.builds(PlaceContainer, x=st.floats(-60, 60), y=st.floats(-60, 60), factor=numbers),
    st.builds(SetOption, name=st.just("padding"), value=st.floats(0, 6)),
    st.builds(
        Reshape, rings=st.tuples(st.lists(st.tuples(places, places), min_size=3, max_size=5))
    ),
    st.builds(
        SetOption,
        name=st.just("sizes"),
        value=st.sampled_from(["free", "shared", "fixed"]),
    ),
    st.builds(SetOption, name=st.just("rotate"), value=st.sampled_from(["free", "30", "none"])),
    st.builds(SetOption, name=st.just("evenness"), value=st.floats(0, 2)),
    st.builds(Cover, share=st.floats(0.05, 0.95)),
    st.builds(Add, asset=st.just("hexagon"), x=places, y=places, area=st.floats(10, 20_000)),
    st.builds(Replace, item=items, asset=st.just("hexagon")),
    st.builds(Paint, palette=st.sampled_from([(), ("teal", "#f00")])),
    st.builds(Background, colour=st.sampled_from(["", "ivory"])),
    st.builds(
        Together,
        commands=st.tuples(
            st.builds(Move, item=items, x=places, y=places), st.builds(Duplicate, item=items)
        ),
    ),
    st.builds(Grab, items=st.tuples(items)),
    st.just(Drop()),
    st.just(Cancel()),
)


class AnySequence(RuleBasedStateMachine):
    """Commands, epochs, settles and leaps in any order."""

    @initialize()
    def begin(self) -> None:
        self.stream = io.StringIO()
        self.session = Session(start(), Library({"hexagon": HEXAGON}), Log(self.stream))

    @rule(command=commands)
    def apply(self, command: AnyCommand) -> None:
        assert COMMANDS.validate_json(command.model_dump_json()) == command
        before = self.session.document
        refused = ""
        try:
            self.session.apply(command)
        except RecipeError as error:
            refused = str(error)
        assert "\n" not in refused
        assert not refused or self.session.document is before

    @rule(epochs=st.integers(1, 9))
    def flow(self, epochs: int) -> None:
        before = self.session.document
        self.session.flow(epochs=epochs)
        self._nothing_held_moved(before)

    @precondition(lambda self: not self.session.is_grabbed)
    @rule()
    def settle(self) -> None:
        before = self.session.document
        self.session.settle()
        self._nothing_held_moved(before)

    @precondition(lambda self: not self.session.is_grabbed)
    @rule(trials=st.integers(1, 9))
    def polish(self, trials: int) -> None:
        before, was_certified = self.session.document, self.session.is_certified
        self.session.polish(trials)
        self._nothing_held_moved(before)
        assert self.session.is_certified == was_certified

    @precondition(lambda self: not self.session.is_grabbed)
    @rule()
    def replay(self) -> None:
        self.session.log.flush()
        entries = list(read_entries(iter(self.stream.getvalue().splitlines()), "a log"))
        again = Session.replay(start(), entries)
        for name in ("x", "y", "angle", "scale"):
            one, other = (getattr(s.document.poses, name) for s in (self.session, again))
            assert one.tobytes() == other.tobytes()

    @precondition(lambda self: not self.session.is_grabbed and self.session.history.can_undo)
    @rule()
    def there_and_back(self) -> None:
        before = self.session.document
        self.session.undo()
        self.session.redo()
        assert self.session.document is before

    @invariant()
    def is_whole(self) -> None:
        if not hasattr(self, "session"):
            return
        document = self.session.document
        assert len(document.items) == len(document.poses) == len(document.ids)
        assert len(np.unique(document.ids)) == len(document.ids)
        columns = (getattr(document.poses, name) for name in ("x", "y", "angle", "scale"))
        assert all(np.isfinite(column).all() for column in columns)
        assert (document.poses.scale > 0).all()
        if self.session.is_certified:
            layout = self.session.layout
            gap = document.options.padding
            assert violations(layout.outlines, layout.container.outline, gap) == ()

    def _nothing_held_moved(self, before: Document) -> None:
        after = self.session.document
        for column, names in enumerate((("x", "y"), ("angle",), ("scale",))):
            held = before.held[:, column]
            for name in names:
                one, other = getattr(before.poses, name), getattr(after.poses, name)
                assert one[held].tobytes() == other[held].tobytes()


TestAnySequence = AnySequence.TestCase
TestAnySequence.settings = settings(
    max_examples=25,
    stateful_step_count=12,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)
