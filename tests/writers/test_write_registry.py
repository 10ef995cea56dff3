from __future__ import annotations

import json
from pathlib import Path

import pytest

from packwork.errors import RecipeError, WriteError
from packwork.scene.layout import Layout
from packwork.writers import SvgOptions, WriteOptions, check_output, write


@pytest.mark.parametrize(
    ("name", "beginning"),
    [
        ("a.svg", b"<?xml"),
        ("a.PNG", b"\x89PNG"),
        ("a.pdf", b"%PDF"),
        ("a.dxf", b"  0\nSECTION"),
        ("a.geojson", b'{"type"'),
        ("a.json", b'{"type"'),
    ],
)
def test_the_ending_picks_the_format(
    three: Layout, tmp_path: Path, name: str, beginning: bytes
) -> None:
    check_output(tmp_path / name)
    write(three, tmp_path / name, WriteOptions(png_side_px=32))
    assert (tmp_path / name).read_bytes().startswith(beginning)


def test_options_reach_their_writer(three: Layout, tmp_path: Path) -> None:
    write(three, tmp_path / "a.svg", WriteOptions(svg=SvgOptions(flatten=True)))
    assert "<use" not in (tmp_path / "a.svg").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", ["a.bmp", "a", ".svg", "a.svg.gz"])
def test_unknown_ending(three: Layout, tmp_path: Path, name: str) -> None:
    for act in (check_output, lambda path: write(three, path)):
        with pytest.raises(
            WriteError, match=r"(use one of|all are) \.svg, \.png, \.jpg, \.jpeg, \.webp, \.tif"
        ):
            act(tmp_path / name)
    assert not list(tmp_path.iterdir())


def test_a_refused_option_leaves_the_old_file(three: Layout, tmp_path: Path) -> None:
    path = tmp_path / "a.png"
    path.write_bytes(b"old")
    with pytest.raises(RecipeError):
        write(three, path, WriteOptions(png_side_px=0))
    assert path.read_bytes() == b"old"


def test_same_layout_same_bytes(three: Layout, tmp_path: Path) -> None:
    for ending in ("svg", "geojson", "png", "pdf", "dxf"):
        for name in ("a", "b"):
            write(three, tmp_path / f"{name}.{ending}")
        first, second = ((tmp_path / f"{n}.{ending}").read_bytes() for n in "ab")
        assert first == second
    assert json.loads((tmp_path / "a.geojson").read_text(encoding="utf-8"))


def test_all_packages_that_a_format_lacks_are_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda _: None)
    line = r'needs the packages typst and pikepdf; install them: pip install "packwork\[pdf\]"$'
    with pytest.raises(WriteError, match=line):
        check_output(tmp_path / "a.pdf")
