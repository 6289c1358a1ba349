"""The tables [controller] and [clock]."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path
from typing import Annotated

from rapidsim.language.robotware import RobotWare, read_robotware
from rapidsim.station.declared_tables import ReadBy
from rapidsim.station.toml_reader import Reader, Table
from rapidsim.values import value_class


def _version(reader: Reader, table: Table, path: str, key: str) -> RobotWare | None:
    text = reader.text(table, path, key)
    version = None if text is None else read_robotware(text)
    if text is not None and version is None:
        reader.wrong(f"{path}.{key}", f"`{text}` is not a version", 'such as "6.15" or "7.13"')
    return version


@value_class(frozen=True, slots=True)
class ControllerTable:
    """The table [controller]."""

    robotware: Annotated[RobotWare | None, ReadBy(_version)] = None
    """Version; newer features are errors."""
    stubs: tuple[Path, ...] = ()
    """Modules in place of libraries that the program lacks: they declare the libraries' routines,
    all tasks have them, and each call reports that the stub was executed."""


@value_class(frozen=True, slots=True)
class ClockTable:
    """The table [clock]."""

    start: datetime | None = None
    """Date and time that the controller's clock shows at time zero, without a zone."""
