"""Files that are none: pipes and devices never keep a reader waiting."""

from __future__ import annotations

import os

import pytest

from packwork.errors import ReadError
from packwork.readers.container import read_container
from packwork.readers.reading import exists, read_bytes, read_text

needs_pipes = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")


@needs_pipes
def test_a_pipe_is_refused_at_once(tmp_path):
    pipe = tmp_path / "pipe.svg"
    os.mkfifo(pipe)
    link = tmp_path / "link.svg"
    link.symlink_to(pipe)
    for path in (pipe, link):
        with pytest.raises(ReadError, match=r"\.svg: is a pipe or a device; give a file"):
            read_bytes(path, 10)
        with pytest.raises(ReadError, match="is a pipe"):
            read_container(path)


@pytest.mark.skipif(not os.path.exists("/dev/zero"), reason="no such device")  # noqa: PTH110
def test_a_device_is_refused():
    with pytest.raises(ReadError, match="device"):
        read_bytes("/dev/zero", 10)


def test_folders_and_missing_files_are_told_apart(tmp_path):
    with pytest.raises(ReadError, match="is a folder"):
        read_bytes(tmp_path, 10)
    with pytest.raises(ReadError, match="no such file"):
        read_text(tmp_path / "none", 10)
    assert exists(tmp_path)
    assert not exists("a\0b")


def test_a_link_to_a_file_is_followed(tmp_path):
    (tmp_path / "real").write_bytes(b"x")
    (tmp_path / "link").symlink_to(tmp_path / "real")
    assert read_bytes(tmp_path / "link", 10) == b"x"
