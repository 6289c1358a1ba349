"""Recognition of a SCARA from the positions of its axes with all joints at 0."""

from __future__ import annotations

import numpy as np

from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.kinematics.closed_form.scara import JOINT_COUNT, SLIDING, Scara, ScaraGeometry
from rapidsim.motion.kinematics.serial_chain import AxesAtZero

_EXACT = 1e-9
"""Tolerance [m], and of sines; descriptions with rounded or measured values exceed it."""
_DIRECTIONS = np.array([[0.0, 0.0, 1.0]] * 3 + [[0.0, 0.0, -1.0]])


def scara_arm(axes: AxesAtZero, slides: Mask) -> Scara | str:
    """Return the arm with its closed form, or the reason why it lacks this structure.

    Args:
        axes: The axes; only the direction of a sliding axis is used.
        slides: Mask (m,) of the sliding axes.
    """
    if len(slides) != JOINT_COUNT or np.flatnonzero(slides).tolist() != [SLIDING]:
        return "only joint 3 of an arm with four joints may slide"
    if np.abs(axes.directions - _DIRECTIONS).max() > _EXACT:
        return "axes 1 to 3 do not all point up, or axis 4 not down"
    foot, elbow, _, end = axes.points
    if np.abs([*foot[:2], elbow[1], end[1]]).max() > _EXACT or not 0.0 < elbow[0] < end[0]:
        return "with its joints at 0 it is not stretched along x from axis 1 in the base's origin"
    arm = Scara(
        ScaraGeometry(
            a1=float(elbow[0]),
            a2=float(end[0] - elbow[0]),
            arm_1_up=float(foot[2]),
            arm_2_up=float(elbow[2]),
            flange_up=float(axes.base_from_flange.translation[2]),
        )
    )
    zero = np.zeros(JOINT_COUNT)
    if np.abs(axes.base_from_flange.matrix - arm.forward(zero).matrix).max() > _EXACT:
        return "with its joints at 0 its flange does not point down, x forward, on axis 4"
    if np.abs(axes.base_from_link.matrix - arm.link_frames(zero).matrix).max() > _EXACT:
        return "frames of its links are not parallel to the base where its joints are at 0"
    return arm
