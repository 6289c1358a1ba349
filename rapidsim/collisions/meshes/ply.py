"""PLY files, ASCII and binary.

Source:
    Turk (1994), The PLY polygon file format.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from types import MappingProxyType

import numpy as np

from rapidsim.collisions.meshes.triangles import MOST_TRIANGLES, Faces, face_array, require_few
from rapidsim.files import InputError
from rapidsim.frames.transform import Array

_TYPES = MappingProxyType(
    {
        **dict.fromkeys(("char", "int8"), "b"),
        **dict.fromkeys(("uchar", "uint8"), "B"),
        **dict.fromkeys(("short", "int16"), "h"),
        **dict.fromkeys(("ushort", "uint16"), "H"),
        **dict.fromkeys(("int", "int32"), "i"),
        **dict.fromkeys(("uint", "uint32"), "I"),
        **dict.fromkeys(("float", "float32"), "f"),
        **dict.fromkeys(("double", "float64"), "d"),
    }
)
_ORDERS = {b"ascii": "", b"binary_little_endian": "<", b"binary_big_endian": ">"}
_MOST_ROWS = 3 * MOST_TRIANGLES


@dataclass(slots=True)
class _Element:
    name: str
    count: int
    columns: list[tuple[str, str, str | None]] = field(default_factory=list)
    """Name and type, and for a list the type of its count."""


def read_ply(name: str, data: bytes) -> tuple[Array, Faces]:
    """Return vertices (k, 3) and faces (f, 3); a face with more vertices becomes a fan.

    Raises:
        InputError: If the data are not a PLY file, or are truncated.
    """
    head, mark, body = data.partition(b"end_header")
    if not data.startswith(b"ply") or not mark:
        raise InputError(f"{name} is not a PLY file")
    try:
        order, elements = _header(head)
        rows = _rows(body.split(b"\n", 1)[1], order, elements)
        corners = np.array([row[:3] for row in rows["vertex"]], dtype=np.float64)
        faces: list[tuple[int, int, int]] = []
        for around in rows.get("face", []):
            faces += [(int(around[0]), int(b), int(c)) for b, c in pairwise(around[1:])]
            require_few(name, len(faces))
    except (ValueError, IndexError, KeyError, struct.error, OverflowError):
        raise InputError(f"{name} is a damaged or truncated PLY file") from None
    return corners.reshape(-1, 3), face_array(name, faces)


def _header(head: bytes) -> tuple[str, list[_Element]]:
    order, elements = "", []
    for line in head.splitlines()[1:]:
        match line.split():
            case [b"format", kind, *_]:
                order = _ORDERS[kind]
            case [b"element", kind, count]:
                elements.append(_Element(kind.decode(), int(count)))
                if not 0 <= elements[-1].count <= _MOST_ROWS:
                    raise ValueError
            case [b"property", b"list", of_count, kind, column]:
                count_type = _TYPES[of_count.decode()]
                elements[-1].columns.append((column.decode(), _TYPES[kind.decode()], count_type))
            case [b"property", kind, column]:
                elements[-1].columns.append((column.decode(), _TYPES[kind.decode()], None))
            case _:
                pass
    return order, elements


def _rows(
    body: bytes, order: str, elements: Sequence[_Element]
) -> dict[str, list[Sequence[float]]]:
    """Return x, y, z of each vertex, and the corners of each face."""
    words = iter(body.split()) if not order else None
    place = 0

    def take(kind: str, count: int) -> Sequence[float]:
        nonlocal place
        if words is not None:
            taken = [float(word) for _, word in zip(range(count), words, strict=False)]
            if len(taken) < count:
                raise ValueError
            return taken
        size = struct.calcsize(order + kind) * count
        if place + size > len(body):
            raise ValueError
        values = struct.unpack_from(f"{order}{count}{kind}", body, place)
        place += size
        return values

    found: dict[str, list[Sequence[float]]] = {}
    for element in elements:
        rows = found.setdefault(element.name, [])
        for _ in range(element.count):
            row: dict[str, Sequence[float]] = {}
            for column, kind, of_count in element.columns:
                count = 1 if of_count is None else int(take(of_count, 1)[0])
                if count < 0 or count > _MOST_ROWS:
                    raise ValueError
                row[column] = take(kind, count)
            if element.name == "vertex":
                rows.append([row[axis][0] for axis in "xyz"])
            elif element.name == "face":
                rows.append(
                    row["vertex_indices"] if "vertex_indices" in row else row["vertex_index"]
                )
    return found
