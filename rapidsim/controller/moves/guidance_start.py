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
from rapidsim.motion.guidance.feedback import GuidedFeedback, ProgramData
from rapidsim.motion.guidance.goals import Band, GuidanceGoal, JointGoal
from rapidsim.motion.guidance.guided_execution import EndConditions, GuidedExecution
from rapidsim.motion.guidance.joint_law import CYCLE_S, GuidedAxes, JointMotion, Tuning
from rapidsim.motion.timing.axis_limits import Limits
from rapidsim.motion.trajectory.guided_section import GuidedSection
from rapidsim.values import value_class

DEFAULT_ANGLE: Final = EgmMinMax(-0.5, 0.5)
DEFAULT_LENGTH: Final = EgmMinMax(-1.0, 1.0)
r"""Defaults of \J1 and its like: tolerance [deg, mm] of the goal."""
_LENGTHS: Final = 3
"""Number of lengths that a pose begins with."""
_ROUNDING: Final = 1e-6


@value_class(frozen=True, slots=True)
class ExternalMotionData:
    """A configuration of the type External Motion Interface Data."""

    filters: bool
    """Whether the controller adds its own filter: at levels 1 and 2, not at 0."""
    gain: float
    """Kp [1/s]."""
    bandwidth_hz: float
    """Bandwidth of the goal's filter [Hz], and of the speed's [rad/s]; see `joint_law`."""
    ramp_s: float


DEFAULT_DATA: Final = ExternalMotionData(filters=True, gain=5.0, bandwidth_hz=20.0, ramp_s=0.5)
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
                _number(one.get("ramp_time"), DEFAULT_DATA.ramp_s),
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
    sent: ProgramData,
) -> tuple[GuidedExecution, FeedbackSchedule, GuidedSection]:
    """Build a guidance that begins at the next cycle.

    Args:
        request: Of the program.
        resolver: Of the robot.
        state: Of the task's motion.
        limits: Of its axes.
        waypoint: Position of the robot.
        now_s: Time [s].
        sent: Data of the program for the sensor.

    Raises:
        NotAllowed: If frames are invalid or not simulated.
    """
    robot, activation, terms = resolver.robot, request.activation, request.terms
    data, count = request.data, len(robot.joints)
    speed, acceleration = limits.max_speed[:count], limits.max_acceleration[:count]
    furthest = math.radians(activation.max_deviation)
    axes = GuidedAxes(
        np.maximum(robot.lower, waypoint.joints - furthest),
        np.minimum(robot.upper, waypoint.joints + furthest),
        speed,
        acceleration,
    )
    frames = frames_of(resolver, state, activation, waypoint)
    run = GuidedExecution(
        JointMotion(axes, waypoint.joints.copy(), np.zeros(count)),
        _aim(request, resolver, state, waypoint),
        Tuning(
            data.gain * terms.gain,
            math.radians(activation.max_speed),
            data.bandwidth_hz if data.filters else 0.0,
        ),
        EndConditions(
            terms.condition_s,
            data.ramp_s if terms.ramp_in_s is None else terms.ramp_in_s,
            request.setup.silence_s,
            terms.moves_back,
            data.ramp_s if terms.ramp_out_s is None else terms.ramp_out_s,
        ),
    )
    told = FeedbackSchedule(
        math.ceil(now_s / CYCLE_S - _ROUNDING) * CYCLE_S,
        max(1, round(activation.sample_s / CYCLE_S)),
        GuidedFeedback(frames, used_axes(resolver.ext_joint(waypoint.external))),
        sent,
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
    filter_hz = activation.filter_hz
    filters = (request.data.bandwidth_hz if filter_hz is None else filter_hz,)
    is_pose = activation.frames is not None
    count = len(activation.bands) if is_pose else len(waypoint.joints)
    chosen = np.array(terms.chosen[:count])
    defaults = [DEFAULT_LENGTH if is_pose and k < _LENGTHS else DEFAULT_ANGLE for k in range(count)]
    bands = np.array([band or by for band, by in zip(activation.bands, defaults, strict=False)])
    if not is_pose:
        lowest, highest = np.radians(bands).T
        return JointGoal(Band(chosen, lowest, highest), filters, waypoint.joints)
    return pose_aim(resolver, waypoint, state, activation, terms.offset, bands, chosen, filters)


def _number(text: str | None, default: float) -> float:
    """A parameter of the configuration; the default if it is not a finite number >= 0."""
    try:
        value = float(text or "")
    except ValueError:
        return default
    return value if 0.0 <= value < math.inf else default
