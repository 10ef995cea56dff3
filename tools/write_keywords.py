"""Write ``api/keywords.py``, the types of options in Python, from the fields of the options.

    python tools/write_keywords.py

A test compares the file with what this would write, so that neither is ahead of the other.
"""

from __future__ import annotations

import subprocess
import sys
import textwrap
from collections.abc import Callable as AbstractCallable
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel

from packwork.api.inputs import COLOURS, CONTAINERS, ITEMS, PICTURES, VECTORS
from packwork.api.signatures import BACKGROUND
from packwork.options import Offer, Offered, Options, Verbs, offered
from packwork.recipe import Recipe
from packwork.recipe.rules import Pin, Rule
from packwork.recipe.verbs import VERBS, default_of, run_options
from packwork.writers.film.options import FilmOptions
from packwork.writers.options import DrawingOptions

TARGET = Path(__file__).resolve().parents[1] / "src" / "packwork" / "api" / "keywords.py"
WIDTH = 100
TABLES = {Pin: "PinTable", Rule: "RuleTable"}
RULES = "Sequence[RuleTable]"

OF_PYTHON = {
    **dict.fromkeys(COLOURS, "Colours | None"),
    "seed": "Generator | int | None",
    "weights": "str | Path | Mapping[str, float] | Cells | None",
}
"""Types of options that take values of NumPy, pandas and Matplotlib."""

COLUMNS = ("size_by", "color_by", "mark_by", "label_by", "by")
"""Options of charts that name columns, or are the cells of one."""

HEAD = '''"""Options of the verbs as type checkers and editors know them.

Written by ``tools/write_keywords.py`` from the fields of the options: not to be changed by hand.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from collections.abc import Set as AbstractSet
from pathlib import Path
from typing import Any, Literal, Required, TypedDict

'''


@dataclass(frozen=True)
class Key:
    """A key of a table: name, type as it is spelt, what it means."""

    name: str
    kind: str
    help: str


def written() -> str:
    """The whole file, before it is formatted."""
    imports = {"from packwork.api.signatures import RunKeywords"}
    parts = [
        _table("PinTable", "Given parts of one item's pose.", _keys(Pin, imports)),
        _table("RuleTable", "Rule for the items of some names.", _keys(Rule, imports)),
        *_verb_tables(imports),
        _table("SaveKeywords", "Options of drawing a layout.", _offered(DrawingOptions, imports)),
        _table("FilmKeywords", "Options of films.", _offered(FilmOptions, imports)),
    ]
    return HEAD + "\n".join(sorted(imports)) + "\n\n\n" + "\n\n".join(parts)


def _verb_tables(imports: set[str]) -> Iterable[str]:
    """Tables that several verbs share, then those of each verb, which inherit from them."""
    sets = _by_verbs(imports)
    shared = {verbs: keys for verbs, keys in sets.items() if len(verbs) > 1}
    for verbs, keys in shared.items():
        yield _table(_shared_name(verbs), f"Options of {_enumerated(verbs)}.", keys)
    for verb in VERBS:
        bases = [_shared_name(verbs) for verbs in shared if verb in verbs]
        said = f"Options of :func:`packwork.{_name(verb)}`."
        name = _name(verb).title()
        yield _table(f"{name}Keywords", said, sets.get((verb,), []), bases)
        said = f"All parameters of :func:`packwork.{_name(verb)}` that are given by name."
        yield _table(f"{name}Run", said, [], ["RunKeywords", f"{name}Keywords"])


def _by_verbs(imports: set[str]) -> dict[tuple[Verbs, ...], list[Key]]:
    """Options by the verbs that have them, type and meaning alike."""
    found: dict[tuple[str, str, str], list[tuple[Verbs, Offered]]] = {}
    for verb in VERBS:
        more = (BACKGROUND,) if verb in Verbs.WORDS | Verbs.CHART else ()
        for option in (*run_options(verb), *more):
            if option.name != "items":
                kind = _taken(option.name, option.field, option.offer.takes, imports)
                if verb is Verbs.CHART and option.name in COLUMNS:
                    kind = "Cells | None"
                found.setdefault((option.name, kind, option.help), []).append((verb, option))
    sets: dict[tuple[Verbs, ...], list[Key]] = {}
    for (name, kind, _), offers in found.items():
        verbs = tuple(verb for verb, _ in offers)
        said = _meaning(offers[0][1], _defaults(offers))
        sets.setdefault(verbs, []).append(Key(name, kind, said))
    about = Recipe.model_fields["rules"].description or ""
    sets.setdefault(tuple(VERBS), []).append(Key("rules", RULES, about))
    return sets


def _meaning(option: Offered, defaults: Mapping[str, list[Verbs]]) -> str:
    """Description of an option, and what holds where it is not given, unless it says so."""
    said = option.field.description or option.help
    if "default" in said.lower() or set(defaults) <= {"None", "()", "{}"}:
        return said
    each = [
        value if len(defaults) == 1 else f"{value} ({_enumerated(verbs)})"
        for value, verbs in defaults.items()
    ]
    return f"{said} Default: {', '.join(each)}."


def _defaults(offers: Iterable[tuple[Verbs, Offered]]) -> dict[str, list[Verbs]]:
    """Verbs by what they take an option for that is not given."""
    found: dict[str, list[Verbs]] = {}
    for verb, option in offers:
        found.setdefault(repr(default_of(verb, option)), []).append(verb)
    return found


def _offered(model: type[Options], imports: set[str]) -> list[Key]:
    return [
        Key(
            option.name,
            _taken(option.name, option.field, option.offer.takes, imports),
            _meaning(option, {repr(option.default): []}),
        )
        for option in offered(model)
    ]


