"""What the gate lets in, and what it never does."""

from __future__ import annotations

import base64
import contextlib
import time
from io import BytesIO

import pytest
from PIL import Image

from packwork.errors import ReadError
from packwork.readers import reading
from packwork.readers.gate.door import document, parse_untrusted
from packwork.readers.reading import UnfitError
from packwork.readers.svg.item import item_of_svg
from packwork.readers.svg.resvg import render

HANG_S = 5.0
"""Far more than any of these takes, far less than what they would take unbounded."""

SPACES = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'


def svg(body: str) -> bytes:
    return f'<svg {SPACES} viewBox="0 0 100 100">{body}</svg>'.encode()


def admitted(body: str) -> str:
    return document(parse_untrusted(svg(body)))


def png_reference(side: int = 4, mark: str = "data:image/png;base64,") -> str:
    file = BytesIO()
    Image.new("RGB", (side, side)).save(file, "PNG")
    return mark + base64.b64encode(file.getvalue()).decode()


@pytest.mark.parametrize(
    "body",
    [
        "<script>alert(1)</script>",
        '<g onload="alert(1)"/>',
        "<foreignObject><p>hello</p></foreignObject>",
        '<image href="http://evil.test/a.png"/>',
        '<image xlink:href="file:///etc/passwd"/>',
        '<image href="data:image/svg+xml;base64,PHN2Zy8+"/>',
        '<image href="data:image/png;base64,PHN2Zy8+"/>',
        '<use href="other.svg#evil"/>',
        '<use href="#evil evil"/>',
        '<path fill="url(http://evil.test/#g)" d="M0 0h1v1z"/>',
        "<path fill=\"url('//evil.test/#g')\" d='M0 0h1v1z'/>",
        '<path fill="u\\72l(evil.svg#g)" d="M0 0h1v1z"/>',
        '<path style="fill:u\\72l(evil.svg#g)" d="M0 0h1v1z"/>',
        '<path style="fill:url(/**/evil.svg#g)" d="M0 0h1v1z"/>',
        '<path style="background:url(evil.png);-x-evil:1" d="M0 0h1v1z"/>',
        '<path fill="image-set(evil)" d="M0 0h1v1z"/>',
        "<style>@import 'http://evil.test/a.css';</style>",
        "<style>@font-face{font-family:evil;src:url(http://evil.test/f)}</style>",
        "<style>path{fill:url(http://evil.test/#g)}</style><path d='M0 0h1v1z'/>",
        "<style>path{mask:u\\rl(evil.svg)}</style><path d='M0 0h1v1z'/>",
        "<style>@media all{path{fill:url(evil)}}</style><path d='M0 0h1v1z'/>",
        '<a href="javascript:evil()"><path d="M0 0h1v1z"/></a>',
        '<path d="M0 0h1v1z"><set attributeName="fill" to="evil"/></path>',
        '<path d="M0 0h1v1z"><animate attributeName="href" values="evil"/></path>',
        '<filter id="f"><feImage href="file:///evil.png"/></filter><g filter="url(#f)"/>',
        '<path filter="url(evil.svg#f)" style="filter:url(evil.svg)" d="M0 0h1v1z"/>',
        '<path fill="var(--x, url(evil))" d="M0 0h1v1z"/>',
        "<style>:root{--x:url(http://evil.test)}</style><path style='mask:var(--x)'/>",
        '<text><tspan><textPath href="evil.svg#p">a</textPath></tspan></text>',
        '<x:thing xmlns:x="evil"><path d="M0 0h1v1z"/></x:thing>',
        '<g xml:base="http://evil.test/"/>',
        "<metadata>evil</metadata><title>evil</title><!-- evil --><?evil pi?>",
    ],
)
def test_nothing_reaches_out(body):
    clean = admitted(body)
    for trace in ("evil", "script", "alert", "onload", "passwd", "hello", "svg+xml", "PHN2"):
        assert trace not in clean.replace('xmlns="http://www.w3.org/2000/svg"', "")


def test_a_local_file_is_never_read(tmp_path):
    secret = tmp_path / "secret.png"
    Image.new("RGB", (8, 8), "red").save(secret)
    for reference in (secret.as_uri(), str(secret)):
        root = parse_untrusted(svg(f'<image href="{reference}" width="90" height="90"/>'))
        assert "secret" not in document(root)
        pixels = Image.open(BytesIO(render(root))).convert("RGBA")
        assert pixels.getextrema()[3] == (0, 0)


