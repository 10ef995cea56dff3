"""Files that a page sends: under safe names, with limits."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from hypothesis import given
from hypothesis import strategies as st

from packwork.errors import ReadError
from packwork.studio import files as module
from packwork.studio.files import Uploads, safe_name


@pytest.fixture
def uploads() -> Iterator[Uploads]:
    made = Uploads()
    yield made
    made.close()


def test_files_of_one_name_do_not_meet(uploads: Uploads) -> None:
    batch = uploads.new_batch()
    for data in (b"one", b"two"):
        uploads.add(batch, "a/b/cat.svg", data)
    assert sorted(p.name for p in uploads.folder(batch).iterdir()) == ["cat 2.svg", "cat.svg"]


@pytest.mark.parametrize("batch", ["", ".", "..", "0" * 16, "../" * 5, "0" * 15, "zz"])
def test_batches_that_were_not_made_are_refused(uploads: Uploads, batch: str) -> None:
    with pytest.raises(ReadError, match="drop them again"):
        uploads.add(batch, "cat.svg", b"")


def test_limits_are_kept(uploads: Uploads, monkeypatch: pytest.MonkeyPatch) -> None:
    batch = uploads.new_batch()
    monkeypatch.setattr(module, "MOST_BYTES", 4)
    monkeypatch.setattr(module, "MOST_FILES", 2)
    with pytest.raises(ReadError, match="larger than"):
        uploads.add(batch, "cat.svg", b"12345")
    for _ in range(2):
        uploads.add(batch, "cat.svg", b"1234")
    with pytest.raises(ReadError, match="one too many"):
        uploads.add(batch, "cat.svg", b"1")


@given(st.text())
def test_any_name_is_made_one_that_stays_in_its_folder(name: str) -> None:
    safe = safe_name(name)
    assert safe
    assert len(safe.encode()) <= module.LONGEST_NAME
    assert not set(safe) & set("/\\\0:")
    assert safe not in {".", ".."}
