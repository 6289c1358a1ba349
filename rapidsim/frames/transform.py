"""Rigid transforms, single or batched, named `a_from_b`: they map coordinates in b to a."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from rapidsim.values import value_class

Array = npt.NDArray[np.float64]
_ALL = slice(None)

_ROUNDING = 1e-9


@value_class(frozen=True, slots=True, eq=False)
class Transform:
    """A rigid transform, or a batch of them: leading dimensions broadcast like NumPy's.

    The arrays are not copied; code that shares them must not change them.
    """

    rotation: Array
    """Rotation matrices, shape (..., 3, 3)."""
    translation: Array
    """Translations [m], shape (..., 3)."""

    def __matmul__(self, other: Transform) -> Transform:
        """a_from_b @ b_from_c = a_from_c."""
        if other.rotation.ndim == 2 < self.rotation.ndim:
            # One product of many rows takes a tenth of the time of many small ones.
            rows = self.rotation.reshape(-1, 3) @ other.rotation
            rotation = rows.reshape(self.rotation.shape)
        else:
            rotation = self.rotation @ other.rotation
        if self.translation.ndim == other.translation.ndim == 1:
            # For single transforms, this is faster than broadcasting.
            return Transform(rotation, self.rotation @ other.translation + self.translation)
        moved = np.einsum("...ij,...j->...i", self.rotation, other.translation)
        return Transform(rotation, moved + self.translation)

    def __getitem__(self, index: object) -> Transform:
        """Return part of a batch: NumPy's indexing of the leading dimensions, `...` included."""
        leading = index if isinstance(index, tuple) else (index,)
        return Transform(self.rotation[(*leading, _ALL, _ALL)], self.translation[(*leading, _ALL)])

    def __len__(self) -> int:
        """Return the number of transforms in the first dimension of a batch."""
        return len(self.translation)

    def inverse(self) -> Transform:
        """Return the inverse, b_from_a."""
        rotation = np.swapaxes(self.rotation, -1, -2)
        return Transform(rotation, -np.einsum("...ij,...j->...i", rotation, self.translation))

    def apply(self, points_in_b: Array) -> Array:
        """Return points (..., 3) [m], expressed in a."""
        turned: Array = np.einsum("...ij,...j->...i", self.rotation, points_in_b)
        return turned + self.translation

    @property
    def quaternion(self) -> Array:
        """Unit quaternions (..., 4), scalar first and not negative."""
        return quaternion_from_matrix(self.rotation)

    @property
    def matrix(self) -> Array:
        """Homogeneous matrices (..., 4, 4)."""
        matrix = np.zeros((*self.translation.shape[:-1], 4, 4))
        matrix[..., :3, :3] = self.rotation
        matrix[..., :3, 3] = self.translation
        matrix[..., 3, 3] = 1.0
        return matrix

    @staticmethod
    def identity() -> Transform:
        """Return the identity transform."""
        return Transform(np.eye(3), np.zeros(3))

    @staticmethod
    def stacked(transforms: Sequence[Transform]) -> Transform:
        """Return a batch from single transforms."""
        return Transform(
            np.array([one.rotation for one in transforms]).reshape(-1, 3, 3),
            np.array([one.translation for one in transforms]).reshape(-1, 3),
        )

    @staticmethod
    def from_quaternion(
        quaternion: Sequence[float] | Array, translation: Sequence[float] | Array
    ) -> Transform:
        """Build from quaternions (..., 4), scalar first, normalised here, and translations [m]."""
        rotation = matrix_from_quaternion(np.asarray(quaternion, dtype=np.float64))
        return Transform(rotation, np.asarray(translation, dtype=np.float64))


