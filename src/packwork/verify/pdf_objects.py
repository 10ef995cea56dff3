"""Objects of PDFs: streams within bounds, colour spaces by the names that printers give them."""

from __future__ import annotations

import zlib
from typing import Any

import pikepdf

from packwork.readers.reading import UnfitError

TOO_MUCH = "paints more than can be looked at"


_DEEPEST = 8
"""Colour spaces by way of which one is named; what refers to itself has no end. Chosen."""


def space_name(space: Any, resources: Any, depth: int = 0) -> str:
    """Plain name of a colour space; empty of patterns and of what refers to itself."""
    if depth > _DEEPEST:
        return ""
    if isinstance(space, pikepdf.Name):
        named = resources.get("/ColorSpace", {}).get(space)
        if named is not None:
            return space_name(named, resources, depth + 1)
        plain = {"/DeviceRGB": "RGB", "/DeviceCMYK": "CMYK", "/DeviceGray": "grey"}
        return plain.get(str(space), "")
    kind = str(space[0])
    if kind == "/ICCBased":
        return {1: "grey", 3: "RGB", 4: "CMYK"}[int(space[1].N)]
    if kind == "/Indexed":
        return space_name(space[1], resources, depth + 1)
    if kind in {"/Separation", "/DeviceN"}:
        names = [space[1]] if kind == "/Separation" else space[1]
        return "ink " + ", ".join(str(name).removeprefix("/") for name in names)
    return {"/CalRGB": "RGB", "/CalGray": "grey"}.get(kind, "")


_FLATE = frozenset({"/FlateDecode", "/Fl"})
_ASCII = frozenset({"/ASCIIHexDecode", "/AHx", "/ASCII85Decode", "/A85"})
_LZW = frozenset({"/LZWDecode", "/LZW"})

LOOSEST = 64
"""Times as large as packed for which LZW is taken. Larger refuses more of what is sound, smaller
unpacks more at most: it may be 2,600 times. Chosen."""


def check_size(stream: Any, most: int) -> None:
    """Refuse a stream that would be larger than ``most`` bytes, before it is unpacked."""
    packed, owner = stream.read_raw_bytes(), pikepdf.new()
    for kind in map(str, listed(stream.get("/Filter", ""))):
        if kind in _FLATE:
            try:
                packed = zlib.decompressobj().decompress(packed, most + 1)
            except zlib.error:
                return
        elif kind in _LZW and LOOSEST * len(packed) > most:
            raise UnfitError(TOO_MUCH)
        elif kind in _ASCII | _LZW:
            one = pikepdf.Stream(owner, b"")
            one.write(packed, filter=pikepdf.Name(kind))
            packed = one.read_bytes()
        if len(packed) > most:
            raise UnfitError(TOO_MUCH)


def listed(found: Any) -> list[Any]:
    """Objects that may stand in a list or alone."""
    return list(found) if isinstance(found, pikepdf.Array) else [found]
