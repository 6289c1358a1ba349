"""The table [controller]: what runs the program, and what is installed there.

robotware = "7.13"
stubs = ["stubs/gripper.mod"]

Stub modules declare the routines of libraries that a repository lacks: all tasks have them, and
each call says that it did what the stub says.
"""

from __future__ import annotations

from pathlib import Path

from rapidsim.language.robotware import RobotWare, read_robotware
from rapidsim.station.toml_reader import Reader, Table

_KEYS = ("robotware", "stubs")


def read_stubs(reader: Reader, controller: Table) -> tuple[Path, ...]:
    """The stub modules; what is wrong is noted."""
    names = reader.texts(controller, "controller", "stubs")
    files = (reader.inside(name, "controller.stubs") for name in names)
    return tuple(file for file in files if file is not None)


def read_robotware_of(reader: Reader, controller: Table) -> RobotWare | None:
    """The RobotWare; None where the file does not say."""
    reader.known("controller", controller, _KEYS)
    text = reader.text(controller, "controller", "robotware")
    if text is None:
        return None
    version = read_robotware(text)
    if version is None:
        reader.wrong(
            "controller.robotware", f"`{text}` is not a version", 'such as "6.15" or "7.13"'
        )
    return version
