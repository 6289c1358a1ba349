"""Requests of a program to motion: a move with its arguments evaluated, and motion settings.

Everything is in RAPID's units.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from enum import Enum, auto
from typing import TYPE_CHECKING, Protocol

from rapidsim.diagnostics import Span
from rapidsim.language.data import (
    IDENTITY_POSE,
    MAX_TCP_SPEED_MM_S,
    AccData,
    ConfSupData,
    ExtJoint,
    JointTarget,
    LoadData,
    MotSetData,
    Pose,
    ProgDisp,
    RobTarget,
    SingData,
    SpeedData,
    ToolData,
    VelData,
    WobjData,
    ZoneData,
)
from rapidsim.values import value_class

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

LEAST_RAMP_PERCENT = 10.0
CONFIGURATION_LIMITS_DEG = (30.0, 180.0, 90.0)
"""Maximum turns of axes 1, 4 and 6 with ConfJ and ConfL on, as in C_MOTSET."""
NO_LIMIT = -1.0
"""Value in C_MOTSET of a limit that is off."""
NO_OFFSETS = ExtJoint(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@value_class(frozen=True, slots=True, repr=False)
class Place:
    """Location of a statement in the program, for events and reports."""

    span: Span
    routine: str
    arguments: Mapping[str, str] = field(default_factory=dict)
    """Source text of the call's arguments, by folded parameter name: `{"topoint": "p20"}`."""
    row: AnnouncedRow | None = field(default=None, compare=False)
    """Its row in bulk moves, which make a place anew for each execution; None for others."""

    def __repr__(self) -> str:
        """One line."""
        return f"{self.span!r} in {self.routine}"


class AnnouncedTargets(Protocol):
    """Targets of the next moves, known before their statements execute."""

    def __len__(self) -> int: ...

    def __getitem__(self, number: int) -> RobTarget: ...

    @property
    def starts(self) -> npt.NDArray[np.int64]:
        """Offsets of their statements in the text."""
        ...

    def place(self, number: int) -> Place:
        """Place of the statement with the target of a number."""
        ...


@value_class(frozen=True, slots=True, eq=False)
class AnnouncedRow:
    """A statement with an announced target."""

    targets: AnnouncedTargets
    number: int


class Interpolation(Enum):
    """Path of a move to its end."""

    JOINT = "joint"
    """MoveJ: straight in joint space to a pose."""
    LINE = "line"
    """MoveL: the TCP on a straight line."""
    CIRCLE = "circle"
    """MoveC: the TCP on an arc through a circle point."""
    AXES = "axes"
    """MoveAbsJ: straight in joint space to axis positions."""
    EXTERNAL_AXES = "external axes"
    """MoveExtJ: only the external axes."""

    @property
    def leads_tcp(self) -> bool:
        """Whether the TCP follows a curve in space; otherwise axes move straight to their ends."""
        return self in (Interpolation.LINE, Interpolation.CIRCLE)


@value_class(frozen=True, slots=True)
class StopTime:
    """Minimum time at a stop point."""

    seconds: float
    program_waits: bool
    """Whether the program waits with the robot."""


class SensorInfluence(Enum):
    """Whether a sensor affects the path of a move."""

    NEVER = auto()
    """The sensor has no influence: all moves but EGMMoveL and EGMMoveC."""
    NOT_HERE = auto()
    """The sensor corrects the moves before and after, but not this one: \\NoCorr."""
    CORRECTED = auto()


@value_class(frozen=True, slots=True)
class Move:
    """One move instruction with its arguments evaluated."""

    instruction: str
    interpolation: Interpolation
    to: RobTarget | JointTarget
    speed: SpeedData
    zone: ZoneData
    tool: ToolData
    wobj: WobjData
    circle_point: RobTarget | None = None
    duration_s: float | None = None
    """The argument \\T: time of the whole move, which replaces the speed."""
    concurrent: bool = False
    """The argument \\Conc: the program continues at once."""
    sync_id: float | None = None
    """The argument \\ID: moves of several robots with the same number are made together."""
    stop: StopTime | None = None
    """The argument \\Inpos, if it specifies a time."""
    programmed: RobTarget | None = None
    """The target as programmed, if \\Corr moves it; else None."""
    sensed: SensorInfluence = SensorInfluence.NEVER
    """Whether a sensor corrects its path."""


class SingularArea(Enum):
    """SingArea: treatment of singularities of the wrist."""

    OFF = "off"
    """The programmed path is kept."""
    WRIST = "wrist"
    """The wrist axes are interpolated; the orientation of the tool deviates a little."""
    LOCK_AXIS_4 = "lock axis 4"
    """Like `WRIST`, with axis 4 fixed at 0 or half a turn."""


class CirclePathMode(Enum):
    """CirPathMode: orientation of the tool on an arc."""

    PATH_FRAME = r"\PathFrame"
    OBJECT_FRAME = r"\ObjectFrame"
    CIR_POINT_ORI = r"\CirPointOri"
    WRIST45 = r"\Wrist45"
    WRIST46 = r"\Wrist46"
    WRIST56 = r"\Wrist56"


