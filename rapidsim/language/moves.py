"""What a program asks of the motion: a move with its arguments evaluated, and motion settings.

Everything is in RAPID's units.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from enum import Enum, auto

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

LEAST_RAMP_PERCENT = 10.0
CONFIGURATION_LIMITS_DEG = (30.0, 180.0, 90.0)
"""How far axes 1, 4 and 6 may turn with ConfJ and ConfL on, as C_MOTSET gives it."""
NO_LIMIT = -1.0
"""What C_MOTSET gives for a limit that is off."""
NO_OFFSETS = ExtJoint(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


@value_class(frozen=True, slots=True, repr=False)
class Place:
    """Where a statement stands, for events and reports."""

    span: Span
    routine: str
    arguments: Mapping[str, str] = field(default_factory=dict)
    """Source text of the call's arguments, by folded parameter name: `{"topoint": "p20"}`."""
    is_lasting: bool = field(default=True, compare=False)
    """Whether it stays the same when the statement is executed again; not in runs of moves."""

    def __repr__(self) -> str:
        """One line."""
        return f"{self.span!r} in {self.routine}"


class Interpolation(Enum):
    """How a move gets to its end."""

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
        """Whether the TCP follows a curve in space; else axes move straight to where they end."""
        return self in (Interpolation.LINE, Interpolation.CIRCLE)


@value_class(frozen=True, slots=True)
class StopTime:
    """The shortest time at a stop point."""

    seconds: float
    program_waits: bool
    """Whether the program waits with the robot."""


class SensorInfluence(Enum):
    """Whether a sensor affects the path of a move."""

    NEVER = auto()
    """Nothing: all moves but EGMMoveL and EGMMoveC."""
    NOT_HERE = auto()
    """It corrects the moves before and behind: \\NoCorr."""
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
    """The argument \\Conc: the program goes on at once."""
    sync_id: float | None = None
    """The argument \\ID: moves of several robots with the same number are made together."""
    stop: StopTime | None = None
    """The argument \\Inpos, where it gives a time."""
    programmed: RobTarget | None = None
    """The target as programmed, where \\Corr moves it."""
    sensed: SensorInfluence = SensorInfluence.NEVER
    """Whether a sensor corrects its path."""


class SingularArea(Enum):
    """SingArea: how singularities of the wrist are passed."""

    OFF = "off"
    """The programmed path is kept."""
    WRIST = "wrist"
    """The wrist axes are interpolated; the orientation of the tool deviates a little."""
    LOCK_AXIS_4 = "lock axis 4"
    """As `WRIST`, and axis 4 stays at 0 or half a turn."""


class CirclePathMode(Enum):
    """CirPathMode: how the tool turns on an arc."""

    PATH_FRAME = r"\PathFrame"
    OBJECT_FRAME = r"\ObjectFrame"
    CIR_POINT_ORI = r"\CirPointOri"
    WRIST45 = r"\Wrist45"
    WRIST46 = r"\Wrist46"
    WRIST56 = r"\Wrist56"


@value_class(frozen=True, slots=True)
class MotionSettings:
    """What VelSet, AccSet, ConfL and their like have set; these are the values after PP to main."""

    speed_override_percent: float = 100.0
    speed_refresh_percent: float = 100.0
    """SpeedRefresh: the operator's override."""
    max_speed_mm_s: float | None = None
    acceleration_percent: float = 100.0
    ramp_percent: float = 100.0
    fine_ramp_percent: float = 100.0
    """AccSet: how quickly the arm brakes at stop points, of what `ramp_percent` leaves."""
    grip_load: LoadData | None = None
    """GripLoad: what the gripper holds; None before the first."""
    grip_load_name: str = "load0"
    """What the program calls it."""
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
    """Names in small letters of the mechanical units that DeactUnit has switched off."""
    independent_axes: frozenset[str] = frozenset()
    """External axes, such as `eax_a`, that IndCMove and its like have taken off the path."""
    displacement: Pose | None = None
    """PDispOn, PDispSet: moves reach the controller with it applied already."""
    axis_offsets: ExtJoint | None = None
    """EOffsOn, EOffsSet: moves reach the controller with them applied already."""
    path_resolution_percent: float = 100.0
    motion_supervision: bool = True
    supervision_tune_percent: float = 100.0
    """PathResol and MotionSup: kept to be read back, without effect."""

    @property
    def speed_share(self) -> float:
        """The share of programmed speeds that both overrides leave."""
        return self.speed_override_percent * self.speed_refresh_percent / 1e4

    @property
    def grip_load_kg(self) -> float:
        """The mass of what the gripper holds."""
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
    """What the robot does at the first hit."""

    STIFFLY = "stop stiffly"
    """It stops as fast as it can."""
    SOFTLY = "stop softly"
    """It stops on its path, or near it."""
    ON_PATH = "stop on the path"
    """It stops on its path and takes its time."""
    GO_ON = "go on"
    """It goes on to the end of the move."""
    GO_ON_ONCE = "go on, one hit"
    """It goes on, and a second hit is an error."""
