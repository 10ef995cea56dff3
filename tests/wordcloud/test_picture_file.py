"""The picture that the drop-in's command line writes: whole or not at all."""

from __future__ import annotations

from pathlib import Path

import pytest

from packwork.wordcloud import wordcloud_cli


@pytest.fixture
def text(tmp_path: Path) -> Path:
    place = tmp_path / "text.txt"
    place.write_text("bears and bees", encoding="utf-8")
    return place


def test_what_fails_leaves_the_older_picture(text: Path, tmp_path: Path) -> None:
    kept = tmp_path / "keep.png"
    kept.write_bytes(b"older")
    with pytest.raises(SystemExit):
        wordcloud_cli.run(["--text", str(text), "--background", "bogus", "--imagefile", str(kept)])
    assert kept.read_bytes() == b"older"
    assert len(list(tmp_path.iterdir())) == 2


@pytest.mark.parametrize("place", ["/dev/full", "text.txt", "."])
def test_devices_folders_and_inputs_are_refused(
    text: Path, place: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(text.parent)
    with pytest.raises(SystemExit) as end:
        wordcloud_cli.run(["--text", "text.txt", "--imagefile", place])
    assert text.read_text(encoding="utf-8") == "bears and bees"
    assert "Traceback" not in f"{end.value}{capsys.readouterr().err}"
