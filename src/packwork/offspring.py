"""Processes of ours that end with the one that started them, however that was ended.

A thread that waits for the other's end does not run while native code keeps Python's lock. Linux
ends a process by itself when it was asked to (prctl(2), PR_SET_PDEATHSIG).
"""

from __future__ import annotations

END_WITH_PARENT = """
import sys
if sys.platform == "linux":
    import ctypes, signal
    try:
        ctypes.CDLL(None).prctl(1, signal.SIGKILL)
    except (OSError, AttributeError):
        pass
"""
"""First lines of a program that is given to another Python as text."""


def end_with_parent() -> None:
    """Have this process end with the one that started it, where the system does so."""
    exec(END_WITH_PARENT, {})  # noqa: S102 - our own words
