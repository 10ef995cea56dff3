"""Messages of a page that fill the container with others, or put all anew in some way."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias

from pydantic import Field

from packwork.live import edits
from packwork.live.kinds import LineWay
from packwork.live.relayout import BY_TEXT
from packwork.studio.documents import Font, Name, PageRequest
from packwork.studio.files import FILES

if TYPE_CHECKING:
    from packwork.studio.tab import Tab

Weight: TypeAlias = Annotated[float, Field(gt=0, allow_inf_nan=False)]
Ring: TypeAlias = Annotated[
    tuple[Annotated[str, Field(min_length=1, max_length=200)], ...], Field(max_length=2)
]


class Fill(PageRequest):
    """Fill the container with other items, all of those there taken away."""

    type: Literal["fill"] = "fill"
    use: Literal["items", "words", "photos"]
    source: Name
    count: Annotated[int, Field(ge=1, le=2_000)] | None = None
    font: Font | None = None
    """Of words, as of a container."""
    palette: Annotated[str, Field(max_length=200)] | None = None
    """Of words."""
    without: Annotated[tuple[Name, ...], Field(max_length=500)] = ()
    """Words of a text that are left out."""
    along: LineWay | None = None
    """Lines that words follow."""
    ring: Ring = ()
    """Texts round the edge of the container, words within."""

    def act(self, tab: Tab) -> None:
        """Have a run of what is read."""
        tab.importer.read(partial(self._fill, tab), "Pouring")

    def _fill(self, tab: Tab) -> None:
        importer, options = tab.importer, dict[str, Any](count=self.count)
        source = importer.source(self.source)
        if self.use == "words":
            source = importer.file(self.source) if self.source.startswith(FILES) else source
            options |= {"font": importer.font(self.font), "palette": self.palette}
            options |= {"along": self.along, "ring": self.ring}
            # One list, with a comma at the end: none of its words is taken for a file.
            options["stopwords"] = ",".join((*self.without, "")) if self.without else None
        tab.workspace.fill(self.use, source, options)


class Order(PageRequest):
    """Put all anew in an order along a way; no measure of a file, which a page cannot name."""

    type: Literal["order"] = "order"
    way: Literal["right", "left", "down", "up", "outwards", "inwards", "around", "along"]
    by: Literal["weight", "hue", "lightness", "name"]

    def act(self, tab: Tab) -> None:
        """Have a run."""
        asked = {"arrange": f"{self.way} by={self.by}"}
        tab.importer.read(lambda: tab.workspace.pour_now(asked), "Pouring")


class Alike(PageRequest):
    """Put all anew, like items side by side, by vectors in a file that was sent before."""

    type: Literal["alike"] = "alike"
    source: Name
    """The file, or ``auto``: of words, by their text."""

    def act(self, tab: Tab) -> None:
        """Have a run."""

        def read() -> None:
            source = self.source if self.source == BY_TEXT else tab.importer.file(self.source)
            tab.workspace.pour_now({"embeddings": source})

        tab.importer.read(read, "Pouring")


class Words(PageRequest):
    """Have these words with these weights; those that stay keep their places."""

    type: Literal["words"] = "words"
    words: Annotated[tuple[tuple[Name, Weight], ...], Field(min_length=1, max_length=2_000)]
    font: Font | None = None

    def act(self, tab: Tab) -> None:
        """Set them, and change those that are others."""

        def read() -> None:
            font = tab.importer.font(self.font)
            options = {} if font is None else {"fonts": [font]}
            words = dict(self.words)
            shown = tab.workspace.shown
            if shown is not None and shown.view.kind.name == "lines":
                tab.workspace.pour_now({"words": words, "font": font})
                return
            tab.workspace.change(
                lambda session: edits.words(session, words, **options), "Setting words"
            )

        tab.importer.read(read, "Setting words")


class Lines(PageRequest):
    """Have the words that there are follow other lines, or none."""

    type: Literal["lines"] = "lines"
    along: LineWay | None = None
    ring: Ring = ()
    font: Font | None = None

    def act(self, tab: Tab) -> None:
        """Set them anew."""

        def read() -> None:
            font = tab.importer.font(self.font)
            tab.workspace.pour_now({"along": self.along, "ring": self.ring, "font": font})

        tab.importer.read(read, "Setting words")
