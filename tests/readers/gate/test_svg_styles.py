"""Style sheets as browsers read them, and what is said of what is left out."""

from __future__ import annotations

import logging
import xml.etree.ElementTree as ET

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from packwork.readers.gate.css.colours import is_paint, plain_colour
from packwork.readers.gate.css.declarations import parse_declarations
from packwork.readers.gate.css.selectors import Node, UnknownSelectorError, parse_selector
from packwork.readers.gate.css.sheets import StyleSheet
from packwork.readers.gate.door import parse_untrusted
from packwork.readers.gate.lengths import Context, resolved
from packwork.readers.svg.item import item_of_svg

PAGE = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{}</svg>'
TREE = ET.fromstring(  # noqa: S314 - ours
    '<svg><title/><g id="a" class="x y" data-n="v-1"><path/><rect fill="Red"/><path/></g>'
    '<g><a><path class="x"/></a></g></svg>'
)


def nodes() -> list[Node]:
    found, waiting = [], [Node(TREE, None, None)]
    while waiting:
        found.append(waiting.pop(0))
        waiting = [*found[-1].children, *waiting]
    return found


@pytest.mark.parametrize(
    ("selector", "count"),
    [
        ("*", 9),
        ("path", 3),
        (".x.y", 1),
        ("#a > path", 2),
        ("svg path", 3),
        ("svg > path", 0),
        ("path + rect", 1),
        ("path ~ path", 1),
        ("title+g", 1),
        ("path:first-child", 2),
        ("path:last-of-type", 2),
        ("path:nth-child(odd)", 3),
        ("g:nth-of-type(2)", 1),
        (":nth-last-child(-n+1)", 5),
        ("path:only-child", 1),
        (":root", 1),
        ("[data-n]", 1),
        ("[data-n|=v]", 1),
        ("[fill=red]", 0),
        ("[fill='red' i]", 1),
        ("[class~=y]", 1),
        ("[class^='x']", 2),
        (":not(path, rect)", 5),
        ("g:is(#a, .z) :not(rect)", 2),
        ("path:hover", 0),
    ],
)
def test_selectors_mean_what_they_mean_in_browsers(selector, count):
    parsed = parse_selector(selector)
    assert sum(parsed.matches(node) for node in nodes()) == count


@pytest.mark.parametrize("selector", ["", "> a", "a >", "a:has(b)", "a::before", "a[", "1a", "a)("])
def test_unknown_selectors_are_left_out(selector):
    with pytest.raises(UnknownSelectorError):
        parse_selector(selector)


@settings(deadline=None, max_examples=100)
@given(st.text("ab.#:[]()>+~*,='\"- \\{};@!/", max_size=40))
def test_any_sheet_is_read(text):
    StyleSheet(100.0, 100.0).add(text)


def test_media_queries_are_asked_of_the_page():
    sheet = StyleSheet(100.0, 50.0)
    sheet.add(
        "@media print{a{fill:red}}@media screen and (min-width:90px){b{fill:red}}"
        "@media (max-width:90px){c{fill:red}}@media not print{d{fill:red}}"
        "@media (prefers-color-scheme:dark){e{fill:red}}@supports (x:y){f{fill:red}}"
    )
    assert [rule.selector.steps[0].tag for rule in sheet.rules] == ["b", "d", "f"]


@pytest.mark.parametrize(
    ("declared", "values"),
    [
        ("marker:url(#m)", {"marker-start": "url(#m)", "marker-end": "url(#m)"}),
        ("font:italic 700 20px/2 'A B', serif", {"font-size": "20px", "font-weight": "700"}),
        ("d:path('M0 0h1')", {"d": "M0 0h1"}),
        ("mask:url(#m) alpha", {"mask": "url(#m)"}),
        ("filter:opacity(50%)", {"opacity": "50%"}),
    ],
)
def test_shorthands_are_parted(declared, values):
    found = {name: value for name, (value, _) in parse_declarations(declared).values.items()}
    assert values.items() <= found.items()


@pytest.mark.parametrize(
    ("colour", "plain"),
    [
        ("hwb(0 0% 0%)", "#ff0000"),
        ("oklch(0.628 0.2577 29.23)", "#ff0000"),
        ("oklab(100% 0 0)", "#ffffff"),
        ("lab(0 0 0)", "#000000"),
        ("lch(100 0 0)", "#ffffff"),
        ("color(srgb 0 1 0 / .5)", "#00ff0080"),
        ("color(display-p3 0 0 0)", "#000000"),
        ("color-mix(in srgb, red 25%, transparent)", "#ff000040"),
        ("color-mix(in oklab, red 20%, blue 20%)", "#8c53a266"),
        ("color-mix(in hsl longer hue, red, blue)", "#00ff00"),
        ("color-mix(in xyz, white, color-mix(in srgb, red, red))", "#ffbcbc"),
        ("color(a98-rgb 1 0 0)", "#ff0000"),
        ("lab(50% 40 59)", "#bf5702"),
        ("color(xyz-d50 .5 .5 .5)", "#beb9cf"),
        ("oklch(60% .1 50 / none)", "#b06d4700"),
        ("rgb(none 0 0)", "#000000"),
        ("rgb(0 0 0 / 0)", "#00000000"),
        ("lab(1e200 1e300 0)", "lab(1e200 1e300 0)"),
        ("color-mix(in nothing, red, blue)", "color-mix(in nothing, red, blue)"),
        ("color-mix(in hsl no hue, red, blue)", "color-mix(in hsl no hue, red, blue)"),
        ("color-mix(red, blue)", "#8c53a2"),
        ("color-mix(in srgb, red 0%, blue 0%)", "#ff000000"),
        ("rgb(calc(100 + 50) calc(60 / -3 * -1) 30)", "#96141e"),
        ("hsl(calc(180deg / 2) 50% 50%)", "#80bf40"),
        ("oklch(1.2 0.3 30)", "#ff9777"),
        ("lab(-10 50 50)", "#420000"),
        ("CURRENTCOLOR", "currentColor"),
        ("#cd853f icc-color(press, 0.1, 0.2)", "#cd853f"),
        ("light-dark(oklab(100% 0 0), red)", "#ffffff"),
        ("hsl(120deg 100% 50%)", "#00ff00"),
        ("oklch(oops)", "oklch(oops)"),
        ("url(#a)", "url(#a)"),
    ],
)
def test_new_colours_are_written_as_old_ones(colour, plain):
    assert plain_colour(colour) == plain


