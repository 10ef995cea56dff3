"""An element tree to one that holds plain, harmless SVG and nothing else.

What is not on the lists of ``vocabulary`` is dropped, so scripts, event handlers, foreign
content, animations and metadata need no rule of their own. Tags lose their namespace,
styles become attributes, and no value refers to anything outside the document.
"""

from __future__ import annotations

import re
import string
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import dataclass, field

from packwork.readers.gate import css
from packwork.readers.gate.embedded import is_harmless_picture
from packwork.readers.gate.variables import filled_in, variables_in
from packwork.readers.gate.vocabulary import (
    ATTRIBUTES,
    CSS_ONLY,
    ELEMENTS,
    FILTER_PARTS,
    FUNCTIONS,
    RENAMED,
    TEXTS,
)
from packwork.readers.unfit import UnfitError, notice

HREF = "xlink:href"
"""The one spelling of references, understood by old and new programs alike."""

MAX_VALUE = 2_000
"""Letters of an attribute that is no list of coordinates: patterns are matched against
them again and again. Longer ones are dropped. Chosen."""

MAX_TEXT = 20_000
"""Letters of visible text in one drawing: laying out text is slow. Chosen."""

LOST = {
    "animate": "its animation was left out: it is drawn as it stands before that begins",
    "animateTransform": "its animation was left out: it is drawn as it stands before that begins",
    "filter": "a filter was left out: it fetches or makes pictures, or is slow by design",
    "foreignObject": "text or pictures in HTML were left out; turn them into shapes",
}
"""What is said of elements that are seen elsewhere but not here."""

FILTER = "filter"

_LISTS = frozenset({"d", "points"})
_SVG_SPACES = frozenset({"", "http://www.w3.org/2000/svg"})
_HREF_NAMES = frozenset({"href", "{http://www.w3.org/1999/xlink}href"})
_XML_SPACE = "{http://www.w3.org/XML/1998/namespace}space"
_WORD = string.ascii_letters + string.digits + "-_"
_FORBIDDEN = re.compile(r"[\\{}<>@;]|/\*")
_LOCAL_URL = re.compile(r"url\(\s*(['\"]?)#([^'\"()\s]+)\1\s*\)", re.IGNORECASE)


def sanitised(raw: ET.Element) -> ET.Element:
    """Harmless twin of a parsed document; the original is left as it is.

    Raises
    ------
    UnfitError
        If the root is not ``<svg>``, or styles or text pass their limits.

    Examples
    --------
    >>> raw = ET.fromstring('<svg><script/><g onload="x()" style="fill:red"/></svg>')
    >>> ET.tostring(sanitised(raw)).decode()
    '<svg><g fill="red" /></svg>'
    """
    space, name = _split(raw.tag)
    if name != "svg" or space not in _SVG_SPACES:
        raise UnfitError(f"is XML but not SVG: its root is <{name[:40]}>, not <svg>")
    sheets = ("".join(e.itertext()) for e in raw.iter() if _split(e.tag)[1] == "style")
    found = _Found(variables_in([*sheets, raw.get("style", "")]))
    root = _admitted(raw, found)
    for said in sorted({LOST[name] for name in found.lost}):
        notice(said)
    rules = css.Cascade.of(css.parse_rules("\n".join(found.sheets)))
    _apply_styles(root, [], rules, found.variables)
    if sum(len(e.text or "") + len(e.tail or "") for e in root.iter()) > MAX_TEXT:
        raise UnfitError(f"has more than {MAX_TEXT:,} letters of text; turn it into paths")
    return root


def safe_value(value: str) -> str | None:
    r"""The value in its plain form, or None if it could reach outside the document.

    Examples
    --------
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


def _calls_known(text: str) -> bool:
    """Whether every function the text calls is on the list, ``url`` not being there."""
    callers = [before.rstrip() for before in text.split("(")[:-1]]
    return all(c[len(c.rstrip(_WORD)) :].lower() in FUNCTIONS for c in callers)


@dataclass
class _Found:
    """What was met on the way: variables, style sheets, kinds of elements left out."""

    variables: dict[str, str]
    sheets: list[str] = field(default_factory=list)
    lost: set[str] = field(default_factory=set)


def _admitted(raw: ET.Element, found: _Found) -> ET.Element:
    """Copy with only known elements and attributes."""
    name = _split(raw.tag)[1]
    element = ET.Element(RENAMED.get(name, name), _plain_attributes(raw, found.variables))
    if name in TEXTS:
        element.text, element.tail = raw.text, raw.tail
    for child in _children(raw, found):
        child_name = _split(child.tag)[1]
        if child_name == "style":
            found.sheets.append("".join(child.itertext()))
        else:
            element.append(_admitted(child, found))
    return element


def _children(raw: ET.Element, found: _Found) -> list[ET.Element]:
    """Children that are known elements; of a ``switch`` only the one that shows."""
    known = [child for child in raw if _is_known(child)]
    if _split(raw.tag)[1] == "switch":
        plain = [c for c in known if not c.get("requiredExtensions") and _is_english(c)]
        return plain[:1]
    if len(known) < len(raw):
        found.lost |= {_split(child.tag)[1] for child in raw if not _is_known(child)} & LOST.keys()
    return known


def _is_known(child: ET.Element) -> bool:
    space, name = _split(child.tag)
    if name == FILTER:
        # With a step missing it would show something else, or nothing.
        parts = {_split(part.tag)[1] for part in child.iter() if part is not child}
        return space in _SVG_SPACES and parts <= FILTER_PARTS
    return space in _SVG_SPACES and (name in ELEMENTS or name in RENAMED)


def _is_english(child: ET.Element) -> bool:
    languages = child.get("systemLanguage")
    return languages is None or "en" in languages.lower()


def _plain_attributes(raw: ET.Element, variables: Mapping[str, str]) -> dict[str, str]:
    """Attributes that may stay; ``class`` and ``style`` until styles are applied."""
    plain: dict[str, str] = {}
    for key, value in raw.attrib.items():
        if key in _HREF_NAMES:
            is_image = _split(raw.tag)[1] == "image"
            target = _safe_reference(value, is_image=is_image)
            if target is not None:
                plain[HREF] = target
            elif is_image:
                notice("a linked picture was left out, for no other file is read; embed it")
        elif key == _XML_SPACE and value in {"preserve", "default"}:
            plain["xml:space"] = value
        elif key == "style" or (key == "class" and len(value) <= MAX_VALUE):
            plain[key] = value
        elif key in ATTRIBUTES and (len(value) <= MAX_VALUE or key in _LISTS):
            safe = safe_value(filled_in(value, variables))
            if safe:
                plain[key] = safe
    return plain


def _safe_reference(value: str, *, is_image: bool) -> str | None:
    target = value.strip()
    if is_image:
        return target if is_harmless_picture(target) else None
    return target if re.fullmatch(r"#[^\s'\"()<>\\]+", target) else None


def _apply_styles(
    element: ET.Element,
    ancestors: list[ET.Element],
    cascade: css.Cascade,
    variables: Mapping[str, str],
) -> None:
    """Set every declared property as an attribute and drop ``class`` and ``style``."""
    kept: list[str] = []
    declared = cascade.declared(element, ancestors)
    for child in element:
        _apply_styles(child, [*ancestors, element], cascade, variables)
    for name in ("class", "style"):
        element.attrib.pop(name, None)
    for name, value in declared.items():
        safe = safe_value(filled_in(value, variables))
        if not safe or len(safe) > MAX_VALUE:
            continue
        if name in CSS_ONLY:
            kept.append(f"{name}:{safe}")
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