def test_embedded_pictures_stay():
    assert "data:image/png" in admitted(f'<image href="{png_reference()}" width="9" height="9"/>')


def test_huge_embedded_pictures_go():
    assert "data:" not in admitted(f'<image href="{png_reference(4_100)}"/>')


def test_addresses_as_entities_pass():
    head = '<!DOCTYPE svg PUBLIC "x" "y" [<!ENTITY ns_svg "http://www.w3.org/2000/svg">]>'
    assert parse_untrusted(f'{head}<svg xmlns="&ns_svg;"><g/></svg>'.encode())[0].tag == "g"


@pytest.mark.parametrize(
    ("declared", "said"),
    [
        ('<!ENTITY a SYSTEM "file:///etc/passwd">', "declares"),
        ('<!ENTITY % a "x">', "declares"),
        ('<!ENTITY a "x"><!ENTITY b "&a;&a;">', "declares"),
        ('<!ENTITY a "&#60;g/>">', "declares"),
        (f'<!ENTITY a "{"x" * 400}">', "declares"),
        ('<!NOTATION n SYSTEM "n"><!ENTITY a SYSTEM "b" NDATA n>', "declares"),
        ('<!ENTITY a "bbbbbbbbbbbbbbbbbbbbbbbbb">', "too often"),
    ],
)
def test_entities_that_could_do_more_do_not_pass(declared, said):
    repeats = "&a;" * 100_000 if said == "too often" else ""
    with pytest.raises(UnfitError, match=said):
        parse_untrusted(f"<!DOCTYPE svg [{declared}]>".encode() + svg(f"<desc>{repeats}</desc>"))


def test_plain_doctype_passes():
    head = (
        b'<?xml version="1.0"?><!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" '
        b'"http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">'
    )
    assert parse_untrusted(head + svg("<g/>")).tag == "svg"


def test_prefixed_svg_passes():
    text = '<s:svg xmlns:s="http://www.w3.org/2000/svg"><s:path d="M0 0h1v1z"/></s:svg>'
    assert [child.tag for child in parse_untrusted(text.encode())] == ["path"]


def nested_uses(levels: int, each: int) -> str:
    groups = "".join(
        f'<g id="u{k + 1}">' + f'<use xlink:href="#u{k}"/>' * each + "</g>" for k in range(levels)
    )
    return f'<defs><path id="u0" d="M0 0h1v1z"/>{groups}</defs><use xlink:href="#u{levels}"/>'


def nested_masks(levels: int) -> str:
    parts = [
        f'<mask id="m{k}">{f"""<rect mask="url(#m{k + 1})"/>""" * 10}</mask>' for k in range(levels)
    ]
    return "".join(parts) + f'<mask id="m{levels}"/><rect mask="url(#m0)"/>'


@pytest.mark.parametrize(
    ("body", "problem"),
    [
        (nested_uses(9, 10), "grows to 4,691,358,014 elements"),
        (nested_uses(40, 10), "far too many"),
        (nested_masks(30), "far too many"),
        ('<g opacity=".5">' * 20 + "</g>" * 20, "see-through groups 20 deep"),
        ('<g id="a"><use xlink:href="#a"/></g>', "in a circle"),
        ('<g id="a"><use href="#b"/></g><g id="b"><use href="#a"/></g>', "in a circle"),
        ('<mask id="m"><rect mask="url(#m)"/></mask><g mask="url(#m)"/>', "in a circle"),
        ("<g>" * 500 + "</g>" * 500, "more than 100 deep"),
        ("<rect/>" * 40_000, "grows to 40,000"),
        ("<g/>" * 300_000, "more than 200,000 elements"),
        ("<style>" + "g>g{fill:red}" * 2000 + "</style>" + "<g/>" * 2000, "style rules"),
        ("<style>a~g{fill:red}</style>" + "<g/>" * 20_000, "style rules"),
        ("<style>" + "a," * 1_500_000 + "b{fill:red}</style>", "style rules"),
        ("<text>" + "a" * 30_000 + "</text>", "letters of text"),
    ],
)
def test_bombs_are_refused_at_once(body, problem, monkeypatch):
    monkeypatch.setattr(reading, "SHAPES_NS", reading.SHAPES_NS / 4)
    data, begin = svg(body), time.process_time()
    with pytest.raises(UnfitError, match=problem):
        parse_untrusted(data)
    assert time.process_time() - begin < HANG_S


DASHED = '<path d="M0 0H1000" stroke="red" stroke-dasharray="{}"/>'


