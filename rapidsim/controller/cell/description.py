"""Description of the cell: signals, cross connections, stimuli of inputs, socket peers.

All of it is plain data, read from a station file or from the file of `--io`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from enum import StrEnum
from typing import Annotated, Literal

from rapidsim.controller.cell.camera_scripts import CameraScript
from rapidsim.controller.cell.conditions import Condition
from rapidsim.controller.cell.conveyor_scripts import ConveyorScript
from rapidsim.controller.cell.faults import Fault
from rapidsim.controller.cell.occasions import Occasion
from rapidsim.controller.cell.part_poses import PartPose
from rapidsim.controller.cell.socket_scripts import SocketScript
from rapidsim.json_records.declarations import AboveZero, Key, NotNegative, OneOf, Required
from rapidsim.values import value_class


class SignalKind(StrEnum):
    """Type of a signal's value, and whether it is an input or an output."""

    DI = "di"
    DO = "do"
    GI = "gi"
    GO = "go"
    AI = "ai"
    AO = "ao"


_LONGEST_NUMBER = 10
GROUP_WIDTH = 32
"""Number of bits of an undeclared group, and the maximum of a group."""


def mapped_bits(text: str) -> tuple[int, ...]:
    """Bits of a device that a text such as `0-3,8` defines, the lowest of the group first.

    At most as many as a group can have; invalid parts are skipped.
    """
    found: list[int] = []
    for part in text.replace(" ", "").split(","):
        first, _, last = part.partition("-")
        if _is_bit(first) and _is_bit(last or first):
            begin, end = int(first), int(last or first)
            step = 1 if begin <= end else -1
            bits = range(begin, end + step, step)
            found += bits[: GROUP_WIDTH - len(found)]
    return tuple(found)


def _is_bit(word: str) -> bool:
    return word.isascii() and word.isdecimal() and len(word) < _LONGEST_NUMBER


FIRST_ROBOT = "ROB_1"


class Status(StrEnum):
    """State of a controller that a system output shows, in the words of its configuration."""

    TASK_EXECUTING = "TaskExecuting"
    CYCLE_ON = "CycleOn"
    ERROR = "Error"
    EXECUTION_ERROR = "ExecutionError"
    MOTOR_ON = "MotorOn"
    MOTOR_ON_STATE = "MotOnState"
    MOTOR_OFF = "MotorOff"
    MOTOR_OFF_STATE = "MotOffState"
    AUTO_ON = "AutoOn"
    RUN_CHAIN_OK = "RunchOk"
    EMERGENCY_STOP = "EmStop"
    UNIT_ACTIVE = "MechUnitActive"
    UNIT_NOT_MOVING = "MechUnitNotMoving"

    @property
    def at_start(self) -> float:
        """Value at the start of a run: automatic mode, motors on, no error, robots at rest."""
        return float(self not in _NOT_IN_A_RUN)


_NOT_IN_A_RUN = (
    Status.ERROR,
    Status.EXECUTION_ERROR,
    Status.MOTOR_OFF,
    Status.MOTOR_OFF_STATE,
    Status.EMERGENCY_STOP,
)


class SystemAction(StrEnum):
    """Action of a controller that a system input causes when it becomes 1, as configured."""

    START = "Start"
    START_AT_MAIN = "StartMain"
    STOP = "Stop"
    QUICK_STOP = "QuickStop"
    SOFT_STOP = "SoftStop"
    STOP_AT_CYCLE_END = "StopCycle"
    STOP_AT_INSTRUCTION_END = "StopInstr"
    MOTORS_ON = "MotOn"
    MOTORS_OFF = "MotOff"
    MOTORS_ON_AND_START = "MotOnStart"
    RESET_EMERGENCY_STOP = "ResetEstop"
    POINTER_TO_MAIN = "PPtoMain"
    RESTART = "SysReset"


@value_class(frozen=True, slots=True)
class SignalDeclaration:
    """One signal of the I/O configuration."""

    name: str
    kind: SignalKind
    value: float = 0.0
    """Its initial value."""
    lowest: float | None = None
    highest: float | None = None
    """Logical limits; None if not limited."""
    status: Status | None = None
    """The controller state that it shows, if it is a system output."""
    task: str | None = None
    """The task whose state it shows; None for any."""
    unit: str = FIRST_ROBOT
    """The mechanical unit whose state it shows."""
    action: SystemAction | None = None
    """The action of the controller that it causes, if it is a system input."""
    cycle: str = ""
    """Cycle mode of a start that it causes: CONT or CYCLE; empty for the current one."""

    @property
    def width(self) -> int | None:
        """Number of bits of a group; None for other signals."""
        if self.kind not in (SignalKind.GI, SignalKind.GO) or self.highest is None:
            return None
        return round(math.log2(self.highest + 1.0))


@value_class(frozen=True, slots=True, kw_only=True)
class Stimulus(Occasion):
    """An external change of inputs: at a time, or after a condition became true."""

    values: Annotated[
        Mapping[str, float],
        Key("set"),
        Required("name signals and their values, as in { diReady = 1 }"),
    ]
    """New values of the signals."""
    pulse_s: Annotated[AboveZero | None, Key("pulse")] = None
    """After this time the signals return to their previous values."""

    def replaces(self, stimulus: Stimulus) -> bool:
        """Whether it is about the same event and the same signals as another."""
        names = {name.lower() for name in stimulus.values}
        is_same_event = self.when is not None and self.when == stimulus.when
        return is_same_event and {name.lower() for name in self.values} == names


