"""Sanitising of an element tree: allow-lists, styles as attributes, embedded pictures checked.

What is not on the lists of ``vocabulary`` is dropped, so scripts, event handlers, foreign
content, animations and metadata need no rule of their own. Tags lose their namespace,
styles become attributes, and no value refers to anything outside the document.

Programs disagree about pictures that move and about pictures that a note in their file turns;
such a picture is written anew: its first frame, upright.
"""

from __future__ import annotations

import base64
import math
import re
import string
import warnings
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import dataclass, field
from io import BytesIO

from PIL import Image, ImageOps

from packwork.readers.budget.rendering import FILTER
from packwork.readers.gate.css.colours import is_paint, plain_colour
from packwork.readers.gate.css.declarations import filled_in, parse_declarations, with_variables
from packwork.readers.gate.css.selectors import Node
from packwork.readers.gate.css.sheets import Cascade, StyleSheet
from packwork.readers.pictures.decode import MAX_PIXELS, eight_bit, opened
from packwork.readers.reading import UnfitError, notice, spend
from packwork.readers.svg_syntax.coordinates import parse_length, parse_numbers
from packwork.readers.svg_syntax.references import embedded_bytes, embedded_size
from packwork.readers.svg_syntax.vocabulary import (
    ATTRIBUTES,
    COLOURS,
    CSS_ONLY,
    ELEMENTS,
    FILTER_PARTS,
    FUNCTIONS,
    GRADIENTS,
    HREF,
    MOVES,
    RENAMED,
    TEXTS,
)

MAX_EMBEDDED_PIXELS = MAX_PIXELS // 4
"""Pixels of one embedded picture: four bytes each once decoded."""

_PIXEL_NS = 150.0
"""For a pixel that is decoded and written anew. Measured."""

_QUALITY = 95
_ORIENTATION = 0x0112
_ALL_READ = frozenset({"PNG", "JPEG"})
"""Kinds that every program shows, if they neither move nor are turned."""


def is_harmless_picture(reference: str) -> bool:
    """Whether a reference is an embedded pixel picture of sane size.

    The kind is read from the picture itself: an SVG that calls itself PNG is none.

    >>> is_harmless_picture("file:///etc/passwd")
    False
    >>> is_harmless_picture("data:image/svg+xml;base64,PHN2Zy8+")
    False
    """
    size = embedded_size(reference)
    return size is not None and 0 < size[0] * size[1] <= MAX_EMBEDDED_PIXELS


def one_picture(reference: str) -> str | None:
    """The embedded picture as one that all programs show alike; None if it is not usable."""
    if not is_harmless_picture(reference):
        return None
    data = embedded_bytes(reference)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            with opened(data or b"") as image:
                if image.format in _ALL_READ and not _is_special(image):
                    return reference
                spend(_PIXEL_NS * image.width * image.height, "holds too large pictures")
                return _upright(image)
    except UnfitError:
        return None


def _is_special(image: Image.Image) -> bool:
    """Whether it moves or is turned by a note in its file."""
    is_still = getattr(image, "n_frames", 1) == 1
    return not is_still or image.getexif().get(_ORIENTATION, 1) != 1


def _upright(image: Image.Image) -> str:
    """First frame of a picture, upright, as a reference."""
    is_photo = image.format == "JPEG"
    plain = ImageOps.exif_transpose(eight_bit(image, "RGB" if is_photo else "RGBA"))
    file = BytesIO()
    if is_photo:
        plain.save(file, "JPEG", quality=_QUALITY)
    else:
        plain.save(file, "PNG")
    kind = "jpeg" if is_photo else "png"
    return f"data:image/{kind};base64,{base64.b64encode(file.getvalue()).decode('ascii')}"


MAX_VALUE = 2_000
"""Letters of an attribute that is no list of coordinates: patterns are matched against
them again and again. Longer ones are dropped. Chosen."""

MAX_LETTERS = 20_000
"""Of visible text in one drawing, as laying out text is slow, and of one ``style`` attribute that
is read. Chosen."""

LOST = {
    **dict.fromkeys(
        ("animate", "animateTransform", "animateMotion", "animateColor", "set"),
        "its animation: it is drawn as it stands before that begins",
    ),
    "filter": "a filter: it fetches or makes pictures, or is slow by design",
    "foreignObject": "text or pictures in HTML; turn them into shapes",
    "video": "a film or a sound",
    "audio": "a film or a sound",
    "iframe": "another document inside it",
    "canvas": "what a script would draw",
}
"""What is said of elements that are seen elsewhere but not here."""

