"""Normals for link shapes whose files hold none: round surfaces smooth, edges sharp.

The viewer draws a mesh without normals in flat facets. Files of the catalogue hold positions and
faces alone, since normals follow from these: the normal at a corner of a face is the mean over the
faces around the vertex that lie within the crease angle, weighted by area. Large flat faces stay
flat, and their rounded edges take up the turn.
"""

from __future__ import annotations

import json
import struct
from typing import Any

import numpy as np
import numpy.typing as npt

from rapidsim.collisions.meshes.gltf import Accessors, parts_of
from rapidsim.collisions.meshes.triangles import Faces
from rapidsim.files import InputError
from rapidsim.frames.transform import Array
from rapidsim.repeated_rows import repeated

_COS_CREASE = np.cos(np.radians(38.0))
"""Faces that meet at a larger angle keep a sharp edge between them."""
_STEPS = 500.0
"""Inverse of the difference between unit vectors up to which a vertex has one normal."""
_ONLY = frozenset({"asset", "scene", "scenes", "nodes", "meshes", "materials"})
_DATA = frozenset({"accessors", "bufferViews", "buffers"})
_UNSIGNED_SHORT, _UNSIGNED_INT, _FLOAT = 5123, 5125, 5126
_NUMBERS = {_UNSIGNED_SHORT: "<u2", _UNSIGNED_INT: "<u4", _FLOAT: "<f4"}


def shaded(data: bytes) -> bytes:
    """Return a binary glTF file with normals, if its meshes are positions and faces alone.

    Any other file is returned unchanged: one with normals or textures, or an unreadable one.
    """
    try:
        tree, binary = parts_of(data)
        accessors = Accessors("", tree, binary, lambda _: b"")
        if not binary or not tree.keys() <= _ONLY | _DATA:
            return data
        primitives = [one for mesh in tree["meshes"] for one in mesh["primitives"]]
        if any(one["attributes"].keys() != {"POSITION"} for one in primitives):
            return data
        meshes = [
            smooth(
                accessors.rows(one["attributes"]["POSITION"]).astype(np.float64),
                accessors.rows(one["indices"]).astype(np.int64).reshape(-1, 3),
            )
            for one in primitives
        ]
    except (InputError, ValueError, LookupError, TypeError, AttributeError, OverflowError):
        return data
    written = _Buffer()
    for primitive, (vertices, normals, faces) in zip(primitives, meshes, strict=True):
        primitive["attributes"] = {
            "POSITION": written.add(vertices, "VEC3", _FLOAT),
            "NORMAL": written.add(normals, "VEC3", _FLOAT),
        }
        number = _UNSIGNED_SHORT if len(vertices) < 2**16 else _UNSIGNED_INT
        primitive["indices"] = written.add(faces.reshape(-1), "SCALAR", number)
    return written.file({key: tree[key] for key in tree if key in _ONLY})


def smooth(vertices: Array, faces: Faces) -> tuple[Array, Array, Faces]:
    """Return vertices (n, 3), normals (n, 3) and faces (f, 3), a vertex once for each normal.

    Args:
        vertices: Shape (k, 3) [m], each position once.
        faces: Shape (f, 3).
    """
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    across = np.cross(b - a, c - a)
    flat = across / np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-30)
    # Corners in order of their vertices, each paired with all corners of its vertex.
    vertex = faces.reshape(-1)
    order = np.argsort(vertex, kind="stable")
    counts = np.bincount(vertex, minlength=len(vertices))
    partners = np.repeat(counts, counts)
    corner, number = repeated(partners)
    first = np.repeat(np.cumsum(counts) - counts, counts)
    own, other = order[corner] // 3, order[first[corner] + number] // 3
    alike = np.einsum("ij,ij->i", flat[own], flat[other]) > _COS_CREASE
    starts = np.cumsum(partners) - partners
    summed = np.empty((len(vertex), 3))
    summed[order] = np.add.reduceat(np.where(alike[:, None], across[other], 0.0), starts)
    normals = summed / np.maximum(np.linalg.norm(summed, axis=1, keepdims=True), 1e-30)
    key = vertex
    for axis in np.round((normals.T + 1.0) * _STEPS).astype(np.int64):
        key = key * (2 * int(_STEPS) + 1) + axis
    _, kept, index = np.unique(key, return_index=True, return_inverse=True)
    return vertices[vertex[kept]], normals[kept], index.reshape(-1, 3)


class _Buffer:
    """The arrays of a file in one buffer."""

    def __init__(self) -> None:
        self._data = bytearray()
        self._views: list[dict[str, Any]] = []
        self._accessors: list[dict[str, Any]] = []

    def add(self, rows: npt.NDArray[Any], kind: str, number: int) -> int:
        """Add an array; return the number of its accessor."""
        data = rows.astype(_NUMBERS[number]).tobytes()
        data += bytes(-len(data) % 4)
        self._accessors.append(
            {
                "bufferView": len(self._views), "componentType": number,
                "type": kind, "count": len(rows),
                "min": np.atleast_1d(rows.min(axis=0)).tolist(),
                "max": np.atleast_1d(rows.max(axis=0)).tolist(),
            }
        )  # fmt: skip
        self._views.append({"buffer": 0, "byteOffset": len(self._data), "byteLength": len(data)})
        self._data += data
        return len(self._accessors) - 1

    def file(self, tree: dict[str, Any]) -> bytes:
        """Return a binary glTF file of a description and the arrays."""
        tree = tree | {
            "accessors": self._accessors, "bufferViews": self._views,
            "buffers": [{"byteLength": len(self._data)}],
        }  # fmt: skip
        text = json.dumps(tree, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text
        chunks += struct.pack("<I4s", len(self._data), b"BIN\0") + bytes(self._data)
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks
