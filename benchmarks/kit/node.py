"""Programs in JavaScript, through Node, in a folder of their own: ``build/peers``."""

from __future__ import annotations

import json
import resource
import shutil
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

SCRIPTS = Path(__file__).parents[1] / "peers" / "node"
FOLDER = Path(__file__).parents[2] / "build" / "peers"
"""Git passes over it; ``packwork bench peers install`` fills it."""


def install() -> None:
    """Fetch what ``node/package.json`` names, at those versions."""
    if shutil.which("npm") is None:
        sys.exit("packwork: bench peers install: npm is not there; install Node first")
    FOLDER.mkdir(parents=True, exist_ok=True)
    shutil.copy(SCRIPTS / "package.json", FOLDER)
    subprocess.run(["npm", "install", "--no-audit", "--no-fund"], cwd=FOLDER, check=True)  # noqa: S607


def version(package: str) -> str | None:
    """Of an installed package; None if it, or Node, is not there."""
    about = FOLDER / "node_modules" / package / "package.json"
    if shutil.which("node") is None or not about.exists():
        return None
    return str(json.loads(about.read_text(encoding="utf-8"))["version"])


def run(script: str, data: dict[str, Any], seconds: int = 300) -> dict[str, Any]:
    """What a script prints; raises ``TimeoutError`` after so many seconds of the processor."""
    # A module finds others beside itself.
    shutil.copy(SCRIPTS / script, FOLDER)
    done = subprocess.run(  # noqa: S603
        ["node", "--max-old-space-size=8192", script],  # noqa: S607
        cwd=FOLDER, input=json.dumps(data), capture_output=True, text=True,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds)),
    )  # fmt: skip
    if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        raise TimeoutError
    if done.returncode != 0:
        raise RuntimeError(f"{script}: {done.stderr.strip()[-400:]}")
    return dict(json.loads(done.stdout))