@pytest.mark.parametrize(
    "colour",
    [
        "notacolour",
        "#12345",
        "rgb(1 2)",
        "rgb(calc(1 / 0) 2 3)",
        "rgb(calc(1, 2) 0 0)",
        "rgb(calc(9**9) 2 3)",
        "rgb(calc(1% + 2) 2 3)",
        "color-mix(in srgb, red 120%, blue)",
        "color-mix(in srgb longer hue, red, blue)",
    ],
)
@pytest.mark.parametrize("as_style", [True, False])
def test_what_is_no_colour_leaves_the_one_outside(colour: str, as_style: bool) -> None:
    # As browsers show it: the declaration before, else the group's.
    said = f'style="fill:{colour}"' if as_style else f'fill="{colour}"'
    rect = f'<g fill="#336699"><rect width="9" height="9" {said}/></g>'
    markup = item_of_svg(f"<svg>{rect}</svg>".encode(), "item", "item.svg").art.markup
    assert markup.count("fill=") == 1
    assert not is_paint(colour)
    both = rect.replace("fill:", "fill:#ff0000;fill:")
    if as_style:
        kept = item_of_svg(f"<svg>{both}</svg>".encode(), "item", "item.svg").art.markup
        assert 'fill="#ff0000"' in kept


LEFT_OUT = {
    '<use href="other.svg#a"/>': "another file",
    "<rect><set attributeName='x' to='9'/></rect>": "animation",
    "<rect><animateMotion path='M0 0h9'/></rect>": "animation",
    "<style>rect{animation:turn 2s}@keyframes turn{to{rotate:1turn}}</style>": "animation",
    "<style>rect:has(a){fill:red}</style>": ":has",
    "<style>@font-face{font-family:a;src:url(b)}</style>": "fonts",
    "<style>@import 'other.css';</style>": "other style sheets",
    '<rect style="filter:blur(2px)"/>': "CSS filters",
    '<rect style="clip-path:shape(from 0 0, hline to 9px)"/>': "clip-path",
    '<rect style="offset-path:path(&quot;M0 0&quot;)"/>': "motion along a path",
}


@pytest.mark.parametrize("body", LEFT_OUT)
def test_what_is_left_out_is_said_in_one_line(body, caplog):
    with caplog.at_level(logging.WARNING, "packwork"):
        parse_untrusted(PAGE.format(body + '<g style="zoom:2"/>').encode())
    (record,) = caplog.records
    assert LEFT_OUT[body] in record.getMessage()
    assert "zoom" in record.getMessage()


def test_plain_drawings_say_nothing(caplog):
    body = '<title/><style>path{fill:red}</style><path d="M0 0h9v9z"/><metadata/><desc/>'
    with caplog.at_level(logging.WARNING, "packwork"):
        parse_untrusted(PAGE.format(body).encode())
    assert not caplog.records


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("calc(50% - 1em)", "40"),
        ("-webkit-calc(1em + 2px)", "12"),
        ("calc(2 * (1em + -2px) / 4)", "4"),
        ("max(1px, min(2em, 50%), clamp(1px, 9rem, 30px))", "30"),
        ("calc(1px -2px)", "-1"),
        ("calc(1px" + 40 * " + 1px" + ")", "41"),
    ],
)
def test_calculations_of_lengths_have_their_value(text: str, number: str) -> None:
    assert resolved("x", text, Context(10.0, 8.0, (100.0, 40.0), (1.0, 1.0))) == number


@pytest.mark.parametrize(
    "text",
    [
        "calc(1px,)", "min(1px, )", "calc(1px, 2px)", "clamp(1px, 2px, 3px, 4px)",
        "calc(1px / 0)", "calc(1px ** 2)", "calc(2 zz)", "calc()", "calc(1px", "calc(x)",
        "clamp(1px, 2px)", "calc(__import__(1))", "calc(1 if 2 else 3)", "calc('1')",
        f"calc({'(' * 500}1{')' * 500})", f"calc({'-' * 1_000}1)",
    ],
)  # fmt: skip
def test_calculations_without_a_sense_stay_as_they_are(text: str) -> None:
    assert resolved("x", text, Context(10.0, 8.0, (100.0, 40.0), (1.0, 1.0))) == text
