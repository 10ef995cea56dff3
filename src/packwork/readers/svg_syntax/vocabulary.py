"""Allow-lists of SVG elements, attributes and CSS properties."""

from __future__ import annotations

HREF = "xlink:href"
"""The one spelling of references, understood by old and new programs alike."""

SHAPES = frozenset({"path", "rect", "circle", "ellipse", "line", "polyline", "polygon"})

GROUPS = frozenset({"svg", "g", "defs", "symbol", "use"})

GRADIENTS = frozenset({"linearGradient", "radialGradient"})

FILTER_STEPS = frozenset(
    {"feBlend", "feColorMatrix", "feComponentTransfer", "feComposite", "feDropShadow"}
    | {"feFlood", "feGaussianBlur", "feMerge", "feOffset"}
)
"""What a filter may do. Pictures, noise, light, and what is slow by design it may not."""

FILTER_PARTS = FILTER_STEPS | {"feFuncA", "feFuncB", "feFuncG", "feFuncR", "feMergeNode"}

NEVER_DRAWN = GRADIENTS | {"defs", "symbol", "clipPath", "mask", "pattern", "marker", "filter"}
"""Elements that show only where something refers to them."""

TRACED = frozenset({"text", "image", "mask", "pattern", "marker"})
"""What the plain geometry of shapes does not tell: drawn, then traced."""

TEXTS = frozenset({"text", "tspan", "textPath"})

ELEMENTS = SHAPES | GROUPS | NEVER_DRAWN | TEXTS | FILTER_PARTS | {"image", "stop", "style"}

RENAMED = {"a": "g", "switch": "g"}
"""Elements that are groups once links and languages are gone."""

CUSTOM = "--"
"""What the names of CSS variables begin with."""

MOVES = frozenset({"rotate", "scale", "translate"})
"""Properties that are transforms of their own; attributes of these names say other things."""

CSS_MOVES = frozenset(f"css-{name}" for name in MOVES)
"""Attributes that they are kept in until all transforms are one."""

PROPERTIES = MOVES | frozenset({
    "alignment-baseline", "baseline-shift", "clip-path", "clip-rule", "color",
    "color-interpolation-filters", "direction", "display", "dominant-baseline", "fill",
    "fill-opacity", "fill-rule", "filter", "flood-color", "flood-opacity", "font-family",
    "font-size", "font-stretch", "font-style", "font-variant", "font-weight", "isolation",
    "letter-spacing", "marker-end", "marker-mid", "marker-start", "mask", "mask-type",
    "mix-blend-mode", "opacity", "overflow", "paint-order", "shape-rendering", "stop-color",
    "stop-opacity", "stroke", "stroke-dasharray", "stroke-dashoffset", "stroke-linecap",
    "stroke-linejoin", "stroke-miterlimit", "stroke-opacity", "stroke-width", "text-anchor",
    "text-decoration", "transform", "transform-box", "transform-origin", "vector-effect",
    "visibility", "word-spacing", "writing-mode", "cx", "cy", "d", "height", "r", "rx", "ry",
    "width", "x", "y",
})  # fmt: skip
"""Properties that CSS may set, geometry among them; each becomes an attribute of that name."""

COLOURS = frozenset({"color", "fill", "flood-color", "stop-color", "stroke"})
"""Those that are colours."""

CSS_ONLY = frozenset({"isolation", "mix-blend-mode"})
"""Properties that are no attributes and have to stay in ``style``."""

ATTRIBUTES = (PROPERTIES - CSS_ONLY - MOVES) | frozenset({
    "amplitude", "clipPathUnits", "dx", "dy", "exponent", "filterUnits", "fr", "fx", "fy",
    "gradientTransform", "gradientUnits", "id", "in", "in2", "intercept", "k1", "k2", "k3", "k4",
    "lengthAdjust", "markerHeight", "markerUnits", "markerWidth", "maskContentUnits", "maskUnits",
    "mode", "offset", "operator", "orient", "pathLength", "patternContentUnits",
    "patternTransform", "patternUnits", "points", "preserveAspectRatio", "primitiveUnits", "refX",
    "refY", "result", "rotate", "slope", "spreadMethod", "startOffset", "stdDeviation",
    "tableValues", "textLength", "type", "values", "viewBox", "x1", "x2", "y1", "y2",
})  # fmt: skip

FUNCTIONS = frozenset({
    "calc", "circle", "clamp", "ellipse", "inset", "max", "min", "path", "polygon", "rect",
    "xywh", "hsl", "hsla", "matrix", "rgb", "rgba", "rotate", "scale", "scalex", "scaley", "skew",
    "skewx", "skewy", "translate", "translatex", "translatey",
})  # fmt: skip
"""Functions a value may call, in lower case; ``url`` has a rule of its own."""
