"""Files that hypothesis makes up: right in form, odd in what they say."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

import tomli_w
from hypothesis import strategies as st

from benchmarks.robustness.hostile.mutations import ODD_NUMBERS, ODD_WORDS, sayable
from packwork.recipe import Recipe
from packwork.recipe.rules import Rule

TAGS = (
    "g", "path", "rect", "circle", "ellipse", "line", "polyline", "polygon", "use", "defs",
    "symbol", "svg", "text", "tspan", "textPath", "clipPath", "mask", "pattern", "marker",
    "linearGradient", "radialGradient", "stop", "filter", "feGaussianBlur", "feFlood", "image",
    "style", "switch", "a", "foreignObject", "animate", "title", "script",
)  # fmt: skip
NUMERIC = (
    "x", "y", "x1", "y2", "cx", "cy", "r", "rx", "ry", "width", "height", "stroke-width",
    "opacity", "fill-opacity", "stroke-dashoffset", "offset", "font-size", "stdDeviation",
    "stroke-miterlimit",
)  # fmt: skip
SAID = (
    "fill", "stroke", "transform", "d", "points", "viewBox", "style", "class", "id", "href",
    "clip-path", "mask", "filter", "stroke-dasharray", "stroke-linejoin", "fill-rule", "display",
    "preserveAspectRatio", "gradientTransform", "patternUnits", "marker-end", "font-family",
    "stroke-linecap", "color", "visibility", "mix-blend-mode", "xml:space", "systemLanguage",
)  # fmt: skip
VALUES = (
    "#f00", "red", "none", "url(#a)", "url(#b)", "#a", "#b", "a", "b", "translate(5 5) scale(2)",
    "matrix(1 2 3 4 5 6)", "M10 10h50v50z", "m0 0c1 2 3 4 5 6s7 8 9 9t1 1q1 2 3 4a5 5 0 1 1 9 9",
    "0 0 100 100", "0 0 0 0", "10,10 90,10 50,90", "1 2 3", "fill:red;stroke:blue", "evenodd",
    "round", "xMidYMid slice", "objectBoundingBox", "userSpaceOnUse", "data:image/png;base64,AAAA",
)  # fmt: skip


def _one_of(words: Sequence[str]) -> st.SearchStrategy[str]:
    """As ``sampled_from``, which would write all of them into the name of each strategy."""
    return st.integers(0, len(words) - 1).map(lambda k: words[k])


ODD = _one_of(ODD_NUMBERS) | st.floats(allow_nan=True).map(repr)
NUMBERS = st.one_of(st.integers(-200, 300).map(str), st.floats(-200, 300).map(repr), ODD)
CLEAN = _one_of([word for word in ODD_WORDS if not set(word) & set('<&"\0\ufffe')])
_SAID = _one_of(VALUES) | CLEAN | NUMBERS
ATTRIBUTES = st.fixed_dictionaries(
    {}, optional={**dict.fromkeys(NUMERIC, NUMBERS), **dict.fromkeys(SAID, _SAID)}
)


def _element(children: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    return st.builds(_tag, st.sampled_from(TAGS), ATTRIBUTES, st.lists(children, max_size=4))


def _tag(name: str, attributes: dict[str, str], children: list[str]) -> str:
    said = "".join(f' {key}="{value}"' for key, value in attributes.items())
    return f"<{name}{said}>{''.join(children)}</{name}>"


_LEAVES = _element(st.sampled_from(["", "Ab", ".a{fill:red}", "@import 'x'"]))
PAGES = st.sampled_from(
    ['viewBox="0 0 100 100"', 'width="50" height="20"', "", 'width="0" viewBox="0 0 1 1"']
) | ATTRIBUTES.map(lambda said: _tag("", said, [])[1:-3])  # fmt: skip

DRAWINGS = st.builds(
    lambda page, body: (
        f'<svg xmlns="http://www.w3.org/2000/svg" {page}><path id="a" d="M9 9h60v60z"/>'
        f"{''.join(body)}</svg>"
    ).encode(),
    PAGES,
    st.lists(st.recursive(_LEAVES, _element, max_leaves=12), max_size=5),
)

CELLS = st.one_of(NUMBERS, CLEAN, st.sampled_from(["bear", "word", "weight", "#c33", "a b"]))
TABLES = st.lists(st.lists(CELLS, max_size=5), max_size=12).map(
    lambda rows: "\n".join(",".join(row) for row in rows).encode()
)

PLAIN = st.one_of(
    st.none(), st.booleans(), st.integers(-3, 40), st.integers(), st.floats(),
    st.sampled_from(["star", "circle", "50%", "1mm", "heart", "none", "exact", "draft", "shared"]),
    _one_of(ODD_WORDS),
)  # fmt: skip
TREES = st.recursive(
    PLAIN, lambda c: st.lists(c, max_size=4) | st.dictionaries(st.text(max_size=4), c, max_size=3)
)

_CORNER = st.integers(0, 100) | st.floats(-50, 150) | st.sampled_from([1e7, -1e300, None, "1"])
_RINGS = st.lists(st.lists(st.lists(_CORNER, max_size=3), max_size=6), max_size=3)
_GEOMETRIES = st.fixed_dictionaries(
    {"type": st.sampled_from(["Polygon", "MultiPolygon", "Point", 3]),
     "coordinates": _RINGS | st.lists(_RINGS, max_size=2) | TREES}
)  # fmt: skip
_PROPERTIES = st.fixed_dictionaries(
    {"role": st.sampled_from(["container", "item", "item", None])},
    optional=dict.fromkeys(
        ("item", "source", "x", "y", "angle", "scale", "weight", "fill", "link"), TREES
    ),
)
LAYOUTS = st.fixed_dictionaries(
    {"type": st.just("FeatureCollection"),
     "features": st.lists(st.fixed_dictionaries(
         {"type": st.just("Feature"), "geometry": _GEOMETRIES, "properties": _PROPERTIES}
     ), max_size=4)},
    optional={"canvas": TREES, "manifest": TREES},
).map(lambda tree: json.dumps(tree).encode())  # fmt: skip


def _toml(options: dict[str, Any]) -> bytes:
    """Options as a file; without what TOML has no word for."""
    try:
        return tomli_w.dumps(sayable(options)).encode()
    except (UnicodeEncodeError, ValueError):
        return b'container = "heart"'


_RULES = st.lists(
    st.dictionaries(st.sampled_from(sorted(Rule.model_fields)), TREES, max_size=3), max_size=2
)
_SOUND = {"items": ["star", "circle"], "count": 4, "levels": [16], "epochs": 2}
_OTHERS = sorted(set(Recipe.model_fields) - {*_SOUND, "container", "rules", "time"})
RECIPES = st.builds(
    lambda container, odd, rules: _toml({**_SOUND, "container": container, **odd, "rules": rules}),
    st.sampled_from(["heart", "circle", "none", "text:AB"]) | CLEAN,
    st.dictionaries(st.sampled_from(_OTHERS), TREES, max_size=2),
    st.just([]) | _RULES,
)
