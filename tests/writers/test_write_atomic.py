from __future__ import annotations

import errno
import os
import stat
import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path

import pytest

from packwork.errors import WriteError
from packwork.writers.atomic import check_outputs, check_writable, write_all, write_atomic

as_root = hasattr(os, "geteuid") and os.geteuid() == 0
needs_user = pytest.mark.skipif(as_root, reason="root may write anywhere")
needs_links = pytest.mark.skipif(os.name == "nt", reason="links need rights on Windows")


@contextmanager
def failing_sync(error: BaseException) -> Iterator[None]:
    """The moment when the bytes are on their way and the name is not yet swapped."""

    def fail(_: int) -> None:
        raise error

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(os, "fsync", fail)
        yield


def names(folder: Path) -> list[str]:
    return sorted(p.name for p in folder.iterdir())


def test_new_file_and_overwriting(tmp_path: Path) -> None:
    path = tmp_path / "out.svg"
    write_atomic(path, b"one")
    write_atomic(str(path), b"two")
    assert path.read_bytes() == b"two"
    assert names(tmp_path) == ["out.svg"]


def test_missing_folders_are_made(tmp_path: Path) -> None:
    path = tmp_path / "a" / "b" / "out.svg"
    check_writable(path)
    assert names(tmp_path) == [], "looking must touch nothing"
    write_atomic(path, b"x")
    assert path.read_bytes() == b"x"


def test_full_disk_leaves_the_old_file_and_nothing_else(tmp_path: Path) -> None:
    path = tmp_path / "out.svg"
    path.write_bytes(b"old")
    full = OSError(errno.ENOSPC, "No space left on device")
    with failing_sync(full), pytest.raises(WriteError, match="disk is full"):
        write_atomic(path, b"new")
    assert path.read_bytes() == b"old"
    assert names(tmp_path) == ["out.svg"]


@pytest.mark.parametrize("stop", [KeyboardInterrupt(), SystemExit(), MemoryError()])
def test_interruption_leaves_the_old_file_and_nothing_else(
    tmp_path: Path, stop: BaseException
) -> None:
    path = tmp_path / "out.svg"
    path.write_bytes(b"old")
    with failing_sync(stop), pytest.raises(type(stop)):
        write_atomic(path, b"new")
    assert path.read_bytes() == b"old"
    assert names(tmp_path) == ["out.svg"]


@pytest.mark.parametrize("stop", [KeyboardInterrupt(), OSError(errno.ENOSPC, "full")])
def test_folders_made_in_vain_are_removed(tmp_path: Path, stop: BaseException) -> None:
    with failing_sync(stop), pytest.raises((KeyboardInterrupt, WriteError)):
        write_atomic(tmp_path / "a" / "b" / "out.svg", b"new")
    assert names(tmp_path) == []


def test_unknown_trouble_is_told_in_its_own_words(tmp_path: Path) -> None:
    odd = OSError(errno.EIO, "Input/output error")
    with failing_sync(odd), pytest.raises(WriteError, match=r"out\.svg: .*Input/output error"):
        write_atomic(tmp_path / "out.svg", b"new")


