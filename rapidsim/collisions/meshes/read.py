"""Reader of shapes from files of all supported formats."""

from __future__ import annotations

from pathlib import Path

from rapidsim.collisions.meshes.gltf import read_gltf
from rapidsim.collisions.meshes.obj import read_obj
from rapidsim.collisions.meshes.ply import read_ply
from rapidsim.collisions.meshes.step import read_step
from rapidsim.collisions.meshes.stl import read_stl
from rapidsim.collisions.meshes.triangles import Triangles, checked_triangles
from rapidsim.files import InputError, input_bytes, require_inside

IN_METRES = (".glb", ".gltf", ".step", ".stp")
"""Formats that define a unit, whose lengths are returned in metres."""
KINDS = (".stl", ".obj", ".ply", *IN_METRES)
_MOST_BYTES = 50_000_000


def read_mesh(file: Path, room: Path) -> Triangles:
    """Return the triangles of a file, in its unit.

    Args:
        file: The file; its suffix determines the format.
        room: Folder that must contain it and the files it refers to.

    Raises:
        InputError: If the file is missing, too large, of another format, or damaged.
    """
    name, kind = str(file), file.suffix.lower()
    if kind not in KINDS:
        raise InputError(f"{name}: unknown kind of shape file", f"known: {', '.join(KINDS)}")
    data = _bytes_of(file)

    def beside(other: str) -> bytes:
        try:
            (found,) = require_inside([file.parent / other], [room])
        except InputError as mistake:
            raise InputError(f"{name} names another file: {mistake.message}") from None
        return _bytes_of(found)

    match kind:
        case ".stl":
            corners, faces = read_stl(name, data)
        case ".obj":
            corners, faces = read_obj(name, data)
        case ".ply":
            corners, faces = read_ply(name, data)
        case ".step" | ".stp":
            corners, faces = read_step(name, data)
        case _:
            corners, faces = read_gltf(name, data, beside)
    return checked_triangles(name, corners, faces)


def _bytes_of(file: Path) -> bytes:
    try:
        size = file.stat().st_size
    except (OSError, ValueError):
        size = 0  # `input_bytes` reports a missing file.
    if size > _MOST_BYTES:
        raise InputError(
            f"{file} is larger than {_MOST_BYTES // 1_000_000} MB", "export it with less detail"
        )
    return input_bytes(file)
