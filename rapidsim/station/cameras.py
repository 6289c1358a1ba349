"""The tables [[camera]]: objects that a camera detects in successive pictures.

[[camera]]
name = "cam1"
after = 0.2
repeat = true
parameters = { "Pattern_1.Accept_Threshold" = 70 }
pictures = [[{ name = "part", position = [120, 30, 0], quaternion = [1, 0, 0, 0], val1 = 98 }], []]
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, TypeAlias

from rapidsim.controller.cell.camera_scripts import CameraScript
from rapidsim.json_records.declarations import Key, NotNegative, Required
from rapidsim.language.data import IDENTITY_POSE, Orient, Pos, Pose
from rapidsim.language.option_data import CameraTarget
from rapidsim.station.declared_tables import ReadBy, read_records, values_of
from rapidsim.station.toml_reader import Reader, Table, is_number
from rapidsim.values import value_class

_Parameters: TypeAlias = Mapping[str, float | bool | str]


@value_class(frozen=True, slots=True)
class TargetTable:
    """Result of a camera in a picture, with the fields of RAPID's `cameratarget`."""

    name: str = ""
    position: tuple[float, float, float] = IDENTITY_POSE.trans
    """Position of its frame [mm]."""
    quaternion: tuple[float, float, float, float] = IDENTITY_POSE.rot
    """Rotation of its frame, the scalar first."""
    val1: float = 0.0
    val2: float = 0.0
    val3: float = 0.0
    val4: float = 0.0
    val5: float = 0.0
    string1: str = ""
    string2: str = ""
    type: float = 0.0

    def as_target(self, camera: str, scene: int) -> CameraTarget:
        """Return the result of a camera in its picture of a number."""
        return CameraTarget(
            self.name,
            Pose(Pos(*self.position), Orient(*self.quaternion)),
            self.val1,
            self.val2,
            self.val3,
            self.val4,
            self.val5,
            self.string1,
            self.string2,
            self.type,
            camera,
            float(scene),
        )


def _parameters(reader: Reader, table: Table, path: str, key: str) -> _Parameters:
    path = f"{path}.{key}"
    found: dict[str, float | bool | str] = {}
    for name, value in reader.table(table, key, path).items():
        if isinstance(value, bool | str):
            found[name.lower()] = value
        elif is_number(value):
            found[name.lower()] = float(value)
        else:
            reader.wrong(f"{path}.{name}", "a number, a text, true or false is needed")
    return found


def _pictures(
    reader: Reader, table: Table, path: str, key: str
) -> tuple[tuple[TargetTable, ...], ...] | None:
    path = f"{path}.{key}"
    pictures = table[key]
    if not isinstance(pictures, list) or not all(isinstance(one, list) for one in pictures):
        reader.wrong(path, 'a list of lists is needed, as in [[{ name = "part" }], []]')
        return None
    found = []
    for number, picture in enumerate(pictures, start=1):
        here = f"{path} {number}"
        targets = []
        for one in picture:
            if isinstance(one, dict):
                targets.append(TargetTable(**values_of(reader, TargetTable, one, here)))
            else:
                reader.wrong(here, 'write what is found as { name = "part" }')
        found.append(tuple(targets))
    return tuple(found)


@value_class(frozen=True, slots=True)
class CameraTable:
    """A table [[camera]]."""

    name: Annotated[str, Required("is missing")]
    """Name in the program."""
    after_s: Annotated[NotNegative, Key("after")] = 0.0
    """Time from the request for a picture to its results."""
    repeats: Annotated[bool, Key("repeat")] = False
    """Whether the pictures repeat after the last one; otherwise later ones show nothing."""
    parameters: Annotated[_Parameters | None, ReadBy(_parameters)] = None
    """The parameters of its job with their initial values."""
    pictures: Annotated[tuple[tuple[TargetTable, ...], ...], ReadBy(_pictures)] = ()
    """The results found in each picture."""


def read_cameras(reader: Reader, tables: Table) -> tuple[CameraScript, ...]:
    """Read the list; errors are collected in the reader."""
    return tuple(map(_script, read_records(reader, tables, "camera", CameraTable)))


def _script(camera: CameraTable) -> CameraScript:
    pictures = tuple(
        tuple(target.as_target(camera.name, scene) for target in picture)
        for scene, picture in enumerate(camera.pictures, start=1)
    )
    parameters = tuple((camera.parameters or {}).items())
    return CameraScript(camera.name, pictures, camera.after_s, camera.repeats, parameters)
