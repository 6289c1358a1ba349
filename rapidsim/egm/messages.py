"""The fields and field numbers of EGM messages.

Source: what public clients of RobotWare 6 and 7 send and parse; the field numbers are theirs.
"""

from __future__ import annotations

from enum import IntEnum
from typing import Final

from rapidsim.egm.codec import FieldType, message

_N, _D, _ALL = FieldType.NUMBER, FieldType.DOUBLE, FieldType.DOUBLES


class MessageType(IntEnum):
    """The message type in the header."""

    COMMAND = 1
    DATA = 2
    CORRECTION = 3
    PATH_CORRECTION = 4


class MotorState(IntEnum):
    """Whether the motors are on."""

    ON = 1
    OFF = 2


class MciState(IntEnum):
    """The state of the guidance."""

    UNDEFINED = 0
    ERROR = 1
    STOPPED = 2
    RUNNING = 3


class ExecutionState(IntEnum):
    """Whether RAPID is executing."""

    STOPPED = 1
    RUNNING = 2


_HEADER = message(seqno=(1, _N), tm=(2, _N), mtype=(3, _N))
_CARTESIAN = message(x=(1, _D, True), y=(2, _D, True), z=(3, _D, True))
_QUATERNION = message(u0=(1, _D, True), u1=(2, _D, True), u2=(3, _D, True), u3=(4, _D, True))
_CLOCK = message(sec=(1, _N, True), usec=(2, _N, True))
_POSE = message(pos=(1, _CARTESIAN), orient=(2, _QUATERNION), euler=(3, _CARTESIAN))
_JOINTS = message(joints=(1, _ALL))
_SPEEDS = message(value=(1, _ALL))
_PLANNED = message(
    joints=(1, _JOINTS), cartesian=(2, _POSE), externalJoints=(3, _JOINTS), time=(4, _CLOCK)
)
_SPEED_REF = message(joints=(1, _JOINTS), cartesians=(2, _SPEEDS), externalJoints=(3, _JOINTS))
_STATE = message(state=(1, _N, True))
_DATA = message(digVal=(1, _N), dnum=(2, _ALL))

ROBOT: Final = message(
    header=(1, _HEADER),
    feedBack=(2, _PLANNED),
    planned=(3, _PLANNED),
    motorState=(4, _STATE),
    mciState=(5, _STATE),
    mciConvergenceMet=(6, _N),
    testSignals=(7, message(signals=(1, _ALL))),
    rapidExecState=(8, _STATE),
    utilizationRate=(10, _D),
    moveIndex=(11, _N),
    CollisionInfo=(12, message(collsionTriggered=(1, _N), collDetQuota=(2, _ALL))),
    RAPIDfromRobot=(13, _DATA),
)
"""Message of the controller; clients spell field 12 so. Forces (9) are not modelled and omitted."""
SENSOR: Final = message(
    header=(1, _HEADER), planned=(2, _PLANNED), speedRef=(3, _SPEED_REF), RAPIDtoRobot=(4, _DATA)
)
"""Message of a sensor."""
HEADED: Final = message(header=(1, _HEADER))
"""Header of any message, which has its type."""
PATH_CORRECTION: Final = message(
    header=(1, _HEADER),
    pathCorr=(2, message(pos=(1, _CARTESIAN, True), age=(2, _N, True))),
)
"""Message of a sensor that corrects a path."""
