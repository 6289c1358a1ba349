"""Paths of files to write: refused before a long run rather than after it."""

from __future__ import annotations

import os
from pathlib import Path

from rapidsim.extras import require
from rapidsim.files import InputError, did_you_mean


def new_trace(name: str) -> Path:
    """The place of a trace.

    Raises:
        InputError: If nothing of that kind can be written there.
    """
    path = new_file(name, (".csv", ".parquet", ".json"))
    if path.suffix.lower() == ".parquet":
        require("pyarrow", f"{path}")
    return path


def new_profile(name: str) -> Path:
    """The place of a profile of the interpreter.

    Raises:
        InputError: If nothing of that kind can be written there.
    """
    return new_file(name, (".prof",))


def new_file(name: str, suffixes: tuple[str, ...]) -> Path:
    """The place of a file with one of some suffixes, refused if it cannot be written there."""
    path = Path(name)
    if path.suffix.lower() not in suffixes:
        raise InputError(f"{path} must end in {' or '.join(suffixes)}")
    if path.is_dir():
        raise InputError(f"{path} cannot be written: it is a folder")
    _require_writable(path, path.parent)
    return path


def new_recording(name: str) -> Path:
    """The place of a recording, refused if it cannot be made or written there."""
    require("rerun", "--record")
    return new_file(name, (".rrd",))


def new_plots(name: str) -> Path:
    """The folder of pictures, refused if they cannot be drawn or written there."""
    require("matplotlib", "--plots")
    return _new_folder(name)


def new_page(name: str) -> Path:
    """The folder of a page with a recording, refused if it cannot be made or written there."""
    require("rerun", "--export")
    return _new_folder(name)


def _new_folder(name: str) -> Path:
    path = Path(name)
    if path.exists() and not path.is_dir():
        raise InputError(f"{path} is a file; a folder is needed")
    _require_writable(path, path if path.exists() else path.parent)
    return path


def _require_writable(path: Path, folder: Path) -> None:
    if not folder.is_dir():
        near = [one.name for one in folder.parent.iterdir()] if folder.parent.is_dir() else []
        raise InputError(
            f"{path} cannot be written: {folder} is not a folder", did_you_mean(folder.name, near)
        )
    if not os.access(folder, os.W_OK | os.X_OK):
        raise InputError(f"{path} cannot be written: the folder {folder} may not be written to")
