"""Write the studio's list of messages for its page, ``src/packwork/studio/static/wire.js``."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from packwork import studio
from packwork.studio.messages import schema


def page_types(schema: Mapping[str, Any]) -> str:
    """The page's list of messages by their schema, ``static/wire.js``: types for its checker."""
    named: dict[str, str] = {}
    for side, side_schema in schema.items():
        names = [one.rpartition("/")[2] for one in side_schema["discriminator"]["mapping"].values()]
        defined = side_schema["$defs"]
        named |= {name: _written(one) for name, one in defined.items()}
        named[side.capitalize()] = " | ".join(names)
    lines = [f" * @typedef {{{written}}} {name}" for name, written in sorted(named.items())]
    head = "// @ts-check\n/**\n * What page and studio say to each other.\n *"
    foot = " * Written by ``tools/write_wire.py`` from the schema; nothing here is run.\n *"
    return "\n".join((head, foot, *lines, " */", "export {};", ""))


def _written(schema: dict[str, Any]) -> str:
    if "$ref" in schema:
        return str(schema["$ref"]).rpartition("/")[2]
    if "const" in schema or "enum" in schema:
        values = [json.dumps(one) for one in schema.get("enum", [schema.get("const")])]
        return values[0] if len(values) == 1 else f"({' | '.join(values)})"
    for key in ("anyOf", "oneOf"):
        if key in schema:
            return "(" + " | ".join(_written(one) for one in schema[key]) + ")"
    if "prefixItems" in schema:
        return "[" + ", ".join(_written(one) for one in schema["prefixItems"]) + "]"
    if schema.get("type") == "array":
        return f"{_written(schema.get('items', {}))}[]"
    if "properties" in schema:
        needed = schema.get("required", [])
        parts = [
            f"{name}{'' if name in needed or 'const' in one else '?'}: {_written(one)}"
            for name, one in schema["properties"].items()
        ]
        return "{" + ", ".join(parts) + "}"
    plain = {"integer": "number", "number": "number", "string": "string", "boolean": "boolean"}
    return plain.get(str(schema.get("type")), "any" if schema.get("type") != "null" else "null")


if __name__ == "__main__":
    path = Path(studio.__file__).parent / "static" / "wire.js"
    path.write_text(page_types(schema()), encoding="utf-8")