def _keys(model: type[Options], imports: set[str]) -> list[Key]:
    """Keys of a table of its own; those without a default have to be there."""
    found = []
    for name, field in model.model_fields.items():
        offer = next((said for said in field.metadata if isinstance(said, Offer)), Offer())
        kind = _taken(name, field, offer.takes, imports)
        kind = f"Required[{kind}]" if field.is_required() else kind
        found.append(Key(name, kind, field.description or ""))
    return found


def _taken(name: str, field: Any, takes: Any, imports: set[str]) -> str:
    """Type of what Python may give for a field."""
    if name == "start":
        imports.add("from packwork.scene.layout import Layout")
        imports.add("from packwork.scene.pose import Poses")
        return "str | Path | Layout | Poses | None"
    if name in OF_PYTHON:
        imports.add("from numpy.random import Generator")
        imports.add("from packwork.api.plain import Cells, Colours")
        return OF_PYTHON[name]
    if name in (*PICTURES, *VECTORS):
        imports.add("from packwork.readers.memory.values import Value")
        return "Value | None"
    if name in (*ITEMS, *CONTAINERS):
        imports.add("from packwork.readers.memory.values import Value")
        more = {"region": "Sequence[str | float] | ", "shape": ""}.get(name, "Iterable[Value] | ")
        return f"Value | {more}None"
    kinds = list(dict.fromkeys(_spelt(field.annotation if takes is None else takes, imports)))
    if "str" not in kinds:
        # A text would be a sequence of texts, of one letter each.
        kinds = [
            kind.replace("Sequence", many)
            for kind in kinds
            for many in (("list", "tuple") if kind.startswith("Sequence[str") else ("Sequence",))
        ]
    return " | ".join(kind.replace("tuple[str]", "tuple[str, ...]") for kind in kinds)


def _spelt(kind: Any, imports: set[str]) -> list[str]:
    """Alternatives of a type as they are written; of containers what is read of them."""
    origin, inner = get_origin(kind), get_args(kind)
    if origin is Annotated:
        return _spelt(inner[0], imports)
    if origin in (Union, UnionType):
        return [said for part in inner for said in _spelt(part, imports)]
    if origin is Literal:
        return [f"Literal[{', '.join(map(repr, inner))}]"]
    if origin is tuple:
        return _spelt_tuple(inner, imports)
    if origin is dict or origin is Mapping:
        return _spelt_mapping(inner, imports)
    if origin is AbstractCallable:
        return [_spelt_function(inner, imports)]
    if origin is not None:
        name = "AbstractSet" if origin.__name__ == "Set" else origin.__name__
        return [f"{name}[{', '.join(' | '.join(_spelt(part, imports)) for part in inner)}]"]
    return [_spelt_name(kind, imports)]


def _spelt_tuple(inner: tuple[Any, ...], imports: set[str]) -> list[str]:
    each = [" | ".join(_spelt(part, imports)) for part in inner if part is not Ellipsis]
    if Ellipsis in inner:
        return [f"Sequence[{each[0]}]"]
    return [f"list[{' | '.join(dict.fromkeys(each))}]", f"tuple[{', '.join(each)}]"]


def _spelt_mapping(inner: tuple[Any, Any], imports: set[str]) -> list[str]:
    keys = _spelt(inner[0], imports)
    # Keys of a Mapping are invariant: one of texts alone would be refused where both may be.
    key = keys[0] if len(keys) == 1 else "Any"
    return [f"Mapping[{key}, {' | '.join(_spelt(inner[1], imports))}]"]


def _spelt_function(inner: tuple[Any, Any], imports: set[str]) -> str:
    *taken, given = inner
    several = taken[0] if isinstance(taken[0], list) else taken
    said = (
        "..." if several == [Ellipsis] else f"[{', '.join(_spelt(t, imports)[0] for t in several)}]"
    )
    return f"Callable[{said}, {' | '.join(_spelt(given, imports))}]"


def _spelt_name(kind: Any, imports: set[str]) -> str:
    if kind is NoneType or kind is None:
        return "None"
    if kind is Any:
        return "Any"
    if kind in TABLES:
        return TABLES[kind]
    if issubclass(kind, BaseModel):
        return "Mapping[str, Any]"
    if kind.__module__ not in ("builtins", "pathlib"):
        imports.add(f"from {kind.__module__} import {kind.__name__}")
    return str(kind.__name__)


def _table(name: str, said: str, keys: list[Key], bases: Iterable[str] = ()) -> str:
    head = f"class {name}({', '.join(bases) or 'TypedDict'}, total=False):\n"
    parts = [f'    """{said}"""\n']
    parts += [f"    {key.name}: {key.kind}\n{_docstring(key.help)}" for key in keys]
    return head + "\n".join(parts)


def _docstring(text: str) -> str:
    plain = " ".join(text.split()).replace("\\", "\\\\")
    lines = textwrap.wrap(f'"""{plain}"""', WIDTH - 4, break_on_hyphens=False)
    return textwrap.indent("\n".join(lines), "    ") + "\n"


def _name(verb: Verbs) -> str:
    return str(verb.name).lower()


def _shared_name(verbs: tuple[Verbs, ...]) -> str:
    return "_Every" if len(verbs) == len(VERBS) else f"_{''.join(_name(v).title() for v in verbs)}"


def _enumerated(verbs: Iterable[Verbs]) -> str:
    return ", ".join(map(_name, verbs))


def main() -> None:
    """Write the file."""
    TARGET.write_text(written(), encoding="utf-8")
    for asked in (["format"], ["check", "--fix", "--select", "F401,I"]):
        subprocess.run([sys.executable, "-m", "ruff", *asked, "--quiet", TARGET], check=True)  # noqa: S603


if __name__ == "__main__":
    main()
