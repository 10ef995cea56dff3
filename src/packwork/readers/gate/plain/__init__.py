"""What CSS says in ways of its own, in plain SVG: units, transforms, cuts, lines."""
