"""The files of a program: where their paths lead, what may be done with them, and how many."""

from __future__ import annotations

from pathlib import Path

import pytest

from rapidsim.controller.cell.home_folder import HomeFolder
from rapidsim.language.errors import RapidError
from rapidsim.language.files import FileMode


def test_files_go_back_to_where_they_were(tmp_path: Path) -> None:
    root = tmp_path / "home"
    home = HomeFolder(root)
    empty = home.snapshot()
    assert empty is not None
    assert (empty.content, empty.positions) == ({}, ())
    log = home.open_file("log.txt", FileMode.WRITE)
    log.write(b"one\n")
    home.open_file("kept.txt", FileMode.WRITE).write(b"kept")
    before = home.snapshot()
    assert before is not None
    log.write(b"two\n")
    assert home.snapshot() is not None  # Written to the disk.
    home.open_file("new/late.txt", FileMode.WRITE).write(b"late")
    (root / "kept.txt").unlink()
    home.restore(before)
    assert (root / "log.txt").read_bytes() == b"one\n"
    assert (root / "kept.txt").read_bytes() == b"kept"
    assert not (root / "new" / "late.txt").exists()
    log.write(b"three\n")
    assert home.snapshot() is not None  # Written to the disk.
    assert (root / "log.txt").read_bytes() == b"one\nthree\n"
    home.close_all()
    after = home.snapshot()
    assert after is not None
    assert after.positions == ()
    home.restore(empty)
    assert [one for one in root.rglob("*") if one.is_file()] == []


@pytest.mark.parametrize(
    ("path", "place"),
    [
        ("a.txt", "home/a.txt"),
        ("HOME:/a.txt", "home/a.txt"),
        ("home:a.txt", "home/a.txt"),
        ("HOME/a.txt", "home/a.txt"),
        ("HOME:\\b\\a.txt", "home/b/a.txt"),
        ("c:/a.txt", "home/C/a.txt"),
        ("usbdisk1:a.txt", "home/USBDISK1/a.txt"),
        ("/temp:/a.txt", "home/TEMP/a.txt"),
        ("RAMDISK:/a.txt", "ram/a.txt"),
        ("HOME:/b/../a.txt", "home/a.txt"),
        ("HOME:/../a.txt", "HOME:/../a.txt lies outside the home folder"),
        ("RAMDISK:/../home/a.txt", "RAMDISK:/../home/a.txt lies outside the home folder"),
        ("HOME:/", "HOME:/ lies outside the home folder"),
        ("RAMDISK:", "RAMDISK: lies outside the home folder"),
        ("c:/../../a.txt", "c:/../../a.txt lies outside the home folder"),
        ("temp:/", "temp:/ lies outside the home folder"),
        ("flp1:/a.txt", "flp1:/a.txt: only disks are simulated, as HOME:"),
        ("a b:/a.txt", "a b:/a.txt: only disks are simulated, as HOME:"),
        ("HOME:/a\0", "'HOME:/a\\x00' is not a file name"),
        ("HOME:/loop", "HOME:/loop is a link to itself"),
        ("HOME:/folder", "HOME:/folder: is a directory"),
        ("HOME:/away/a.txt", "HOME:/away/a.txt lies outside the home folder"),
    ],
)
def test_where_a_path_leads(path: str, place: str, tmp_path: Path) -> None:
    for one in ("home/folder", "ram", "other"):
        (tmp_path / one).mkdir(parents=True)
    (tmp_path / "home" / "loop").symlink_to("loop")
    (tmp_path / "home" / "away").symlink_to(tmp_path / "other")
    home = HomeFolder(tmp_path / "home", tmp_path / "ram")
    message = ""
    try:
        home.open_file(path, FileMode.WRITE).close()
    except RapidError as error:
        message = error.message
    written = [one.relative_to(tmp_path) for one in tmp_path.rglob("*") if one.is_file()]
    assert (message or str(*written)) == place
    assert not (message and written)


def test_a_file_is_read_or_written_while_it_is_open(tmp_path: Path) -> None:
    home = HomeFolder(tmp_path)
    log = home.open_file("log.txt", FileMode.WRITE)
    log.write(b"one\r\ntwo")
    with pytest.raises(RapidError, match=r"log.txt is open to be written, not read"):
        log.read(1)
    log.close()
    log.close()
    with pytest.raises(RapidError, match=r"log.txt is closed"):
        log.write(b"")
    with pytest.raises(RapidError, match=r"there is no file none.txt"):
        home.read("none.txt", 10)
    assert home.lacks
    assert home.read("log.txt", 8)[1] == b"one\r\ntwo"
    with pytest.raises(RapidError, match=r"log.txt has more than 7 bytes"):
        home.read("log.txt", 7)
    again = home.open_file("log.txt", FileMode.READ)
    assert [again.read_line() for _ in range(3)] == [b"one", b"two", None]
    again.rewind()
    assert again.read(2) == b"on"
    with pytest.raises(RapidError, match=r"log.txt is open to be read, not written"):
        again.write(b"x")
    for number in range(99):
        home.open_file(f"{number}.txt", FileMode.APPEND)
    with pytest.raises(RapidError, match="100 files are open already"):
        home.open_file("more.txt", FileMode.APPEND)
    again.close()
    home.open_file("more.txt", FileMode.APPEND)
    home.close_all()


def test_a_full_disk_takes_nothing_more(tmp_path: Path) -> None:
    home = HomeFolder(tmp_path)
    log = home.open_file("log.txt", FileMode.WRITE)
    home.disk.use(home.disk.free - 3)
    log.write(b"abc")
    with pytest.raises(RapidError, match="the disk is full: a run may write"):
        log.write(b"d")
    home.disk.release(1)
    log.write(b"d")
    home.disk.release(10)
    home.disk.is_full = True
    assert home.disk.free == 0
    with pytest.raises(RapidError, match="the disk is full"):
        log.write(b"e")
    with pytest.raises(RapidError, match="the disk is full"):
        home.open_file("other.txt", FileMode.WRITE)
    home.open_file("log.txt", FileMode.APPEND)
    home.close_all()


def test_without_a_home_folder_there_are_no_files() -> None:
    with pytest.raises(RapidError, match=r"a.txt: the run has no home folder"):
        HomeFolder(None).open_file("a.txt", FileMode.READ)
