"""Three programs whose logs show what a calibration needs: swings, corners and picks.

They move the bare arm around the posture in which its runs begin. Their size is a share of the
arm's reach, the largest that has no findings.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from types import MappingProxyType

import numpy as np

from rapidsim.applications.calibrate.rapid_text import joint_target, rob_target
from rapidsim.diagnostics import Severity
from rapidsim.files import InputError
from rapidsim.frames.transform import Array, Transform
from rapidsim.jobs.checking.check_files import check
from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot.robot import Robot, RobotError
from rapidsim.motion.timing.axis_limits import limits_of

_SIZES = (1.0, 0.7, 0.5, 0.35, 0.25, 0.15, 0.1)
_SPEEDS = ("v2000", "v1000", "v500", "v200")
_SWING_DEG = 30.0
_OF_MARGIN = 0.6
"""Largest swing, as a share of the distance of an axis to its nearer limit."""
_OF_REACH = 0.12
"""Length of the short lines, as a share of the reach."""
_TYPICAL_REACH_M = 1.0
_ZONES = ("z1", "z5", "z10", "z20")
_CORNERS = 5
_MOST_AXES_ON_LINES = 6

Body = Callable[[Robot, float, str], Iterator[str]]
"""Statements for an arm, a size, and the highest speed."""


def standard_programs(robot: Robot) -> Mapping[str, str]:
    """Return the programs for an arm, by the name of their file.

    Raises:
        InputError: If no size of a program is possible, or the speed of an axis is unknown.
    """
    try:
        limits_of(robot, MotionModel())
    except RobotError as error:
        raise InputError(
            str(error), "programs are written only for arms whose axis speeds are known"
        ) from error
    return {f"{name}.mod": _largest(robot, name, body) for name, body in _BODIES.items()}


def _largest(robot: Robot, name: str, body: Body) -> str:
    """Return the largest program of a kind that has no findings, at the highest speed."""
    with TemporaryDirectory() as folder:
        file = Path(folder) / f"{name}.mod"
        for size in _SIZES:
            for speed in _SPEEDS:
                text = _module(robot, name, list(body(robot, size, speed)))
                file.write_text(text, encoding="ascii")
                findings = check([file], robot=robot).diagnostics
                if not findings:
                    return text
                if any(one.severity is Severity.ERROR for one in findings):
                    break
    raise InputError(f"{robot.name}: no {name} are possible around its first posture")


def _module(robot: Robot, name: str, statements: list[str]) -> str:
    home = joint_target(robot.start, robot.kinematics)
    lines = [
        f"MODULE {name}",
        f"  ! For {robot.title}, without tool and load. Keep the space around the arm free.",
        "  ! Log the axes from rest before the start until the arm is at rest again.",
        f"  CONST jointtarget home:={home};",
        "",
        "  PROC main()",
        r"    ConfJ\Off;",
        r"    ConfL\Off;",
        "    MoveAbsJ home,v500,fine,tool0;",
        "    WaitTime 1;",
        *(f"    {statement}" for statement in statements),
        "  ENDPROC",
        "ENDMODULE",
    ]
    return "\n".join(lines) + "\n"


def _swings(robot: Robot, size: float, speed: str) -> Iterator[str]:
    """Swings of each axis, then of all, between stop points at full speed."""
    del speed
    margin = np.minimum(robot.start - robot.lower, robot.upper - robot.start)
    swing = np.minimum(np.radians(_SWING_DEG), _OF_MARGIN * margin) * size
    ways: list[Array] = [*np.diag(swing), swing, swing * (-1.0) ** np.arange(len(swing))]
    for way in ways:
        for joints in (robot.start + way, robot.start - way):
            yield f"MoveAbsJ {joint_target(joints, robot.kinematics)},vmax,fine,tool0;"
    yield "MoveAbsJ home,vmax,fine,tool0;"


def _corners(robot: Robot, size: float, speed: str) -> Iterator[str]:
    """A long line at moderate speed, and zigzags with small zones at full speed."""
    step, line = _step(robot, size), _line(robot)
    across = np.array([0.0, 1.0, 0.0]) * step
    begin = -0.5 * _CORNERS * across
    yield f"{line} {_target(robot, begin)},v200,fine,tool0;"
    yield f"{line} {_target(robot, -begin)},v300,fine,tool0;"
    yield f"{line} {_target(robot, begin)},v300,fine,tool0;"
    for zone in _ZONES:
        for number in range(1, _CORNERS + 1):
            aside = np.array([step * (number % 2), 0.0, 0.0])
            corner = "fine" if number == _CORNERS else zone
            place = begin + number * across + aside
            yield f"{line} {_target(robot, place)},{speed},{corner},tool0;"
        yield f"{line} {_target(robot, begin)},v300,fine,tool0;"


def _picks(robot: Robot, size: float, speed: str) -> Iterator[str]:
    """Cycles of picking and placing, with the speeds and zones of such work."""
    step, line = _step(robot, size), _line(robot)
    down, aside = np.array([0.0, 0.0, -0.5 * step]), np.array([0.0, 2.0 * step, 0.0])
    yield "FOR i FROM 1 TO 3 DO"
    for place in (-aside, aside):
        above, at = _target(robot, place), _target(robot, place + down)
        yield f"  MoveJ {above},{speed},z20,tool0;"
        yield f"  {line} {at},v200,fine,tool0;"
        yield "  WaitTime 0.2;"
        yield f"  {line} {above},{speed},z20,tool0;"
    yield "ENDFOR"
    yield "MoveAbsJ home,v500,fine,tool0;"


def _step(robot: Robot, size: float) -> float:
    """Length [m] of the short lines."""
    return _OF_REACH * size * (robot.reach_m or _TYPICAL_REACH_M)


def _line(robot: Robot) -> str:
    """Return the instruction for lines; those of arms with seven axes are not simulated."""
    return "MoveL" if len(robot.joints) <= _MOST_AXES_ON_LINES else "MoveJ"


def _target(robot: Robot, offset: Array) -> str:
    """Return the target at an offset [m] from the flange in the posture of the start."""
    pose = robot.forward(robot.start)
    moved = Transform(pose.rotation, pose.translation + offset)
    return rob_target(moved, robot.start, robot.kinematics)


_BODIES: Mapping[str, Body] = MappingProxyType(
    {"swings": _swings, "corners": _corners, "picks": _picks}
)
