"""Live sessions: a layout that is changed by commands, flows, and settles into an exact one."""
