"""Lines for cutters on the command line."""

from __future__ import annotations

import json
from pathlib import Path

QUICK = "--canvas 100mm --levels 24 --epochs 4 -q"


def test_a_kiss_cut_makes_its_own_room(folder: Path, packwork) -> None:
    result = packwork(
        f"fill circle star heart -n 4 {QUICK} --kiss-cut 2mm -o a.dxf -o a.pdf --bleed 3mm "
        "--report r.json --save-recipe r.toml"
    )
    assert result.exit_code == 0, result.output
    assert "padding is 4.004mm, twice the --kiss-cut" in result.stderr
    assert 'padding = "4.004mm"' in (folder / "r.toml").read_text(encoding="utf-8")
    report = json.loads((folder / "r.json").read_text(encoding="utf-8"))
    assert report["certified"]
    assert report["metrics"]["exact"]["min_gap"] >= 4.0
    assert packwork("measure a.dxf -q").exit_code == 0


def test_too_little_padding_is_refused_before_the_run(folder: Path, packwork) -> None:
    result = packwork(f"fill circle star -n 4 {QUICK} --padding 1mm --kiss-cut 2mm -o a.dxf")
    assert result.exit_code == 2
    assert "--kiss-cut: 2mm on either side needs a --padding of 4.004 mm" in result.stderr
    assert not list(folder.iterdir())


def test_a_bleed_without_a_pdf_is_refused(packwork) -> None:
    result = packwork("fill circle star --bleed 3mm -o a.svg")
    assert result.exit_code == 2
    assert "--bleed is for a PDF" in result.stderr
    assert packwork("fill circle star --kiss-cut wide").exit_code == 2
