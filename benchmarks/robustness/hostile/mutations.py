"""One file made of another: by bytes, by words of its text, by values of its tree."""

from __future__ import annotations

import json
import re
import struct
import tomllib
import zlib
from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
import tomli_w

Rng: TypeAlias = np.random.Generator
Mutate: TypeAlias = Callable[[bytes, Rng], bytes]

MOST_BYTES = 2_000_000
"""What mutations may make a file grow to."""

ODD_NUMBERS = (
    "0", "-0", "-1", "1e308", "-1e308", "1e400", "1e-320", "NaN", "inf", "-Infinity", "0.5", "2",
    "99999999999999999999", "2147483648", "-32769", "1e5", "50%", "1e9mm", "0x10", ".", "1,5",
)  # fmt: skip

ODD_WORDS = (
    "", " ", "\x00", "\ufeff", "\u202e", "\u200d", "é", "ﷺ",
    "\U0001f469\u200d\U0001f469\u200d\U0001f467", "𝔸", "\r", "\n\n", '"', "'", "<", "&amp;",
    "&#0;", "&x;", "]]>", "none", "url(#a)", "url(#k)", "inherit", "currentColor", "var(--a)",
    "var(--a,var(--a))", "calc(1px/0)", "100%", "matrix(0 0 0 0 0 0)", "scale(1e200)",
    "rotate(1e9)", "M0 0", "M0,0A1e9 1e-9 0 0 1 5 5z", "M0 0h1e300v1z", "z", "text:", "around:",
    "builtin:", "../x", "/dev/zero", "/", "~", "*", "**", "[", "{}", "%s", "A" * 3_000,
)  # fmt: skip

ODD_VALUES: tuple[Any, ...] = (
    None, True, False, 0, -1, 1, 2.5, 1e308, -1e308, 5e-324, 10**30, "", " ", "0", "star", "1e999",
    "50%", "-5%", "1mm", "builtin:icons", "text:", "\0", "é" * 50, [], {}, [[]], [None], [1, 2],
    [0, 0, 0, 0], [1e308, 1e308], {"a": 1}, {"x": "1%", "y": 2}, [["a"]], ["star", "star"],
)  # fmt: skip
"""In place of a value of a tree, whatever its type was."""

_NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:[eE]-?\d+)?")
_QUOTED = re.compile(r"\"[^\"\n]*\"|'[^'\n]*'")
_TAG = re.compile(r"<(/?)([A-Za-z][\w:]*)")


def by_bytes(data: bytes, rng: Rng) -> bytes:
    """Some bytes set, cut out, doubled, put in or moved, or the end cut off."""
    changed = bytearray(data)
    for _ in range(int(rng.geometric(0.6))):
        if not changed:
            break
        _BYTE_CHANGES[int(rng.integers(len(_BYTE_CHANGES)))](changed, rng)
    return bytes(changed[:MOST_BYTES])


def _set(data: bytearray, rng: Rng) -> None:
    data[int(rng.integers(len(data)))] = int(rng.choice([0, 1, 0x7F, 0x80, 0xFF, *rng.bytes(3)]))


def _flip(data: bytearray, rng: Rng) -> None:
    data[int(rng.integers(len(data)))] ^= 1 << int(rng.integers(8))


def _number(data: bytearray, rng: Rng) -> None:
    form = str(rng.choice([">H", "<H", ">I", "<I"]))
    size = struct.calcsize(form)
    place = int(rng.integers(len(data)))
    value = int(rng.choice([0, 1, 0x7FFF, 0x8000, 0xFFFF])) if size == 2 else int(
        rng.choice([0, 1, 0xFFFF, 0x10000, 0x7FFFFFFF, 0xFFFFFFFF]))  # fmt: skip
    data[place : place + size] = struct.pack(form, value)


def _span(data: bytearray, rng: Rng) -> slice:
    start = int(rng.integers(len(data)))
    return slice(start, start + int(2 ** rng.uniform(0, 10)))


def _cut(data: bytearray, rng: Rng) -> None:
    del data[_span(data, rng)]


def _double(data: bytearray, rng: Rng) -> None:
    span = _span(data, rng)
    data[span.start : span.start] = data[span] * int(rng.choice([1, 2, 50]))


def _insert(data: bytearray, rng: Rng) -> None:
    place = int(rng.integers(len(data)))
    data[place:place] = rng.bytes(int(2 ** rng.uniform(0, 6)))


def _shorten(data: bytearray, rng: Rng) -> None:
    del data[int(rng.integers(len(data))) :]


_BYTE_CHANGES = (_set, _set, _flip, _flip, _number, _cut, _double, _insert, _shorten)


def by_words(data: bytes, rng: Rng) -> bytes:
    """Numbers, quoted values, tags and lines of a text changed for others."""
    text = data.decode("utf-8", errors="replace")
    for _ in range(int(rng.geometric(0.6))):
        text = _WORD_CHANGES[int(rng.integers(len(_WORD_CHANGES)))](text, rng)
    return text.encode("utf-8", errors="replace")[:MOST_BYTES]


def _in_place_of(pattern: re.Pattern[str], text: str, rng: Rng, make: Callable[[str], str]) -> str:
    found = list(pattern.finditer(text))
    if not found:
        return text
    match = found[int(rng.integers(len(found)))]
    return text[: match.start()] + make(match[0]) + text[match.end() :]


