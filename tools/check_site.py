"""Checks the built site: ``python tools/check_site.py``, after ``make site``.

Every link and picture leads to a file, every anchor to an element; the first page with all that
it loads is small; axe-core (``make setup-page``) finds nothing serious on three pages, light and
dark. Exit code 1 if not.
"""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterator
from functools import cache
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag, urlsplit

ROOT = Path(__file__).resolve().parents[1]
SITE = ROOT / "build" / "site"
AXE = Path(os.environ.get("PACKWORK_AXE", ROOT / ".page/node_modules/axe-core/axe.min.js"))
FIRST_BYTES = 1_000_000
LOOKED_AT = ("index.html", "docs/gallery.html", "docs/reference/commands.html")
RUN = "() => axe.run(document, { resultTypes: ['violations'] }).then((found) => found.violations)"


class Page(HTMLParser):
    """Links and ids of a page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[str] = []
        self.ids: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note what a tag leads to and is called."""
        for name, value in attrs:
            if name in {"href", "src"} and value:
                self.links.append(value)
            elif name == "id" and value:
                self.ids.add(value)


@cache
def page(path: Path) -> Page:
    """A page of the site, read once."""
    return Page(path.read_text(encoding="utf-8"))


def dead_links() -> Iterator[str]:
    """Links that lead nowhere; those to other sites are not followed."""
    for path in sorted(SITE.rglob("*.html")):
        for link in page(path).links:
            if urlsplit(link).scheme or link.startswith("//"):
                continue
            plain, anchor = urldefrag(link.split("?")[0])
            target = (path.parent / unquote(plain)).resolve() if plain else path
            if not target.is_file():
                yield f"{path.relative_to(SITE)}: {link} is no file"
            elif anchor and target.suffix == ".html" and unquote(anchor) not in page(target).ids:
                yield f"{path.relative_to(SITE)}: {link} is no heading"


def first_bytes() -> int:
    """Bytes of the first page and of all that it loads from the site."""
    first = SITE / "index.html"
    loaded = {urldefrag(link.split("?")[0])[0] for link in page(first).links}
    files = [SITE / unquote(link) for link in loaded if not link.endswith((".html", "/"))]
    return sum(file.stat().st_size for file in [first, *files] if file.is_file())


def faults() -> Iterator[str]:
    """Serious findings of axe-core."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as tools:
        browser = tools.chromium.launch(executable_path=shutil.which("chromium"))
        for scheme in ("light", "dark"):
            shown = browser.new_context(color_scheme=scheme).new_page()
            for name in LOOKED_AT:
                shown.goto((SITE / name).as_uri())
                shown.evaluate(AXE.read_text(encoding="utf-8"))
                for one in shown.evaluate(RUN):
                    if one["impact"] in {"serious", "critical"}:
                        nodes = [node["html"][:120] for node in one["nodes"][:3]]
                        yield f"{name}, {scheme}: {one['id']}: {nodes}"
        browser.close()


def main() -> int:
    """Print what is wrong, and how large the first page is."""
    wrong = list(dead_links())
    size = first_bytes()
    sys.stdout.write(f"first page: {size / 1e6:.2f} MB\n")
    if size > FIRST_BYTES:
        wrong.append(f"the first page has {size} bytes, more than {FIRST_BYTES}")
    if AXE.is_file():
        wrong += faults()
    else:
        sys.stdout.write("no axe-core: make setup-page fetches it\n")
    sys.stdout.write("\n".join(wrong or ["nothing wrong"]) + "\n")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
