"""Folders for what may be lost: whose they are, where, and what is in them."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from packwork import folders
from packwork.folders import Store, is_private, private_folder

POSIX = pytest.mark.skipif(not hasattr(os, "geteuid"), reason="Windows knows no such rights")
NOBODY = 54_321
"""Number of a user that is in no list of users."""


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv(folders.VARIABLE, str(tmp_path / "mine"))
    return tmp_path / "mine"


def test_an_entry_comes_back_and_only_as_it_was_put(place: Path) -> None:
    store = Store("some", 1_000)
    assert store.get("a") is None
    store.put("a", b"whole")
    assert store.get("a") == b"whole"
    assert store.get("b") is None
    (entry,) = (place / "packwork" / "some").iterdir()
    entry.write_bytes(entry.read_bytes()[:-1] + b"?")
    assert store.get("a") is None
    assert not entry.exists()


def test_what_was_not_used_for_longest_goes_first(place: Path) -> None:
    store = Store("some", 400)
    for number in range(4):
        store.put(str(number), bytes(100))
    folder = place / "packwork" / "some"
    old = folder / "abc.part"
    old.touch()
    for path in folder.iterdir():
        os.utime(path, (1_000, 1_000))
    assert store.get("2") is not None
    # Another process, which looks at the size before its first entry.
    Store("some", 400).put("new", b"")
    assert not old.exists()
    assert [store.get(key) is not None for key in ("0", "1", "2", "3", "new")].count(True) == 2
    assert store.get("2") is not None


def test_all_that_is_put_is_bounded_and_seldom_looked_through(
    place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    store, looks = Store("some", 64_000), list[int]()
    shorten = Store._shorten

    def counted(self: Store, folder: Path) -> int:
        looks.append(shorten(self, folder))
        return looks[-1]

    monkeypatch.setattr(Store, "_shorten", counted)
    sizes = list[int]()
    for number in range(500):
        store.put(str(number), bytes(300))
        if number % 50 == 49:
            sizes.append(sum(path.stat().st_size for path in (place / "packwork/some").iterdir()))
    # With a digest each, and what is written before the next look.
    assert max(sizes) < 1.2 * 64_000
    assert store.get("499") is not None
    assert len(looks) < 40


def test_nothing_is_kept_where_that_is_switched_off(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(folders.VARIABLE, "off")
    assert private_folder("some") is None
    store = Store("some", 1_000)
    store.put("a", b"")
    assert store.get("a") is None


def test_another_variable_is_heeded_after_ours(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv(folders.VARIABLE, raising=False)
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "theirs"))
    assert private_folder("k", "NUMBA_CACHE_DIR") == tmp_path / "theirs" / "packwork" / "k"
    monkeypatch.setenv(folders.VARIABLE, str(tmp_path / "ours"))
    assert private_folder("k", "NUMBA_CACHE_DIR") == tmp_path / "ours" / "packwork" / "k"


@POSIX
def test_what_a_person_made_is_no_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(folders.VARIABLE, raising=False)
    for name in ("cache", "data"):
        (tmp_path / name).mkdir(mode=0o700)
        monkeypatch.setenv(f"XDG_{name.upper()}_HOME", str(tmp_path / name))
    if sys.platform != "darwin":
        assert private_folder("k") == tmp_path / "cache/packwork/k"
        assert private_folder("k", kind="data") == tmp_path / "data/packwork/k"
    monkeypatch.setenv(folders.VARIABLE, folders.OFF)
    assert private_folder("k", kind="data") is None


def test_a_relative_folder_is_passed_over(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv(folders.VARIABLE, "here")
    monkeypatch.setenv("XDG_CACHE_HOME", "~")
    found = private_folder("some")
    assert found is not None
    assert tmp_path not in found.parents
    assert not list(tmp_path.iterdir())


@POSIX
def test_folders_that_others_may_write_to_are_not_private(tmp_path: Path) -> None:
    mine = tmp_path / "mine"
    mine.mkdir(mode=0o700)
    assert is_private(mine)
    link = tmp_path / "link"
    link.symlink_to(mine)
    assert not is_private(link)
    mine.chmod(0o770)
    assert not is_private(mine)
    mine.chmod(0o700)
    tmp_path.chmod(0o777)
    assert not is_private(mine)
    # Where only owners may rename what is theirs, as in /tmp.
    for mode in (0o1777, 0o1770):
        tmp_path.chmod(mode)
        assert is_private(mine)


@POSIX
@pytest.mark.parametrize("mode", [0o770, 0o775, 0o702, 0o720, 0o777, 0o2775])
def test_below_a_folder_that_a_group_or_all_may_write_to_nothing_is_private(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, mode: int
) -> None:
    deep = tmp_path / "shared" / "one" / "two" / "mine"
    deep.mkdir(parents=True, mode=0o700)
    for folder in (deep.parent, deep.parent.parent):
        folder.chmod(0o700)
    deep.chmod(0o700)
    (tmp_path / "shared").chmod(0o700)
    assert is_private(deep)
    (tmp_path / "shared").chmod(mode)
    assert not is_private(deep)
    monkeypatch.setenv(folders.VARIABLE, str(deep))
    found = private_folder("some")
    assert found is not None
    assert tmp_path / "shared" not in found.parents


@POSIX
def test_links_on_the_way_are_followed_and_where_they_lie_is_looked_at(tmp_path: Path) -> None:
    (tmp_path / "home" / "mine").mkdir(parents=True)
    (tmp_path / "home" / "mine").chmod(0o700)
    (tmp_path / "home").chmod(0o700)
    (tmp_path / "shared").mkdir()
    (tmp_path / "shared" / "link").symlink_to(tmp_path / "home")
    (tmp_path / "link").symlink_to("shared/../shared/link")
    (tmp_path / "round").symlink_to("round")
    for way in (tmp_path / "link" / "mine", tmp_path / "shared" / "link" / "mine"):
        (tmp_path / "shared").chmod(0o755)
        assert is_private(way)
        (tmp_path / "shared").chmod(0o775)
        # Whoever writes to that folder may let the link lead elsewhere.
        assert not is_private(way)
    assert is_private(tmp_path / "home" / "mine")
    assert not folders.is_private(tmp_path / "home" / "mine" / ".." / "mine" / ".." / ".." / "link")


@POSIX
@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() != 0, reason="gives files away")
def test_below_a_folder_or_link_of_another_user_nothing_is_private(tmp_path: Path) -> None:
    (tmp_path / "theirs" / "mine").mkdir(parents=True)
    (tmp_path / "theirs" / "mine").chmod(0o700)
    (tmp_path / "theirs").chmod(0o755)
    (tmp_path / "link").symlink_to("theirs")
    os.chown(tmp_path / "link", NOBODY, -1, follow_symlinks=False)
    assert is_private(tmp_path / "theirs" / "mine")
    assert not is_private(tmp_path / "link" / "mine")
    os.chown(tmp_path / "theirs", NOBODY, -1)
    assert not is_private(tmp_path / "theirs" / "mine")


@POSIX
def test_folders_are_made_for_this_user_alone_whatever_the_mask(place: Path) -> None:
    before = os.umask(0o002)
    try:
        found = private_folder("new")
    finally:
        os.umask(before)
    assert found == place / "packwork" / "new"
    assert not any(one.stat().st_mode & 0o077 for one in (found, found.parent, place))


@POSIX
def test_a_folder_that_is_not_ours_alone_is_not_used(place: Path) -> None:
    (place / "packwork" / "some").mkdir(parents=True)
    (place / "packwork" / "some").chmod(0o777)
    found = private_folder("some")
    assert found != place / "packwork" / "some"


PROGRAM = (
    "import os, pwd, sys\n"
    "from packwork.folders import private_folder\n"
    "from packwork.fonts import _folders\n"
    "if len(sys.argv) > 1: os.setgid(int(sys.argv[1])); os.setuid(int(sys.argv[1]))\n"
    "_folders()\n"
    "print(private_folder('some'))"
)


def found_by(tmp_path: Path, *arguments: str, **environment: str) -> Path:
    """Folder that a process of its own finds, with nothing but this environment."""
    (tmp_path / "current").mkdir(exist_ok=True)
    source = str(Path(folders.__file__).parents[1])
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, *arguments],
        env={"PYTHONPATH": source, **environment},
        cwd=tmp_path / "current", capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert not list((tmp_path / "current").iterdir())
    return Path(done.stdout.strip())


@POSIX
def test_a_home_that_cannot_be_written_to_gives_way_to_a_temporary_folder(tmp_path: Path) -> None:
    (tmp_path / "no-folder").touch()
    found = found_by(tmp_path, HOME=str(tmp_path / "no-folder"), TMPDIR=str(tmp_path))
    assert found == tmp_path / f"packwork-{os.getuid()}" / "some"
    # Where that is somebody else's, one for this process alone, which is gone with it.
    (tmp_path / f"packwork-{os.getuid()}" / "some").chmod(0o777)
    found = found_by(tmp_path, HOME=str(tmp_path / "no-folder"), TMPDIR=str(tmp_path))
    assert found.parent == tmp_path
    assert not found.exists()


@POSIX
def test_a_home_that_is_missing_is_not_made(tmp_path: Path) -> None:
    found = found_by(tmp_path, HOME=str(tmp_path / "home"), TMPDIR=str(tmp_path))
    assert found == tmp_path / f"packwork-{os.getuid()}" / "some"
    assert not (tmp_path / "home").exists()


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() != 0, reason="only root may")
def test_a_user_in_no_list_has_a_folder_too() -> None:
    with tempfile.TemporaryDirectory(dir="/tmp") as folder:
        own = Path(folder)
        (own / "temporary").mkdir()
        (own / "temporary").chmod(0o1777)
        own.chmod(0o755)
        (own / "current").mkdir()
        found = found_by(own, str(NOBODY), TMPDIR=str(own / "temporary"))
        assert found == own / "temporary" / f"packwork-{NOBODY}" / "some"
        assert found.stat().st_uid == NOBODY
