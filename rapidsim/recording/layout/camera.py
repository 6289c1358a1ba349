"""Viewpoints that show all points, from the side of the work."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.recording.samples import RecordedRobot
from rapidsim.recording.scene.failed_moves import in_sight, reason_room
from rapidsim.recording.scene.targets import Targets
from rapidsim.recording.scene.work_objects import object_origins
from rapidsim.values import value_class

_HALF_VIEW_RAD = np.radians(22.0)
"""Half of the viewer camera's vertical field of view, less a margin."""
_SIDE_RAD = np.radians(48.0)
"""Angle of the camera from the line base to work, so that the arm hides nothing."""
_BESIDE_ROW_RAD = np.radians(75.0)
_HEIGHT_RAD = np.radians(24.0)
_CLOSE_HEIGHT_RAD = np.radians(38.0)
_SMALLEST_M = 0.05
_POSES = 60
"""Number of poses that represent the sweep of the arm."""


@value_class(frozen=True, slots=True, eq=False)
class Viewpoint:
    """Eye and target (3,) [m] in the world."""

    eye: Array
    target: Array


def cell_camera(runs: Sequence[RecordedRobot], wide: float = 1.0) -> Viewpoint:
    """Return a view of the arms in all their poses, their paths and their work objects.

    Args:
        runs: Recorded run of each robot.
        wide: Aspect ratio (width / height) of the picture.
    """
    points = np.concatenate([run.robot_run.world_from_base.apply(cell_points(run)) for run in runs])
    air = 1.08 if len(runs) == 1 else 1.25
    return looking_at(points, _azimuth(runs), _HEIGHT_RAD, air=air, wide=wide)


def near_camera(run: RecordedRobot, near: Targets) -> Viewpoint:
    """Return a view of some targets from near, with the points at which moves failed."""
    points = np.concatenate([near.points, in_sight(run, run.robot_run.failed_moves)])
    world_points = run.robot_run.world_from_base.apply(points)
    return looking_at(world_points, _azimuth([run]), _CLOSE_HEIGHT_RAD, air=1.15)


def cell_size(run: RecordedRobot) -> float:
    """Return the largest extent [m] of a robot with its work, along an axis."""
    return float(np.ptp(cell_points(run), axis=0).max())


def cell_points(run: RecordedRobot) -> Array:
    """Return points (k, 3) [m] in base that a picture of the robot and its work must contain."""
    rows = np.linspace(0, len(run.samples.times) - 1, _POSES).astype(np.int64)
    links = run.robot.kinematics.link_frames(run.samples.joints[rows])
    base = Transform(np.tile(np.eye(3), (len(rows), 1, 1)), np.zeros((len(rows), 3)))
    external = run.samples.external[rows] if run.on_track else run.samples.external
    bases = run.still_from(base, external)
    return np.concatenate(
        [
            bases.translation,
            bases[:, None].apply(links.translation).reshape(-1, 3),
            run.places,
            object_origins(run),
            in_sight(run, run.robot_run.failed_moves),
            reason_room(run),
        ]
    )


def _azimuth(runs: Sequence[RecordedRobot]) -> float:
    """Return the direction [rad] from the work to the camera, seen from above."""
    feet = np.array([run.robot_run.world_from_base.translation for run in runs])
    if len(runs) > 1:
        # To the side of the row of robots, so that none hides another.
        x, y, _ = feet[-1] - feet[0]
        return float(np.arctan2(y, x) - _BESIDE_ROW_RAD)
    work = [run.robot_run.world_from_base.apply(np.mean(run.places, axis=0)) for run in runs]
    x, y, _ = np.mean(work, axis=0) - np.mean(feet, axis=0)
    return float(np.arctan2(y, x) - _SIDE_RAD)


def looking_at(
    points: Array, azimuth: float, height: float, air: float = 1.0, wide: float = 1.0
) -> Viewpoint:
    """Return the closest viewpoint in a direction with all points (k, 3) [m] in the picture."""
    back = np.array(
        [
            np.cos(height) * np.cos(azimuth),
            np.cos(height) * np.sin(azimuth),
            np.sin(height),
        ]
    )
    right = np.array([-np.sin(azimuth), np.cos(azimuth), 0.0])
    picture = np.stack([right, np.cross(back, right), back])
    # Axes of the picture: right, up, towards the eye.
    placed = points @ picture.T
    low, high = placed.min(axis=0), placed.max(axis=0)
    middle = 0.5 * (low + high)
    aside = (np.abs(placed[:, :2] - middle[:2]) / [wide, 1.0]).max(axis=1)
    away = air * np.maximum(aside, _SMALLEST_M) / np.tan(_HALF_VIEW_RAD)
    distance = float((away + placed[:, 2] - middle[2]).max())
    target: Array = middle @ picture
    return Viewpoint(target + distance * back, target)
