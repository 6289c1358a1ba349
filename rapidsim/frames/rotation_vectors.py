"""Rotation vectors: a unit axis times an angle [rad], turned into matrices and back, in batches."""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array, quaternion_from_matrix


def rotation_from_vector(vector: Array) -> Array:
    """Return rotation matrices (..., 3, 3) from rotation vectors (..., 3) [rad]."""
    angle = np.linalg.norm(vector, axis=-1)[..., None, None]
    # sinc and similar functions keep every digit at angle 0, where the axis is undefined.
    sine = np.sinc(angle / np.pi)
    cosine = 0.5 * np.sinc(angle / (2.0 * np.pi)) ** 2
    cross = cross_matrix(vector)
    rotation: Array = np.eye(3) + sine * cross + cosine * (cross @ cross)
    return rotation


def vector_from_rotation(rotation: Array) -> Array:
    """Return rotation vectors (..., 3) [rad], up to half a turn, of matrices (..., 3, 3)."""
    quaternion = quaternion_from_matrix(rotation)
    axis = quaternion[..., 1:]
    sine = np.linalg.norm(axis, axis=-1)
    angle = 2.0 * np.arctan2(sine, quaternion[..., 0])
    # For tiny angles the vector part is half the rotation vector.
    scale = np.where(sine > 1e-12, angle / np.maximum(sine, 1e-300), 2.0)
    vector: Array = axis * scale[..., None]
    return vector


def cross_matrix(vector: Array) -> Array:
    """Return skew-symmetric matrices (..., 3, 3): multiplication by them is `vector x`."""
    x, y, z = vector[..., 0], vector[..., 1], vector[..., 2]
    matrix = np.zeros((*vector.shape[:-1], 3, 3))
    matrix[..., 0, 1], matrix[..., 0, 2] = -z, y
    matrix[..., 1, 0], matrix[..., 1, 2] = z, -x
    matrix[..., 2, 0], matrix[..., 2, 1] = -y, x
    return matrix


def rotate(rotation: Array, vector: Array) -> Array:
    """Return vectors (..., 3) rotated by matrices (..., 3, 3)."""
    turned: Array = np.einsum("...ij,...j->...i", rotation, vector)
    return turned


def cross(a: Array, b: Array) -> Array:
    """Return cross products of (..., 3); np.cross costs ten times as much for small batches."""
    product = np.empty(np.broadcast_shapes(a.shape, b.shape))
    product[..., 0] = a[..., 1] * b[..., 2] - a[..., 2] * b[..., 1]
    product[..., 1] = a[..., 2] * b[..., 0] - a[..., 0] * b[..., 2]
    product[..., 2] = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return product