@pytest.mark.parametrize(
    "body",
    [
        DASHED.format("0.0012") * 200,
        DASHED.format("1 1") * 200,
        DASHED.format("1e-300"),
        DASHED.format("0.0001em .01"),
        DASHED.format("0.0001% 1"),
        "<style>path{stroke-dasharray:.001mm}</style>" + DASHED.format("9"),
        '<g stroke-dasharray="1e-3"><use href="#a"/></g><path id="a" d="M0 0H1000"/>',
        '<svg stroke-dasharray="0.001"><circle r="9"/><line x2="9"/><rect width="1e6"/></svg>',
        f'<marker id="m">{DASHED.format(1)}</marker><path marker-mid="url(#m)" d="{"h1" * 400}"/>',
        '<line x2="100%" stroke-dasharray="4"/>',
        '<g stroke-dasharray="1e-3"><text stroke="red">a</text></g>',
    ],
)
def test_dashes_beyond_count_are_drawn_solid(body):
    data, begin = svg(body), time.process_time()
    root = parse_untrusted(data)
    assert {e.get("stroke-dasharray") for e in root.iter("path")} <= {None, "none"}
    assert {e.get("stroke-dasharray") for e in root.iter("text")} <= {None, "none"}
    render(root)
    assert time.process_time() - begin < HANG_S


def test_dashes_that_people_draw_stay():
    body = DASHED.format("4, 2") * 20 + '<rect width="90" height="9" stroke-dasharray="1mm"/>'
    clean = admitted(body)
    assert clean.count('stroke-dasharray="4, 2"') == 20
    assert 'stroke-dasharray="1mm"' in clean


def test_billion_laughs():
    entities = "".join(f'<!ENTITY l{k + 1} "{f"&l{k};" * 10}">' for k in range(9))
    head = f'<!DOCTYPE svg [<!ENTITY l0 "ha">{entities}]>'
    with pytest.raises(UnfitError, match="entities"):
        parse_untrusted(head.encode() + svg("<text>&l9;</text>"))


def test_declared_attributes_are_no_harm_and_no_default():
    head = b'<!DOCTYPE svg [<!ATTLIST path fill CDATA "red" onload CDATA "evil()">]>'
    (path,) = parse_untrusted(head + svg('<path d="M0 0h9v9z"/>')).iter("path")
    assert path.attrib == {"d": "M0 0h9v9z"}


@pytest.mark.parametrize(
    "declared",
    [
        f'<!ATTLIST path d CDATA "{"h1" * 1000}">',
        "".join(f'<!ATTLIST path a{k} CDATA "9">' for k in range(200)),
        "<!ELEMENT svg ANY><!ATTLIST svg a %b;>",
        '<!ENTITY % b "c"><!ATTLIST svg a CDATA %b;>',
    ],
)
def test_attributes_declared_to_excess_are_refused(declared):
    with pytest.raises(UnfitError):
        parse_untrusted(b"<!DOCTYPE svg [" + declared.encode() + b"]>" + svg("<g/>"))


@pytest.mark.parametrize(
    ("data", "problem"),
    [
        (b"", "is empty"),
        (b" \n", "is empty"),
        (b"hello", "not well-formed"),
        (b"<svg", "not well-formed"),
        (b"<html/>", "its root is <html>"),
        (b'<svg xmlns="http://example.com"/>', "its root is <svg>"),
        (b"\x1f\x8b\x08", "compressed SVG .* cut short"),
        (b"\x89PNG\r\n", "not well-formed"),
        (b"<?xml version='1.0' encoding='rot13'?><svg/>", "encoding"),
        (b"<svg xmlns:a='" + b"a" * 600 + b"'/>", "namespace"),
        (b" " * 20_000_001, "is empty"),
        (b"<svg/>" + b" " * 20_000_000, "20 MB"),
    ],
)
def test_what_is_no_svg(data, problem):
    with pytest.raises(UnfitError, match=problem):
        parse_untrusted(data)


def test_an_address_of_a_namespace_may_be_long():
    address = "http://example.com/" + "a" * 481
    assert parse_untrusted(f'<svg xmlns:a="{address}"/>'.encode()).tag.endswith("svg")


def test_styles_become_attributes():
    clean = admitted(
        '<style type="text/css"><![CDATA[.a{fill:red;mix-blend-mode:multiply}]]></style>'
        '<g class="a" style="opacity:.5"/>'
    )
    assert '<g fill="red" opacity=".5" style="mix-blend-mode:multiply"/>' in clean