MAX_SAID = 8
"""Things left out that are named in one notice. Chosen."""

_ELEMENT_NS = 3e4
"""For cleaning an element. Measured."""

_AUTO, _RADII = "auto", frozenset({"rx", "ry"})
_LISTS = frozenset({"d", "points"})
_SVG_SPACES = frozenset({"", "http://www.w3.org/2000/svg"})
_HREF_NAMES = frozenset({"href", "{http://www.w3.org/1999/xlink}href"})
_XML_SPACE = "{http://www.w3.org/XML/1998/namespace}space"
_WORD = string.ascii_letters + string.digits + "-_"
_FORBIDDEN = re.compile(r"[\\{}<>@;]|/\*")
_LOCAL_URL = re.compile(r"url\(\s*(['\"]?)#([^'\"()\s]+)\1\s*\)", re.IGNORECASE)


def sanitised(raw: ET.Element) -> ET.Element:
    """Harmless twin of a parsed document; the original is left as it is.

    >>> raw = ET.fromstring('<svg><script/><g onload="x()" style="fill:red"/></svg>')
    >>> ET.tostring(sanitised(raw)).decode()
    '<svg><g fill="red" /></svg>'
    """
    space, name = _split(raw.tag)
    if name != "svg" or space not in _SVG_SPACES:
        raise UnfitError(f"is XML but not SVG: its root is <{name[:40]}>, not <svg>")
    sheet = _sheet(raw)
    found = _Context(Cascade(sheet.rules), lost=set(sheet.lost))
    root = _admitted(Node(raw, None, None), found, {})
    if found.lost:
        named = sorted(found.lost)
        more = [f"{len(named) - MAX_SAID} more"] if len(named) > MAX_SAID else []
        notice(f"left out {', '.join([*named[:MAX_SAID], *more])}")
    if sum(len(e.text or "") + len(e.tail or "") for e in root.iter()) > MAX_LETTERS:
        raise UnfitError(f"has more than {MAX_LETTERS:,} letters of text; turn it into paths")
    return root


def safe_value(value: str) -> str | None:
    r"""The value in its plain form, or None if it could reach outside the document.

    >>> safe_value("url( '#g' ) red"), safe_value("url(http://x/y#g)"), safe_value("u\\72l(x)")
    ('url(#g) red', None, None)
    """
    text = value.strip()
    if _FORBIDDEN.search(text):
        return None
    local = _LOCAL_URL.match(text)
    if local is None:
        return text if _calls_known(text) else None
    rest = text[local.end() :].strip()
    return f"url(#{local.group(2)}) {rest}".strip() if _calls_known(rest) else None


def _safe(name: str, value: str) -> str | None:
    """Plain form of a property's value; None if it is none, or could reach outside."""
    if name not in COLOURS:
        return safe_value(value)
    safe = safe_value(plain_colour(value))
    return safe if safe and is_paint(safe) else None


def _calls_known(text: str) -> bool:
    """Whether every function the text calls is on the list, ``url`` not being there."""
    callers = [before.rstrip() for before in text.split("(")[:-1]]
    return all(c[len(c.rstrip(_WORD)) :].lower() in FUNCTIONS for c in callers)


@dataclass
class _Context:
    """The style rules, and what was met on the way and left out."""

    cascade: Cascade
    lost: set[str] = field(default_factory=set)


def _sheet(raw: ET.Element) -> StyleSheet:
    """Rules of all style elements, wherever they stand."""
    attributes = {key: value for key, value in raw.attrib.items() if key in {"width", "height"}}
    view = parse_numbers(raw.get("viewBox"))
    sides = view[2:] if len(view) == 4 else [None, None]
    width, height = (
        parse_length(attributes.get(name), math.nan)
        if "%" not in attributes.get(name, "")
        else None
        for name in ("width", "height")
    )
    sheet = StyleSheet(width or sides[0], height or sides[1])
    for element in raw.iter():
        if _split(element.tag) in {(space, "style") for space in _SVG_SPACES}:
            # A style for paper or the like is none for the screen.
            media = element.get("media", "all")
            text = "".join(element.itertext())
            sheet.add(
                text if media.strip() in {"", "all", "screen"} else f"@media {media}{{{text}}}"
            )
    return sheet


