"""State of an arm at some instants, and what moves it off its path."""

from __future__ import annotations

from dataclasses import field, replace

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.arm import Kinematics, Mask
from rapidsim.motion.trajectory.command import Index
from rapidsim.motion.trajectory.corrected_section import CorrectedSection, moved_joints
from rapidsim.motion.trajectory.guided_section import GuidedSection
from rapidsim.values import value_class


@value_class(frozen=True, slots=True, eq=False)
class Samples:
    """State of the arm at some instants."""

    times: Array
    """Shape (k,) [s]."""
    move: Index
    """Shape (k,): index of the active move; at rest, that of the last move before, or of the first
    one."""
    joints: Array
    """Shape (k, n) [rad]."""
    base_from_tcp: Transform
    """Shape (k,); the tool is that of the move."""
    tcp_speed: Array
    """Shape (k,) [m/s], against the work object."""
    external: Array = field(default_factory=lambda: np.zeros((0, 0)))
    """Shape (k, e) [m or rad]: the external axes."""
    lost: Mask | None = None
    """Shape (k,): whether a belt is where the arm cannot follow it; it then stays on its path. None
    if it follows none."""


@value_class(frozen=True, slots=True, eq=False)
class JointSamples:
    """Axes at some instants, without poses."""

    move: Index
    """Shape (k,): see `Samples`."""
    joints: Array
    """Shape (k, n) [rad]."""
    external: Array
    """Shape (k, e) [m or rad]: the external axes."""


def move_arm(samples: Samples, kinematics: Kinematics, offsets: Array) -> Samples:
    """Move the arm by offsets (k, 3) [m] where it can; return the samples."""
    rows = np.flatnonzero(offsets.any(axis=1))
    joints = moved_joints(kinematics, samples.joints[rows], offsets[rows])
    reached = ~np.isnan(joints).any(axis=1)
    lost = np.zeros(len(offsets), dtype=np.bool_)
    lost[rows[~reached]] = True
    rows, joints = rows[reached], joints[reached]
    samples.joints[rows] = joints
    samples.base_from_tcp.translation[rows] += offsets[rows]
    return replace(samples, lost=lost)


def lead(samples: Samples, section: CorrectedSection, mask: Mask) -> None:
    """Apply a correction to the samples that it determines."""
    times = samples.times[mask]
    ways = section.offsets_at(times)
    joints = section.joints(samples.joints[mask], ways)
    reached = ~np.isnan(joints).any(axis=1)
    rows = np.flatnonzero(mask)[reached]
    samples.joints[rows] = joints[reached]
    samples.base_from_tcp.translation[rows] += ways[reached]
    samples.tcp_speed[rows] = np.hypot(samples.tcp_speed[rows], section.speeds_at(times)[reached])


def guide(samples: Samples, section: GuidedSection, mask: Mask) -> None:
    """Replace the samples that a guided section determines."""
    times = samples.times[mask]
    joints = section.joints_at(times)
    pose = section.tcp_at(joints)
    samples.joints[mask], samples.external[mask] = joints, section.external
    samples.base_from_tcp.rotation[mask] = pose.rotation
    samples.base_from_tcp.translation[mask] = pose.translation
    samples.tcp_speed[mask] = section.tcp_speed_at(times)
