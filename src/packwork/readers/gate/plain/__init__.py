"""CSS features rewritten as plain SVG attributes: units, transforms, clip shapes, dashes."""