def matrix_from_quaternion(quaternion: Array) -> Array:
    """Return matrices (..., 3, 3) from quaternions (..., 4) of nonzero norm, scalar first."""
    q = quaternion / np.linalg.norm(quaternion, axis=-1, keepdims=True)
    w, x, y, z = q[..., 0], q[..., 1], q[..., 2], q[..., 3]
    matrix = np.empty((*q.shape[:-1], 3, 3))
    matrix[..., 0, 0] = 1.0 - 2.0 * (y * y + z * z)
    matrix[..., 0, 1] = 2.0 * (x * y - w * z)
    matrix[..., 0, 2] = 2.0 * (x * z + w * y)
    matrix[..., 1, 0] = 2.0 * (x * y + w * z)
    matrix[..., 1, 1] = 1.0 - 2.0 * (x * x + z * z)
    matrix[..., 1, 2] = 2.0 * (y * z - w * x)
    matrix[..., 2, 0] = 2.0 * (x * z - w * y)
    matrix[..., 2, 1] = 2.0 * (y * z + w * x)
    matrix[..., 2, 2] = 1.0 - 2.0 * (x * x + y * y)
    return matrix


def quaternion_from_matrix(rotation: Array) -> Array:
    """Return quaternions (..., 4), scalar first, from rotation matrices (..., 3, 3).

    The scalar is not negative, except for rounding. Each row is computed from its largest
    component, so half turns lose no precision.

    Source:
        Shepperd (1978), Quaternion from rotation matrix.
    """
    m = rotation
    trace = m[..., 0, 0] + m[..., 1, 1] + m[..., 2, 2]
    # Four times the products of the components; row i belongs to component i being the largest.
    rows = np.empty((*m.shape[:-2], 4, 4))
    rows[..., 0, 0] = 1.0 + trace
    for i in range(3):
        rows[..., i + 1, i + 1] = 1.0 + 2.0 * m[..., i, i] - trace
    rows[..., 0, 1] = rows[..., 1, 0] = m[..., 2, 1] - m[..., 1, 2]
    rows[..., 0, 2] = rows[..., 2, 0] = m[..., 0, 2] - m[..., 2, 0]
    rows[..., 0, 3] = rows[..., 3, 0] = m[..., 1, 0] - m[..., 0, 1]
    rows[..., 1, 2] = rows[..., 2, 1] = m[..., 0, 1] + m[..., 1, 0]
    rows[..., 1, 3] = rows[..., 3, 1] = m[..., 0, 2] + m[..., 2, 0]
    rows[..., 2, 3] = rows[..., 3, 2] = m[..., 1, 2] + m[..., 2, 1]
    largest = np.argmax(np.diagonal(rows, axis1=-2, axis2=-1), axis=-1)
    q = np.take_along_axis(rows, largest[..., None, None], axis=-2)[..., 0, :]
    q = q / np.linalg.norm(q, axis=-1, keepdims=True)
    # At a half turn the scalar is zero except for rounding, which must not determine the sign.
    positive: Array = np.where(q[..., :1] < -_ROUNDING, -q, q)
    return positive


def unbroken(quaternions: Array) -> Array:
    """Return orientations (k, 4) without sign changes: q and -q are one orientation."""
    flips = np.sum(quaternions[1:] * quaternions[:-1], axis=1) < 0.0
    signs = np.concatenate([[1.0], np.where(np.cumsum(flips) % 2 == 1, -1.0, 1.0)])
    same: Array = quaternions * signs[:, None]
    return same


def slerp(start: Array, end: Array, fraction: Array) -> Array:
    """Interpolate from one orientation to another at constant rate, along the shortest rotation.

    Args:
        start: Unit quaternion (4,), scalar first.
        end: Unit quaternion (4,).
        fraction: Share of the rotation (...); may be outside 0..1.

    Returns:
        Unit quaternions (..., 4).
    """
    end = -end if float(start @ end) < 0.0 else end
    # Half the angle from the chord and its complement: exact for tiny angles and half turns alike.
    half = np.arctan2(np.linalg.norm(end - start), np.linalg.norm(end + start))
    angle = 2.0 * half
    t = np.asarray(fraction, dtype=np.float64)[..., None]
    if angle < 1e-9:
        blended = start + t * (end - start)
    else:
        blended = (np.sin((1.0 - t) * angle) * start + np.sin(t * angle) * end) / np.sin(angle)
    unit: Array = blended / np.linalg.norm(blended, axis=-1, keepdims=True)
    return unit
