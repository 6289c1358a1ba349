"""Files of a controller: folders by `$NAME`, from which no path leads out.

`$HOME` is the home folder; the other disks are folders in it with their names, as for a program,
unless the RAM disk has its own folder. Files outside, by `..`, an absolute path or a link, do not
exist, nor do pipes and devices. What clients write is limited together with what programs write.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator, Mapping, Set
from contextlib import contextmanager, suppress
from datetime import datetime
from pathlib import Path
from typing import Final

from rapidsim.controller.cell.home_folder import CAUTION, DiskLimit
from rapidsim.language.errors import RapidError
from rapidsim.server.messages import Answer, Item, RefusedRequest
from rapidsim.server.resources.codes import (
    BAD_PARAMETER,
    LATER_NO_FILE,
    LATER_NO_VOLUME,
    NOT_FOUND,
    refused,
)
from rapidsim.values import value_class

DISKS: Final = ("HOME", "TEMP", "RAMDISK", "BACKUP")
"""Folders that clients reach by `$NAME`."""
_ROOT: Final = "/fileservice/"
_UPLOAD: Final = ".upload-"
"""Prefix of files that are not complete yet."""
_STAMP = "%Y-%m-%d T %H:%M:%S"


@value_class(frozen=True, slots=True)
class FileService:
    """Access to the files of the disks."""

    home: Path
    ramdisk: Path | None
    """None if it is in the home folder."""
    limit: DiskLimit

    def read(self, address: str) -> bytes | Answer:
        """Return a file's bytes, or the entries of a folder.

        Raises:
            RefusedRequest: If neither exists.
        """
        with _missing_if_refused(address):
            place = self._place(address)
            if place.is_dir():
                entries = (one for one in sorted(place.iterdir()) if _is_file_or_folder(one))
                return Answer(resources=tuple(_item(address, one) for one in entries))
            if place in self._roots() and not place.exists():
                return Answer(
                    resources=()
                )  # A folder for programs is made when the first writes into it.
            if not place.is_file():
                raise _missing(address)
            with os.fdopen(os.open(place, os.O_RDONLY | CAUTION), "rb") as stream:
                return stream.read()

    def write(self, address: str, content: bytes | memoryview) -> bool:
        """Write a file completely or not at all; return whether it is new.

        Raises:
            RefusedRequest: If it cannot be written, or the disk is full.
        """
        with _missing_if_refused(address):
            place = self._place(address)
            is_new = not place.exists()
        if not is_new and not place.is_file():
            raise refused(BAD_PARAMETER, f"{address} is no file")
        try:
            old = 0 if is_new else place.stat().st_size
            self._reserve(place, len(content) - old)
            place.parent.mkdir(parents=True, exist_ok=True)
            handle, temporary = tempfile.mkstemp(dir=place.parent, prefix=_UPLOAD)
            try:
                with os.fdopen(handle, "wb") as stream:
                    stream.write(content)
                Path(temporary).replace(place)
            except BaseException:
                with suppress(OSError):
                    Path(temporary).unlink()
                raise
        except OSError as error:
            raise refused(BAD_PARAMETER, f"{address} cannot be written: {error.strerror}") from None
        return is_new

    def is_below_a_disk(self, address: str) -> bool:
        """Whether an address is inside a disk other than HOME."""
        disk, _, rest = address.partition("/")
        name = disk.lstrip("$").rstrip(":").upper()
        return bool(rest.strip("/")) and name in DISKS and name != "HOME"

    def home_files(self) -> Iterator[tuple[str, Path]]:
        """Yield each file of HOME, but for those of the other disks, with its path in HOME."""
        return _files(self.home, {self._folder(disk) for disk in DISKS} - {self.home})

    def write_folder(self, address: str, files: Mapping[str, bytes | Path]) -> None:
        """Write a new folder with files, or copies, by paths in it, completely or not at all.

        Raises:
            RefusedRequest: If there is such a folder, it cannot be written, or the disk is full.
        """
        with _missing_if_refused(address):
            place = self._place(address)
            if place.exists():
                raise refused(BAD_PARAMETER, f"{address} is there already")
            sizes = (
                len(one) if isinstance(one, bytes) else one.stat().st_size for one in files.values()
            )
            self._reserve(place, sum(sizes))
            place.parent.mkdir(parents=True, exist_ok=True)
            temporary = Path(tempfile.mkdtemp(dir=place.parent, prefix=_UPLOAD))
            try:
                for name, content in files.items():
                    self._reserve(temporary / name)
                    (temporary / name).parent.mkdir(parents=True, exist_ok=True)
                    if isinstance(content, bytes):
                        (temporary / name).write_bytes(content)
                    else:
                        shutil.copyfile(content, temporary / name, follow_symlinks=False)
                temporary.chmod(0o755)
                temporary.replace(place)
            except BaseException:
                shutil.rmtree(temporary, ignore_errors=True)
                raise

    def remove(self, address: str) -> None:
        """Remove a file, or a folder with all its contents.

        Raises:
            RefusedRequest: If it does not exist, or is a disk.
        """
        with _missing_if_refused(address):
            place = self._place(address)
            if place in self._roots():
                raise refused(BAD_PARAMETER, f"{address} cannot be removed")
            if not _is_file_or_folder(place):
                raise _missing(address)
            contents = [place, *place.rglob("*")] if place.is_dir() else [place]
            sizes = [one.lstat().st_size for one in contents if one.is_file()]
            if place.is_dir():
                shutil.rmtree(place)
            else:
                place.unlink()
            self.limit.release(sum(sizes), len(contents))

    def change(self, address: str, action: str, name: str) -> bool:
        """Create a folder in a folder, or rename or copy a file or a folder.

        Args:
            address: That of the file or folder.
            action: create, rename or copy.
            name: Name in the folder; that of a copy may be an address from the root on.

        Returns:
            Whether it is a folder.

        Raises:
            RefusedRequest: If the change is impossible, or the disk is full.
        """
        with _missing_if_refused(address):
            place, target = self._place(address), _target(address, action, name)
            other = place if target is None else self._place(target)
            if target is None or other == place or other.exists():
                raise refused(BAD_PARAMETER, f"`{name}` is there already, or no name")
            is_folder = place.is_dir()
            match action:
                case "create":
                    self._reserve(other)
                    other.mkdir(parents=True)
                case "copy" if is_folder:
                    self.write_folder(target, dict(_files(place)))
                case "copy":
                    if not place.is_file():
                        raise _missing(address)
                    self._reserve(other, place.stat().st_size)
                    shutil.copyfile(place, other, follow_symlinks=False)
                case "rename":
                    place.rename(other)
                case _:
                    raise refused(BAD_PARAMETER, f"files have no action {action}")
        return is_folder

    def _reserve(self, place: Path, count: int = 0) -> None:
        """Use more bytes of the disk, for a file or folder that may be new.

        Raises:
            RefusedRequest: If the disk is full.
        """
        try:
            self.limit.use(max(0, count))
            self.limit.release(max(0, -count))
            try:
                self.limit.make(place)
            except RapidError:
                self.limit.release(count)
                raise
        except RapidError as error:
            raise refused(BAD_PARAMETER, error.message) from None

    def _roots(self) -> tuple[Path, ...]:
        return (self.home, *(self._folder(disk) for disk in DISKS))

    def _folder(self, disk: str) -> Path:
        if disk == "RAMDISK" and self.ramdisk is not None:
            return self.ramdisk
        return self.home if disk == "HOME" else self.home / disk

    def _place(self, address: str) -> Path:
        """Return the path of an address on this computer's disk.

        Raises:
            RefusedRequest: If it is not a file of this controller.
        """
        disk, *parts = [part for part in address.split("/") if part] or [""]
        root = self._root(disk.lstrip("$").rstrip(":").upper())
        if root is None:
            raise refused(NOT_FOUND, f"{address} is not there", LATER_NO_VOLUME)
        if any(_leads_away(part) for part in parts):
            raise _missing(address)
        place = root
        for part in parts:
            place = _without_case(place, part)
            if place.is_symlink():
                raise _missing(address)
        return place

    def _root(self, disk: str) -> Path | None:
        if disk not in DISKS:
            return None
        place = self._folder(disk)
        return None if place.is_symlink() else place


def _target(address: str, action: str, name: str) -> str | None:
    """Return the address that a change names; None if it is no name."""
    if action == "copy" and name.startswith(_ROOT):
        return name.removeprefix(_ROOT)
    if action == "create":
        return f"{address}/{name}" if name.strip("/") and not name.startswith("/") else None
    return f"{address.rpartition('/')[0]}/{name}" if name and "/" not in name else None


def _files(folder: Path, without: Set[Path] = frozenset()) -> Iterator[tuple[str, Path]]:
    """Yield each file below a folder, but for those in some folders, with its path in it."""
    pending = [folder]
    while pending:
        for one in sorted(pending.pop().iterdir()):
            if not _is_file_or_folder(one) or _leads_away(one.name) or one in without:
                continue
            if one.is_dir():
                pending.append(one)
            else:
                yield one.relative_to(folder).as_posix(), one


def path_of_programs(address: str) -> str:
    """Convert an address to the notation of programs: `$HOME/a.mod` becomes `HOME:/a.mod`."""
    disk, _, rest = address.partition("/")
    name = disk.lstrip("$").rstrip(":").upper()
    return f"{name}:/{rest}" if name in DISKS else address


def _is_file_or_folder(place: Path) -> bool:
    return not place.is_symlink() and (place.is_file() or place.is_dir())


@contextmanager
def _missing_if_refused(address: str) -> Iterator[None]:
    """Answer that a file does not exist if the system gives no access to it, or to such a name.

    Raises:
        RefusedRequest: For any error of the system.
    """
    try:
        yield
    except OSError:
        raise _missing(address) from None


def _leads_away(part: str) -> bool:
    return part in (".", "..") or any(one in part for one in "\\:\0") or part.startswith(_UPLOAD)


def _without_case(folder: Path, name: str) -> Path:
    """Return the path of a name in a folder with its actual case: controllers ignore case."""
    exact = folder / name
    if not exact.exists() and folder.is_dir():
        for one in folder.iterdir():
            if one.name.lower() == name.lower():
                return one
    return exact


def _item(folder: str, place: Path) -> Item:
    stat = place.lstat()
    stamp = datetime.fromtimestamp(stat.st_mtime).strftime(_STAMP)
    fields = {"fs-cdate": stamp, "fs-mdate": stamp, "fs-readonly": "false"}
    href = f"fileservice/{folder}/{place.name}"
    if place.is_dir():
        return Item("fs-dir", place.name, fields, href=href)
    return Item("fs-file", place.name, {**fields, "fs-size": str(stat.st_size)}, href=href)


def _missing(address: str) -> RefusedRequest:
    return refused(NOT_FOUND, f"{address} is not there", LATER_NO_FILE)