AXES_IN_USE = frozenset({"inactive_units", "independent_axes"})
"""Settings by which targets have no effect on external axes; the robot stops to change them."""


@value_class(frozen=True, slots=True)
class MotionSettings:
    """Settings by VelSet, AccSet, ConfL and their like; the defaults are those after PP to main."""

    speed_override_percent: float = 100.0
    speed_refresh_percent: float = 100.0
    """SpeedRefresh: the operator's override."""
    max_speed_mm_s: float | None = None
    acceleration_percent: float = 100.0
    ramp_percent: float = 100.0
    fine_ramp_percent: float = 100.0
    """AccSet: rate at which braking rises at stop points [%], relative to `ramp_percent`."""
    grip_load: LoadData | None = None
    """GripLoad: load of the gripper; None before the first."""
    grip_load_name: str = "load0"
    """Its name in the program."""
    tcp_acceleration_m_s2: float | None = None
    """PathAccLim: along the path."""
    tcp_deceleration_m_s2: float | None = None
    world_acceleration_m_s2: float | None = None
    """WorldAccLim: in any direction."""
    conf_j: bool = True
    conf_l: bool = True
    singular_area: SingularArea = SingularArea.OFF
    circle_path: CirclePathMode = CirclePathMode.PATH_FRAME
    inactive_units: frozenset[str] = frozenset()
    """Folded names of the mechanical units that DeactUnit has deactivated."""
    independent_axes: frozenset[str] = frozenset()
    """External axes, such as `eax_a`, that IndCMove and its like have made independent."""
    displacement: Pose | None = None
    """PDispOn, PDispSet: already applied to the moves that reach the controller."""
    axis_offsets: ExtJoint | None = None
    """EOffsOn, EOffsSet: already applied to the moves that reach the controller."""
    path_resolution_percent: float = 100.0
    motion_supervision: bool = True
    supervision_tune_percent: float = 100.0
    """PathResol and MotionSup: stored to be read back, without effect."""

    @property
    def speed_share(self) -> float:
        """Share of programmed speeds that results from both overrides."""
        return self.speed_override_percent * self.speed_refresh_percent / 1e4

    @property
    def grip_load_kg(self) -> float:
        """Mass [kg] of the load of the gripper."""
        return 0.0 if self.grip_load is None else self.grip_load.mass

    @property
    def c_motset(self) -> MotSetData:
        """RAPID's C_MOTSET."""
        fastest = MAX_TCP_SPEED_MM_S if self.max_speed_mm_s is None else self.max_speed_mm_s
        area, modes = self.singular_area, tuple(CirclePathMode)
        return MotSetData(
            VelData(self.speed_override_percent, fastest),
            AccData(self.acceleration_percent, self.ramp_percent, self.fine_ramp_percent),
            SingData(
                area is SingularArea.WRIST,
                area is SingularArea.LOCK_AXIS_4,
                False,
                area is SingularArea.OFF,
            ),
            ConfSupData(self.conf_j, self.conf_l, *CONFIGURATION_LIMITS_DEG),
            self.path_resolution_percent,
            self.motion_supervision,
            self.supervision_tune_percent,
            self.tcp_acceleration_m_s2 is not None,
            NO_LIMIT if self.tcp_acceleration_m_s2 is None else self.tcp_acceleration_m_s2,
            self.tcp_deceleration_m_s2 is not None,
            NO_LIMIT if self.tcp_deceleration_m_s2 is None else self.tcp_deceleration_m_s2,
            float(modes.index(self.circle_path)),
            self.world_acceleration_m_s2 is not None,
            NO_LIMIT if self.world_acceleration_m_s2 is None else self.world_acceleration_m_s2,
            True,
        )

    @property
    def c_progdisp(self) -> ProgDisp:
        """RAPID's C_PROGDISP."""
        return ProgDisp(self.displacement or IDENTITY_POSE, self.axis_offsets or NO_OFFSETS)


class Flank(Enum):
    """The signal change a search waits for."""

    RISING = "rising"
    """The signal goes to 1; it must not be 1 at the start."""
    FALLING = "falling"
    """The signal goes to 0; it must not be 0 at the start."""
    ONLY_RISING = "only rising"
    """The signal goes to 1, whatever it was."""
    ONLY_FALLING = "only falling"
    """The signal goes to 0, whatever it was."""
    EITHER = "either"
    """The signal changes."""


class SearchStop(Enum):
    """Reaction of the robot to the first hit."""

    STIFFLY = "stop stiffly"
    """Stop as fast as possible."""
    SOFTLY = "stop softly"
    """Stop on the path, or near it."""
    ON_PATH = "stop on the path"
    """Stop on the path, with gentle braking."""
    GO_ON = "go on"
    """Continue to the end of the move."""
    GO_ON_ONCE = "go on, one hit"
    """Continue to the end of the move; a second hit is an error."""
