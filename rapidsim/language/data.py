"""RAPID's record types as Python values.

Each class is at once the RAPID type (the checker reads its fields), the RAPID value (immutable, so
assignment copies for free) and the argument of motion. Units are RAPID's: mm, degrees, seconds.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "Data types".
"""

from __future__ import annotations

from dataclasses import field
from typing import Annotated, NamedTuple

from rapidsim.language import types
from rapidsim.values import value_class

UNUSED_AXIS = 8999999488.0
"""An external axis that is not connected: 9E9 in single precision, as `num` has it."""


class Pos(NamedTuple):
    """A position [mm]."""

    x: float
    y: float
    z: float


class Orient(NamedTuple):
    """An orientation as a unit quaternion, scalar first."""

    q1: float
    q2: float
    q3: float
    q4: float


class Pose(NamedTuple):
    """A frame: position [mm] and orientation."""

    trans: Pos
    rot: Orient


class ConfData(NamedTuple):
    """Axis configuration: quarter revolutions of axes 1, 4 and 6, and the branch 0..7."""

    cf1: float
    cf4: float
    cf6: float
    cfx: float


class ExtJoint(NamedTuple):
    """External axes a to f [mm or deg]; `UNUSED_AXIS` for an axis that is not connected."""

    eax_a: float
    eax_b: float
    eax_c: float
    eax_d: float
    eax_e: float
    eax_f: float


class RobJoint(NamedTuple):
    """Robot axes 1 to 6 [deg]."""

    rax_1: float
    rax_2: float
    rax_3: float
    rax_4: float
    rax_5: float
    rax_6: float


class RobTarget(NamedTuple):
    """A pose of the TCP in the work object, with configuration and external axes."""

    trans: Pos
    rot: Orient
    robconf: ConfData
    extax: ExtJoint


class JointTarget(NamedTuple):
    """Positions of all axes."""

    robax: RobJoint
    extax: ExtJoint


class SpeedData(NamedTuple):
    """Speeds: TCP [mm/s], reorientation [deg/s], linear [mm/s] and rotating [deg/s] axes."""

    v_tcp: float
    v_ori: float
    v_leax: float
    v_reax: float


class ZoneData(NamedTuple):
    """Passing of a position: stop point, or zones [mm, mm, mm, deg, mm, deg]."""

    finep: bool
    pzone_tcp: float
    pzone_ori: float
    pzone_eax: float
    zone_ori: float
    zone_leax: float
    zone_reax: float


class LoadData(NamedTuple):
    """A load: mass [kg], centre of gravity [mm], axes of moment, moments of inertia [kg m2]."""

    mass: float
    cog: Pos
    aom: Orient
    ix: float
    iy: float
    iz: float


class ToolData(NamedTuple):
    """A tool: held by the robot or stationary, its TCP frame, its load."""

    robhold: bool
    tframe: Pose
    tload: LoadData


class WobjData(NamedTuple):
    """A work object: its user frame in the world and its object frame in the user frame."""

    robhold: bool
    ufprog: bool
    ufmec: str
    uframe: Pose
    oframe: Pose


class InPosData(NamedTuple):
    """Stop-point criteria: position and speed [%], minimum and maximum wait [s]."""

    position: float
    speed: float
    mintime: float
    maxtime: float


class StopPointData(NamedTuple):
    """End of a stop point: kind, synchronisation, criteria and times [s]."""

    type: float
    progsynch: bool
    inpos: InPosData
    stoptime: float
    followtime: float
    signal: str
    relation: float
    checkvalue: float


class ProgDisp(NamedTuple):
    """Program displacement: its frame, and offsets of the external axes."""

    pdisp: Pose
    eoffs: ExtJoint


class VelData(NamedTuple):
    """Settings of VelSet: override [%] and maximum TCP speed [mm/s]."""

    oride: float
    max: float


