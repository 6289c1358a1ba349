"""Write `docs/station_keys.md` from the declarations of the station file's tables.

python scripts/build_station_page.py
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import MISSING
from datetime import datetime
from enum import Enum, EnumType
from pathlib import Path
from typing import Any, Literal, get_args, get_origin

from wrap_markdown import wrap

from rapidsim.collisions.geometry import Colour, IgnoredPair, Parent
from rapidsim.controller.cell.conditions import Condition
from rapidsim.controller.cell.conveyor_scripts import ConveyorScript
from rapidsim.controller.cell.description import (
    CrossConnection,
    DescribedFingers,
    Gripper,
    Stimulus,
)
from rapidsim.controller.cell.faults import Fault
from rapidsim.controller.cell.message_queues import QueueSettings
from rapidsim.controller.cell.socket_scripts import SocketStep
from rapidsim.frames.transform import Transform
from rapidsim.json_records.declarations import (
    NumberRange,
    RecordField,
    Valid,
    alternatives,
    is_record,
    marks_of,
    record_fields,
)
from rapidsim.json_records.schema import field_descriptions
from rapidsim.language.robotware import RobotWare
from rapidsim.motion.model import MotionModel
from rapidsim.station.cameras import CameraTable, TargetTable
from rapidsim.station.check import CheckTable
from rapidsim.station.controller import ClockTable, ControllerTable
from rapidsim.station.external_axes import AxisTable
from rapidsim.station.frames import FrameTable
from rapidsim.station.motion import DynamicsTable, MotionTable
from rapidsim.station.object_tables import (
    AttachTable,
    CollisionsTable,
    CylinderTable,
    ObjectTable,
    SinkTable,
    SourceTable,
    SphereTable,
)
from rapidsim.station.robot import RobotTable
from rapidsim.station.searches import SearchTable
from rapidsim.station.signals import SignalEntry
from rapidsim.station.sockets import PeerTable
from rapidsim.station.task_kind import TaskEvent
from rapidsim.station.tasks import TaskTable

PAGE = Path(__file__).parents[1] / "docs" / "station_keys.md"
INTRODUCTION = """\
# Keys of the station file

All tables of `rapidsim.toml` with their keys. [Describe a cell](station.md) shows them in use. A
file for `--io` has those from `[signals]` to `[[search]]`. A key that is missing has the value of
the controller backup, if there is one, else the default. Generated from the source by
`python scripts/build_station_page.py`.
"""
TABLES: Mapping[str, tuple[str, type]] = {
    "controller": ("[controller]", ControllerTable),
    "robot": ("[robot] or [[robot]]", RobotTable),
    "external_axis": ("[[external_axis]]", AxisTable),
    "motion": ("[motion]", MotionTable),
    "dynamics": ("[dynamics]", DynamicsTable),
    "task": ("[[task]]", TaskTable),
    "signals": ("[signals]", SignalEntry),
    "cross": ("[[cross]]", CrossConnection),
    "stimulus": ("[[stimulus]]", Stimulus),
    "fault": ("[[fault]]", Fault),
    "socket": ("[[socket]]", PeerTable),
    "camera": ("[[camera]]", CameraTable),
    "conveyor": ("[[conveyor]]", ConveyorScript),
    "gripper": ("[gripper] or [[gripper]]", Gripper),
    "smart_gripper": ("[[smart_gripper]]", DescribedFingers),
    "search": ("[[search]]", SearchTable),
    "clock": ("[clock]", ClockTable),
    "check": ("[check]", CheckTable),
    "object": ("[[object]]", ObjectTable),
    "attach": ("[[attach]]", AttachTable),
    "source": ("[[source]]", SourceTable),
    "sink": ("[[sink]]", SinkTable),
    "collisions": ("[collisions]", CollisionsTable),
}
INNER: Mapping[type, str] = {
    FrameTable: "Frame",
    QueueSettings: "Message queue",
    SocketStep: "Step",
    TargetTable: "Camera target",
    SphereTable: "Sphere",
    CylinderTable: "Cylinder",
}
"""Tables that are values of keys."""
PHRASES: Mapping[Any, str] = {
    NumberRange.ABOVE_ZERO: "number above 0",
    NumberRange.NOT_NEGATIVE: "number, not negative",
    NumberRange.LEVEL: "number, `true` or `false`",
    str: "text",
    bytes: "text",
    bool: "`true` or `false`",
    int: "number",
    float: "number",
    Path: "path",
    datetime: "date with a time",
    Condition: "condition",
    RobotWare: 'text, such as `"6.15"`',
    Transform: "[frame](#frame)",
    Parent: "text",
    Colour: "text",
    tuple[str, ...]: "list of texts",
    tuple[Path, ...]: "list of paths",
    tuple[str, int]: 'port, or text `"address:port"`',
    tuple[SocketStep, ...]: "list of [steps](#step)",
    tuple[tuple[TargetTable, ...], ...]: "list of lists of [targets](#camera-target)",
    tuple[IgnoredPair, ...]: 'list of `{ between = ["fence", "link 3"], reason = "..." }`',
    tuple[tuple[str, tuple[str, ...]], ...]: "table: pattern to list of texts",
    Mapping[str, float]: "table: signal to value",
    Mapping[str, float | bool | str]: "table: name to value",
    tuple[tuple[TaskEvent, str], ...]: f"table: {', '.join(TaskEvent)} to name of a routine",
    Mapping[str, Any]: "[message queue](#message-queue)",
}
UNITS = {"_mm_s": "mm/s", "_mm": "mm", "_kg": "kg", "_s": "s"}
"""Units by the ends of the fields' names."""


