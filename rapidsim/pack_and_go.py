"""RobotStudio's Pack & Go, `.rspag`: an archive with the backups of a station's controllers.

A backup is the folder `Backups/NAME`, in newer archives `Controller Data/NAME`. It is unpacked into
a temporary folder that is removed when the process ends; its files are displayed with their path in
the archive, `cell.rspag!NAME/RAPID/...`.
"""

from __future__ import annotations

import atexit
import errno
import io
import lzma
import struct
import zipfile
import zlib
from collections.abc import Iterator
from hashlib import sha256
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory

_ROOTS = ("backups", "controller data")
_PARTS = ("rapid", "syspar", "backinfo", "home")
_MOST_BYTES = 200_000_000
_MOST_FILES = 10_000
_DAMAGED = (
    zipfile.BadZipFile,
    zlib.error,
    lzma.LZMAError,
    struct.error,
    EOFError,
    RuntimeError,
    ValueError,
    LookupError,
    OverflowError,
    MemoryError,
    OSError,
)
"""Errors that zipfile raises for invalid bytes of an archive."""
_OF_DISK = (errno.ENOSPC, errno.EDQUOT, errno.EACCES, errno.EROFS, errno.EIO)
_unpacked: dict[str, Path] = {}
"""Temporary folders of this process, by fingerprint of the archive."""
_shown: dict[Path, str] = {}
"""Display names of these folders."""


class PackedStationError(ValueError):
    """An unusable archive; the message has the reason."""


def unpacked_backup(data: bytes, name: str, controller: str | None) -> Path:
    """Return the folder of a backup in an archive.

    Args:
        data: The archive.
        name: Display name of the archive.
        controller: The name of the controller, without case; None for the only one.

    Raises:
        PackedStationError: If it is damaged, too large, or does not contain that backup.
        OSError: If it cannot be unpacked.
    """
    found = _backups(data)
    names = [entry.name for entry in found]
    if controller is not None:
        found = [entry for entry in found if entry.name.lower() == controller.lower()]
    if len(found) == 1:
        _shown[found[0]] = f"{name}!{found[0].name}"
        return found[0]
    if not names:
        raise PackedStationError("holds no backup of a controller")
    listed = ", ".join(f"{name}!{one}" for one in names)
    if controller is None:
        raise PackedStationError(
            f"holds {len(names)} controllers; name one: {listed}; check --each checks all"
        )
    raise PackedStationError(f"holds no controller {controller}; there are: {listed}")


def controllers(data: bytes) -> tuple[str, ...]:
    """Return the names of the controllers whose backups an archive contains.

    Raises:
        PackedStationError: If it is damaged or too large.
        OSError: If it cannot be unpacked.
    """
    return tuple(entry.name for entry in _backups(data))


def _backups(data: bytes) -> list[Path]:
    """Return the folders of all backups in an archive, sorted."""
    key = sha256(data).hexdigest()
    if key not in _unpacked:
        _unpacked[key] = _unpack(data)
    return sorted(entry for entry in _unpacked[key].iterdir() if entry.is_dir())


def shown_name(file: Path) -> str:
    """Display name of a file: its path in the archive if it was unpacked from one."""
    for folder, name in _shown.items():
        if file.is_relative_to(folder):
            return f"{name}/{file.relative_to(folder).as_posix()}"
    return str(file)


def _unpack(data: bytes) -> Path:
    temporary = TemporaryDirectory(prefix="rapidsim-")
    folder = Path(temporary.name)
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            for path, member in _members(archive):
                _write(folder.joinpath(*path.parts), archive.read(member))
    except BaseException as error:
        temporary.cleanup()
        of_disk = isinstance(error, OSError) and error.errno in _OF_DISK
        if isinstance(error, PackedStationError) or of_disk or not isinstance(error, _DAMAGED):
            raise
        raise PackedStationError(f"is no archive that can be read: {error}") from None
    atexit.register(temporary.cleanup)
    return folder


def _write(file: Path, content: bytes) -> None:
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_bytes(content)


def _members(archive: zipfile.ZipFile) -> Iterator[tuple[PurePosixPath, zipfile.ZipInfo]]:
    """Yield the members of backups, with their paths from the name of the controller."""
    count = size = 0
    for member in archive.infolist():
        parts = PurePosixPath(member.filename.replace("\\", "/")).parts
        wanted = len(parts) > 3 and parts[0].lower() in _ROOTS and parts[2].lower() in _PARTS
        if member.is_dir() or not wanted or ".." in parts or any(":" in part for part in parts):
            continue
        count, size = count + 1, size + member.file_size
        if count > _MOST_FILES or size > _MOST_BYTES:
            raise PackedStationError("holds more than a backup does")
        yield PurePosixPath(*parts[1:]), member
