"""Pages behind items: left out or kept, as files of one folder agree."""

from __future__ import annotations

import logging
from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

from packwork.phrasing import MOST_NAMED, enumerated
from packwork.scene.item import Item

_LOG = logging.getLogger("packwork")


class PageFate(Enum):
    """Fate of the page behind a drawing; each value says it of one file."""

    NONE = ""
    """There is none, or the drawing is its own ground: clear beside it."""

    LEFT_OUT = "its white page was left out; --keep-page keeps it"

    CUT_AWAY = "its plain background was cut away; --keep-page keeps it"

    KEPT = "its white page is part of it, as what is on it touches its edge; --drop-page drops it"

    FILLED = "it fills its page"


DROPPED = (PageFate.LEFT_OUT, PageFate.CUT_AWAY)


@dataclass(frozen=True, eq=False)
class Read:
    """An item, its file (None of a built-in one), its page's fate, and a way to keep the page."""

    item: Item
    file: str | None = None
    page: PageFate = PageFate.NONE
    again: Callable[[], Item] | None = None


def with_pages_alike(reads: Sequence[Read]) -> list[Item]:
    """Items of files, those of one folder treated alike, which is said.

    Where most files fill their pages, as flags do, those that look like drawings on a white
    page are of the same kind and keep theirs.

    Examples
    --------
    >>> from packwork.readers.builtin import builtin_item
    >>> star, page = builtin_item("star"), builtin_item("square")
    >>> flags = [Read(page, f"flags/{k}.svg", PageFate.FILLED) for k in range(3)]
    >>> japan = Read(star, "flags/jp.svg", PageFate.LEFT_OUT, lambda: page)
    >>> [item.name for item in with_pages_alike([*flags, japan])]
    ['square', 'square', 'square', 'square']
    >>> [item.name for item in with_pages_alike([japan])]
    ['star']
    """
    items = [one.item for one in reads]
    folders: dict[Path, list[int]] = defaultdict(list)
    for k, one in enumerate(reads):
        if one.file is not None:
            folders[Path(one.file).parent].append(k)
    for folder, members in folders.items():
        dropped = [k for k in members if reads[k].page in DROPPED]
        filled = [k for k in members if reads[k].page in (PageFate.FILLED, PageFate.KEPT)]
        if len(filled) > len(dropped) > 0:
            for k in dropped:
                again = reads[k].again
                items[k] = items[k] if again is None else again()
            _LOG.warning(
                "%s: the page behind %s is part of the drawing, as of most files there; "
                "--drop-page leaves it out",
                folder, _named(reads[k] for k in dropped),
            )  # fmt: skip
        else:
            _tell(folder, [reads[k] for k in dropped if reads[k].page is PageFate.LEFT_OUT])
        if len(members) == 1:
            _tell(folder, [one for k in members if (one := reads[k]).page is PageFate.KEPT])
    return items


def _tell(folder: Path, reads: Sequence[Read]) -> None:
    if len(reads) <= MOST_NAMED:
        for one in reads:
            _LOG.warning("%s: %s", one.file, one.page.value)
        return
    _LOG.warning(
        "%s: the white pages behind %s were left out; --keep-page keeps them", folder,
        _named(reads),
    )  # fmt: skip


def _named(reads: Iterable[Read]) -> str:
    return enumerated([Path(one.file or "").name for one in reads])
