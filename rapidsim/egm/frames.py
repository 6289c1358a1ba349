"""The datagrams that a controller and a sensor exchange."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from datetime import UTC
from typing import Any, Final

from rapidsim.controller.cell.inputs import START_OF_TIME
from rapidsim.egm.codec import DecodeError, Fields, decode, encode
from rapidsim.egm.messages import (
    HEADED,
    PATH_CORRECTION,
    ROBOT,
    SENSOR,
    ExecutionState,
    MciState,
    MessageType,
    MotorState,
)
from rapidsim.frames.quaternion import from_zyx
from rapidsim.motion.guidance.feedback import NO_DATA, Feedback, Guided, ProgramData
from rapidsim.motion.guidance.sensor import SensorAnswer

ARM_AXES: Final = 6
"""Number of joints reported as arm joints; a seventh precedes the external ones."""
_MOST: Final = 1e9
"""Maximum number that a sensor may send [mm, deg, mm/s, deg/s]."""
_UINT32: Final = 2**32
_EPOCH_S: Final = int(START_OF_TIME.replace(tzinfo=UTC).timestamp())
_MCI: Final = {
    Guided.NOT_YET: MciState.STOPPED,
    Guided.RUNNING: MciState.RUNNING,
    Guided.STOPPED: MciState.STOPPED,
    Guided.FAILED: MciState.ERROR,
}


def robot_datagram(number: int, feedback: Feedback) -> bytes:
    """The EgmRobot message sent to a sensor.

    Args:
        number: Sequence number of the message, incremented by one.
        feedback: The state of the robot.
    """
    x, y, z = feedback.position
    u0, u1, u2, u3 = feedback.orientation
    microseconds = round(feedback.time_s * 1e6)
    placed: Fields = {
        "joints": {"joints": feedback.joints[:ARM_AXES]},
        "cartesian": {
            "pos": {"x": x, "y": y, "z": z},
            "orient": {"u0": u0, "u1": u1, "u2": u2, "u3": u3},
        },
        "externalJoints": {"joints": (*feedback.joints[ARM_AXES:], *feedback.external)},
        "time": {"sec": _EPOCH_S + microseconds // 1_000_000, "usec": microseconds % 1_000_000},
    }
    executes, motors_on = feedback.executes, feedback.motors_on
    return encode(
        ROBOT,
        {
            "header": {
                "seqno": number % _UINT32,
                "tm": microseconds // 1000 % _UINT32,
                "mtype": MessageType.DATA,
            },
            "feedBack": placed,
            # The arm follows its command without lag here, so planned and actual positions are
            # equal.
            "planned": placed,
            "motorState": {"state": MotorState.ON if motors_on else MotorState.OFF},
            "mciState": {"state": _MCI[feedback.guided]},
            "mciConvergenceMet": feedback.is_met,
            "testSignals": {"signals": ()},
            "rapidExecState": {
                "state": ExecutionState.RUNNING if executes else ExecutionState.STOPPED
            },
            "utilizationRate": feedback.utilisation,
            "moveIndex": 0,
            "CollisionInfo": {"collsionTriggered": False},
            "RAPIDfromRobot": _program_data(feedback.sent),
        },
    )


def _program_data(sent: ProgramData) -> Fields | None:
    """The data of the program, as sent; None without any."""
    return None if sent == NO_DATA else {"digVal": sent.digital, "dnum": sent.numbers}


def sensor_answer(data: bytes) -> SensorAnswer:
    """The content of an EgmSensor or EgmSensorPathCorr message.

    Raises:
        DecodeError: If it is neither, or its numbers are absurdly large.
    """
    kind = decode(HEADED, data).get("header", {}).get("mtype")
    answer = _correction(data) if kind == MessageType.PATH_CORRECTION else _goal(data)
    said: Sequence[tuple[float, ...]] = (
        answer.joints,
        answer.position,
        answer.joint_speed,
        answer.tcp_speed,
        answer.correction,
    )
    if any(abs(value) > _MOST for part in said for value in part):
        raise DecodeError("a number is implausibly large")
    return answer


def _correction(data: bytes) -> SensorAnswer:
    told = decode(PATH_CORRECTION, data).get("pathCorr", {})
    return SensorAnswer(correction=_numbers(told.get("pos", {}), ("x", "y", "z")))


def _goal(data: bytes) -> SensorAnswer:
    read = decode(SENSOR, data)
    planned, speed = read.get("planned", {}), read.get("speedRef", {})
    program: Mapping[str, Any] = read.get("RAPIDtoRobot", {})
    pose = planned.get("cartesian", {})
    orientation = _numbers(pose.get("orient", {}), ("u0", "u1", "u2", "u3"))
    if "euler" in pose:
        orientation = _quaternion(_numbers(pose["euler"], ("x", "y", "z")))
    return SensorAnswer(
        joints=(*_list(planned, "joints"), *_list(planned, "externalJoints")),
        position=_numbers(pose.get("pos", {}), ("x", "y", "z")),
        orientation=orientation,
        joint_speed=(*_list(speed, "joints"), *_list(speed, "externalJoints")),
        tcp_speed=tuple(speed.get("cartesians", {}).get("value", ())),
        values=tuple(program.get("dnum", ())),
        digital=bool(program["digVal"]) if "digVal" in program else None,
    )


def _list(fields: Mapping[str, Any], name: str) -> tuple[float, ...]:
    return tuple(fields.get(name, {}).get("joints", ()))


def _numbers(fields: Mapping[str, float], names: Sequence[str]) -> tuple[float, ...]:
    return tuple(fields[name] for name in names) if fields else ()


def _quaternion(degrees: tuple[float, ...]) -> tuple[float, ...]:
    """q1..q4 of a rotation about the fixed x, then y, then z axis [deg], as OrientZYX has it."""
    if not degrees:
        return ()
    x, y, z = map(math.radians, degrees)
    return from_zyx(z, y, x)
