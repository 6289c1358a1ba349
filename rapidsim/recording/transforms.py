"""Transforms in rerun's format: metres, quaternions with the scalar last."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
import rerun as rr

from rapidsim.frames.transform import Transform

WORLD = "world"
BASE = "base"
FOOT = "foot"
"""Base frame of a robot on a track with the track at zero."""
BASE_FROM_WORLD = Transform.identity()
"""Default base: the robot's base is in the origin of the world."""


def quaternion_xyzw(a_from_b: Transform) -> npt.NDArray[np.float32]:
    """Return quaternions (..., 4), scalar last."""
    return np.roll(a_from_b.quaternion, -1, axis=-1).astype(np.float32)


def static_frame(parent: str, child: str, parent_from_child: Transform) -> rr.Transform3D:
    """Return an edge between two named frames that never changes."""
    return rr.Transform3D(
        translation=parent_from_child.translation,
        quaternion=rr.Quaternion(xyzw=quaternion_xyzw(parent_from_child)),
        parent_frame=parent,
        child_frame=child,
    )


def moving_frame(
    parent: str | Sequence[str], child: str, parent_from_child: Transform
) -> rr.ComponentColumnList:
    """Return an edge between two named frames, one row for each element of a batch (k,).

    Every row contains the names: a row replaces the whole edge, names included. A frame that is
    handed over has a parent for each row.
    """
    count = len(parent_from_child)
    parents = [parent] * count if isinstance(parent, str) else list(parent)
    return rr.Transform3D.columns(
        translation=parent_from_child.translation.astype(np.float32),
        quaternion=quaternion_xyzw(parent_from_child),
        parent_frame=parents,
        child_frame=[child] * count,
    )
