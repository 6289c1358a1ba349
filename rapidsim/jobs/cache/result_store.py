"""Store of results of earlier checks and runs: a folder of the user, safe to delete.

It is not in the folder that is checked: otherwise findings that a repository contains would be
trusted. An entry is written completely or not at all; an unreadable one counts as missing, and a
read-only folder stores nothing. The least recently used entries are removed first.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

from rapidsim.files import InputError, input_bytes
from rapidsim.values import value_class

FOLDER_VARIABLE = "RAPIDSIM_CACHE_DIR"
MOST_BYTES = 200_000_000
_KEPT_SHARE = 0.8
"""Share of `MOST_BYTES` that remains after a clean-up."""
_SUFFIX, _BYTES = ".json", ".bin"
_PART = ".part"


def cache_folder(environment: Mapping[str, str], platform: str = sys.platform) -> Path:
    """Return the folder that the environment names, else the system's folder for caches."""
    if named := environment.get(FOLDER_VARIABLE):
        return Path(named)
    if platform == "win32":
        local = environment.get("LOCALAPPDATA")
        return (Path(local) if local else Path.home() / "AppData" / "Local") / "rapidsim" / "Cache"
    if platform == "darwin":
        return Path.home() / "Library" / "Caches" / "rapidsim"
    return Path(environment.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "rapidsim"


def store_of_user() -> ResultStore | None:
    """Return the store of the user; None for one without a home."""
    try:
        return ResultStore(cache_folder(os.environ))
    except RuntimeError:
        return None


@value_class(frozen=True, slots=True)
class ResultStore:
    """Store of texts and bytes by key, in the files of a folder."""

    folder: Path

    def text(self, key: str) -> str | None:
        """Return the text stored under a key; None if there is no such text."""
        data = self.data(key, _SUFFIX)
        try:
            return None if data is None else data.decode("utf-8")
        except UnicodeDecodeError:
            return None

    def keep_text(self, key: str, text: str) -> None:
        """Store a text, if the folder can be written."""
        self.keep_data(key, text.encode("utf-8"), _SUFFIX)

    def data(self, key: str, suffix: str = _BYTES) -> bytes | None:
        """Return the bytes stored under a key; None if there are none."""
        file = self.folder / f"{key}{suffix}"
        try:
            data = input_bytes(file)
            # Mark as used, so that other entries are removed first.
            os.utime(file)
        except (OSError, InputError):
            return None
        return data

    def keep_data(self, key: str, data: bytes, suffix: str = _BYTES) -> None:
        """Store bytes, if the folder can be written."""
        file = self.folder / f"{key}{suffix}"
        part = file.with_name(f"{key}.{os.getpid()}{_PART}")
        with suppress(OSError):
            self.folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            try:
                part.write_bytes(data)
                part.replace(file)
            finally:
                part.unlink(missing_ok=True)

    def value(self, key: str) -> object | None:
        """Return the value stored under a key; None if there is no such value."""
        text = self.text(key)
        try:
            return None if text is None else json.loads(text)
        except (ValueError, RecursionError):
            return None

    def keep(self, key: str, value: object) -> None:
        """Store a value that JSON can represent."""
        self.keep_text(key, json.dumps(value, separators=(",", ":")))

    def tidy(self, most_bytes: int = MOST_BYTES) -> None:
        """Remove the least recently used entries, if the store is too large."""
        with suppress(OSError):
            found = []
            with os.scandir(self.folder) as entries:
                for entry in entries:
                    if entry.name.endswith((_SUFFIX, _BYTES, _PART)):
                        status = entry.stat()
                        found.append((status.st_mtime_ns, status.st_size, entry.path))
            left = sum(size for _, size, _ in found)
            if left <= most_bytes:
                return
            for _, size, path in sorted(found):
                if left <= _KEPT_SHARE * most_bytes:
                    return
                Path(path).unlink(missing_ok=True)
                left -= size
