"""Recording of the items' motion, for films."""