@pytest.mark.parametrize("act", [check_writable, lambda p: write_atomic(p, b"x")])
class TestRefusals:
    def test_folder(self, tmp_path: Path, act: object) -> None:
        with pytest.raises(WriteError, match="is a folder"):
            act(tmp_path)  # type: ignore[operator]

    def test_file_as_folder(self, tmp_path: Path, act: object) -> None:
        (tmp_path / "file").write_bytes(b"")
        with pytest.raises(WriteError, match="not a folder"):
            act(tmp_path / "file" / "sub" / "out.svg")  # type: ignore[operator]

    def test_long_name(self, tmp_path: Path, act: object) -> None:
        with pytest.raises(WriteError, match="too long"):
            act(tmp_path / ("n" * 300))  # type: ignore[operator]

    @pytest.mark.parametrize("name", ["", "out\0.svg"])
    def test_no_name(self, act: object, name: str) -> None:
        with pytest.raises(WriteError, match="no file name"):
            act(name)  # type: ignore[operator]

    @pytest.mark.skipif(not Path(os.devnull).is_char_device(), reason="no such device")
    def test_device(self, act: object) -> None:
        with pytest.raises(WriteError, match="device"):
            act(os.devnull)  # type: ignore[operator]

    @needs_links
    def test_circle_of_links(self, tmp_path: Path, act: object) -> None:
        (tmp_path / "a").symlink_to(tmp_path / "b")
        (tmp_path / "b").symlink_to(tmp_path / "a")
        with pytest.raises(WriteError, match="circle"):
            act(tmp_path / "a")  # type: ignore[operator]

    @needs_user
    def test_unwritable_folder(self, tmp_path: Path, act: object) -> None:
        tmp_path.chmod(0o500)
        try:
            with pytest.raises(WriteError, match="may not be written to"):
                act(tmp_path / "out.svg")  # type: ignore[operator]
        finally:
            tmp_path.chmod(0o700)

    def test_protected_file(
        self, tmp_path: Path, act: object, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        path = tmp_path / "out.svg"
        path.write_bytes(b"old")
        monkeypatch.setattr(os, "access", lambda p, mode: Path(p) != path)
        with pytest.raises(WriteError, match="protected"):
            act(path)  # type: ignore[operator]
        assert path.read_bytes() == b"old"


def test_folder_without_rights_is_told_beforehand(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "access", lambda *_: False)
    with pytest.raises(WriteError, match="may not be written to"):
        check_writable(tmp_path / "out.svg")


@needs_links
def test_a_link_is_followed(tmp_path: Path) -> None:
    (tmp_path / "link.svg").symlink_to(tmp_path / "real.svg")
    write_atomic(tmp_path / "link.svg", b"x")
    assert (tmp_path / "link.svg").is_symlink()
    assert (tmp_path / "real.svg").read_bytes() == b"x"


@pytest.mark.skipif(os.name == "nt", reason="permissions of POSIX")
def test_permissions_are_kept(tmp_path: Path) -> None:
    path = tmp_path / "out.svg"
    path.write_bytes(b"old")
    path.chmod(0o640)
    write_atomic(path, b"new")
    assert stat.S_IMODE(path.stat().st_mode) == 0o640


def test_writers_at_the_same_time_never_mix(tmp_path: Path) -> None:
    path = tmp_path / "out.svg"
    texts = [bytes([65 + k]) * 200_000 for k in range(8)]
    with ThreadPoolExecutor(4) as pool:
        list(pool.map(lambda text: write_atomic(path, text), texts))
    assert path.read_bytes() in texts
    assert names(tmp_path) == ["out.svg"]


@needs_links
def test_two_names_of_one_file_are_refused(tmp_path: Path) -> None:
    (tmp_path / "link.png").symlink_to(tmp_path / "same.png")
    with pytest.raises(WriteError, match=r"link\.png: is the same file as .*same\.png"):
        check_outputs([tmp_path / "same.png", tmp_path / "b.svg", tmp_path / "link.png"])


@pytest.mark.parametrize("order", [1, -1])
def test_a_file_inside_a_file_is_refused(tmp_path: Path, order: int) -> None:
    paths = [tmp_path / "d" / "a.svg", tmp_path / "d" / "a.svg" / "sub" / "b.png"][::order]
    with pytest.raises(WriteError, match=r"b\.png: lies in .*a\.svg, which is to be a file"):
        check_outputs(paths)
    with pytest.raises(WriteError, match="lies in"):
        write_all([(path, b"x") for path in paths])
    assert names(tmp_path) == []


def test_outputs_side_by_side_pass(tmp_path: Path) -> None:
    check_outputs([tmp_path / "a.svg", tmp_path / "a.png", tmp_path / "a" / "a.svg"])


def test_several_files_are_all_written(tmp_path: Path) -> None:
    paths = [tmp_path / "a" / "b" / "1", tmp_path / "a" / "2", tmp_path / "3"]
    write_all([(path, path.name.encode()) for path in paths])
    assert [path.read_bytes() for path in paths] == [b"1", b"2", b"3"]
    assert names(tmp_path) == ["3", "a"]


@pytest.mark.parametrize("stop", [KeyboardInterrupt(), OSError(errno.ENOSPC, "full")])
def test_no_file_is_written_until_all_are_on_the_disk(
    tmp_path: Path, stop: BaseException, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "old.svg").write_bytes(b"old")
    calls: list[int] = []

    def fail_at_the_second(handle: int) -> None:
        calls.append(handle)
        if len(calls) == 2:
            raise stop

    monkeypatch.setattr(os, "fsync", fail_at_the_second)
    with pytest.raises((KeyboardInterrupt, WriteError), match=r"new\.png: the disk is full|^$"):
        write_all([(tmp_path / "old.svg", b"new"), (tmp_path / "sub" / "new.png", b"new")])
    assert (tmp_path / "old.svg").read_bytes() == b"old"
    assert names(tmp_path) == ["old.svg"]


def test_a_name_that_cannot_be_swapped_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    swap = Path.replace

    def fail_for_b(self: Path, target: Path) -> Path:
        if target.name == "b":
            raise PermissionError(errno.EACCES, "not permitted")
        return swap(self, target)

    monkeypatch.setattr(Path, "replace", fail_for_b)
    with pytest.raises(WriteError, match=r"b: the folder may not be written to"):
        write_all([(tmp_path / name, b"x") for name in "abc"])
    assert names(tmp_path) == ["a"]


def test_what_is_in_place_is_named_when_a_later_name_cannot_be_swapped(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    replace = Path.replace

    def refuse(beside: Path, target: Path) -> Path:
        if target.name == "c.svg":
            raise PermissionError(errno.EACCES, "no")
        return replace(beside, target)

    monkeypatch.setattr(Path, "replace", refuse)
    files = [(tmp_path / name, b"new") for name in ("a.svg", "b.svg", "c.svg")]
    with pytest.raises(WriteError, match=r"written before it: .*a\.svg, .*b\.svg$"):
        write_all(files)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.svg", "b.svg"]


def test_what_a_killed_process_has_left_is_removed_by_the_next(tmp_path: Path) -> None:
    with subprocess.Popen([sys.executable, "-c", ""]) as ended:
        ended.wait()
    gone, here, name = ended.pid, os.getpid(), f"{0:016x}.part"
    ages = {
        f".packwork-{gone}-{name}": 100.0,
        f".packwork-{gone}-f{name[1:]}": 1.0,
        f".packwork-{here}-{name}": 100.0,
        f".packwork-{here}-f{name[1:]}": 1e6,
        ".packwork-mine.part": 1e6,
        "other.part": 1e6,
    }
    for left, age in ages.items():
        (tmp_path / left).write_bytes(b"half")
        os.utime(tmp_path / left, (time.time() - age,) * 2)
    write_atomic(tmp_path / "a.svg", b"new")
    kept = {path.name for path in tmp_path.iterdir()} - {"a.svg"}
    removed = {f".packwork-{here}-f{name[1:]}"}
    if os.name != "nt":
        removed.add(f".packwork-{gone}-{name}")
    assert kept == set(ages) - removed
