"""Openings of a studio: a recipe to run, a layout that was saved, or a session's file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from packwork import uses
from packwork.errors import PackworkError, ReadError, RecipeError
from packwork.live.document import Document
from packwork.live.file.disk import ENDING, Disk, lock_beside
from packwork.live.file.records import kept_text
from packwork.live.ground import MOSAIC_PX, Mosaic
from packwork.live.relayout import Shown, poured
from packwork.live.session import Session
from packwork.readers.layouts.read import holds_layout, is_drawn, read_written
from packwork.readers.maps import ENDINGS, is_map
from packwork.readers.recipe import read_recipe
from packwork.readers.target import kept_picture
from packwork.recipe import Recipe, make_recipe
from packwork.recipe_paths import named_elsewhere
from packwork.scene.container import Container

FIRST = "heart"
"""Container of a workspace in which nothing was put."""

FIRST_COUNT = 60
"""Items of such a workspace. More take longer until they lie, fewer show less. Chosen."""

DOCUMENTS = frozenset({ENDING, ".toml", ".geojson", ".json"})
"""Endings of files that hold a session, a recipe or a layout and can be nothing else."""


@dataclass(frozen=True, kw_only=True)
class Opening:
    """Opening of a studio: a recipe, a document or a session's file.

    ``container``: that is filled in place of the recipe's.
    ``title``: of a document that has none; empty for its container's name.
    ``kept_in``: file in which the session is kept, with a journal; None to keep it nowhere.
    ``is_copied``: whether ``file`` is read once and never written.
    ``is_bare``: whether nothing was given.
    """

    recipe: Recipe | None = None
    container: Container | None = None
    title: str = ""
    document: Document | None = None
    file: Path | None = None
    kept_in: Path | None = None
    is_copied: bool = False
    is_bare: bool = False


def opening_of(inputs: Sequence[str], count: int | None = None, **options: Any) -> Opening:
    """Opening that inputs stand for, as people type them.

    ``inputs``: None: the bundled icons in a heart. One file: a recipe, a layout or a session by its
    ending, an SVG or DXF that this program wrote too. Else the container, then the items.

    Examples
    --------
    >>> opening_of([]).recipe.container, opening_of(["bear", "star"], 9).recipe.count
    ('heart', 9)
    """
    if len(inputs) == 1 and _is_document(path := Path(inputs[0])):
        ending = path.suffix.lower()
        if count is not None and ending != ".toml":
            raise RecipeError("count", f"a {ending} file has its items; leave it out")
        return _of_file(path, ending, count, options)
    container = inputs[0] if inputs else FIRST
    items = list(inputs[1:]) or ["builtin:icons"]
    if count is None and len(inputs) < 2:
        count = FIRST_COUNT
    recipe = make_recipe(container=container, items=items, **_drafted(count, options))
    return Opening(recipe=recipe, is_bare=not inputs)


def opening_sent(folder: Path) -> Opening | None:
    """Opening of files that were sent together; None if none of them is a document.

    A recipe may name what is bundled and what was sent with it, nothing else on this machine.

    Raises
    ------
    ReadError, RecipeError
        If a document cannot be read, or there are several.
    """
    files = sorted(folder.iterdir())
    recipes = [one for one in files if one.suffix.lower() == ".toml"]
    if len(recipes) == 1:
        options = read_recipe(recipes[0])
        if elsewhere := named_elsewhere(options, folder):
            raise RecipeError(
                recipes[0].name,
                f"names {elsewhere[:80]}, which was not sent with it; send both together, or run "
                "packwork studio with the recipe",
            )
        recipe = make_recipe(**options | _drafted(None, {}))
        return Opening(recipe=recipe, title=_named(recipes[0]))
    documents = [one for one in files if _is_document(one)]
    if not documents:
        return None
    if len(files) > 1:
        raise ReadError(documents[0].name, "is a document; open it alone")
    return replace(_of_file(files[0], files[0].suffix.lower(), None, {}), is_copied=True)


def chart_opening(container: Container, table: str, **options: Any) -> Opening:
    """Opening of a chart of a table's file, with options as ``packwork chart`` has them."""
    recipe = uses.chart_recipe("page", table, **_drafted(None, options))
    title = options.get("title") or Path(table).stem
    return Opening(recipe=recipe, container=container, title=title)


