"""Colour spaces of PDFs by the names that printers give them."""

from __future__ import annotations

from typing import Any

import pikepdf


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
