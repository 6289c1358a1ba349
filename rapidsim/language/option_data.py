"""Records of unsimulated routines: known so that programs with them are checked and run.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "cameratarget",
"restartdata", "sensor"; compared with declarations of programs from controllers.
"""

from __future__ import annotations

from typing import NamedTuple

from rapidsim.language.data import Pose


class CameraTarget(NamedTuple):
    """Result of a camera."""

    name: str
    cframe: Pose
    val1: float
    val2: float
    val3: float
    val4: float
    val5: float
    string1: str
    string2: str
    type: float
    cameraname: str
    sceneid: float


class RestartData(NamedTuple):
    """Values of the signals of a process before and after a stop."""

    restartstop: bool
    stoponpath: bool
    predo1val: float
    postdo1val: float
    prego1val: float
    postgo1val: float
    prego2val: float
    postgo2val: float
    prego3val: float
    postgo3val: float
    prego4val: float
    postgo4val: float
    preshadowval: float
    shadowflanks: float
    postshadowval: float


class Sensor(NamedTuple):
    """A device with which data are exchanged: its number, its last error, its state."""

    id: float
    error: float
    state: float


class SensorVarData(NamedTuple):
    """One variable of a sensor, with its scale."""

    type: float
    scale: float
    value: float


class MenuData(NamedTuple):
    """A line of the Production Manager's menu, with its procedure."""

    description: str
    image: str
    proc: str
    plccode: float
    task: str
    users: float
    enabled: bool
    type: float
    station: float
    blocking: bool
    order: float
