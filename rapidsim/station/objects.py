"""The tables [[object]], [[attach]] and [collisions]: bodies of the cell, and the checked pairs.

[[object]]
name = "table"
box = [800, 600, 40]                       # mm
pose = { position = [900, 0, -20] }        # of its centre, in its parent
parent = "world"                           # or "wobj:wobjVice", "link:3", "tool"

[[attach]]
when = "doGrip = 1"
object = "part"
to = "tool"
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Annotated

import numpy as np

from rapidsim.collisions import shape
from rapidsim.collisions.geometry import (
    GREY,
    Attachment,
    CellGeometry,
    CellObject,
    Colour,
    IgnoredPair,
    Parent,
    ParentKind,
)
from rapidsim.collisions.meshes.read import IN_METRES, read_mesh
from rapidsim.collisions.shape import Filling, Shape
from rapidsim.files import InputError, did_you_mean
from rapidsim.frames.transform import Transform
from rapidsim.json_records.declarations import Key, NotNegative
from rapidsim.motion.configurations.targets import MM
from rapidsim.station.declared_tables import ReadBy, read_when, values_of
from rapidsim.station.external_axes import read_frame
from rapidsim.station.toml_reader import UNITS_M, Reader, Table
from rapidsim.values import value_class

_SHAPES = ("box", "cylinder", "sphere", "capsule", "plane", "mesh")
_KEYS = ("name", *_SHAPES, "unit", "scale", "filling", "pose", "parent", "robot", "colour")
_MESH_KEYS = ("unit", "scale", "filling")
_MOST_M = 100.0
_LEAST_M = 1e-5
_MOST_OBJECTS, _MOST_AXES = 1000, 6
_COLOUR = re.compile("#[0-9a-fA-F]{6}")


def read_geometry(reader: Reader, station: Table) -> CellGeometry | None:
    """Read the tables; None if there are no such tables. Errors are collected in the reader."""
    if not {"object", "attach", "collisions"} & station.keys():
        return None
    objects: dict[str, CellObject] = {}
    for number, (path, table) in enumerate(reader.tables(station, "object")):
        if number >= _MOST_OBJECTS:
            reader.wrong("object", f"more than {_MOST_OBJECTS} are not supported")
            break
        found = _object(reader, path, table)
        if found is None:
            continue
        if found.name.lower() in objects:
            reader.wrong(f"{path}.name", f"another object is called `{found.name}`")
        objects[found.name.lower()] = found
    attachments = [
        one
        for path, table in reader.tables(station, "attach")
        if (one := _attachment(reader, path, table, [*objects])) is not None
    ]
    table = reader.table(station, "collisions")
    settings = values_of(reader, CollisionsTable, table, "collisions")
    clearance_m = settings.pop("clearance_mm", 0.0) * MM
    bodies = CellGeometry(tuple(objects.values()), tuple(attachments), clearance_m=clearance_m)
    return replace(bodies, **settings)


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
    stops: Annotated[bool, Key("stop-on-collision")] = False
    own_links: Annotated[bool, Key("own-links")] = True
    ignored: Annotated[tuple[IgnoredPair, ...], Key("ignore"), ReadBy(_ignored)] = ()


def _attachment(
    reader: Reader, path: str, table: Table, objects: Sequence[str]
) -> Attachment | None:
    reader.note_unknown_keys(path, table, ("when", "object", "to", "robot"))
    condition = read_when(reader, table, path, "when")
    name = reader.text(table, path, "object")
    to = reader.text(table, path, "to")
    robot = reader.text(table, path, "robot")
    reader.require(path, table, ("when", "object", "to"))
    if to is not None and to != ParentKind.TOOL:
        reader.wrong(f"{path}.to", f"`{to}` is not `tool`; only a tool carries objects")
    if name is not None and name.lower() not in objects:
        cure = did_you_mean(name, objects) or f"there are {', '.join(objects) or 'none'}"
        reader.wrong(f"{path}.object", f"there is no object `{name}`", cure)
        return None
    if condition is None or name is None:
        return None
    return Attachment(condition.text, name, robot)


def _object(reader: Reader, path: str, table: Table) -> CellObject | None:
    reader.note_unknown_keys(path, table, _KEYS)
    name = reader.text(table, path, "name")
    if not name:
        reader.wrong(f"{path}.name", "is missing")
    given = [key for key in _SHAPES if key in table]
    if len(given) != 1:
        reader.wrong(path, f"one of {', '.join(_SHAPES)} is needed")
        return None
    (kind,) = given
    for key in _MESH_KEYS:
        if key in table and kind != "mesh":
            reader.wrong(f"{path}.{key}", f"a {kind} has no such key")
    body = _mesh(reader, path, table) if kind == "mesh" else _solid(reader, path, table, kind)
    pose = read_frame(reader, reader.table(table, "pose", f"{path}.pose"), f"{path}.pose")
    if not (abs(pose.translation) <= 1000.0).all():
        reader.wrong(f"{path}.pose", "more than a kilometre away")
        pose = Transform.identity()
    parent = _parent(reader, path, table)
    colour = _colour(reader, path, table)
    if body is None or not name or parent is None:
        return None
    return CellObject(name, body, parent, pose, colour)


def _solid(reader: Reader, path: str, table: Table, kind: str) -> Shape | None:
    if kind == "box":
        size = reader.numbers(table, path, "box", 3)
        if size is None or not _are_lengths(reader, f"{path}.box", size):
            return None
        return shape.box(np.array(size) * MM)
    if kind == "plane":
        if table["plane"] is not True:
            reader.wrong(
                f"{path}.plane", "plane = true; everything below its x and y axes is solid"
            )
        return shape.half_space()
    sizes = reader.table(table, kind, f"{path}.{kind}")
    keys = ("diameter",) if kind == "sphere" else ("diameter", "length")
    reader.note_unknown_keys(f"{path}.{kind}", sizes, keys)
    given = [reader.positive(sizes, f"{path}.{kind}", key) for key in keys]
    if missing := [key for key in keys if key not in sizes]:
        reader.wrong(f"{path}.{kind}.{missing[0]}", "is missing")
    lengths = [one for one in given if one is not None]
    if len(lengths) < len(keys) or not _are_lengths(reader, f"{path}.{kind}", lengths):
        return None
    radius, *rest = 0.5 * lengths[0] * MM, *(one * MM for one in lengths[1:])
    if kind == "sphere":
        return shape.sphere(radius)
    if kind == "cylinder":
        return shape.cylinder(radius, *rest)
    if rest[0] <= 2.0 * radius:
        reader.wrong(f"{path}.capsule.length", "with both ends it is longer than the diameter")
        return None
    return shape.capsule(radius, rest[0] - 2.0 * radius)


def _are_lengths(reader: Reader, path: str, lengths: Sequence[float]) -> bool:
    if all(_LEAST_M <= one * MM <= _MOST_M for one in lengths):
        return True
    reader.wrong(path, f"lengths are from {_LEAST_M / MM:g} to {_MOST_M / MM:g} mm")
    return False


def _mesh(reader: Reader, path: str, table: Table) -> Shape | None:
    name = reader.text(table, path, "mesh")
    unit = reader.text(table, path, "unit")
    factor = reader.positive(table, path, "scale") or 1.0
    filling = reader.text(table, path, "filling") or Filling.SOLID
    if filling not in list(Filling):
        reader.wrong(f"{path}.filling", f"`{filling}` is none of {', '.join(Filling)}")
        filling = Filling.SOLID
    file = None if name is None else reader.inside(name, f"{path}.mesh")
    if file is None:
        return None
    if unit is None and file.suffix.lower() in IN_METRES:
        unit = "m"
    if unit not in UNITS_M:
        wrong = (
            "the file does not give one" if unit is None else f"`{unit}` is not a unit of length"
        )
        reader.wrong(f"{path}.unit", wrong, f"known: {', '.join(UNITS_M)}")
        return None
    try:
        mesh = read_mesh(file, file.parent)
    except InputError as mistake:
        reader.wrong(f"{path}.mesh", mistake.message, mistake.help)
        return None
    if filling == Filling.SOLID and not mesh.closed:
        reader.wrong(
            f"{path}.mesh",
            f"{file} is not closed, so it has no inside",
            'filling = "surface" checks only its triangles, filling = "hull" their convex hull',
        )
        return None
    mesh = replace(mesh, vertices=mesh.vertices * (UNITS_M[unit] * factor))
    size = float(np.ptp(mesh.vertices, axis=0).max())
    if not _LEAST_M <= size <= _MOST_M:
        reader.wrong(
            f"{path}.unit",
            f"{file} would be {size / MM:.6g} mm long in {unit}",
            "give the unit that it was drawn in",
        )
        return None
    return shape.of_mesh(mesh, Filling(filling))


def _parent(reader: Reader, path: str, table: Table) -> Parent | None:
    text = reader.text(table, path, "parent") or ParentKind.WORLD
    robot = reader.text(table, path, "robot")
    kind, _, name = (part.strip() for part in text.partition(":"))
    if kind in (ParentKind.WORLD, ParentKind.TOOL) and not name:
        return Parent(ParentKind(kind), robot=robot)
    if kind == ParentKind.WOBJ and name:
        return Parent(ParentKind.WOBJ, name=name, robot=robot)
    if kind == ParentKind.LINK and name.isdecimal() and len(name) < 3:
        return Parent(ParentKind.LINK, link=int(name), robot=robot)
    if kind == ParentKind.UNIT and name:
        unit, _, axis = (part.strip() for part in name.partition(":"))
        if unit and (not axis or (axis.isdecimal() and 0 < int(axis) <= _MOST_AXES)):
            return Parent(ParentKind.UNIT, name=unit, link=int(axis or 0), robot=robot)
    reader.wrong(
        f"{path}.parent",
        f"`{text}` is none of `world`, `wobj:NAME`, `link:NUMBER`, `tool`, `unit:NAME`, "
        "`unit:NAME:AXIS`",
    )
    return None


def _colour(reader: Reader, path: str, table: Table) -> Colour:
    text = reader.text(table, path, "colour")
    if text is None:
        return GREY
    if _COLOUR.fullmatch(text) is None:
        reader.wrong(f"{path}.colour", f"`{text}` is not a colour, such as `#6080a0`")
        return GREY
    red, green, blue = bytes.fromhex(text[1:])
    return red, green, blue
