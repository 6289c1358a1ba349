"""Where results of earlier checks are kept: a folder of the user's own, safe to delete.

It is not in the folder that is checked: findings that a repository brought along would be believed.
An entry appears whole or not at all; one that cannot be read is none, and a folder that cannot be
written keeps nothing. What was not used for longest goes first when there is too much.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

from rapidsim.values import value_class

FOLDER_VARIABLE = "RAPIDSIM_CACHE_DIR"
MOST_BYTES = 200_000_000
_KEPT_SHARE = 0.8
"""Of these as much is kept when there is too much."""
_SUFFIX = ".json"
_PART = ".part"


def cache_folder(environment: Mapping[str, str], platform: str = sys.platform) -> Path:
    """The folder that the environment names, else where the system keeps what can be made anew."""
    if named := environment.get(FOLDER_VARIABLE):
        return Path(named)
    if platform == "win32":
        local = environment.get("LOCALAPPDATA")
        return (Path(local) if local else Path.home() / "AppData" / "Local") / "rapidsim" / "Cache"
    if platform == "darwin":
        return Path.home() / "Library" / "Caches" / "rapidsim"
    return Path(environment.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "rapidsim"


@value_class(frozen=True, slots=True)
class ResultStore:
    """Texts by their keys, in the files of a folder."""

    folder: Path

    def text(self, key: str) -> str | None:
        """The text kept under a key; None if there is none."""
        file = self._file(key)
        try:
            text = file.read_text(encoding="utf-8")
            # Used now, so that others go first.
            os.utime(file)
        except (OSError, ValueError):
            return None
        return text

    def keep_text(self, key: str, text: str) -> None:
        """Keep a text, if the folder can be written."""
        file = self._file(key)
        part = file.with_name(f"{key}.{os.getpid()}{_PART}")
        with suppress(OSError):
            self.folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            try:
                part.write_text(text, encoding="utf-8")
                part.replace(file)
            finally:
                part.unlink(missing_ok=True)

    def value(self, key: str) -> object | None:
        """The value kept under a key; None if there is none."""
        text = self.text(key)
        try:
            return None if text is None else json.loads(text)
        except ValueError:
            return None

    def keep(self, key: str, value: object) -> None:
        """Keep what JSON can say."""
        self.keep_text(key, json.dumps(value, separators=(",", ":")))

    def tidy(self, most_bytes: int = MOST_BYTES) -> None:
        """Remove what was not used for longest, if there is too much."""
        with suppress(OSError):
            found = []
            with os.scandir(self.folder) as entries:
                for entry in entries:
                    if entry.name.endswith((_SUFFIX, _PART)):
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

    def _file(self, key: str) -> Path:
        return self.folder / f"{key}{_SUFFIX}"
