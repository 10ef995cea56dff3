"""Builds the documentation as a site: ``python tools/build_site.py``, into build/site.

Lays the pages out as they lie in the clone, so that their links lead on unchanged, adds a first
page for strangers (``site/index.md``) and the reference, written from the code
(``reference.py``), and lets Sphinx build it; a warning is an error.
Needs ``packwork[docs]``.
"""

from __future__ import annotations

import re
import shutil
import sys
from pathlib import Path

from reference import REFERENCE

ROOT = Path(__file__).resolve().parents[1]
BUILD = ROOT / "build"
STAGE, SITE = BUILD / "site-source", BUILD / "site"
FIRST = ROOT / "tools" / "site"
CARD_PX = 480
"""Longer side of a picture on the first page: two pixels for each of a screen's."""

PAGES = {
    "Begin": ("README", "guide/tutorial", "guide/users", "how-it-works", "gallery"),
    "Uses": tuple(
        f"guide/{name}"
        for name in (
            "words", "photos", "mosaics", "tiles", "arranging", "meaning", "charts", "films",
            "forces", "rules", "cutting", "print", "nesting", "python", "inkscape", "live",
            "studio", "batch",
        )
    ),
    "Reference": tuple(
        f"reference/{name}" for name in (*REFERENCE, "glossary", "units", "files", "options")
    ),
    "About": ("architecture", "security"),
}  # fmt: skip
"""What is in the sidebar by name; examples follow by themselves."""

LISTED = {"benchmarks": "Benchmarks", "decisions": "Decisions"}
"""Folders of ``docs`` whose pages are in the sidebar by themselves, and under which caption."""

CONF = """
project = "Packwork"
copyright = "Packwork contributors"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
myst_enable_extensions = ["dollarmath", "html_image"]
myst_heading_anchors = 4
html_math_renderer = "mathml"
html_theme = "furo"
html_static_path = ["_site"]
html_css_files = ["site.css"]
smartquotes = False
html_title = "Packwork"
html_show_sphinx = False
html_theme_options = {"light_css_variables": {"color-brand-primary": "#2663a5",
                                              "color-brand-content": "#2663a5"}}
autodoc_typehints = "none"
napoleon_use_rtype = False
napoleon_use_ivar = True
suppress_warnings = ["myst.header"]


def setup(app):
    # Browsers draw MathML themselves: no script, nothing fetched from elsewhere.
    from docutils import nodes
    from docutils.utils.math.latex2mathml import tex2mathml

    def inline(writer, node):
        writer.body.append(str(tex2mathml(node.astext())))
        raise nodes.SkipNode

    def block(writer, node):
        writer.body.append(str(tex2mathml(node.astext(), as_block=True)))
        raise nodes.SkipNode

    app.add_html_math_renderer("mathml", (inline, None), (block, None))
"""

TOCTREE = "```{{toctree}}\n:hidden:\n:caption: {caption}\n\n{pages}\n```\n"


def main() -> int:
    """Lay out, write, build; the exit code of Sphinx."""
    # Who only asks for the list of pages needs no Sphinx.
    from sphinx.cmd.build import main as sphinx

    shutil.rmtree(STAGE, ignore_errors=True)
    for path in _documents():
        copy = STAGE / path.relative_to(ROOT)
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, copy)
    for name, write in REFERENCE.items():
        page = STAGE / "docs" / "reference" / f"{name}.md"
        page.parent.mkdir(exist_ok=True)
        page.write_text(write(), encoding="utf-8")
    first = _with_small_pictures((FIRST / "index.md").read_text(encoding="utf-8"))
    (STAGE / "index.md").write_text(first + "\n" + "\n".join(_toctrees()), encoding="utf-8")
    (STAGE / "_site").mkdir()
    shutil.copy(FIRST / "site.css", STAGE / "_site")
    (STAGE / "conf.py").write_text(CONF, encoding="utf-8")
    shutil.rmtree(SITE, ignore_errors=True)
    code = sphinx(["-W", "--keep-going", "-q", "-b", "html", str(STAGE), str(SITE)])
    for path in SITE.rglob("*.html"):
        path.write_text(_usable_by_keyboard(path.read_text(encoding="utf-8")), encoding="utf-8")
    return code


def _usable_by_keyboard(page: str) -> str:
    """A page as the theme writes it; captions say how deep they are, code can be scrolled."""
    deep = page.replace('role="heading">', 'role="heading" aria-level="2">')
    return deep.replace("<pre>", '<pre tabindex="0">')


def _documents() -> list[Path]:
    """Pages, and the files beside them that they show or lead to."""
    found = [ROOT / name for name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md", "LICENSE")]
    for folder in ("docs", "examples"):
        found += [path for path in sorted((ROOT / folder).rglob("*")) if path.is_file()]
    found.append(ROOT / "src" / "packwork" / "bundled" / "LICENCE.txt")
    return [path for path in found if "__pycache__" not in path.parts]


def _with_small_pictures(page: str) -> str:
    """The first page, its PNGs as small WebP files, so that all of it is soon there."""
    from PIL import Image

    folder = STAGE / "_small"
    folder.mkdir()
    for name in set(re.findall(r'src="(\S+\.png)"', page)):
        small = f"{name.replace('/', '-').removesuffix('.png')}.webp"
        with Image.open(ROOT / name) as picture:
            picture.thumbnail((CARD_PX, CARD_PX))
            picture.save(folder / small, quality=80)
        page = page.replace(f'"{name}"', f'"_small/{small}"')
    return page


def _toctrees() -> list[str]:
    pages = {caption: [f"docs/{name}" for name in names] for caption, names in PAGES.items()}
    for folder, caption in LISTED.items():
        pages[caption] = _all(f"docs/{folder}", "*.md")
    pages["Examples"] = _all("examples", "*/README.md")
    pages["Begin"] = ["Set up, first commands <README>", *pages["Begin"]]
    pages["About"] += ["CONTRIBUTING", "CHANGELOG"]
    return [
        TOCTREE.format(caption=caption, pages="\n".join(names)) for caption, names in pages.items()
    ]


def _all(folder: str, pattern: str) -> list[str]:
    found = sorted((STAGE / folder).glob(pattern))
    return [str(path.relative_to(STAGE).with_suffix("")) for path in found]


if __name__ == "__main__":
    sys.exit(main())
