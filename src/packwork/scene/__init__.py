"""Frozen values: item, container, pose, layout. They know no file and no pixel."""
