"""The tutorial: every command runs, and the picture that it makes stands beside it."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import numpy as np
import pytest

from clone_pages import ROOT, commands, prepare, run_all, sections
from numerics import central_differences, compare

SECTIONS = {name: text for name, text in sections("tutorial.md").items() if commands(text)}
IMAGES = (".png", ".gif")


def drawn(section: str) -> list[str]:
    """Pictures that a section's command writes."""
    words = [word for line in commands(section) for word in line]
    return [word for word in words if word.endswith(IMAGES) and "/" not in word]


@pytest.mark.parametrize("heading", SECTIONS)
def test_every_command_runs(heading: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(str(tmp_path))
    prepare(SECTIONS[heading], tmp_path)
    (result,) = run_all(SECTIONS[heading])
    assert result.exit_code in {0, 1}, result.stderr
    assert all((tmp_path / name).stat().st_size for name in drawn(SECTIONS[heading]))


@pytest.mark.parametrize("heading", SECTIONS)
def test_the_picture_beside_it_is_the_commands(heading: str) -> None:
    shown = re.findall(r"\]\(\.\./pictures/tutorial/(\S+)\)", SECTIONS[heading])
    assert shown == drawn(SECTIONS[heading])
    assert all((ROOT / "docs" / "pictures" / "tutorial" / name).exists() for name in shown)


def test_the_loss_tells_its_derivative(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(tmp_path))
    prepare(SECTIONS["A loss of your own"], tmp_path)
    rising = __import__("rising").rising
    sys.modules.pop("rising")
    density = np.random.default_rng(0).random((4, 5))
    reference = central_differences(lambda image: rising(image, None).value, density)
    assert compare(rising(density, None).adjoint, reference).error < 1e-6