@value_class(frozen=True, slots=True, kw_only=True)
class Gripper:
    """A gripper of a program: the signals that close it and those that confirm that."""

    name: str = "the gripper"
    """Its name in findings."""
    close: Annotated[
        Condition, Required('name what closes it, as in close = "doGrip = 1"', of_table=True)
    ]
    """While it holds, the gripper closes or is closed; otherwise it opens or is open."""
    closed: Condition | None = None
    """The feedback; None if the gripper has none."""
    at: Annotated[
        Literal["stand", "anywhere"], OneOf('"stand" or "anywhere" is needed', folds_case=False)
    ] = "stand"
    """Place of its action: where the arm is at rest, or anywhere."""
    load_kg: Annotated[NotNegative, Key("load")] = 0.0
    """Mass of the held object; 0 if not specified."""
    task: str | None = None
    """The task whose robot carries it; None for that of the first robot."""


_CROSS = Required('both are needed: set = "doLamp", from = "doRun and not diFault"', of_table=True)


@value_class(frozen=True, slots=True)
class CrossConnection:
    """A signal that the I/O system or a device derives from others, without the program."""

    result: Annotated[str, Key("set"), _CROSS]
    """The signal."""
    condition: Annotated[Condition, Key("from"), _CROSS]
    """While it holds, the signal is 1, otherwise 0."""
    after_s: Annotated[NotNegative, Key("after")] = 0.0
    """The delay, each time."""


@value_class(frozen=True, slots=True, kw_only=True)
class DescribedFingers:
    """A servo gripper as the station describes it."""

    task: str | None = None
    """The task of its robot; None for all."""
    object_mm: Annotated[
        NotNegative,
        Key("object"),
        Required(
            "state where closing fingers meet the object, as in object = 12 [mm]", of_table=True
        ),
    ]
    """Position at which closing fingers meet an object."""

    def is_of(self, task: str) -> bool:
        """Whether it is the gripper of a task."""
        return self.task is None or self.task.lower() == task.lower()


@value_class(frozen=True, slots=True)
class CellIo:
    """The signals of a cell and what drives them."""

    signals: tuple[SignalDeclaration, ...] = ()
    crosses: tuple[CrossConnection, ...] = ()
    stimuli: tuple[Stimulus, ...] = ()
    faults: tuple[Fault, ...] = ()
    sockets: tuple[SocketScript, ...] = ()
    """The peers of the program's sockets."""
    cameras: tuple[CameraScript, ...] = ()
    conveyors: tuple[ConveyorScript, ...] = ()
    grippers: tuple[Gripper, ...] = ()
    smart_grippers: tuple[DescribedFingers, ...] = ()
    parts: tuple[PartPose, ...] = ()
    """Poses of the parts that a torch searches; the first that applies counts."""

    def and_also(self, other: CellIo) -> CellIo:
        """Both combined; what both declare, or drive at one event, is as the other says."""
        later = {signal.name.lower() for signal in other.signals}
        kept = tuple(signal for signal in self.signals if signal.name.lower() not in later)
        driven = tuple(
            one for one in self.stimuli if not any(new.replaces(one) for new in other.stimuli)
        )
        return replace(
            self,
            signals=(*kept, *other.signals),
            crosses=(*self.crosses, *other.crosses),
            stimuli=(*driven, *other.stimuli),
            faults=(*self.faults, *other.faults),
            sockets=(*self.sockets, *other.sockets),
            cameras=(*self.cameras, *other.cameras),
            conveyors=(*self.conveyors, *other.conveyors),
            grippers=(*self.grippers, *other.grippers),
            smart_grippers=(*self.smart_grippers, *other.smart_grippers),
            parts=(*other.parts, *self.parts),
        )

    @property
    def written(self) -> tuple[str, ...]:
        """Names of the signals that follow others or are driven, each once."""
        driven = [name for stimulus in self.stimuli for name in stimulus.values]
        driven += [name for one in self.conveyors for name in (one.switch, one.connected) if name]
        return tuple(dict.fromkeys((*(cross.result for cross in self.crosses), *driven)))

    @property
    def read(self) -> tuple[str, ...]:
        """Names of the signals that connections, stimuli and grippers read, each once."""
        looked_at = [cross.condition for cross in self.crosses]
        occasions: tuple[Occasion, ...] = (*self.stimuli, *self.faults)
        looked_at += [occasion.when for occasion in occasions if occasion.when]
        looked_at += [condition for one in self.conveyors for condition in one.conditions]
        for gripper in self.grippers:
            looked_at += [one for one in (gripper.close, gripper.closed) if one is not None]
        return tuple(dict.fromkeys(name for one in looked_at for name in one.signals()))

    @property
    def wired(self) -> tuple[str, ...]:
        """Names of the signals that connections, stimuli and grippers mention."""
        return tuple(dict.fromkeys((*self.written, *self.read)))
