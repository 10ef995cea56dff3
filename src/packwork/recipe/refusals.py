"""Errors of pydantic about options, in one line that says what would do."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeVar, get_args

from pydantic import AfterValidator, BaseModel, BeforeValidator, ValidationError

from packwork.errors import RecipeError
from packwork.synonyms import key_meant
from packwork.units import length_asked, parse_share
from packwork.writers.options import DrawingOptions

_Model = TypeVar("_Model", bound=BaseModel)

_PLAIN_WORDS = {
    "should be": "must be",
    "greater than or equal to": "at least",
    "less than or equal to": "at most",
    "greater than": "more than",
    "a valid integer, unable to parse string as an integer": "a whole number",
    "Unable to parse input string as an integer, exceeded maximum size": (
        "must be a whole number of fewer digits"
    ),
    "a valid number, unable to parse string as a number": "a number",
    "a valid number": "a number",
    "a valid integer, got a number with a fractional part": "a whole number",
    "a valid integer": "a whole number",
    "a valid string": "a text",
    "a valid dictionary or instance of Rule": 'a table such as {items = "star", count = 3}',
    "a valid dictionary or instance of Pin": 'a table such as {x = "50%", y = "50%"}',
}


def validated(
    model: type[_Model], values: Mapping[str, Any], names: Mapping[str, str] | None = None
) -> _Model:
    """Options of a model, from plain values.

    Parameters
    ----------
    names
        What people call an option that goes by another name in the model.
    """
    try:
        return model.model_validate(values)
    except ValidationError as error:
        raise refusal(error, model, names) from error


def refusal(
    error: ValidationError, model: type[BaseModel], names: Mapping[str, str] | None = None
) -> RecipeError:
    """The first thing wrong, as an error about the option that people know.

    What a validator of ours says comes first, in its own words: it knows most.

    Parameters
    ----------
    names
        What people call an option that goes by another name in the model.

    Examples
    --------
    >>> class Bag(BaseModel, extra="forbid"):
    ...     count: int = 1
    >>> try:
    ...     Bag(cuont=3)
    ... except ValidationError as error:
    ...     print(refusal(error, Bag))
    cuont: no such option; did you mean count?
    """
    found = error.errors(include_url=False)
    causes = (problem.get("ctx", {}).get("error") for problem in found)
    refused = next((cause for cause in causes if isinstance(cause, RecipeError)), None)
    if refused is not None:
        return refused
    # A misspelt key is also a missing one: name what was written.
    # Of the forms that a value may have, the one that was given got furthest.
    forms = [e for e in found if e["loc"][: len(found[0]["loc"]) - 1] == found[0]["loc"][:-1]]
    deepest = max(forms, key=lambda e: len(e["loc"]))
    first = next((e for e in found if e["type"] == "extra_forbidden"), deepest)
    key, *within = first["loc"] or ("recipe",)
    key = (names or {}).get(str(key), str(key))
    if first["type"] == "extra_forbidden":
        return RecipeError(key, _unknown(within, key, _keys_at(model, first["loc"][:-1])))
    where = _where(within) if key in {"rules", "weights", "words", "chart", "film"} else ""
    if first["type"] == "missing":
        return RecipeError(key, f"{where}must be given")
    message = plain_words(first["msg"])
    met = ""
    if first["type"] != "value_error":
        message, met = message[:200], f", not {_said(first['input'])}"
    hint = _percent_meant(model, first)
    return RecipeError(key, f"{where}{message[0].lower()}{message[1:]}{met}{hint}")


def plain_words(message: str) -> str:
    """A message of pydantic in the words of other messages."""
    message = re.sub(r"(^|: )(Value error, |Input )", r"\1", message)
    for said, meant in _PLAIN_WORDS.items():
        message = message.replace(said, meant)
    return message


def _percent_meant(model: type[BaseModel], error: Mapping[str, Any]) -> str:
    """Question behind a share that is too large and would be one in percent."""
    met, (name, *within) = error["input"], error["loc"] or ("",)
    field = None if within else model.model_fields.get(str(name))
    if field is None or error["type"] not in ("less_than", "less_than_equal"):
        return ""
    kinds = get_args(field.annotation)
    rules = [*field.metadata, *(m for kind in kinds for m in getattr(kind, "__metadata__", ()))]
    is_share = any(isinstance(one, BeforeValidator) and one.func is parse_share for one in rules)
    return f"; did you mean {met:g}%?" if is_share and 1 < met < 100 else ""


def _said(value: object) -> str:
    """The beginning of a value, as it is written.

    Examples
    --------
    >>> _said("bear"), _said(12), _said([16**5_000])
    ("'bear'", '12', 'a number of too many digits')
    """
    try:
        return repr(value[:60]) if isinstance(value, str) else str(value)[:60]
    except ValueError:
        return "a number of too many digits"


def _unknown(within: Sequence[int | str], key: str, known: list[str]) -> str:
    met = str(within[-1]) if within else key
    meant = key_meant(met, known)
    hint = f"did you mean {meant}?" if meant else f"there are {', '.join(known)}"
    if not within:
        saved = met in DrawingOptions.model_fields and met not in known
        return f"no such option; {'give it to save' if saved else hint}"
    return f"{_where(within[:-1])}there is no {met!r}; {hint}"


def _where(within: Sequence[int | str]) -> str:
    """Words for a place inside the rules: ``rule 2: pin.x:``."""
    numbers = [f"rule {part + 1}: " for part in within if isinstance(part, int)][:1]
    named = (part for part in within if isinstance(part, str))
    keys = ".".join(part for part in named if not part.startswith("dict["))
    return "".join(numbers) + (f"{keys}: " if keys else "")


def _keys_at(model: type[BaseModel], path: Sequence[int | str]) -> list[str]:
    """Keys of the table at a place in a model."""
    for part in path:
        # Keys of tables and names of kinds stand in a place too.
        if isinstance(part, str) and part in model.model_fields:
            model = _model_in(model.model_fields[part].annotation) or model
    return list(model.model_fields)


def _model_in(annotation: Any) -> type[BaseModel] | None:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    return next((found for a in get_args(annotation) if (found := _model_in(a))), None)


def length_of(key: str, *, may_be_zero: bool = False, word: str | None = None) -> AfterValidator:
    """Validator of a length, or None, or a word."""

    def check(value: str | float | None) -> str | float | None:
        if value in {None, word} or length_asked(key, value, "px", 1.0, word) > 0 or may_be_zero:
            return value
        raise RecipeError(key, f"must be more than nothing, not {value}")

    return AfterValidator(check)


def one_or_more(value: object) -> object:
    """One text as several, None as none of them, and what is several as it is."""
    return (value,) if isinstance(value, str) else () if value is None else value


def parsed_by(parse: Callable[[Any], object]) -> AfterValidator:
    """Validator of a value that is kept as it is, if it can be parsed; None is kept, too."""

    def check(value: Any) -> Any:
        if value is not None:
            parse(value)
        return value

    return AfterValidator(check)
