"""The part of SVG that is let in: elements, attributes and properties by name.

Filters are not: what they paint lies beyond the outline, where the neighbours are, and a
line of markup can make them cost minutes. Shapes are drawn without them.
"""

from __future__ import annotations

SHAPES = frozenset({"path", "rect", "circle", "ellipse", "line", "polyline", "polygon"})

GROUPS = frozenset({"svg", "g", "defs", "symbol", "use"})

GRADIENTS = frozenset({"linearGradient", "radialGradient"})

NEVER_DRAWN = GRADIENTS | {"defs", "symbol", "clipPath", "mask", "pattern", "marker"}
"""Elements that show only where something refers to them."""

TRACED = frozenset({"text", "image", "clipPath", "mask", "pattern", "marker"})
"""What the plain geometry of shapes does not tell: drawn, then traced."""

TEXTS = frozenset({"text", "tspan", "textPath"})

ELEMENTS = SHAPES | GROUPS | NEVER_DRAWN | TEXTS | {"image", "stop", "style"}

RENAMED = {"a": "g", "switch": "g"}
"""Elements that are groups once links and languages are gone."""

PROPERTIES = frozenset(
    {
        "alignment-baseline",
        "baseline-shift",
        "clip-path",
        "clip-rule",
        "color",
        "direction",
        "display",
        "dominant-baseline",
        "fill",
        "fill-opacity",
        "fill-rule",
        "font-family",
        "font-size",
        "font-stretch",
        "font-style",
        "font-variant",
        "font-weight",
        "isolation",
        "letter-spacing",
        "marker-end",
        "marker-mid",
        "marker-start",
        "mask",
        "mask-type",
        "mix-blend-mode",
        "opacity",
        "overflow",
        "paint-order",
        "shape-rendering",
        "stop-color",
        "stop-opacity",
        "stroke",
        "stroke-dasharray",
        "stroke-dashoffset",
        "stroke-linecap",
        "stroke-linejoin",
        "stroke-miterlimit",
        "stroke-opacity",
        "stroke-width",
        "text-anchor",
        "text-decoration",
        "transform",
        "visibility",
        "word-spacing",
        "writing-mode",
        # Geometry that SVG 2 lets style sheets set.
        "cx",
        "cy",
        "height",
        "r",
        "rx",
        "ry",
        "width",
        "x",
        "y",
    }
)
"""Properties that CSS may set; each becomes an attribute of the same name."""

CSS_ONLY = frozenset({"isolation", "mix-blend-mode"})
"""Properties that are no attributes and have to stay in ``style``."""

ATTRIBUTES = (PROPERTIES - CSS_ONLY) | frozenset(
    {
        "clipPathUnits",
        "d",
        "dx",
        "dy",
        "fr",
        "fx",
        "fy",
        "gradientTransform",
        "gradientUnits",
        "id",
        "lengthAdjust",
        "markerHeight",
        "markerUnits",
        "markerWidth",
        "maskContentUnits",
        "maskUnits",
        "offset",
        "orient",
        "patternContentUnits",
        "patternTransform",
        "patternUnits",
        "points",
        "preserveAspectRatio",
        "refX",
        "refY",
        "rotate",
        "spreadMethod",
        "startOffset",
        "textLength",
        "viewBox",
        "x1",
        "x2",
        "y1",
        "y2",
    }
)

FUNCTIONS = frozenset(
    {
        "hsl",
        "hsla",
        "matrix",
        "rgb",
        "rgba",
        "rotate",
        "scale",
        "skewx",
        "skewy",
        "translate",
        "translatex",
        "translatey",
    }
)
"""Functions a value may call, in lower case; ``url`` has a rule of its own."""
