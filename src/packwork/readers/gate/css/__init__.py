"""Style sheets to plain declarations on the elements they match."""
