"""Where to look from: far enough to see it all, from the side the work is on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.recording.sampled import SampledRun
from rapidsim.recording.targets import Target, points_of
from rapidsim.recording.work_objects import object_origins

_HALF_VIEW_RAD = np.radians(22.5)
"""Half of what the viewer's camera sees from top to bottom, less a margin."""
_SIDE_RAD = np.radians(48.0)
"""How far the camera stands beside the line from base to work, so that the arm hides nothing."""
_HEIGHT_RAD = np.radians(24.0)
_CLOSE_HEIGHT_RAD = np.radians(38.0)
_SMALLEST_M = 0.05
_POSES = 60
"""Poses of the arm that stand for its sweep."""


@dataclass(frozen=True, slots=True, eq=False)
class Camera:
    """Eye and target (3,) [m] in the world."""

    eye: Array
    target: Array


def cell_camera(run: SampledRun) -> Camera:
    """See the arm in all its poses, its path and its work objects."""
    return _looking_at(_cell_points(run), _azimuth(run), _HEIGHT_RAD)


def near_camera(run: SampledRun, near: Sequence[Target]) -> Camera:
    """See some targets from near."""
    return _looking_at(points_of(near), _azimuth(run), _CLOSE_HEIGHT_RAD, air=1.15)


def cell_size(run: SampledRun) -> float:
    """The largest extent [m] of the cell along an axis."""
    return float(np.ptp(_cell_points(run), axis=0).max())


def _cell_points(run: SampledRun) -> Array:
    rows = np.linspace(0, len(run.samples.times) - 1, _POSES).astype(np.int64)
    links = run.simulation.robot.kinematics.link_frames(run.samples.joints[rows])
    return np.concatenate(
        [
            np.zeros((1, 3)),
            links.translation.reshape(-1, 3),
            run.samples.base_from_tcp.translation,
            object_origins(run.simulation.moves),
        ]
    )


def _azimuth(run: SampledRun) -> float:
    """Direction [rad] from the work to the camera, seen from above."""
    x, y, _ = np.mean(run.samples.base_from_tcp.translation, axis=0)
    return float(np.arctan2(y, x) - _SIDE_RAD)


def _looking_at(points: Array, azimuth: float, height: float, air: float = 1.0) -> Camera:
    low, high = np.min(points, axis=0), np.max(points, axis=0)
    target = 0.5 * (low + high)
    radius = max(float(np.linalg.norm(points - target, axis=1).max()), _SMALLEST_M)
    direction = np.array(
        [
            np.cos(height) * np.cos(azimuth),
            np.cos(height) * np.sin(azimuth),
            np.sin(height),
        ]
    )
    return Camera(target + direction * air * radius / np.sin(_HALF_VIEW_RAD), target)
