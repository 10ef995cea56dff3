"""A small certified layout, and sessions that begin with it."""

from __future__ import annotations

from collections.abc import Callable

import pytest

import packwork as pw


@pytest.fixture(scope="session")
def dozen() -> pw.Layout:
    """Twelve stars, hearts and hexagons in a circle."""
    return pw.fill("circle", ["star", "heart", "hexagon"], count=12, epochs=120, levels="50,100")


@pytest.fixture
def session(dozen: pw.Layout) -> pw.Session:
    """A session that begins with the dozen."""
    return dozen.edit()


@pytest.fixture
def same() -> Callable[[pw.Poses, pw.Poses], bool]:
    """Whether two poses are the same, bit for bit."""

    def are(one: pw.Poses, other: pw.Poses) -> bool:
        names = ("x", "y", "angle", "scale", "stretch")
        return all(getattr(one, n).tobytes() == getattr(other, n).tobytes() for n in names)

    return are
