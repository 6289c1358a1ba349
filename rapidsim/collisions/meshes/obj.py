"""Wavefront OBJ files: vertices and faces; groups, materials and normals are ignored."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from rapidsim.collisions.meshes.triangles import Faces, face_array, require_few
from rapidsim.files import InputError
from rapidsim.frames.transform import Array


def read_obj(name: str, data: bytes) -> tuple[Array, Faces]:
    """Return vertices (k, 3) and faces (f, 3); a face with more vertices becomes a fan.

    Raises:
        InputError: If a line cannot be read.
    """
    corners: list[list[float]] = []
    faces: list[tuple[int, int, int]] = []
    for number, line in enumerate(data.splitlines(), start=1):
        words = line.split()
        try:
            if words[:1] == [b"v"]:
                x, y, z = map(float, words[1:4])
                corners.append([x, y, z])
            elif words[:1] == [b"f"]:
                around = [_corner(word, len(corners)) for word in words[1:]]
                faces += [(around[0], b, c) for b, c in pairwise(around[1:])]
                require_few(name, len(faces))
        except ValueError:
            text = line.decode("utf-8", "replace").strip()
            raise InputError(f"{name}:{number}: `{text[:60]}` cannot be read") from None
    return np.array(corners).reshape(-1, 3), face_array(name, faces)


def _corner(word: bytes, count: int) -> int:
    """Return the index of a corner: counted from 1, or from the last one back."""
    number = int(word.split(b"/")[0])
    return number - 1 if number > 0 else count + number if number < 0 else -1