def _admitted(node: Node, found: _Context, outer: Mapping[str, str]) -> ET.Element:
    """Copy with only known elements and attributes, its styles attributes."""
    spend(_ELEMENT_NS, "has too many elements")
    raw, name = node.element, node.tag
    inline = parse_declarations(raw.get("style", "")[:MAX_LETTERS])
    found.lost |= inline.lost
    variables, declared = with_variables(outer, found.cascade.declared(node, inline))
    element = ET.Element(RENAMED.get(name, name), _plain_attributes(node, found, variables))
    _apply(element, declared, variables, found)
    if name in TEXTS:
        element.text, element.tail = raw.text, raw.tail
    for child in _children(node, found):
        element.append(_admitted(child, found, variables))
    return element


def _children(node: Node, found: _Context) -> list[Node]:
    """Children that are known elements; of a ``switch`` only the one that shows."""
    known = [child for child in node.children if _is_known(child.element) and child.tag != "style"]
    if node.tag == "switch":
        plain = [c for c in known if "requiredExtensions" not in c.attributes and _is_english(c)]
        return plain[:1]
    if len(known) < len(node.children):
        names = {c.tag for c in node.children if not _is_known(c.element)}
        found.lost |= {LOST[name] for name in names & LOST.keys()}
    return known


def _is_known(child: ET.Element) -> bool:
    space, name = _split(child.tag)
    if name == FILTER:
        # With a step missing it would show something else, or nothing.
        parts = {_split(part.tag)[1] for part in child.iter() if part is not child}
        return space in _SVG_SPACES and parts <= FILTER_PARTS
    return space in _SVG_SPACES and (name in ELEMENTS or name in RENAMED)


def _is_english(child: Node) -> bool:
    languages = child.attributes.get("systemLanguage")
    return languages is None or "en" in languages.lower()


def _plain_attributes(node: Node, found: _Context, variables: Mapping[str, str]) -> dict[str, str]:
    """Attributes that may stay."""
    plain: dict[str, str] = {}
    for key, value in node.element.attrib.items():
        if key in _HREF_NAMES:
            target = _reference(node, value, found)
            if target is not None and (HREF not in plain or key == "href"):
                plain[HREF] = target
        elif key == _XML_SPACE and value in {"preserve", "default"}:
            plain["xml:space"] = value
        elif value == _AUTO and key in _RADII:
            # Not to state it says the same, to all programs.
            continue
        elif key in ATTRIBUTES and (len(value) <= MAX_VALUE or key in _LISTS):
            text = filled_in(value, variables)
            if safe := _safe(key, text):
                plain[key] = safe
    return plain


def _reference(node: Node, value: str, found: _Context) -> str | None:
    """Target of an element's reference, if that lies inside the file."""
    target = value.strip()
    if node.tag == "image":
        picture = one_picture(target)
        if picture is None:
            found.lost.add("a picture that is linked or cannot be read; embed it")
        return picture
    if re.fullmatch(r"#[^\s'\"()<>\\]+", target):
        return target
    if node.tag in {"use", "textPath"} | GRADIENTS:
        found.lost.add("parts of another file; draw them in this one")
    return None


def _apply(
    element: ET.Element, declared: Mapping[str, str], variables: Mapping[str, str], found: _Context
) -> None:
    """Set every declared property as an attribute."""
    kept: list[str] = []
    for name, value in declared.items():
        text = filled_in(value, variables) if "var(" in value else value
        safe = _safe(name, text)
        if not safe or (len(safe) > MAX_VALUE and name not in _LISTS):
            if text and "(" in text:
                found.lost.add(f"{name} as it is written")
        elif safe == _AUTO and name in _RADII:
            element.attrib.pop(name, None)
        elif name in CSS_ONLY:
            kept.append(f"{name}:{safe}")
        elif name in MOVES:
            element.set(f"css-{name}", safe)
        else:
            element.set(name, safe)
    if kept:
        element.set("style", ";".join(kept))


def _split(tag: object) -> tuple[str, str]:
    """Namespace and local name."""
    text = str(tag)
    if text.startswith("{"):
        space, _, name = text[1:].partition("}")
        return space, name
    return "", text
