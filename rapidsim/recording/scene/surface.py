"""Surfaces of bodies in the viewer."""

from __future__ import annotations

import numpy as np
import rerun as rr

from rapidsim.collisions.shape import Shape
from rapidsim.recording import palette


def surface(shape: Shape, colour: palette.Colour) -> rr.Mesh3D:
    """Return a surface with flat faces."""
    corners = shape.vertices[shape.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = normals / np.where(length > 0.0, length, 1.0)
    return rr.Mesh3D(
        vertex_positions=corners.reshape(-1, 3),
        vertex_normals=np.repeat(normals, 3, axis=0),
        triangle_indices=np.arange(3 * len(corners)).reshape(-1, 3),
        albedo_factor=palette.rgba(colour),
    )
