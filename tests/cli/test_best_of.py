"""``--best-of``: several seeds, the best kept, the very bytes of a run of that seed alone."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from PIL import Image
from typer.testing import Result

LINE = "fill circle star moon -n 5 --effort draft --epochs 20 --levels 50 --seed 3"


def test_the_best_of_several_is_what_its_seed_gives_alone(
    packwork: Callable[..., Result], folder: Path
) -> None:
    covered = {}
    for seed in (3, 4, 5):
        line = LINE.replace("--seed 3", f"--seed {seed}")
        assert packwork(f"{line} -o {seed}.svg --report {seed}.json -q").exit_code == 0
        metrics = json.loads((folder / f"{seed}.json").read_text(encoding="utf-8"))["metrics"]
        covered[seed] = metrics["exact"]["LC"]
    best = max(covered, key=lambda seed: covered[seed])
    more = "-o best.svg --save-recipe best.toml --contact-sheet all.png --threads 2"
    done = packwork(f"{LINE} --best-of 3 {more}")
    assert done.exit_code == 0
    assert (folder / "best.svg").read_bytes() == (folder / f"{best}.svg").read_bytes()
    assert f"seed = {best}" in (folder / "best.toml").read_text(encoding="utf-8")
    with Image.open(folder / "all.png") as sheet:
        assert sheet.width > 2 * 240
    worst = min(covered, key=lambda seed: covered[seed])
    packwork(f"{LINE} --best-of 3 --best-by -exact_LC -o worst.svg --threads 1 -q")
    assert (folder / "worst.svg").read_bytes() == (folder / f"{worst}.svg").read_bytes()


@pytest.mark.parametrize(
    ("more", "said"),
    [
        ("--best-of 0", "--best-of: must be"),
        ("--best-of 2 --best-by nonesuch", "--best-by: must be one of coverage, evenness, overlap"),
        ("--best-by LC", "--best-by: is of --best-of"),
        ("--contact-sheet s.png", "--contact-sheet: is of --best-of"),
        ("--best-of 2 --contact-sheet x.svg", "is the same file"),
    ],
)
def test_what_has_no_meaning_is_refused_before_a_run(
    packwork: Callable[..., Result], folder: Path, more: str, said: str
) -> None:
    done = packwork(f"{LINE} -o x.svg {more}")
    assert done.exit_code == 2
    assert said in " ".join(done.output.split())
    assert list(folder.iterdir()) == []