def page() -> str:
    """Return the page: a section for each table."""
    parts = [INTRODUCTION]
    for heading, table in TABLES.values():
        parts += _section(f"`{heading}`", table)
    parts.append("\n## Values that are tables")
    for table, heading in INNER.items():
        parts += _section(heading, table, "###")
    return wrap("\n".join(parts) + "\n")


def _section(heading: str, table: type, level: str = "##") -> Iterator[str]:
    described = field_descriptions(MotionModel) if table in (MotionTable, DynamicsTable) else {}
    described |= field_descriptions(table)
    yield f"\n{level} {heading}\n"
    yield "| key | value | default | |\n|---|---|---|---|"
    for field in record_fields(table):
        text = re.sub(r"\bNone\b", "no key", described.get(field.name, ""))
        text = re.sub(r"(^|\. )no key", r"\1No key", text)
        yield f"| `{field.key}` | {_value(field)} | {_default(field.default)} | {text} |"


def _value(field: RecordField) -> str:
    declared, marks = marks_of(field.type)
    type_, inner = marks_of(alternatives(declared)[0][0])
    phrase = next((PHRASES[one] for one in (*marks, *inner, type_) if one in PHRASES), None)
    unit = next((f" [{unit}]" for end, unit in UNITS.items() if field.name.endswith(end)), "")
    # The problem of a number is what is needed; that of a table is not.
    has_numbers = type_ in (int, float) or get_origin(type_) is tuple
    problems = [mark.problem for mark in marks if isinstance(mark, Valid) and has_numbers]
    needed = [one.removesuffix(" is needed") for one in problems if "{" not in one]
    return "; ".join([(phrase or _form(type_)) + unit, *needed])


def _form(type_: Any) -> str:
    """Return the form of a value by its type."""
    if is_record(type_):
        return f"[{INNER[type_].lower()}](#{INNER[type_].lower()})"
    members: tuple[Any, ...] = tuple(type_) if isinstance(type_, EnumType) else ()
    words = [member.value for member in members] or get_args(type_)
    if members or get_origin(type_) is Literal:
        return ", ".join(f'`"{word}"`' for word in words)
    return "list of numbers" if Ellipsis in words else f"list of {len(words)} numbers"


def _default(value: object) -> str:
    if value is MISSING:
        return "required"
    if isinstance(value, bool):
        return f"`{str(value).lower()}`"
    if isinstance(value, Enum | str):
        text = value.value if isinstance(value, Enum) else value
        return f'`"{text}"`' if text else ""
    if isinstance(value, int | float):
        return f"`{value:g}`" if math.isfinite(value) else ""
    if isinstance(value, tuple) and value and all(isinstance(one, float) for one in value):
        return f"`[{', '.join(f'{one:g}' for one in value)}]`"
    return ""


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
