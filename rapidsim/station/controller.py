"""The table [controller]: the RobotWare version, and stubs of missing libraries.

robotware = "7.13"
stubs = ["stubs/gripper.mod"]

Stub modules declare the routines of libraries that a repository lacks: they are loaded into all
tasks, and each call reports that the stub was executed.
"""

from __future__ import annotations

from pathlib import Path

from rapidsim.language.robotware import RobotWare, read_robotware
from rapidsim.station.toml_reader import Reader, Table

_KEYS = ("robotware", "stubs")


def read_stubs(reader: Reader, controller: Table) -> tuple[Path, ...]:
    """Read the stub modules; errors are collected in the reader."""
    names = reader.texts(controller, "controller", "stubs")
    files = (reader.inside(name, "controller.stubs") for name in names)
    return tuple(file for file in files if file is not None)


def read_robotware_of(reader: Reader, controller: Table) -> RobotWare | None:
    """Read the RobotWare version; None if the file does not specify it."""
    reader.note_unknown_keys("controller", controller, _KEYS)
    text = reader.text(controller, "controller", "robotware")
    if text is None:
        return None
    version = read_robotware(text)
    if version is None:
        reader.wrong(
            "controller.robotware", f"`{text}` is not a version", 'such as "6.15" or "7.13"'
        )
    return version
