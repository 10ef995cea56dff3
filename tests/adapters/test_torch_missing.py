"""Without PyTorch the adapter loads, and says on one line what to install."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import packwork as pw
from packwork.adapters.torch import render, render_colour, render_items, torch_loss


@pytest.mark.parametrize(
    "use",
    [
        lambda: render(None, [0, 3], (4, 4)),  # type: ignore[arg-type]
        lambda: render_colour(None, [0, 3], None, (4, 4)),  # type: ignore[arg-type]
        lambda: render_items([], *[None] * 4, (4, 4)),  # type: ignore[arg-type]
        lambda: torch_loss(len),  # type: ignore[arg-type]
    ],
    ids=["render", "render_colour", "render_items", "torch_loss"],
)
def test_every_use_says_what_to_install(use: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "torch", None)
    with pytest.raises(pw.PackworkError, match=r'pip install "packwork\[torch\]"$') as met:
        use()
    assert "\n" not in str(met.value)


def test_a_broken_installation_is_not_taken_for_a_missing_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "torch.py").write_text("import no_such_part_of_it", encoding="utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.delitem(sys.modules, "torch", raising=False)
    with pytest.raises(ModuleNotFoundError, match="no_such_part_of_it"):
        torch_loss(len)  # type: ignore[arg-type]


def test_the_package_itself_never_loads_it() -> None:
    code = (
        "import sys, packwork as pw\n"
        "for name in pw.__all__: getattr(pw, name)\n"
        "pw.fill('circle', 'star', epochs=1, levels='8')\n"
        "sys.exit(any(name.split('.')[0] == 'torch' for name in sys.modules))"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
