"""CSS style sheets to plain declarations on the elements that they match."""
