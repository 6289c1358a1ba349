"""glTF files, binary (.glb) and text (.gltf): the triangles of the scene with node transforms.

Lengths are in m and the axes are those in the file. Compressed or otherwise encoded triangles are
refused.

Source:
    Khronos Group, glTF 2.0 specification.
"""

from __future__ import annotations

import base64
import binascii
import json
from collections.abc import Callable
from typing import Any

import numpy as np

from rapidsim.collisions.meshes.triangles import Faces, require_few
from rapidsim.files import InputError
from rapidsim.frames.transform import Array, matrix_from_quaternion

_MAGIC = b"glTF"
_DEEPEST = 50
_TYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
_TRIANGLES = 4
Beside = Callable[[str], bytes]
"""Returns the bytes of a file that another file refers to."""


def read_gltf(name: str, data: bytes, read_neighbour: Beside) -> tuple[Array, Faces]:
    """Return vertices (k, 3) [m] and faces (f, 3).

    Raises:
        InputError: If the data are not glTF, damaged, or have an unsupported encoding.
    """
    try:
        tree, binary = parts_of(data)
        return _Scene(name, tree, Accessors(name, tree, binary, read_neighbour)).triangles()
    except (ValueError, LookupError, TypeError, AttributeError, OverflowError, binascii.Error):
        raise InputError(f"{name} is not a readable glTF file") from None
    except RecursionError:
        raise InputError(f"{name} is nested too deeply") from None


def parts_of(data: bytes) -> tuple[dict[str, Any], bytes]:
    """Return the description of a file, and the buffer that a binary one contains."""
    if data[:4] != _MAGIC:
        return json.loads(data), b""
    chunks: dict[bytes, bytes] = {}
    place = 12
    while place + 8 <= len(data):
        length = int.from_bytes(data[place : place + 4], "little")
        chunks.setdefault(data[place + 4 : place + 8], data[place + 8 : place + 8 + length])
        place += 8 + length
    return json.loads(chunks[b"JSON"]), chunks.get(b"BIN\0", b"")


class Accessors:
    """The arrays of a file."""

    def __init__(
        self, name: str, tree: dict[str, Any], binary: bytes, read_neighbour: Beside
    ) -> None:
        """Read nothing yet; see `parts_of` for the description and the contained buffer."""
        self._name, self._tree, self._binary, self._beside = name, tree, binary, read_neighbour
        self._buffers: dict[int, bytes] = {}

    def rows(self, accessor: int) -> Array:
        """Return the rows (k, width) of an accessor.

        Raises:
            InputError: If it is sparse; errors of `read_gltf` for other damage.
        """
        told = self._tree["accessors"][accessor]
        if "sparse" in told or "bufferView" not in told:
            raise InputError(f"{self._name}: an accessor is sparse", "export it as plain arrays")
        view = self._tree["bufferViews"][told["bufferView"]]
        number = np.dtype(_TYPES[told["componentType"]])
        width, count = _WIDTHS[told["type"]], int(told["count"])
        start = view.get("byteOffset", 0) + told.get("byteOffset", 0)
        step = view.get("byteStride", width * number.itemsize)
        data = self._buffer(view["buffer"])
        if (
            count < 1
            or start < 0
            or step < 1
            or start + (count - 1) * step + width * number.itemsize > len(data)
        ):
            raise ValueError
        return np.ndarray((count, width), number, data, start, (step, number.itemsize))

    def _buffer(self, number: int) -> bytes:
        if number not in self._buffers:
            where = self._tree["buffers"][number].get("uri")
            if where is None:
                self._buffers[number] = self._binary
            elif where.startswith("data:"):
                self._buffers[number] = base64.b64decode(where.partition(",")[2], validate=True)
            else:
                self._buffers[number] = self._beside(where)
        return self._buffers[number]


class _Scene:
    def __init__(self, name: str, tree: dict[str, Any], accessors: Accessors) -> None:
        self._name, self._tree, self._accessors = name, tree, accessors
        self._corners: list[Array] = []
        self._faces: list[Faces] = []
        self._count = 0
        self._seen: set[int] = set()

    def triangles(self) -> tuple[Array, Faces]:
        """Return all triangles of the scene."""
        scenes = self._tree.get("scenes")
        if scenes:
            for node in scenes[self._tree.get("scene", 0)].get("nodes", []):
                self._add_node(node, np.eye(4), 0)
        else:
            for mesh in range(len(self._tree.get("meshes", []))):
                self._add_mesh(mesh, np.eye(4))
        if not self._faces:
            return np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64)
        return np.concatenate(self._corners), np.concatenate(self._faces)

    def _add_node(self, number: int, scene_from_parent: Array, depth: int) -> None:
        if number in self._seen or depth > _DEEPEST:
            raise InputError(f"{self._name}: its nodes do not form a tree, or one too deep")
        self._seen.add(number)
        node = self._tree["nodes"][number]
        scene_from_node = scene_from_parent @ _matrix(node)
        if "mesh" in node:
            self._add_mesh(node["mesh"], scene_from_node)
        for child in node.get("children", []):
            self._add_node(child, scene_from_node, depth + 1)

    def _add_mesh(self, number: int, scene_from_mesh: Array) -> None:
        for primitive in self._tree["meshes"][number]["primitives"]:
            if "KHR_draco_mesh_compression" in primitive.get("extensions", {}):
                raise InputError(
                    f"{self._name} is compressed (Draco)", "export it without compression"
                )
            if primitive.get("mode", _TRIANGLES) != _TRIANGLES:
                continue
            corners = self._accessors.rows(primitive["attributes"]["POSITION"]).astype(np.float64)
            if "indices" in primitive:
                faces = self._accessors.rows(primitive["indices"]).astype(np.int64).reshape(-1, 3)
            else:
                faces = np.arange(len(corners)).reshape(-1, 3)
            if len(faces) and faces.max() >= len(corners):
                raise ValueError
            self._faces.append(faces + self._count)
            self._count += len(corners)
            self._corners.append(corners @ scene_from_mesh[:3, :3].T + scene_from_mesh[:3, 3])
            require_few(self._name, sum(map(len, self._faces)))


def _matrix(node: dict[str, Any]) -> Array:
    if "matrix" in node:
        return np.array(node["matrix"], dtype=np.float64).reshape(4, 4).T
    matrix = np.eye(4)
    x, y, z, w = node.get("rotation", (0.0, 0.0, 0.0, 1.0))
    turn = matrix_from_quaternion(np.array([w, x, y, z], dtype=np.float64))
    matrix[:3, :3] = turn * np.array(node.get("scale", (1.0, 1.0, 1.0)), dtype=np.float64)
    matrix[:3, 3] = node.get("translation", (0.0, 0.0, 0.0))
    return matrix
