"""The tables [[camera]]: objects that a camera detects in successive pictures.

[[camera]]
name = "cam1"
after = 0.2
repeat = true
parameters = { "Pattern_1.Accept_Threshold" = 70 }
pictures = [[{ name = "part", position = [120, 30, 0], quaternion = [1, 0, 0, 0], val1 = 98 }], []]
"""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.controller.cell.camera_scripts import CameraScript
from rapidsim.language.data import IDENTITY_POSE, Orient, Pos, Pose
from rapidsim.language.option_data import CameraTarget
from rapidsim.station.toml_reader import Reader, Table

_KEYS = ("name", "after", "repeat", "parameters", "pictures")
_VALUES = ("val1", "val2", "val3", "val4", "val5")
_FOUND_KEYS = ("name", "position", "quaternion", *_VALUES, "string1", "string2", "type")


def read_cameras(reader: Reader, tables: Table) -> tuple[CameraScript, ...]:
    """Read the list; errors are collected in the reader."""
    scripts = []
    for path, table in reader.tables(tables, "camera"):
        reader.note_unknown_keys(path, table, _KEYS)
        name = reader.text(table, path, "name")
        if not name:
            reader.wrong(f"{path}.name", "is missing")
            continue
        repeats = reader.flag(table, path, "repeat")
        scripts.append(
            CameraScript(
                name,
                _pictures(reader, table, path, name),
                reader.not_negative(table, path, "after") or 0.0,
                repeats,
                tuple(_parameters(reader, table, path)),
            )
        )
    return tuple(scripts)


def _parameters(
    reader: Reader, table: Table, path: str
) -> Iterator[tuple[str, float | bool | str]]:
    for name, value in reader.table(table, "parameters", f"{path}.parameters").items():
        if isinstance(value, bool | str):
            yield name.lower(), value
        elif isinstance(value, int | float):
            yield name.lower(), float(value)
        else:
            reader.wrong(f"{path}.parameters.{name}", "a number, a text, true or false is needed")


def _pictures(
    reader: Reader, table: Table, path: str, camera: str
) -> tuple[tuple[CameraTarget, ...], ...]:
    pictures = table.get("pictures", [])
    if not isinstance(pictures, list) or not all(isinstance(one, list) for one in pictures):
        reader.wrong(
            f"{path}.pictures", 'a list of lists is needed, as in [[{ name = "part" }], []]'
        )
        return ()
    found = []
    for number, picture in enumerate(pictures, start=1):
        here = f"{path}.pictures {number}"
        targets = []
        for one in picture:
            if isinstance(one, dict):
                targets.append(_target(reader, one, here, camera, float(number)))
            else:
                reader.wrong(here, 'write what is found as { name = "part" }')
        found.append(tuple(targets))
    return tuple(found)


def _target(reader: Reader, table: Table, path: str, camera: str, scene: float) -> CameraTarget:
    reader.note_unknown_keys(path, table, _FOUND_KEYS)
    position = reader.numbers(table, path, "position", 3)
    rotation = reader.numbers(table, path, "quaternion", 4)
    frame = Pose(
        IDENTITY_POSE.trans if position is None else Pos(*position),
        IDENTITY_POSE.rot if rotation is None else Orient(*rotation),
    )
    val1, val2, val3, val4, val5 = (reader.number(table, path, key) or 0.0 for key in _VALUES)
    return CameraTarget(
        reader.text(table, path, "name") or "",
        frame,
        val1,
        val2,
        val3,
        val4,
        val5,
        reader.text(table, path, "string1") or "",
        reader.text(table, path, "string2") or "",
        reader.number(table, path, "type") or 0.0,
        camera,
        scene,
    )