def test_hidden_layers_go_unless_something_refers_to_them():
    clean = admitted(
        '<g display="none"><image href="x.png"/><path d="M0 0h1v1z"/></g><g style="display:none">'
        '<path id="used" d="M0 0h2v2z"/></g><use href="#used"/><clipPath id="c" display="none">'
        '<rect width="1"/></clipPath><g clip-path="url(#c)"/>'
    )
    assert "h1v1z" not in clean
    assert "h2v2z" in clean
    assert "clipPath" in clean


def test_variables_are_filled_in():
    clean = admitted(
        "<style>:root{--ink:#05f;--same:var(--ink)} .a{stroke:var(--same)}</style>"
        '<g class="a" fill="var(--none, var(--ink))" color="var(--none)"/>'
    )
    assert '<g fill="#05f" stroke="#05f"/>' in clean


FILTER = '<filter id="f"{}>{}</filter><g filter="url(#f)"/>'


def test_shading_filters_stay():
    clean = admitted(FILTER.format("", '<feFlood flood-color="red"/><feBlend in="SourceGraphic"/>'))
    assert 'filter="url(#f)"' in clean
    assert '<feFlood flood-color="red"/>' in clean


@pytest.mark.parametrize(
    "filtered",
    [
        FILTER.format("", "<feTurbulence numOctaves='99'/>"),
        FILTER.format("", "<feOffset/><feMorphology radius='99'/>"),
        FILTER.format(' width="900%"', "<feOffset/>"),
        FILTER.format(' filterUnits="userSpaceOnUse" width="301"', "<feOffset/>"),
        FILTER.format("", "<feOffset/>") + '<g filter="url(#f)"/>' * 900,
    ],
)
def test_filters_that_are_slow_or_large_go(filtered, caplog):
    clean = admitted(filtered)
    assert "filter" not in clean
    assert "filter" in caplog.text


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("<foreignObject><p>hello</p></foreignObject>", "HTML"),
        ("<path d='M0 0h1v1z'><animate attributeName='d'/></path>", "animation"),
        ("<switch><foreignObject requiredExtensions='x'/><g/></switch>", ""),
        ("<title>a</title><script/><metadata/>", ""),
    ],
)
def test_what_others_would_show_is_said(body, said, caplog):
    admitted(body)
    assert (said in caplog.text) if said else caplog.text == ""


def test_unused_definitions_go():
    clean = admitted(
        '<defs><linearGradient id="a"/><linearGradient id="b"/></defs>'
        '<path id="p" fill="url(#b)" d="M0 0h1v1z"/>'
    )
    assert 'id="b"' in clean
    assert 'id="a"' not in clean
    assert 'id="p"' not in clean


def test_switch_shows_its_first_plain_child():
    clean = admitted(
        '<switch><foreignObject requiredExtensions="x"/><g systemLanguage="de"/>'
        '<path d="M0 0h1v1z"/><g fill="red"/></switch>'
    )
    assert '<g><path d="M0 0h1v1z"/></g>' in clean


@pytest.mark.parametrize(
    "body",
    [
        f'<path d="{"h" + "1" * 300_000}"/>',
        f'<path d="M0 0a{"1" * 3_000}x"/>',
        f'<path d="M0 0{" " * 300_000}x"/>',
        f'<path d="{"a" * 300_000}"/>',
        f'<path transform="{"1" * 300_000}"/>',
        f'<path transform="rotate({"1" * 1_900})"/>',
        f'<path transform="{"1" * 1_900}"/>' * 20,
        f'<path fill="{"rgb(" * 300_000}"/>',
        f'<path fill="{"a" * 300_000}("/>',
        f'<path fill="rgb({"0," * 900}"/>' * 20,
        f'<path class="{"a " * 300_000}"/><style>{".a{fill:red}" * 1000}</style>',
        f'<path style="{"fill:red;" * 100_000}"/>',
        f"<style>{';' * 1_000_000}</style>",
        f"<style>{'{' * 1_000_000}</style>",
        f"<style>{'{}' * 300_000}</style>",
        f"<style>{'/*' * 300_000}</style>",
        f"<style>{'a ' * 300_000}{{}}</style><a/>",
        f"<style>a{{fill:{'! ' * 300_000}important}}</style><a/>",
    ],
)
def test_long_runs_take_no_time(body):
    data, begin = svg(body), time.process_time()
    with contextlib.suppress(ReadError):
        item_of_svg(data, "a", "a.svg")
    assert time.process_time() - begin < HANG_S
