"""Files that were changed so that they are drawn otherwise than they are measured: named."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from typer.testing import CliRunner

import packwork as pw
from packwork.cli import app
from packwork.metrics.certificate import changed_since, taken_on_trust
from packwork.readers.layouts.read import read_written

ITEM, GROUP, ROOT = "<use ", '<g id="items" ', "<svg "
MARKER = '<marker id="m"><circle r="90"/></marker>'


def _with(place: str, more: str) -> Callable[[str], str]:
    """A change that adds an attribute to the first such element."""
    return lambda text: text.replace(place, f"{place}{more} ", 1)


TAMPERED: dict[str, tuple[Callable[[str], str], str]] = {
    "moved by a style": (_with(ITEM, 'style="transform:scale(3)"'), "item 1 .*transform"),
    "a stroke": (_with(ITEM, 'stroke="red" stroke-width="40"'), "item 1 .*stroke-width"),
    "a marker": (_with(ITEM, 'marker-end="url(#m)"'), "item 1 .*marker-end"),
    "a filter": (_with(ITEM, 'filter="url(#f)"'), "item 1 .*filter"),
    "a clip": (_with(GROUP, 'clip-path="url(#c)"'), "group items: clip-path"),
    "a mask": (_with(GROUP, 'style="mask:url(#c)"'), r"group items: style \(mask"),
    "a shift": (_with(ITEM, 'x="40"'), "item 1 .*: x "),
    "a stroke for all": (_with(ROOT, 'stroke="red"'), "the page: stroke"),
    "an item not displayed": (_with(ITEM, 'display="none"'), "item 1 .*hides"),
    "an item hidden": (_with(ITEM, 'style="visibility:hidden"'), "item 1 .*hides"),
    "an item seen through": (_with(ITEM, 'opacity="0"'), "item 1 .*hides"),
    "an item without paint": (_with(ITEM, 'style="fill:none"'), "item 1 .*hides"),
    "only for others": (_with(ITEM, 'systemLanguage="xx"'), "item 1 .*systemLanguage"),
    "a stretched page": (_with(ROOT, 'preserveAspectRatio="none"'), "preserveAspectRatio"),
    "an act": (_with(ITEM, 'onclick="grow()"'), "onclick"),
    "a style sheet": (
        lambda text: text.replace("<defs>", "<style>use{transform:scale(2)}</style><defs>"),
        "the file: the style sheet",
    ),
    "a linked style sheet": (
        lambda text: text.replace("<svg ", '<?xml-stylesheet href="a.css"?><svg ', 1),
        "the file: the style sheet",
    ),
    "attributes by default": (
        lambda text: text.replace(
            "<svg ", '<!DOCTYPE svg [<!ATTLIST use class CDATA "a">]><svg ', 1
        ),
        "the file: the list of attributes",
    ),
    "a motion": (
        lambda text: re.sub(
            r"(<use [^>]*)/>", r'\1><animate attributeName="x" to="99"/></use>', text, count=1
        ),
        "the <animate>",
    ),
    "a script": (lambda text: text.replace("<defs>", "<script>1</script><defs>"), "<script>"),
    "a marker of the drawing": (
        lambda text: text.replace(
            '<defs>\n<path id="shape-1"', f'{MARKER}<defs>\n<path marker-mid="url(#m)" id="shape-1"'
        ),
        "from outside",
    ),
    "a drawing moved by a style": (
        lambda text: text.replace('id="shape-1"', 'id="shape-1" style="transform:scale(2)"'),
        r"item 1 .*style \(transform",
    ),
    "another line by a style": (
        lambda text: text.replace('id="shape-1"', """id="shape-1" style="d:path('M0 0h9v9')\""""),
        r"item 1 .*style \(d\)",
    ),
    "a container's line by a style": (
        lambda text: re.sub('(id="container".*\n<path )', r"""\1style="d:path('M0 0z')" """, text),
        r"the container's line: style \(d\)",
    ),
    "a style beside a motion": (
        lambda text: text.replace(
            "<defs>",
            """<style>[id="a"]{animation:way-1 1s;d:path("M0 0h9v9")}"""
            "@media (prefers-reduced-motion:reduce){a{animation:none!important}}</style><defs>",
        ),
        "the file: the style sheet",
    ),
    "a crop": (
        lambda text: re.sub('viewBox="0 0 [^"]*"', 'viewBox="0 0 300 300"', text),
        "the page was cropped",
    ),
    "a lost item": (lambda text: re.sub("<use .*\n", "", text, count=1), "3 of 4 items are in"),
    "an item elsewhere": (
        lambda text: text.replace("</svg>", '<use xlink:href="#shape-1"/></svg>'),
        "outside the group items",
    ),
    "two links": (_with(ITEM, 'href="#shape-9"'), ""),
    "a container moved": (
        lambda text: re.sub('(id="container".*\n<path )', r'\1transform="scale(2)" ', text),
        "the container's line: transform",
    ),
}


