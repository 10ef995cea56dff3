"""Bytes to text or to rows of JSON: Unicode, and the encodings of Windows programs."""

from __future__ import annotations

import codecs
import json
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from packwork.errors import ReadError
from packwork.readers.reading import read_bytes
from packwork.readers.tables.format import TableFormat

MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    # The mark of UTF-32 begins with that of UTF-16.
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
"""Byte order marks, and what they announce."""

ALPHABETS = {
    # Of French, German, Spanish, Portuguese, Swedish, Danish, Italian, Dutch, Icelandic.
    "cp1252": (
        "éèêëàâçùûîïôœæü", "äöüß", "áéíóúñü", "ãõáéíóúâêôçàü", "åäöé", "æøåé", "àèéìòùí",
        "éëïöüèêç", "þðáéíóúýæö",
    ),
    # Of Polish, Czech and Slovak, Hungarian, Romanian, Croatian.
    "cp1250": ("ąćęłńóśźż", "áčďéěíňóřšťúůýžäôľĺŕ", "áéíóöőúüű", "ăâîșțşţ", "čćđšž"),
    "cp1251": ("абвгдежзийклмнопрстуфхцчшщъыьэюяёіїєґўјљњћђџ",),
    "cp1253": ("αβγδεζηθικλμνξοπρσςτυφχψωάέήίόύώϊϋ",),
    "cp1254": ("çğıöşüâîİ",),
}  # fmt: skip
"""Letters beyond ASCII of each encoding's languages, the likeliest encoding first."""

DOCUMENTS = {
    b"<?xml": "XML or a drawing", b"<svg": "a drawing", b"<!doctype": "a web page",
    b"<html": "a web page", b"%pdf-": "a PDF",
    b"pk\3\4": "a .docx, .xlsx or other archive", b"\xd0\xcf\x11\xe0": "a .doc or .xls",
    b"{\\rtf": "RTF",
}  # fmt: skip
"""First bytes of files whose bytes are not what they say, in lower case."""

_PICTURE = re.compile(rb"\x89png|\xff\xd8\xff|gif8[79]a.{0,6}[\0-\x08\x0e-\x1f]", re.DOTALL)
"""First bytes of pictures, in lower case; after a GIF's name, with which a text may begin, its size
follows."""

_COMMENTS = re.compile(rb"\A\s*(?:<!--.*?-->\s*)*", re.DOTALL)
"""What may stand before a document, and before any text of Markdown."""

OF_OTHER_SCRIPTS = frozenset({"cp1251", "cp1253"})
"""Encodings whose words hold no Latin letters."""

NAMES = {
    "cp1252": "Windows-1252 (Western Europe)",
    "cp1250": "Windows-1250 (Central Europe)",
    "cp1251": "Windows-1251 (Cyrillic)",
    "cp1253": "Windows-1253 (Greek)",
    "cp1254": "Windows-1254 (Turkish)",
}
"""What the encodings are called."""

PLAIN_SHARE = 0.85
"""Share of what is beyond ASCII that must make sense in one language of an encoding for it to be
taken. Larger asks more often, smaller takes more for what it is not. Tried."""

CLEARLY = 0.1
"""How far a likelier encoding's share may lie below the best and still be taken. Chosen."""

SAMPLE = 1_000_000
"""Bytes that are looked at. More take longer: a microsecond each. Chosen."""


@dataclass(frozen=True)
class Decoded:
    """Text, and what has to be told of how it was read: empty if nothing."""

    text: str
    notice: str = ""


def decoded(data: bytes, file: str, encoding: str | None = None) -> Decoded:
    """Text of a file's bytes, without its byte order mark; without an encoding, that is found.

    Examples
    --------
    >>> decoded("Käse".encode("utf-16"), "t.csv").text
    'Käse'
    >>> decoded("Käse; Crème brûlée".encode("cp1252"), "t.csv").notice
    'is not UTF-8 and was read as Windows-1252 (Western Europe); --encoding says otherwise'
    """
    check_no_document(data, file)
    if encoding is not None:
        return Decoded(_strictly(data, file, encoding).removeprefix("\ufeff"))
    for mark, announced in MARKS:
        if data.startswith(mark):
            return Decoded(_strictly(data, file, announced))
    wide = _wide(data)
    if wide is not None:
        return Decoded(_strictly(data, file, wide))
    try:
        return Decoded(data.decode("utf-8"))
    except UnicodeDecodeError:
        chosen = _windows_encoding(data, file)
    told = f"is not UTF-8 and was read as {NAMES[chosen]}; --encoding says otherwise"
    return Decoded(_strictly(data, file, chosen), told)