class AccData(NamedTuple):
    """Settings of AccSet [%]."""

    acc: float
    ramp: float
    finepramp: float


class SingData(NamedTuple):
    """Settings of SingArea."""

    wrist: bool
    lockaxis4: bool
    arm: bool
    base: bool


class ConfSupData(NamedTuple):
    """Settings of ConfJ and ConfL."""

    jsup: bool
    lsup: bool
    ax1: float
    ax4: float
    ax6: float


class MotSetData(NamedTuple):
    """All motion settings."""

    vel: VelData
    acc: AccData
    sing: SingData
    conf: ConfSupData
    pathresol: float
    motionsup: bool
    tunevalue: float
    acclim: bool
    accmax: float
    decellim: bool
    decelmax: float
    cirpathreori: float
    worldacclim: bool
    worldaccmax: float
    evtbufferact: bool


class ListItem(NamedTuple):
    """One line of UIListView."""

    image: str
    text: str


class Tasks(NamedTuple):
    """The name of a task."""

    taskname: str


class EgmMinMax(NamedTuple):
    """Convergence limits of externally guided motion [mm or deg]."""

    min: float
    max: float


class TriggIos(NamedTuple):
    """An output that TriggLIOs sets, at a distance [mm] and with a lag [s]."""

    used: bool
    distance: float
    start: bool
    equiplag: float
    signalname: str
    setvalue: float
    xxx: float


class TriggIosDnum(NamedTuple):
    """Output of TriggLIOs, like `TriggIos` with a dnum value."""

    used: bool
    distance: float
    start: bool
    equiplag: float
    signalname: str
    setvalue: Annotated[float, types.DNUM]
    xxx: float


class TriggStrGo(NamedTuple):
    """Output of TriggLIOs, like `TriggIos` with a value in digits."""

    used: bool
    distance: float
    start: bool
    equiplag: float
    signalname: str
    setvalue: str
    xxx: float


class WzTemporary(NamedTuple):
    """The number of a world zone."""

    wz: float


class WzStationary(NamedTuple):
    """The number of a stationary world zone."""

    wz: float


class RmqHeader(NamedTuple):
    """Type and dimensions of the data of a message in a RAPID message queue."""

    datatype: str
    ndim: float
    dim1: float
    dim2: float
    dim3: float


@value_class(frozen=True, slots=True)
class Signal:
    """The value of a signal variable: the name of its signal; "" if none is connected."""

    name: str
    is_configured: bool = field(default=False, compare=False)
    """Whether the name itself is the signal's, so that AliasIO cannot connect another."""


@value_class(frozen=True, slots=True)
class ClockState:
    """The value of a clock: time counted before, and its start if it runs; virtual seconds."""

    counted_s: float = 0.0
    started_s: float | None = None
    """None while the clock is stopped."""


_MILLI = 0.0010000000474974513
"""0.001 in single precision, as `num` has it."""

MAX_TCP_SPEED_MM_S = 5000.0
"""TCP speed of `vmax`; a controller may replace it by the maximum of its robot."""
MAX_REORIENT_SPEED_DEG_S = 500.0
MAX_LINEAR_AXIS_SPEED_MM_S = 5000.0
MAX_ROTATING_AXIS_SPEED_DEG_S = 1000.0
NO_EXTERNAL_AXES = ExtJoint(*(UNUSED_AXIS,) * 6)
IDENTITY_POSE = Pose(Pos(0.0, 0.0, 0.0), Orient(1.0, 0.0, 0.0, 0.0))
LOAD0 = LoadData(_MILLI, Pos(0.0, 0.0, _MILLI), Orient(1.0, 0.0, 0.0, 0.0), 0.0, 0.0, 0.0)
TOOL0 = ToolData(True, IDENTITY_POSE, LOAD0)
WOBJ0 = WobjData(False, True, "", IDENTITY_POSE, IDENTITY_POSE)
FINE = ZoneData(True, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
