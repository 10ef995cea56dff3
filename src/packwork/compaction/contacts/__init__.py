"""What keeps polygons in place apart."""