def check_no_document(data: bytes, file: str) -> None:
    """Refuse what is written in another way than as text.

    Examples
    --------
    >>> check_no_document(b"<svg viewBox='0 0 9 9'/>", "bear.svg")
    Traceback (most recent call last):
    packwork.errors.ReadError: bear.svg: is a drawing, not text; save its text as .txt or .csv
    """
    head = _COMMENTS.sub(b"", data[:4_000].removeprefix(codecs.BOM_UTF8)).lower()
    kind = next((kind for mark, kind in DOCUMENTS.items() if head.startswith(mark)), None)
    kind = "a picture" if _PICTURE.match(head) else kind
    if kind is not None:
        raise ReadError(file, f"is {kind}, not text; save its text as .txt or .csv")


def _strictly(data: bytes, file: str, encoding: str) -> str:
    try:
        return data.decode(encoding)
    except (UnicodeDecodeError, ValueError):
        raise ReadError(
            file, f"is not text in {encoding.removesuffix('-sig').upper()}; give another --encoding"
        ) from None


def _wide(data: bytes) -> str | None:
    """UTF-16 without a mark: of Latin text every other byte is nothing."""
    head = data[:10_000]
    if len(head) < 4 or b"\0" not in head:
        return None
    even, odd = (head[k::2].count(0) / len(head[k::2]) for k in (0, 1))
    if odd > 0.5 and even < 0.1:
        return "utf-16-le"
    return "utf-16-be" if even > 0.5 and odd < 0.1 else None


def _windows_encoding(data: bytes, file: str) -> str:
    shares = {name: _plainness(data[:SAMPLE], name, sets) for name, sets in ALPHABETS.items()}
    best = max(shares.values())
    if best >= PLAIN_SHARE:
        return next(name for name, share in shares.items() if share >= best - CLEARLY)
    likeliest = next(iter(ALPHABETS))
    # Names of several countries side by side.
    mixed = "".join(ALPHABETS[likeliest])
    if _plainness(data[:SAMPLE], likeliest, [mixed]) >= PLAIN_SHARE:
        return likeliest
    raise ReadError(
        file,
        "is not text in UTF-8; save it with that encoding, or say which it has: --encoding cp1252 "
        "(Western Europe), cp1250, cp1251, shift_jis, gb18030 ...",
    )


def _plainness(data: bytes, encoding: str, alphabets: Sequence[str]) -> float:
    """Share of what is beyond ASCII that makes sense in the language it fits best."""
    try:
        text = data.decode(encoding)
    except UnicodeDecodeError:
        return 0.0
    if "\0" in text:
        return 0.0
    counts: Counter[str] = Counter()
    for word in _WORD.findall(text):
        high = [letter for letter in word if letter > "\x7f"]
        if high:
            counts.update(_ODD * len(high) if _is_odd(word, encoding) else high)
    counts[_ODD] += len(_SPLIT.findall(text))
    total = counts.total()
    if total == 0:
        return 1.0
    held = (
        sum(n for letter, n in counts.items() if letter in alphabet or letter.lower() in alphabet)
        for alphabet in alphabets
    )
    return max(held) / total


def _is_odd(word: str, encoding: str) -> bool:
    """Whether no language that an encoding is for has such a word."""
    if not (word.islower() or word.isupper() or (word[0].isupper() and word[1:].islower())):
        return True
    if encoding in OF_OTHER_SCRIPTS:
        return any(letter.isascii() for letter in word)
    return _FAR_FROM_ASCII.search(word) is not None


_ODD = "?"
_WORD = re.compile(r"[^\W\d_]+")
_SPLIT = re.compile(r"(?<=[^\W\d_])[^\x00-\x7f\w’‘·](?=[^\W\d_])")
_FAR_FROM_ASCII = re.compile(r"[^\x00-\x7f]{3}")


MAX_JSON_BYTES = 30_000_000
"""Size of a JSON file: its values take up to 25 times as much in memory, three quarters of a
gigabyte. Derived."""


def read_json(file: str, asked: TableFormat) -> Any:
    """Value of a JSON file."""
    text = decoded(read_bytes(file, MAX_JSON_BYTES), file, asked.encoding).text
    try:
        return json.loads(text)
    except (ValueError, RecursionError) as error:
        raise ReadError(file, f"is not JSON ({str(error)[:120]})") from None