def _is_document(path: Path) -> bool:
    if path.suffix.lower() in ENDINGS and path.is_file() and is_map(path):
        return False
    is_ours = is_drawn(path) and path.is_file() and holds_layout(path)
    return is_ours or path.suffix.lower() in DOCUMENTS


def _of_file(path: Path, ending: str, count: int | None, options: dict[str, Any]) -> Opening:
    if ending == ".toml":
        recipe = make_recipe(**{**read_recipe(path), **_drafted(count, options)})
        return Opening(recipe=recipe, title=_named(path))
    if ending == ENDING:
        return Opening(file=path, title=path.stem)
    return Opening(document=Document.from_layout(read_written(path)), title=path.stem)


def _named(recipe: Path) -> str:
    """Name that a recipe's file gives to a document; none where it is that of all we write."""
    return "" if recipe.stem.lower() == "recipe" else recipe.stem


def _drafted(count: int | None, options: dict[str, Any]) -> dict[str, Any]:
    """Options of a first run: a draft, for all can be made better later."""
    given = {key: value for key, value in options.items() if value is not None}
    return {"effort": "draft", **({} if count is None else {"count": count}), **given}


def read_once(path: Path) -> Session:
    """Session that a file holds, which is not kept there."""
    return Disk(path, is_journaled=False).opened(Session)


def opened(path: Path) -> tuple[Session, Keeper]:
    """Session that a file holds, all done again that its journal adds, and what keeps it there."""
    disk = Disk(path, is_journaled=True)
    return disk.opened(Session), Keeper(disk)


def begun_with(opening: Opening, shown: Shown) -> tuple[Session, Keeper | None] | None:
    """Session of an opening, its run shown, and what keeps it; None where it is empty."""
    begun = _begun(opening, shown)
    if begun is not None and opening.title and not begun[0].document.manifest.get("title"):
        begun[0].do("entitle", title=kept_text(opening.title))
    return begun


def _begun(opening: Opening, shown: Shown) -> tuple[Session, Keeper | None] | None:
    if opening.file is not None:
        return (read_once(opening.file), None) if opening.is_copied else opened(opening.file)
    document = opening.document
    if opening.recipe is not None:
        layout = poured(opening.recipe, shown, container=opening.container)
        document = Document.from_layout(layout)
        if (picture := opening.recipe.picture) is not None:
            mosaic = Mosaic(kept_picture(picture, MOSAIC_PX), opening.recipe.tint)
            document = replace(document, mosaic=mosaic)
    return None if document is None else (Session(document), None)


def kept_in(path: Path, session: Session) -> Keeper:
    """Keeper of a new session in a file."""
    keeper = Keeper(Disk(path, is_journaled=True))
    keeper.begin(session)
    return keeper


LONGEST_JOURNAL = 60_000
"""Bytes of a journal from which on the file is written anew, in a quiet moment. Larger takes longer
to be done again after a crash: each gesture as long as it took. Chosen."""


def lock_of(file: Path) -> Path:
    """File whose lock says that somebody works at a session that is kept in ``file``."""
    return lock_beside(file)


class Keeper:
    """Keeps a session in a file; called in the thread that owns the session."""

    def __init__(self, disk: Disk) -> None:
        self._disk = disk

    @property
    def missed(self) -> str:
        """Line on what of the journal could not be done again; empty if nothing."""
        return self._disk.missed

    def begin(self, session: Session) -> None:
        """Write the file, and note from now on what is done."""
        self._disk.save(session)

    @property
    def is_long(self) -> bool:
        """Whether the journal is so long that the file should be written anew."""
        try:
            return self._disk.journal.stat().st_size > LONGEST_JOURNAL
        except OSError:
            return False

    def tidy(self, session: Session) -> None:
        """Write the file anew, if nothing is held by the hand."""
        if not session.is_grabbed:
            self._disk.save(session)

    def end(self, session: Session) -> None:
        """Write the file a last time, and end the journal."""
        try:
            self.tidy(session)
        except PackworkError:
            # The journal has it all.
            return
        finally:
            self._disk.close(session)
