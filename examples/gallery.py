"""Writes ``docs/gallery.md`` from the examples' READMEs: ``python examples/gallery.py``.

An example comes in by itself: its title, its picture, which is the film that the README shows, else
``expected.png``, and the commands that stand before it. It is grouped by what they call: Python,
or a verb of ``packwork``.
"""

from __future__ import annotations

import html
import re
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

from PIL import Image

HERE = Path(__file__).resolve().parent
PAGE = HERE.parent / "docs" / "gallery.md"
EXPECTED = "expected.png"

LONGEST_PX = 420
"""Side of the square that pictures are shown in: larger ones are scrolled past, in smaller ones
words cannot be read; chosen by eye. Films with fewer pixels are not enlarged."""

COLLAGES = "Collages"
GROUPS = {
    "fill": COLLAGES,
    "run": COLLAGES,
    "words": "Words",
    "photos": "Photographs",
    "pile": "Piles",
    "nest": "Parts of true size",
    "chart": "Charts",
    "batch": "Many at once",
    "python": "In Python",
}
"""Headings by verb, in the page's order; a verb without one stands at the end, as it is."""

HEAD = """\
# Gallery

<!-- Written by `make gallery` from the READMEs of examples/: change those. -->

Every picture here was made by the commands below it, in the folder that its title leads to.
"""


@dataclass(frozen=True)
class Example:
    """What the page shows of one folder."""

    folder: Path
    title: str
    commands: str
    picture: str
    alt: str

    @property
    def group(self) -> str:
        """Heading for what the commands call first."""
        # A script of a folder that calls nothing of packwork draws what the next command reads.
        called = (
            verb or "python"
            for verb, script in re.findall(
                r"^(?:packwork (\w+)|python (\S+))", self.commands, flags=re.MULTILINE
            )
            if verb or not self._only_draws(script)
        )
        name = next(called)
        return GROUPS.get(name, name.capitalize())

    def _only_draws(self, script: str) -> bool:
        file = self.folder / script
        return file.is_file() and "packwork" not in file.read_text(encoding="utf-8")

    def __str__(self) -> str:
        """Title, picture and commands, in Markdown."""
        place = f"../examples/{self.folder.name}"
        return (
            f"### [{self.title}]({place}/README.md)\n\n"
            f'<img src="{place}/{self.picture}" {shown_size(self.folder / self.picture)} '
            f'alt="{html.escape(self.alt)}">\n\n'
            f"```sh\n{self.commands}```\n"
        )


def read_example(folder: Path) -> Example:
    """Take from a README what the page shows of it.

    Raises
    ------
    ValueError
        If there is no title, or the picture is not shown below a block of commands.
    """
    page = folder / "README.md"
    text = page.read_text(encoding="utf-8")
    title = re.match(r"# (.+)\n", text)
    shown = {name: alt for alt, name in re.findall(r"!\[([^\]]*)\]\(([^)]+)\)", text)}
    films = re.findall(r"(?:--film |the film, `)([^\s`]+)", text)
    picture = next((name for name in films if name in shown), EXPECTED)
    before = text.partition(f"]({picture})")[0]
    commands = "".join(re.findall(r"```sh\n(.*?)```", before, flags=re.DOTALL))
    if title is None or not commands or picture not in shown:
        raise ValueError(f"{page} needs a title and, below its commands (sh), {picture}")
    return Example(folder, title[1], commands, picture, shown[picture])


def shown_size(picture: Path) -> str:
    """Width, as an attribute, at which a picture fits the square; drawings take all of it."""
    if picture.suffix == ".svg":
        return f'width="{LONGEST_PX}"'
    with Image.open(picture) as image:
        width, height = image.size
    return f'width="{round(width * min(1.0, LONGEST_PX / max(width, height)))}"'


def gallery(examples: list[Example]) -> str:
    """Put the page together: what is in it, then a chapter a group."""
    known = [*GROUPS.values(), *sorted(example.group for example in examples)]
    chapters = {name: [e for e in examples if e.group == name] for name in dict.fromkeys(known)}
    filled = {name: members for name, members in chapters.items() if members}
    contents = " · ".join(f"[{name}](#{name.lower().replace(' ', '-')})" for name in filled)
    parts = ([f"## {name}\n", *map(str, members)] for name, members in filled.items())
    return "\n".join([HEAD, f"{contents}\n", *chain.from_iterable(parts)])


def written() -> str:
    """Read all examples, in the order of their folders' names, and put the page together."""
    folders = sorted(page.parent for page in HERE.glob("*/README.md"))
    return gallery([read_example(folder) for folder in folders])


if __name__ == "__main__":
    PAGE.write_text(written(), encoding="utf-8")
