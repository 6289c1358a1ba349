"""A program's files stay in the home folder, whatever it calls them."""

import os
from pathlib import Path

import pytest

from rapidsim.controller.cell.home_folder import HomeFolder
from rapidsim.language.error_numbers import ERR_FILEACC, ERR_FILEOPEN
from rapidsim.language.errors import RapidError
from rapidsim.language.files import FileMode


def test_home_names_and_bare_names_mean_the_same_place(tmp_path: Path) -> None:
    home = HomeFolder(tmp_path)
    home.open_file("HOME:/log/a.txt", FileMode.WRITE).write(b"one\n")
    home.close_all()
    assert (tmp_path / "log" / "a.txt").read_bytes() == b"one\n"
    assert home.open_file("log/a.txt", FileMode.READ).read_line() == b"one"
    assert home.written() == ((str(tmp_path / "log" / "a.txt"), 4),)
    home.close_all()


@pytest.mark.parametrize(
    "path",
    [
        "../outside.txt",
        "HOME:/../outside.txt",
        "HOME:/a/../../outside.txt",
        "HOME:\\..\\outside.txt",
        "HOME:",
        "HOME:/",
        "TEMP:/../../a.txt",
        "TEMP:",
        "flp1:a.txt",
        "com1:",
        "a\0b",
    ],
)
def test_paths_outside_are_refused(tmp_path: Path, path: str) -> None:
    root = tmp_path / "home"
    root.mkdir()
    with pytest.raises(RapidError) as caught:
        HomeFolder(root).open_file(path, FileMode.WRITE)
    assert caught.value.errno == ERR_FILEOPEN
    assert list(tmp_path.rglob("*.txt")) == []


def test_absolute_paths_are_taken_inside(tmp_path: Path) -> None:
    root = tmp_path / "home"
    home = HomeFolder(root)
    home.open_file("/etc/rapidsim-test.txt", FileMode.WRITE)
    home.close_all()
    assert (root / "etc" / "rapidsim-test.txt").exists()


def test_links_that_leave_are_refused(tmp_path: Path) -> None:
    root, outside = tmp_path / "home", tmp_path / "outside"
    root.mkdir()
    outside.mkdir()
    (root / "way_out").symlink_to(outside)
    (root / "file_out").symlink_to(outside / "b.txt")
    home = HomeFolder(root)
    for path in ("way_out/a.txt", "file_out"):
        with pytest.raises(RapidError):
            home.open_file(path, FileMode.WRITE)
    assert list(outside.iterdir()) == []


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
def test_pipes_and_folders_never_hang(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "folder").mkdir()
    home = HomeFolder(tmp_path)
    for path in ("pipe", "folder"):
        with pytest.raises(RapidError):
            home.open_file(path, FileMode.READ)


def test_missing_files_and_closed_files_say_so(tmp_path: Path) -> None:
    home = HomeFolder(tmp_path)
    with pytest.raises(RapidError, match=r"missing\.txt: no such file"):
        home.open_file("missing.txt", FileMode.READ)
    file = home.open_file("a.txt", FileMode.WRITE)
    file.close()
    file.close()
    with pytest.raises(RapidError, match="closed") as caught:
        file.write(b"x")
    assert caught.value.errno == ERR_FILEACC


def test_without_a_home_folder_files_cannot_be_opened() -> None:
    with pytest.raises(RapidError, match="--home"):
        HomeFolder(None).open_file("a.txt", FileMode.READ)


def test_append_keeps_what_is_there(tmp_path: Path) -> None:
    home = HomeFolder(tmp_path)
    for text in (b"a", b"b"):
        home.open_file("log.txt", FileMode.APPEND).write(text)
        home.close_all()
    reader = home.open_file("log.txt", FileMode.READ)
    assert reader.read(10) == b"ab"
    reader.rewind()
    assert reader.read(1) == b"a"
    home.close_all()
