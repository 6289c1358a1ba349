"""STL files, binary and ASCII."""

from __future__ import annotations

import numpy as np

from rapidsim.collisions.meshes.triangles import Faces, require_few
from rapidsim.files import InputError
from rapidsim.frames.transform import Array

_HEAD = 84
_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def read_stl(name: str, data: bytes) -> tuple[Array, Faces]:
    """Return vertices (3 f, 3) and faces (f, 3) of an STL file.

    Raises:
        InputError: If the data are not an STL file, or are truncated.
    """
    count = int.from_bytes(data[80:_HEAD], "little")
    whole = len(data) == _HEAD + count * _FACET.itemsize
    if data[:5].lower() == b"solid" and not whole:
        return _ascii(name, data)
    if len(data) < _HEAD or len(data) < _HEAD + count * _FACET.itemsize:
        raise InputError(
            f"{name} is not an STL file, or is truncated: {count} triangles do not fit in it"
        )
    require_few(name, count)
    corners = np.frombuffer(data, _FACET, count, _HEAD)["corners"].reshape(-1, 3)
    return corners.astype(np.float64), np.arange(3 * count).reshape(-1, 3)


def _ascii(name: str, data: bytes) -> tuple[Array, Faces]:
    corners: list[list[float]] = []
    for line in data.splitlines():
        words = line.split()
        if not words or words[0].lower() != b"vertex":
            continue
        try:
            x, y, z = map(float, words[1:4])
        except ValueError:
            raise InputError(
                f"{name} is damaged: `{line.decode('ascii', 'replace').strip()[:60]}`"
            ) from None
        corners.append([x, y, z])
        if len(corners) % 3 == 0:
            require_few(name, len(corners) // 3)
    if len(corners) % 3:
        raise InputError(f"{name} is truncated: the last triangle has {len(corners) % 3} corners")
    return np.array(corners).reshape(-1, 3), np.arange(len(corners)).reshape(-1, 3)
