"""Building a guidance from the program's request: its law, its frames and its feedback."""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from rapidsim.controller.cell.sensors import FeedbackSchedule
from rapidsim.controller.cell.system_parameters import SystemParameters
from rapidsim.controller.motion_state import MotionState
from rapidsim.controller.moves.guidance_frames import frames_of, pose_aim
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.language.data import UNUSED_AXIS, EgmMinMax, ExtJoint
from rapidsim.language.errors import NotAllowed
from rapidsim.language.guidance import Activation, GuidanceTerms, SensorSetup
from rapidsim.motion.geometry.segments import Waypoint
from rapidsim.motion.guidance.feedback import GuidedFeedback
from rapidsim.motion.guidance.goals import Band, GuidanceGoal, JointGoal
from rapidsim.motion.guidance.guided_execution import EndConditions, GuidedExecution
from rapidsim.motion.guidance.joint_law import CYCLE_S, GuidedAxes, JointMotion, Tuning
from rapidsim.motion.timing.axis_limits import Limits
from rapidsim.motion.trajectory.guided_section import GuidedSection
from rapidsim.values import value_class

DEFAULT_BAND: Final = EgmMinMax(-0.5, 0.5)
r"""Default of \J1 and its like: tolerance [deg, mm] of the goal."""
_ROUNDING: Final = 1e-6


@value_class(frozen=True, slots=True)
class ExternalMotionData:
    """A configuration of the type External Motion Interface Data."""

    filters: bool
    """Whether the controller adds its own filter: at levels 1 and 2, not at 0."""
    gain: float
    """Kp [1/s]."""
    bandwidth_hz: float


DEFAULT_DATA: Final = ExternalMotionData(filters=True, gain=5.0, bandwidth_hz=20.0)
"""The configuration `default`, which every controller has; from memory of ABB's documents."""


@value_class(frozen=True, slots=True)
class GuidanceRequest:
    """The combined data of the instructions of a guidance."""

    setup: SensorSetup
    data: ExternalMotionData
    activation: Activation
    terms: GuidanceTerms


def external_motion_data(parameters: SystemParameters, name: str) -> ExternalMotionData:
    """A configuration by name; without a MOC.cfg every name means `default`.

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
    request: GuidanceRequest,
    resolver: Resolver,
    state: MotionState,
    limits: Limits,
    waypoint: Waypoint,
    now_s: float,
) -> tuple[GuidedExecution, FeedbackSchedule, GuidedSection]:
    """Build a guidance that begins at the next cycle.

    Args:
        request: Of the program.
        resolver: Of the robot.
        state: Of the task's motion.
        limits: Of its axes.
        waypoint: Position of the robot.
        now_s: Time [s].

    Raises:
        NotAllowed: If frames are invalid or not simulated.
    """
    robot, activation, terms = resolver.robot, request.activation, request.terms
    count = len(robot.joints)
    speed, acceleration = limits.max_speed[:count], limits.max_acceleration[:count]
    axes = GuidedAxes(robot.lower, robot.upper, speed, acceleration)
    frames = frames_of(resolver, state, activation, waypoint)
    run = GuidedExecution(
        JointMotion(axes, waypoint.joints.copy(), np.zeros(count)),
        _aim(request, resolver, state, waypoint),
        Tuning(request.data.gain * terms.gain, math.radians(activation.max_speed)),
        EndConditions(
            terms.condition_s,
            terms.ramp_in_s,
            request.setup.silence_s,
            terms.moves_back,
            terms.ramp_out_s,
        ),
    )
    told = FeedbackSchedule(
        math.ceil(now_s / CYCLE_S - _ROUNDING) * CYCLE_S,
        max(1, round(activation.sample_s / CYCLE_S)),
        GuidedFeedback(frames, used_axes(resolver.ext_joint(waypoint.external))),
    )
    stretch = GuidedSection(
        told.first_s,
        CYCLE_S,
        robot.forward,
        frames.tcp_from_flange,
        waypoint.external,
        waypoint.joints,
    )
    return run, told, stretch


def used_axes(external: ExtJoint) -> tuple[float, ...]:
    """The external axes that exist [deg, mm]."""
    return tuple(value for value in external if value != UNUSED_AXIS)


def _aim(
    request: GuidanceRequest, resolver: Resolver, state: MotionState, waypoint: Waypoint
) -> GuidanceGoal:
    activation, terms = request.activation, request.terms
    filters = [activation.filter_hz]
    if request.data.filters:
        filters.append(request.data.bandwidth_hz)
    count = len(waypoint.joints) if activation.frames is None else len(activation.bands)
    chosen = np.array(terms.chosen[:count])
    bands = np.array([band or DEFAULT_BAND for band in activation.bands[:count]])
    if not chosen.any():
        chosen = np.ones(len(chosen), dtype=np.bool_)
    if activation.frames is None:
        lowest, highest = np.radians(bands).T
        return JointGoal(Band(chosen, lowest, highest), tuple(filters), waypoint.joints)
    return pose_aim(
        resolver, waypoint, state, activation, terms.offset, bands, chosen, tuple(filters)
    )


def _number(text: str | None, default: float) -> float:
    """A parameter of the configuration; the default if it is not a finite number >= 0."""
    try:
        value = float(text or "")
    except ValueError:
        return default
    return value if 0.0 <= value < math.inf else default
