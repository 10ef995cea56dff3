"""Messages of a page that put another document on the desk, and the base of all its messages."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Annotated, ClassVar, Literal, TypeAlias

from pydantic import Field

from packwork.errors import ReadError
from packwork.live.chart_groups import region_of_one
from packwork.live.commands.command import made, named_container
from packwork.live.commands.container import SetContainer
from packwork.live.face.offers import container_of, read_again, told_of_map
from packwork.live.face.opening import Opening, chart_opening, opening_sent
from packwork.live.face.templates import template
from packwork.live.kinds import ChartKind
from packwork.scene.container import Container, on_canvas, placed_container
from packwork.studio.wire import Message
from packwork.units import CanvasSize

if TYPE_CHECKING:
    from packwork.studio.tab import Tab

Template: TypeAlias = Literal[
    "icons", "letters", "words", "names", "badge", "paper", "jar", "nest", "photos", "mosaic"
]
Name: TypeAlias = Annotated[str, Field(min_length=1, max_length=200)]
Font: TypeAlias = Annotated[str, Field(max_length=200)]


class PageRequest(Message):
    """A message of a page."""

    type: str

    @abstractmethod
    def act(self, tab: Tab) -> None:
        """Do what the page asks for."""


class ReadRequest(PageRequest):
    """A message that has something read, in the worker of the workspace."""

    doing: ClassVar[str] = "Reading"

    def act(self, tab: Tab) -> None:
        """Have it read; what is there stays until it lies."""
        tab.importer.read(partial(self.read, tab), self.doing)

    @abstractmethod
    def read(self, tab: Tab) -> None:
        """Read what the page names, and do what it asks for."""


class Open(ReadRequest):
    """Have a session, a recipe or a layout that was sent before on the desk, or fill a map."""

    doing = "Opening"
    type: Literal["open"] = "open"
    source: Name

    def read(self, tab: Tab) -> None:
        """Read it; what is there stays until it lies."""
        if (opening := opening_sent(tab.importer.folder(self.source))) is not None:
            tab.importer.begin(opening)
            return
        # GeoJSON that is no layout is a map.
        container = container_of(tab.importer.file(self.source), tab.workspace.canvas)
        if line := told_of_map(container):
            tab.workspace.say(line, is_error=False)
        tab.workspace.pour(0, lambda session: [
            made(SetContainer, asset=named_container(session.library, container))
        ])  # fmt: skip


class BeginChart(ReadRequest):
    """Have a chart of a table that was sent before on the desk, in the container of now."""

    doing = "Drawing the chart"
    type: Literal["chart"] = "chart"
    source: Name
    size_by: Name | None = None
    """Column of numbers; None for marks that are all alike."""
    color_by: Name | None = None
    label_by: Name | None = None
    by: Name | None = None
    """Column whose values are groups, each in a container of its own; None for no groups."""
    in_regions: bool = False
    """Whether groups lie in those parts of the container that have their names."""
    by_step: Annotated[float, Field(gt=0, allow_inf_nan=False)] | None = None
    """Numbers of that column in steps of so much."""
    mark: Annotated[str, Field(pattern="^builtin:[a-z0-9-]{1,60}$")] | None = None
    """A bundled drawing; None for circles."""
    title: Annotated[str, Field(max_length=200)] = ""

    def read(self, tab: Tab) -> None:
        """Read the table, and have a run; what is there stays until it lies."""
        file, container = tab.importer.file(self.source), _room(tab)
        columns = ("size_by", "color_by", "label_by", "by", "by_step", "in_regions")
        asked = {name: getattr(self, name) for name in columns}
        marks = () if self.mark is None else (self.mark,)
        opening = chart_opening(container, file, **asked, mark=marks, title=self.title or None)
        tab.importer.begin(opening)


def _room(tab: Tab) -> Container:
    """Container on the desk, without the paper that a chart has about it."""
    shown, owner = tab.workspace.shown, tab.workspace.owner
    if shown is None or owner is None:
        return container_of("circle", None)
    container = shown.view.container
    if not isinstance(shown.view.kind, ChartKind):
        return container
    if container.file is not None:
        size = CanvasSize(container.side, None, container.unit)
        return on_canvas(read_again(container), size)
    region = region_of_one(owner.frame.document)
    left, top, right, bottom = region.bounds
    box = (left, top, right - left, bottom - top)
    room = placed_container(container.name, container.source, region, box, container.side)
    return replace(room, unit=container.unit)


class Begin(ReadRequest):
    """Begin another document with a template, or go on with one that is kept."""

    doing = "Opening"
    type: Literal["begin"] = "begin"
    template: Template | None = None
    source: Name | None = None
    """Files of those templates that take some."""
    kept: Annotated[str, Field(pattern="^desk-[0-9]{1,2}$")] | None = None
    """Name of the kept one."""

    def read(self, tab: Tab) -> None:
        """Open it; what is there stays until it lies."""
        shelf = tab.workspace.shelf
        if self.template is not None:
            folder = None if self.source is None else tab.importer.folder(self.source)
            opening = template(self.template, folder)
        elif self.kept is not None and shelf is not None:
            opening = Opening(file=shelf.file(self.kept))
        else:
            raise ReadError("begin", "takes a template or the name of what is kept")
        tab.importer.begin(opening)
