"""First poses."""