@pytest.fixture(scope="module")
def ours(tmp_path_factory: pytest.TempPathFactory) -> str:
    """An SVG of a certified layout."""
    file = tmp_path_factory.mktemp("ours") / "ours.svg"
    pw.fill("circle", ["star", "heart"], count=4, effort="draft").save(file)
    return file.read_text(encoding="utf-8")


def _measured(folder: Path, text: str) -> tuple[int, str]:
    file = folder / "found.svg"
    file.write_text(text, encoding="utf-8")
    done = CliRunner().invoke(app, ["measure", str(file)])
    return done.exit_code, done.output


@pytest.mark.parametrize("kind", TAMPERED)
def test_what_was_changed_is_named_and_not_certified(kind: str, ours: str, tmp_path: Path) -> None:
    change, named = TAMPERED[kind]
    text = change(ours)
    assert text != ours
    code, said = _measured(tmp_path, text)
    assert "\ncertified" not in said
    assert code == (1 if named else 2)
    assert re.search(named, said)


def test_the_untouched_twin_is_certified(ours: str, tmp_path: Path) -> None:
    code, said = _measured(tmp_path, ours)
    assert (code, "\ncertified" in said) == (0, True)
    assert "not measured" not in said


@pytest.mark.parametrize(
    "change",
    [
        _with(ITEM, 'style="fill:#ff0000;stroke:none" class="a"'),
        _with(ITEM, 'inkscape:label="x" opacity=".5" x="0" y="0"'),
        _with(ROOT, 'version="1.1" style="enable-background:new 0 0 9 9"'),
        lambda text: text.replace("<defs>", "<metadata><a/></metadata><defs>"),
        lambda text: text.replace(GROUP, f"{GROUP}transform='translate(0)' "),
    ],
)
def test_what_changes_no_place_is_still_certified(
    change: Callable[[str], str], ours: str, tmp_path: Path
) -> None:
    text = change(ours).replace("<svg ", '<svg xmlns:inkscape="urn:inkscape" ', 1)
    code, said = _measured(tmp_path, text)
    assert (code, "\ncertified" in said) == (0, True)


def test_the_first_of_two_drawings_with_one_id_is_measured(ours: str, tmp_path: Path) -> None:
    # As browsers draw it.
    text = ours.replace("<defs>", '<defs><path id="shape-1" d="M-300 0h600v600z"/>')
    code, said = _measured(tmp_path, text)
    assert (code, "\ncertified" in said) == (1, False)


def test_a_file_without_a_count_says_that_it_is_believed(ours: str, tmp_path: Path) -> None:
    file = tmp_path / "old.svg"
    file.write_text(ours.replace(' data-count="4"', ""), encoding="utf-8")
    found = read_written(file)
    assert not changed_since(found.manifest)
    assert "data-count" in taken_on_trust(found.manifest)[0]


@pytest.mark.parametrize(
    ("more", "code", "is_said"),
    [('class="a" style="stroke:none"', 0, False), ('style="transform:scale(3)"', 1, True)],
)
def test_an_edit_goes_on_and_says_what_was_changed(
    more: str, code: int, is_said: bool, ours: str, tmp_path: Path
) -> None:
    file, made = tmp_path / "found.svg", tmp_path / "made.svg"
    file.write_text(_with(ITEM, more)(ours), encoding="utf-8")
    done = CliRunner().invoke(
        app, ["edit", str(file), "--recolor", "heart=#ff006e", "-o", str(made)]
    )
    assert done.exit_code == code, done.output
    assert ("\ncertified" in done.output) == (code == 0)
    assert ("changes what is drawn, and is not measured" in done.output) == is_said
    assert not changed_since(read_written(made).manifest)


def test_a_dxf_that_lost_an_item_is_not_certified(tmp_path: Path) -> None:
    file = tmp_path / "found.dxf"
    pw.fill("circle", "star", count=3, effort="draft", canvas="90mm").save(file)
    assert not changed_since(read_written(file).manifest)
    text = file.read_bytes().decode("cp1252")
    parts = re.split(r"(?=  0\r?\nLWPOLYLINE)", text)
    lost = next(
        k for k, part in enumerate(parts) if re.search(r"1000\r?\n2\r?\n1000\r?\nstar", part)
    )
    file.write_bytes("".join([*parts[:lost], *parts[lost + 1 :]]).encode("cp1252"))
    assert changed_since(read_written(file).manifest) == ("2 of 3 items are in the file",)


def test_a_geojson_that_lost_an_item_is_not_certified(tmp_path: Path) -> None:
    file = tmp_path / "found.geojson"
    layout = pw.fill("circle", "star", count=3, effort="draft")
    layout.save(file)
    assert not changed_since(read_written(file).manifest)
    whole = json.loads(file.read_text(encoding="utf-8"))
    del whole["features"][-1]
    file.write_text(json.dumps(whole), encoding="utf-8")
    found = read_written(file)
    assert changed_since(found.manifest) == ("2 of 3 items are in the file",)
    assert not pw.Layout.load(file).certified
