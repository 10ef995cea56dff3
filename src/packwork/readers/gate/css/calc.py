"""Values of CSS ``calc()``, ``min()``, ``max()`` and ``clamp()``, read by Python's own parser.

Only numbers, the four operations and these functions are computed; all else has no value.
"""

from __future__ import annotations

import ast
import operator
import re
from collections.abc import Callable

MAX_TERMS = 200
"""Numbers, words, signs and brackets of one call: CSS asks for 32 terms at least. Chosen."""

UNCOMPUTABLE = (ArithmeticError, LookupError, SyntaxError, TypeError, ValueError)
"""What comes of calls that make no sense."""

_NUMBER = re.compile(r"((?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)([a-z%]*)")
_PLAIN = re.compile(r"(?:[\w\s.%+*/()-]|,(?!\s*\)))*")
"""Python lets a comma stand before a bracket."""
_TERM = re.compile(r"[\w.%]+|[^\w\s]")
_OPERATORS: dict[type[ast.AST], Callable[..., float]] = {
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv,
    ast.USub: operator.neg, ast.UAdd: operator.pos,
}  # fmt: skip
_CALLS: dict[str, Callable[..., float]] = {
    "calc": lambda value: value,
    "min": lambda *values: min(values),
    "max": lambda *values: max(values),
    "clamp": lambda low, value, high: max(low, min(value, high)),
}


def calculated(call: str, factor: Callable[[str], float]) -> float:
    """Value of a call in the unit to which ``factor`` brings numbers of other units.

    Raises one of ``UNCOMPUTABLE`` if it has none.

    >>> calculated("calc(2em * (3 + 1) - min(1em, 50))", {"em": 16.0, "": 1.0}.__getitem__)
    112.0
    """
    if _PLAIN.fullmatch(call) is None or len(_TERM.findall(call)) > MAX_TERMS:
        raise ValueError("something else, or too long")
    plain = call.lower().replace("-webkit-", "")
    # Spaces keep what follows a number apart from it.
    written = _NUMBER.sub(lambda met: f" {float(met[1]) * factor(met[2])!r} ", plain)
    return _value(ast.parse(written, mode="eval").body)


def _value(node: ast.expr) -> float:
    match node:
        case ast.Constant(float() as number):
            return number
        case ast.UnaryOp(sign, operand) if type(sign) in _OPERATORS:
            return float(_OPERATORS[type(sign)](_value(operand)))
        case ast.BinOp(left, sign, right) if type(sign) in _OPERATORS:
            return float(_OPERATORS[type(sign)](_value(left), _value(right)))
        case ast.Call(ast.Name(name), arguments, []):
            return _CALLS[name](*map(_value, arguments))
    raise ValueError("no number")