def _odd_number(text: str, rng: Rng) -> str:
    return _in_place_of(_NUMBER, text, rng, lambda _: str(rng.choice(ODD_NUMBERS)))


def _odd_value(text: str, rng: Rng) -> str:
    odd = ODD_WORDS[int(rng.integers(len(ODD_WORDS)))]
    return _in_place_of(_QUOTED, text, rng, lambda old: old[0] + odd + old[0])


def _other_value(text: str, rng: Rng) -> str:
    values = _QUOTED.findall(text) or [""]
    return _in_place_of(_QUOTED, text, rng, lambda _: values[int(rng.integers(len(values)))])


def _other_tag(text: str, rng: Rng) -> str:
    names = [name for _, name in _TAG.findall(text)] or ["g"]
    names += ["use", "mask", "clipPath", "pattern", "filter", "text", "image", "symbol", "style"]
    return _in_place_of(
        _TAG, text, rng, lambda old: ("</" if old[1] == "/" else "<") + str(rng.choice(names))
    )


def _odd_word(text: str, rng: Rng) -> str:
    place = int(rng.integers(len(text) + 1))
    return text[:place] + ODD_WORDS[int(rng.integers(len(ODD_WORDS)))] + text[place:]


def _lines(text: str, rng: Rng) -> str:
    lines = re.split(r"(?<=[\n>])", text)
    k, m = (int(v) for v in rng.integers(len(lines), size=2))
    way = int(rng.integers(3))
    if way == 0:
        del lines[k]
    elif way == 1:
        lines[k] *= int(rng.choice([2, 20, 300]))
    else:
        lines[k], lines[m] = lines[m], lines[k]
    return "".join(lines)


_WORD_CHANGES = (_odd_number, _odd_number, _odd_value, _other_value, _other_tag, _odd_word, _lines)


def by_json(data: bytes, rng: Rng) -> bytes:
    """Values of a JSON tree changed for others."""
    tree = json.loads(data)
    for _ in range(int(rng.geometric(0.7))):
        _change(tree, rng)
    return json.dumps(tree).encode()


def by_toml(data: bytes, rng: Rng) -> bytes:
    """Values of a TOML tree changed for others; without those that TOML cannot say."""
    tree = tomllib.loads(data.decode())
    for _ in range(int(rng.geometric(0.7))):
        _change(tree, rng)
    return tomli_w.dumps(sayable(tree)).encode()


def sayable(tree: Any) -> Any:
    if isinstance(tree, dict):
        return {key: sayable(value) for key, value in tree.items() if value is not None}
    if isinstance(tree, list):
        return [sayable(value) for value in tree if value is not None]
    return tree


def _change(tree: Any, rng: Rng) -> None:
    """One value, key or length of a tree, wherever it lies."""
    places = list(_places(tree))
    if not places:
        return
    within, key = places[int(rng.integers(len(places)))]
    way = int(rng.integers(6))
    if way == 0:
        del within[key]
    elif way == 1 and isinstance(within, list):
        within.insert(key, within[key])
    elif way == 1 and isinstance(within, dict):
        within[str(rng.choice(["", "x", "items", "count", "role"]))] = within[key]
    elif way == 2:
        other, place = places[int(rng.integers(len(places)))]
        # A copy, as a tree that holds itself could not be written down.
        within[key] = json.loads(json.dumps(other[place], default=str))
    else:
        odd = ODD_VALUES[int(rng.integers(len(ODD_VALUES)))]
        within[key] = json.loads(json.dumps(odd))


def _places(tree: Any, most: int = 4_000) -> list[tuple[Any, Any]]:
    found: list[tuple[Any, Any]] = []
    waiting = [tree]
    while waiting and len(found) < most:
        within = waiting.pop()
        keys = within if isinstance(within, dict) else range(len(within))
        for key in list(keys):
            found.append((within, key))
            if isinstance(within[key], dict | list):
                waiting.append(within[key])
    return found


def by_chunks(data: bytes, rng: Rng) -> bytes:
    """A PNG changed by bytes, then its check sums put right, so that it is let in."""
    changed = bytearray(by_bytes(data, rng))
    place = 8
    while place + 12 <= len(changed):
        size = int.from_bytes(changed[place : place + 4], "big")
        end = place + 8 + size
        if end + 4 > len(changed):
            break
        changed[end : end + 4] = struct.pack(">I", zlib.crc32(changed[place + 4 : end]))
        place = end + 4
    return bytes(changed)


def by_font_tables(data: bytes, rng: Rng) -> bytes:
    """A font changed inside one of its tables, each as likely as any other."""
    count = int.from_bytes(data[4:6], "big")
    record = 12 + 16 * int(rng.integers(count))
    start, size = struct.unpack(">II", data[record + 8 : record + 16])
    changed = bytearray(data)
    for _ in range(int(rng.geometric(0.5))):
        inside = bytearray(changed[start : start + size])
        if inside:
            _BYTE_CHANGES[int(rng.integers(5))](inside, rng)
        changed[start : start + size] = inside[:size].ljust(size, b"\0")
    return bytes(changed)
