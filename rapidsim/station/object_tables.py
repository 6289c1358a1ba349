"""The tables [[object]], [[attach]] and [collisions] as the station file has them."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path
from typing import Annotated

from rapidsim.collisions.geometry import GREY, Colour, IgnoredPair, Parent, ParentKind
from rapidsim.collisions.shape import Filling
from rapidsim.controller.cell.conditions import Condition
from rapidsim.frames.transform import Transform
from rapidsim.json_records.declarations import (
    AboveZero,
    Excludes,
    Key,
    NotNegative,
    OneOf,
    Required,
    Valid,
    whole_number,
)
from rapidsim.motion.configurations.targets import MM
from rapidsim.station.declared_tables import ReadBy
from rapidsim.station.frames import Frame
from rapidsim.station.toml_reader import Reader, Table
from rapidsim.station.units import UnitKey
from rapidsim.values import value_class

SHAPES = ("box", "cylinder", "sphere", "capsule", "plane", "mesh")
"""Keys of an [[object]], one of which is needed."""
LEAST_M, MOST_M = 1e-5, 100.0
_MOST_AWAY_M = 1000.0
_MOST_AXES = 6
_ONE_CAUSE = "`when` waits for signals, the other keys for the clock; give one"
_COLOUR = re.compile("#[0-9a-fA-F]{6}")


def _are_lengths(lengths_mm: Iterable[float]) -> bool:
    return all(LEAST_M <= one * MM <= MOST_M for one in lengths_mm)


_NO_LENGTHS = f"lengths are from {LEAST_M / MM:g} to {MOST_M / MM:g} mm"


@value_class(frozen=True, slots=True)
class SphereTable:
    """The size of a sphere [mm]."""

    diameter: AboveZero
    """[mm]."""

    def is_possible(self) -> bool:
        """Whether the lengths are those of a body of a cell."""
        return _are_lengths((self.diameter,))

    @property
    def radius_m(self) -> float:
        """Half of the diameter [m]."""
        return 0.5 * self.diameter * MM


@value_class(frozen=True, slots=True)
class CylinderTable(SphereTable):
    """The size of a cylinder, or of a capsule with both ends [mm]."""

    length: AboveZero
    """[mm]."""

    def is_possible(self) -> bool:
        """Whether the lengths are those of a body of a cell."""
        return _are_lengths((self.diameter, self.length))


def _parent(reader: Reader, table: Table, path: str, key: str) -> Parent | None:
    text = reader.text(table, path, key)
    if not text:
        return None
    kind, _, name = (part.strip() for part in text.partition(":"))
    if kind in (ParentKind.WORLD, ParentKind.TOOL) and not name:
        return Parent(ParentKind(kind))
    if kind == ParentKind.WOBJ and name:
        return Parent(ParentKind.WOBJ, name=name)
    if kind == ParentKind.LINK and name.isdecimal() and len(name) < 3:
        return Parent(ParentKind.LINK, link=int(name))
    if kind == ParentKind.UNIT and name:
        unit, _, axis = (part.strip() for part in name.partition(":"))
        if unit and (not axis or (axis.isdecimal() and 0 < int(axis) <= _MOST_AXES)):
            return Parent(ParentKind.UNIT, name=unit, link=int(axis or 0))
    reader.wrong(
        f"{path}.{key}",
        f"`{text}` is none of `world`, `wobj:NAME`, `link:NUMBER`, `tool`, `unit:NAME`, "
        "`unit:NAME:AXIS`",
    )
    return None


def _holder(reader: Reader, table: Table, path: str, key: str) -> Parent | None:
    text = reader.text(table, path, key)
    kind, _, name = (part.strip() for part in (text or "").partition(":"))
    if kind == ParentKind.TOOL:
        return Parent(ParentKind.TOOL, name=name)
    if kind == ParentKind.UNIT:
        return _parent(reader, table, path, key)
    if text is not None:
        reader.wrong(
            f"{path}.{key}",
            f"`{text}` is none of `tool`, `tool:NAME`, `unit:NAME`, `unit:NAME:AXIS`",
        )
    return None


def _colour(reader: Reader, table: Table, path: str, key: str) -> Colour | None:
    text = reader.text(table, path, key)
    if text is None:
        return None
    if _COLOUR.fullmatch(text) is None:
        reader.wrong(f"{path}.{key}", f"`{text}` is not a colour, such as `#6080a0`")
        return None
    red, green, blue = bytes.fromhex(text[1:])
    return red, green, blue


def _plane(reader: Reader, table: Table, path: str, key: str) -> bool:
    if table[key] is not True:
        reader.wrong(f"{path}.{key}", "plane = true; everything below its x and y axes is solid")
    return True


def _is_near(pose: Transform) -> bool:
    return bool((abs(pose.translation) <= _MOST_AWAY_M).all())


@value_class(frozen=True, slots=True)
class ObjectTable:
    """A table [[object]]: a body of the cell."""

    name: Annotated[str, Required("is missing")]
    """Its name."""
    box: Annotated[tuple[float, float, float] | None, Valid(_are_lengths, _NO_LENGTHS)] = None
    """Lengths of the edges [mm]."""
    cylinder: Annotated[
        CylinderTable | None,
        Valid(CylinderTable.is_possible, _NO_LENGTHS),
    ] = None
    """Its axis is z."""
    sphere: Annotated[SphereTable | None, Valid(SphereTable.is_possible, _NO_LENGTHS)] = None
    """Its diameter."""
    capsule: Annotated[
        CylinderTable | None,
        Valid(CylinderTable.is_possible, _NO_LENGTHS),
    ] = None
    """A cylinder whose ends are half spheres, which count in its length."""
    plane: Annotated[bool, ReadBy(_plane)] = False
    """Everything below the x and y axes of its frame."""
    mesh: Path | None = None
    """File of a shape."""
    unit: UnitKey = None
    """Length unit of the mesh; None if its format defines it."""
    scale: AboveZero = 1.0
    """Further factor on the lengths of the mesh."""
    filling: Annotated[
        Filling, OneOf(f"`{{}}` is none of {', '.join(Filling)}", folds_case=False)
    ] = Filling.SOLID
    """Parts of the mesh that are checked."""
    pose: Annotated[Frame | None, Valid(_is_near, "more than a kilometre away")] = None
    """Frame of its centre, or of the origin of its mesh, in its parent."""
    parent: Annotated[Parent, ReadBy(_parent)] = Parent()
    """Frame that it is fixed to: `world`, `wobj:NAME`, `link:NUMBER`, `tool`, `unit:NAME` or
    `unit:NAME:AXIS`."""
    robot: str | None = None
    """Task or name of the robot of its parent; None for the first."""
    colour: Annotated[Colour, ReadBy(_colour)] = GREY
    """Colour in a recording, such as `#6080a0`."""


@value_class(frozen=True, slots=True)
class AttachTable:
    """A table [[attach]]: a condition on signals under which a gripper or a clamp holds objects."""

    when: Condition
    """When it becomes true, the nearest of the objects is taken, and held while it is true."""
    object: str
    """Name of the object; `*` stands for any characters."""
    to: Annotated[Parent, ReadBy(_holder)]
    """Holder: `tool`, `tool:NAME` for one body of a tool, `unit:NAME` or `unit:NAME:AXIS`."""
    nearest: NotNegative = 20.0
    """Largest distance [mm] from the holder of an object that is taken."""
    robot: str | None = None
    """Task or name of the robot; None for the first."""


@value_class(frozen=True, slots=True)
class SourceTable:
    """A table [[source]]: copies of an object that appear at its pose."""

    object: str
    """Name of the object; it is there only in its copies, `NAME 1`, `NAME 2` and so on."""
    at: NotNegative = 0.0
    """Time of the first copy [s]."""
    every: Annotated[AboveZero | None, Excludes("when", _ONE_CAUSE)] = None
    """Time from one copy to the next [s]."""
    times: Annotated[tuple[float, ...], Excludes("when", _ONE_CAUSE)] = ()
    """Times of single copies [s]."""
    when: Condition | None = None
    """In place of times: the condition that makes a copy each time that it becomes true."""


@value_class(frozen=True, slots=True)
class SinkTable:
    """A table [[sink]]: a body from which parts disappear."""

    on: str
    """Name of the object on which the parts are put; if it is the `surface` of a conveyor, parts
    disappear at the end of that."""
    after: Annotated[NotNegative, Excludes("when", _ONE_CAUSE)] = 0.0
    """Time that a part rests there before it disappears [s]."""
    when: Condition | None = None
    """In place of a time: the condition that removes all parts each time that it becomes true."""
    holds: Annotated[int | None, whole_number(1, 10000)] = None
    """Largest number of parts that have a place there; no key for any."""


def _ignored(reader: Reader, table: Table, _: str, key: str) -> tuple[IgnoredPair, ...]:
    pairs = []
    for path, pair in reader.tables(table, key):
        path = f"collisions.{path}"
        reader.note_unknown_keys(path, pair, ("between", "reason"))
        between = reader.texts(pair, path, "between")
        reason = reader.text(pair, path, "reason")
        if len(between) != 2 or not reason:
            reader.wrong(
                path, 'write { between = ["fence", "link 3"], reason = "why they may touch" }'
            )
            continue
        pairs.append(IgnoredPair(*between, reason))
    return tuple(pairs)


@value_class(frozen=True, slots=True)
class CollisionsTable:
    """The table [collisions]: settings of a `CellGeometry`."""

    clearance_mm: Annotated[NotNegative, Key("clearance")] = 0.0
    """Distance below which a run is reported."""
    stops: Annotated[bool, Key("stop-on-collision")] = False
    """Whether a contact ends the run."""
    own_links: Annotated[bool, Key("own-links")] = True
    """Whether an arm is checked against itself."""
    ignored: Annotated[tuple[IgnoredPair, ...], Key("ignore"), ReadBy(_ignored)] = ()
    """Pairs that may touch."""
