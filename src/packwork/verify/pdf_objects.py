"""Objects of PDFs: streams within bounds, colour spaces by the names that printers give them."""

from __future__ import annotations

import contextlib
import zlib
from typing import Any

import pikepdf

from packwork.readers.reading import UnfitError

TOO_MUCH = "paints more than can be looked at"


def space_name(space: Any, resources: Any) -> str:
    """Plain name of a colour space; empty of patterns."""
    if isinstance(space, pikepdf.Name):
        named = resources.get("/ColorSpace", {}).get(space)
        if named is not None:
            return space_name(named, resources)
        plain = {"/DeviceRGB": "RGB", "/DeviceCMYK": "CMYK", "/DeviceGray": "grey"}
        return plain.get(str(space), "")
    kind = str(space[0])
    if kind == "/ICCBased":
        return {1: "grey", 3: "RGB", 4: "CMYK"}[int(space[1].N)]
    if kind == "/Indexed":
        return space_name(space[1], resources)
    if kind in {"/Separation", "/DeviceN"}:
        names = [space[1]] if kind == "/Separation" else space[1]
        return "ink " + ", ".join(str(name).removeprefix("/") for name in names)
    return {"/CalRGB": "RGB", "/CalGray": "grey"}.get(kind, "")


def check_size(stream: Any, most: int) -> None:
    """Refuse a stream that would be larger than ``most`` bytes, before it is unpacked."""
    packed, kinds = stream.read_raw_bytes(), listed(stream.get("/Filter", ""))
    with contextlib.suppress(zlib.error):
        for _ in filter("/FlateDecode".__eq__, map(str, kinds)):
            packed = zlib.decompressobj().decompress(packed, most + 1)
            if len(packed) > most:
                raise UnfitError(TOO_MUCH)


def listed(found: Any) -> list[Any]:
    """Objects that may stand in a list or alone."""
    return list(found) if isinstance(found, pikepdf.Array) else [found]
