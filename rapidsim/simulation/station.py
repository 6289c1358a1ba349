"""Read the station file `rapidsim.toml`: which robot, where it starts, how its controller moves it.

Every key is checked; what this version does not do yet is an error that says so, never ignored.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TypeGuard

from rapidsim.files import InputError, did_you_mean
from rapidsim.motion.model import Corner, MotionModel

FILE_NAME = "rapidsim.toml"

_KEYS: Mapping[str, tuple[str, ...]] = {
    "": ("robot", "motion", "task", "signals", "stimulus", "check"),
    "robot": ("model", "urdf", "base", "start"),
    "robot.base": ("position", "quaternion"),
    "motion": (
        "acceleration_time",
        "acceleration",
        "axis_speed",
        "filter_time",
        "fine_dwell",
        "corner",
        "parabola_acceleration",
    ),
    "task": ("name", "modules"),
    "check": ("ignore", "cycle-budget"),
}
_NOT_YET = {
    "signals": "signals cannot be declared in a station file yet; the program creates its own",
    "stimulus": "inputs cannot be stimulated from a station file yet",
    "check.cycle-budget": "cycle budgets are not checked yet",
}


@dataclass(frozen=True, slots=True)
class Station:
    """What a station file says; without one, the defaults of everything."""

    file: Path | None = None
    robot: str | None = None
    """A name of the catalogue or the path of a URDF file; None where the file names no robot."""
    start_joints_deg: tuple[float, ...] | None = None
    model: MotionModel = field(default_factory=MotionModel)
    task: str = "T_ROB1"
    modules: tuple[Path, ...] = ()
    """Modules of the task that are loaded in addition to those a command names."""
    ignore: tuple[str, ...] = ()
    """Selectors of rules that `check` leaves out."""


def find_station(paths: Iterable[str]) -> Path | None:
    """The station file next to the first path that is a file or folder, or above it."""
    for path in paths:
        if path != "-" and (place := Path(path)).exists():
            folder = place.resolve() if place.is_dir() else place.resolve().parent
            return next((f / FILE_NAME for f in (folder, *folder.parents) if _is_here(f)), None)
    return None


def read_station(file: Path) -> Station:
    """Read a station file.

    Raises:
        InputError: If it is missing, not TOML, or says something that is unknown, of the wrong kind
            or not simulated yet.
    """
    try:
        table = tomllib.loads(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"{file} cannot be read: {error.strerror or error}") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(f"{file} is not TOML: {error}") from error
    reader = _Reader(file)
    reader.known("", table)
    station = Station(file)
    station = _with_robot(station, reader, reader.table(table, "robot"))
    station = replace(station, model=_model(reader, reader.table(table, "motion")))
    station = _with_task(station, reader, table.get("task", []))
    check = reader.table(table, "check")
    return replace(station, ignore=reader.texts(check, "check", "ignore"))


def _is_here(folder: Path) -> bool:
    try:
        return (folder / FILE_NAME).is_file()
    except OSError:
        return False


def _with_robot(station: Station, reader: _Reader, robot: Mapping[str, object]) -> Station:
    if "model" in robot and "urdf" in robot:
        raise reader.wrong("robot", "give `model` or `urdf`, not both")
    base = reader.table(robot, "base", "robot.base")
    position = reader.numbers(base, "robot.base", "position", 3) or (0.0, 0.0, 0.0)
    quaternion = reader.numbers(base, "robot.base", "quaternion", 4) or (1.0, 0.0, 0.0, 0.0)
    turned = any(abs(q) > 1e-9 for q in quaternion[1:])
    if any(position) or turned:
        raise reader.wrong(
            "robot.base", "a robot that stands off the world frame is not simulated yet"
        )
    name = reader.text(robot, "robot", "model")
    urdf = reader.text(robot, "robot", "urdf")
    if urdf is not None:
        name = str(reader.file.parent / urdf)
    start = reader.numbers(robot, "robot", "start", None)
    return replace(station, robot=name, start_joints_deg=start)


def _model(reader: _Reader, motion: Mapping[str, object]) -> MotionModel:
    default = MotionModel()
    acceleration = reader.numbers(motion, "motion", "acceleration", None)
    if acceleration and min(acceleration) <= 0.0:
        raise reader.wrong("motion.acceleration", "accelerations are above 0")
    axis_speed = reader.numbers(motion, "motion", "axis_speed", None)
    if axis_speed and min(axis_speed) <= 0.0:
        raise reader.wrong("motion.axis_speed", "axis speeds are above 0")
    corner: Corner
    match reader.text(motion, "motion", "corner") or default.corner:
        case "c2" | "parabola" as known:
            corner = known
        case other:
            raise reader.wrong("motion.corner", f"`{other}` is neither `c2` nor `parabola`")
    return MotionModel(
        acceleration_time=reader.positive(motion, "acceleration_time", default.acceleration_time),
        acceleration=tuple(math.radians(a) for a in acceleration) if acceleration else None,
        max_speed=tuple(math.radians(v) for v in axis_speed) if axis_speed else None,
        filter_time=reader.not_negative(motion, "filter_time", default.filter_time),
        fine_dwell=reader.not_negative(motion, "fine_dwell", default.fine_dwell),
        corner=corner,
        parabola_acceleration=reader.positive(
            motion, "parabola_acceleration", default.parabola_acceleration
        ),
    )


def _with_task(station: Station, reader: _Reader, tasks: object) -> Station:
    if not isinstance(tasks, list) or not all(isinstance(task, dict) for task in tasks):
        raise reader.wrong("task", "tasks are written as [[task]]")
    if len(tasks) > 1:
        raise reader.wrong(
            "task", "several tasks are not simulated together yet; keep one [[task]]"
        )
    for task in tasks:
        reader.known("task", task)
        name = reader.text(task, "task", "name") or station.task
        modules = reader.texts(task, "task", "modules")
        places = tuple(reader.file.parent / module for module in modules)
        return replace(station, task=name, modules=places)
    return station


@dataclass(frozen=True, slots=True)
class _Reader:
    """Takes values out of tables and says what is wrong with them, by file and key."""

    file: Path

    def wrong(self, key: str, message: str, help: str | None = None) -> InputError:
        """The error for a key."""
        return InputError(f"{self.file}: {key}: {message}", help)

    def known(self, table: str, values: Mapping[str, object]) -> None:
        """Refuse keys that are not known or not done yet."""
        for key in values:
            path = f"{table}.{key}" if table else key
            if path in _NOT_YET:
                raise self.wrong(path, _NOT_YET[path])
            if key not in _KEYS[table]:
                help = did_you_mean(key, _KEYS[table]) or f"known here: {', '.join(_KEYS[table])}"
                raise self.wrong(path, "no such key", help)

    def table(
        self, values: Mapping[str, object], key: str, path: str | None = None
    ) -> Mapping[str, object]:
        """A table with known keys; empty where it is missing."""
        table = values.get(key, {})
        if not isinstance(table, dict):
            raise self.wrong(path or key, f"a table is needed, as in [{path or key}]")
        self.known(path or key, table)
        return table

    def text(self, values: Mapping[str, object], table: str, key: str) -> str | None:
        """A string; None where it is missing."""
        value = values.get(key)
        if value is not None and not isinstance(value, str):
            raise self.wrong(f"{table}.{key}", "text in quotes is needed")
        return value

    def texts(self, values: Mapping[str, object], table: str, key: str) -> tuple[str, ...]:
        """A list of strings; empty where it is missing."""
        value = values.get(key, [])
        if not isinstance(value, list) or not all(isinstance(one, str) for one in value):
            raise self.wrong(f"{table}.{key}", "a list of texts is needed")
        return tuple(value)

    def positive(self, motion: Mapping[str, object], key: str, default: float) -> float:
        """A number above 0 of the motion table."""
        value = self.not_negative(motion, key, default)
        if value == 0.0:
            raise self.wrong(f"motion.{key}", "a number above 0 is needed")
        return value

    def not_negative(self, motion: Mapping[str, object], key: str, default: float) -> float:
        """A number of the motion table that is 0 or above."""
        value = motion.get(key, default)
        if not _is_number(value) or value < 0.0:
            raise self.wrong(f"motion.{key}", "a number that is not negative is needed")
        return float(value)

    def numbers(
        self, values: Mapping[str, object], table: str, key: str, count: int | None
    ) -> tuple[float, ...] | None:
        """A list of numbers, `count` of them unless it is None; None where it is missing."""
        value = values.get(key)
        if value is None:
            return None
        numbers = [one for one in value if _is_number(one)] if isinstance(value, list) else []
        if not numbers or numbers != value:
            raise self.wrong(f"{table}.{key}", "a list of numbers is needed")
        if count is not None and len(numbers) != count:
            raise self.wrong(f"{table}.{key}", f"{count} numbers are needed, not {len(numbers)}")
        return tuple(float(one) for one in numbers)


def _is_number(value: object) -> TypeGuard[float]:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
