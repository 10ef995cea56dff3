"""Runs held against the files that are about to be written of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, replace
from pathlib import Path

from packwork import pipeline, verify, writers
from packwork.scene.layout import Layout


def faults_in(
    drawn: Sequence[tuple[Path, bytes]], layout: Layout, options: writers.WriteOptions
) -> list[str]:
    """Parts of a layout's promise that the text of a file breaks, a sentence each."""
    return [
        f"{path.name}: {fault}"
        for path, data in drawn
        for fault in verify.faults_in_file(data, path, layout, options)
    ]


def on_trust_in(drawn: Sequence[tuple[Path, bytes]], layout: Layout) -> list[str]:
    """Parts of the files that are not held against what was measured, a sentence each."""
    return [
        f"{path.name}: {one}" for path, _ in drawn for one in verify.on_trust_in_file(path, layout)
    ]


def held_against_files(
    run: pipeline.Run, drawn: Sequence[tuple[Path, bytes]], options: writers.WriteOptions
) -> pipeline.Run:
    """A run that is certified if the texts of its files are, measured by themselves."""
    if not run.certified:
        return run
    faults = faults_in(drawn, run.layout, options)
    return replace(run, certified=False, broken=(*run.broken, *faults)) if faults else run


def painted_in(
    run: pipeline.Run, drawn: Sequence[tuple[Path, bytes]], advice: list[str]
) -> dict[str, int] | None:
    """Pixels that the first SVG paints outside or twice, and a line where a certified one does."""
    data = next((data for path, data in drawn if path.suffix.lower() == ".svg"), None)
    if data is None or len(data) > verify.PAINTED_BYTES:
        return None
    painted = verify.painted_pixels(data, run.layout, is_own=True)
    if run.certified and (painted.outside or painted.double):
        advice.append(f"{painted}")
    return asdict(painted)
