"""RobotStudio's Pack & Go, `.rspag`: an archive that holds the backups of a station's controllers.

Its files are unpacked once into a folder of the user's own below that for temporary files, which is
named after what the archive holds: the same archive has the same files each time.
"""

from __future__ import annotations

import hashlib
import io
import os
import stat
import tempfile
import zipfile
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

_BACKUPS = "backups"
_PARTS = ("rapid", "syspar", "backinfo", "home")
_MOST_BYTES = 200_000_000
_MOST_FILES = 10_000


class PackedStationError(ValueError):
    """An archive that cannot be used; the text says why."""


def unpacked_backup(data: bytes, name: str) -> Path:
    """The folder of the one backup that an archive holds.

    Args:
        data: The archive.
        name: What its folder is called.

    Raises:
        PackedStationError: If it is no archive, too large, or holds no backup or several.
        OSError: If it cannot be unpacked.
    """
    folder = _own_room() / hashlib.sha256(data).hexdigest()[:16] / name
    if not folder.is_dir():
        _unpack(data, folder)
    found = sorted(entry for entry in folder.iterdir() if entry.is_dir())
    if len(found) != 1:
        names = ", ".join(one.name for one in found)
        raise PackedStationError(
            f"holds {len(found)} backups ({names}); unpack it and name one"
            if found
            else "holds no backup of a controller"
        )
    return found[0]


def _unpack(data: bytes, folder: Path) -> None:
    folder.parent.mkdir(exist_ok=True)
    # Whole or not at all, also where two runs unpack at once.
    part = Path(tempfile.mkdtemp(dir=folder.parent))
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            for path, member in _members(archive):
                target = part.joinpath(*path.parts)
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_bytes(archive.read(member))
    except (zipfile.BadZipFile, NotImplementedError, RuntimeError, EOFError) as error:
        raise PackedStationError(f"is no archive that can be read: {error}") from None
    try:
        part.rename(folder)
    except OSError:
        if not folder.is_dir():
            raise


def _members(archive: zipfile.ZipFile) -> Iterator[tuple[PurePosixPath, zipfile.ZipInfo]]:
    """What belongs to backups, with its path below `Backups`."""
    count = size = 0
    for member in archive.infolist():
        parts = PurePosixPath(member.filename.replace("\\", "/")).parts
        wanted = len(parts) > 3 and parts[0].lower() == _BACKUPS and parts[2].lower() in _PARTS
        if member.is_dir() or not wanted or ".." in parts or any(":" in part for part in parts):
            continue
        count, size = count + 1, size + member.file_size
        if count > _MOST_FILES or size > _MOST_BYTES:
            raise PackedStationError("holds more than a backup does")
        yield PurePosixPath(*parts[1:]), member


def _own_room() -> Path:
    """A folder that nobody else can write to."""
    own = getattr(os, "getuid", lambda: "user")()
    room = Path(tempfile.gettempdir()) / f"rapidsim-{own}"
    try:
        room.mkdir(mode=0o700)
    except FileExistsError:
        facts = room.lstat()
        is_ours = facts.st_uid == own or not hasattr(os, "getuid")
        if not stat.S_ISDIR(facts.st_mode) or not is_ours:
            return Path(tempfile.mkdtemp())
    return room
