"""Strip packing: ours and spyrrow's in the same seconds, checked by Shapely."""
