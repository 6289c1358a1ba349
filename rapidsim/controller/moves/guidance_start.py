"""From what a program asks for to the guidance: its law, its frames and what it is told."""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from rapidsim.controller.cell.sensors import Teller
from rapidsim.controller.cell.system_parameters import SystemParameters
from rapidsim.controller.motion_state import MotionState
from rapidsim.controller.moves.guidance_frames import frames_of, pose_aim
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.language.data import UNUSED_AXIS, EgmMinMax, ExtJoint
from rapidsim.language.errors import NotAllowed
from rapidsim.language.guidance import Activation, GuidanceTerms, SensorSetup
from rapidsim.motion.geometry.segments import Waypoint
from rapidsim.motion.guidance.aims import Aim, Band, JointAim
from rapidsim.motion.guidance.feedback import GuidedFeedback
from rapidsim.motion.guidance.guided_run import GuidedRun, Terms
from rapidsim.motion.guidance.joint_law import CYCLE_S, GuidedAxes, JointMotion, Tuning
from rapidsim.motion.timing.axis_limits import Limits
from rapidsim.motion.trajectory.guided_stretch import GuidedStretch
from rapidsim.values import dataclass

DEFAULT_BAND: Final = EgmMinMax(-0.5, 0.5)
r"""Default of \J1 and its like: how close [deg, mm] counts as there."""
_ROUNDING: Final = 1e-6


@dataclass(frozen=True, slots=True)
class ExternalMotionData:
    """A configuration of the type External Motion Interface Data."""

    filters: bool
    """Whether the controller filters by itself: at levels 1 and 2, not at 0."""
    gain: float
    """Kp [1/s]."""
    bandwidth_hz: float


DEFAULT_DATA: Final = ExternalMotionData(filters=True, gain=5.0, bandwidth_hz=20.0)
"""The one named `default`, which every controller has; from memory of ABB's documents."""


@dataclass(frozen=True, slots=True)
class AskedGuidance:
    """What the instructions of a guidance say together."""

    setup: SensorSetup
    data: ExternalMotionData
    activation: Activation
    terms: GuidanceTerms


def external_motion_data(parameters: SystemParameters, name: str) -> ExternalMotionData:
    """A configuration by name; without a MOC.cfg every name is taken for `default`.

    Raises:
        NotAllowed: If the configuration of the controller has none of that name.
    """
    known = parameters.instances("MOC", "EXT_MOTION_DATA") or ()
    for one in known:
        if one.get("name", "").lower() == name.lower():
            return ExternalMotionData(
                one.get("ext_motion_level", "1") != "0",
                _number(one.get("ext_motion_kp"), DEFAULT_DATA.gain),
                _number(one.get("ext_motion_filter_bandwidth"), DEFAULT_DATA.bandwidth_hz),
            )
    if name.lower() == "default" or not known:
        return DEFAULT_DATA
    raise NotAllowed(f"EGMSetupUC: MOC.cfg has no External Motion Interface Data `{name}`")


def started(
    asked: AskedGuidance,
    resolver: Resolver,
    state: MotionState,
    limits: Limits,
    stands: Waypoint,
    now_s: float,
) -> tuple[GuidedRun, Teller, GuidedStretch]:
    """A guidance that begins at the next cycle.

    Args:
        asked: By the program.
        resolver: Of the robot.
        state: Of the task's motion.
        limits: Of its axes.
        stands: Where the robot stands.
        now_s: Time [s].

    Raises:
        NotAllowed: Where frames are none, or not simulated.
    """
    robot, activation, terms = resolver.robot, asked.activation, asked.terms
    count = len(robot.joints)
    speed, acceleration = limits.max_speed[:count], limits.max_acceleration[:count]
    axes = GuidedAxes(robot.lower, robot.upper, speed, acceleration)
    frames = frames_of(resolver, state, activation, stands)
    run = GuidedRun(
        JointMotion(axes, stands.joints.copy(), np.zeros(count)),
        _aim(asked, resolver, state, stands),
        Tuning(asked.data.gain * terms.gain, math.radians(activation.max_speed)),
        Terms(
            terms.condition_s,
            terms.ramp_in_s,
            asked.setup.silence_s,
            terms.goes_back,
            terms.ramp_out_s,
        ),
    )
    told = Teller(
        math.ceil(now_s / CYCLE_S - _ROUNDING) * CYCLE_S,
        max(1, round(activation.sample_s / CYCLE_S)),
        GuidedFeedback(frames, used_axes(resolver.ext_joint(stands.external))),
    )
    stretch = GuidedStretch(
        told.first_s,
        CYCLE_S,
        robot.forward,
        frames.tcp_from_flange,
        stands.external,
        stands.joints,
    )
    return run, told, stretch


def used_axes(external: ExtJoint) -> tuple[float, ...]:
    """The external axes that are there [deg, mm]."""
    return tuple(value for value in external if value != UNUSED_AXIS)


def _aim(asked: AskedGuidance, resolver: Resolver, state: MotionState, stands: Waypoint) -> Aim:
    activation, terms = asked.activation, asked.terms
    filters = [activation.filter_hz]
    if asked.data.filters:
        filters.append(asked.data.bandwidth_hz)
    count = len(stands.joints) if activation.frames is None else len(activation.bands)
    chosen = np.array(terms.chosen[:count])
    bands = np.array([band or DEFAULT_BAND for band in activation.bands[:count]])
    if not chosen.any():
        chosen = np.ones(len(chosen), dtype=np.bool_)
    if activation.frames is None:
        lowest, highest = np.radians(bands).T
        return JointAim(Band(chosen, lowest, highest), tuple(filters), stands.joints)
    return pose_aim(
        resolver, stands, state, activation, terms.offset, bands, chosen, tuple(filters)
    )


def _number(text: str | None, otherwise: float) -> float:
    """A parameter of the configuration; what is no number that can be is as if it were missing."""
    try:
        value = float(text or "")
    except ValueError:
        return otherwise
    return value if 0.0 <= value < math.inf else otherwise
