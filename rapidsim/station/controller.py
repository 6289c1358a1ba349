"""The table [controller]: what runs the program."""

from __future__ import annotations

from rapidsim.language.robotware import RobotWare, read_robotware
from rapidsim.station.toml_reader import Reader, Table

_KEYS = ("robotware",)


def read_controller(reader: Reader, controller: Table) -> RobotWare | None:
    """The RobotWare; None where the file does not say."""
    reader.known("controller", controller, _KEYS)
    text = reader.text(controller, "controller", "robotware")
    if text is None:
        return None
    version = read_robotware(text)
    if version is None:
        reader.wrong("controller.robotware", f"`{text}` is no version", 'such as "6.15" or "7.13"')
    return version
