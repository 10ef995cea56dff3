"""Write ``api/keywords.pyi``, the types of options in Python, from the fields of the options.

    python tools/write_keywords.py

A test compares the file with what this would write, so that neither is ahead of the other.
"""

from __future__ import annotations

import subprocess
import sys
import textwrap
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from packwork.api.option_types import RULES, kind_of, kind_of_option
from packwork.api.signatures import BACKGROUND
from packwork.options import Offer, Offered, Options, Verbs, offered
from packwork.recipe import Recipe
from packwork.recipe.rules import Pin, Rule
from packwork.recipe.verbs import VERBS, default_of, run_options
from packwork.writers.film.options import FilmOptions
from packwork.writers.options import DrawingOptions

TARGET = Path(__file__).resolve().parents[1] / "src" / "packwork" / "api" / "keywords.pyi"
WIDTH = 100

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
                kind = kind_of_option(option, verb, imports)
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
            kind_of_option(option, None, imports),
            _meaning(option, {repr(option.default): []}),
        )
        for option in offered(model)
    ]


def _keys(model: type[Options], imports: set[str]) -> list[Key]:
    """Keys of a table of its own; those without a default have to be there."""
    found = []
    for name, field in model.model_fields.items():
        offer = next((said for said in field.metadata if isinstance(said, Offer)), Offer())
        kind = kind_of(name, field, offer.takes, imports)
        kind = f"Required[{kind}]" if field.is_required() else kind
        found.append(Key(name, kind, field.description or ""))
    return found


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
