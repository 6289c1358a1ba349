"""RAPID's predefined types and data: `v100`, `z10`, `tool0`, `pi`, `ERR_DIVZERO`, `reg1`.

All names are folded. Numbers of data of type `num` are rounded to single, as literals of a program
are, so that `z0.pzone_tcp = 0.3` holds.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "Data types"; the
values a RobotWare controller declares in its base and user modules.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import Final

from rapidsim.language import error_numbers, types
from rapidsim.language.data import (
    FINE,
    LOAD0,
    MAX_LINEAR_AXIS_SPEED_MM_S,
    MAX_REORIENT_SPEED_DEG_S,
    MAX_ROTATING_AXIS_SPEED_DEG_S,
    MAX_TCP_SPEED_MM_S,
    TOOL0,
    WOBJ0,
    InPosData,
    SpeedData,
    StopPointData,
    ZoneData,
)
from rapidsim.language.initial_values import initial_value
from rapidsim.language.records import RECORD_CLASSES, record_of
from rapidsim.language.single_precision import single
from rapidsim.language.types import Alias, Type
from rapidsim.library.named_numbers import ENUMERATIONS
from rapidsim.values import value_class

ERRSTR_TASK: Final = "ERRSTR_TASK"
ERRSTR_CONTEXT: Final = "ERRSTR_CONTEXT"
"""Placeholders that error texts replace by the task and by the position in the program."""

SET_BY_CONTROLLER: Final[Mapping[str, str]] = MappingProxyType(
    {"ERRNO": "errnum", "INTNO": "intnum", "C_MOTSET": "motsetdata", "C_PROGDISP": "progdisp"}
)
"""Variables that programs only read: errors, traps and instructions such as VelSet change them.

They are valid in expressions only. The table has their types; `codegen.data_access` finds the
values.
"""

_ALIASES = {
    types.NUM: (
        "aiotrigg btnres busstate buttondata byte cfgdomain css_offset_dir css_ref_frame "
        "css_soft_dir dionum egmframetype egmstate "
        "egmstopmode errdomain errnum errtype event_type exec_level handler_type icondata identno "
        "intnum inttypes iounit_state loadidnum motionprocessmode opcalc opnum paridnum "
        "paridvalidnum sensorstate signalorigin socketstatus stoppoint symnum testsignal tpnum "
        "triggmode tsp_status tunegtype tunetype uishownum"
    ),
    types.STRING: "errstr stringdig",
}

TYPES: Mapping[str, Type] = MappingProxyType(
    {
        **{
            atom.name: atom
            for atom in (
                *(types.NUM, types.DNUM, types.BOOL, types.STRING, types.SWITCH, types.ANYTYPE),
                *(types.RAWBYTES, types.CLOCK, types.IODEV, *types.SIGNALS, *types.OPAQUE),
            )
        },
        **{name: Alias(name, of) for of, names in _ALIASES.items() for name in names.split()},
        **{record.name: record for record in map(record_of, RECORD_CLASSES)},
    }
)
"""Every predefined type by folded name."""


OF_OPTIONS: Final = frozenset(
    {
        # Continuous Application Platform, arc and spot welding
        *("capdata", "captrackdata", "capweavedata", "caplatrackdata", "capspeeddata", "captestno"),
        *("weavestartdata", "supervtimeouts", "processtimes", "restartblkdata", "flypointdata"),
        *("flystartdata", "advseamdata", "forcedata", "gundata", "simdata", "smeqdata", "smeqtype"),
        *("spotdata", "equalizedata", "daintdata", "multidata"),
        # Torch calibration, Production Manager
        *("be_device", "be_scan", "be_tooldesign", "partdata", "ee_event"),
        # Dispensing, picking, force control
        *("beaddata", "equipdata", "itmtgt", "selectiondata", "sortdata"),
        *("fcboxvol", "fccondstatus", "fccylindvol", "fcdamping", "fcforcevector", "fcframe"),
        *("fclindir", "fcplane", "fcprocessdata", "fcrotdir", "fcspdchgtunetyp", "fcspeedvector"),
        *("fcspherevol", "fctorquevector", "fcxyznum"),
    }
)
"""Types of options that differ between installations: their data have the type of their value."""


@value_class(frozen=True, slots=True)
class PredefinedData:
    """One predefined name; data that are neither constant nor persistent are variables."""

    name: str
    type: Type
    value: object
    constant: bool = True
    persistent: bool = False


_SPEEDS = (
    *(5, 10, 20, 30, 40, 50, 60, 80, 100, 150, 200, 300, 400, 500, 600, 800, 1000, 1500),
    *(2000, 2500, 3000, 4000, 5000, 6000, 7000),
)
_ROTATING_AXIS_SPEEDS = (1, 2, 5, 10, 20, 50, 100)
_LINEAR_AXIS_SPEEDS = (10, 20, 50, 100, 200, 500, 1000)

# Zone: TCP [mm], orientation and axes [mm], orientation and rotating axes [deg]; linear external
# axes use the second number as well.
_ZONES = (
    (0, 0.3, 0.3, 0.03),
    (1, 1.0, 1.0, 0.1),
    (5, 5.0, 8.0, 0.8),
    (10, 10.0, 15.0, 1.5),
    (15, 15.0, 23.0, 2.3),
    (20, 20.0, 30.0, 3.0),
    (30, 30.0, 45.0, 4.5),
    (40, 40.0, 60.0, 6.0),
    (50, 50.0, 75.0, 7.5),
    (60, 60.0, 90.0, 9.0),
    (80, 80.0, 120.0, 12.0),
    (100, 100.0, 150.0, 15.0),
    (150, 150.0, 225.0, 23.0),
    (200, 200.0, 300.0, 30.0),
)

_INTEGER_TYPES = {
    **{"USINT": 1.0, "UINT": 2.0, "UDINT": 4.0, "ULINT": 8.0},
    **{"SINT": -1.0, "INT": -2.0, "DINT": -4.0, "LINT": -8.0},
}

_LOWER = "abcdefghijklmnopqrstuvwxyzàáâãäåæçèéêëìíîïðñòóôõöøùúûüýþ"
# Lowercase letters of ISO 8859-1 that have an uppercase form there, so that StrMap can map them.

_CONSTANTS: tuple[tuple[str, str, object], ...] = (
    ("num", "pi", 3.1415926),
    ("num", "END_OF_LIST", -1.0),
    ("num", "EOF_BIN", -1.0),
    ("num", "EOF_NUM", 9.998e36),
    ("num", "WAIT_MAX", 8388608.0),
    ("string", "EOF", "EOF"),
    ("string", "STR_DIGIT", "0123456789"),
    ("string", "STR_LOWER", _LOWER),
    ("string", "STR_UPPER", _LOWER.upper()),
    ("string", "STR_WHITE", " "),
    ("string", "stEmpty", ""),
    ("string", "stSpace", " "),
    ("string", "diskhome", "HOME:"),
    ("string", "disktemp", "TEMP:"),
    ("string", "diskram", "RAMDISK:"),
    ("string", "flp1", "flp1:"),
    *(("string", f"usbdisk{n}", f"RemovableDisk{n}:") for n in range(1, 11)),
    ("errstr", "ERRSTR_EMPTY", ""),
    ("errstr", "ERRSTR_UNUSED", ""),
    ("errstr", "ERRSTR_TASK", ERRSTR_TASK),
    ("errstr", "ERRSTR_CONTEXT", ERRSTR_CONTEXT),
    # Sizes in bytes, negative with a sign.
    *(("inttypes", name, size) for name, size in _INTEGER_TYPES.items()),
)


def _all_data() -> Iterator[PredefinedData]:
    yield from _speeds_and_zones()
    yield from _stop_points()
    for type_name, name, value in _CONSTANTS:
        rounded = single(value) if isinstance(value, float) else value
        yield PredefinedData(name, TYPES[type_name], rounded)
    for type_name, first, names in ENUMERATIONS:
        for offset, name in enumerate(names.split()):
            yield PredefinedData(name, TYPES[type_name], float(first + offset))
    for name, number in error_numbers.NUMBERS.items():
        yield PredefinedData(name, TYPES["errnum"], number)
    for name, of in SET_BY_CONTROLLER.items():
        yield PredefinedData(name, TYPES[of], initial_value(TYPES[of]), constant=False)
    yield PredefinedData("tool0", TYPES["tooldata"], TOOL0, constant=False, persistent=True)
    yield PredefinedData("wobj0", TYPES["wobjdata"], WOBJ0, constant=False, persistent=True)
    yield PredefinedData("load0", TYPES["loaddata"], LOAD0, constant=False, persistent=True)
    # A new controller's user module declares these, and many programs use them as they are.
    for n in range(1, 6):
        yield PredefinedData(f"reg{n}", types.NUM, 0.0, constant=False)
    yield PredefinedData("clock1", types.CLOCK, initial_value(types.CLOCK), constant=False)
    for name in ("ROB_ID", "ROB_1"):
        yield PredefinedData(name, TYPES["mecunit"], None, constant=False)


def _speeds_and_zones() -> Iterator[PredefinedData]:
    speed, zone = TYPES["speeddata"], TYPES["zonedata"]
    for v in _SPEEDS:
        yield PredefinedData(f"v{v}", speed, SpeedData(float(v), 500.0, 5000.0, 1000.0))
    vmax = SpeedData(
        MAX_TCP_SPEED_MM_S,
        MAX_REORIENT_SPEED_DEG_S,
        MAX_LINEAR_AXIS_SPEED_MM_S,
        MAX_ROTATING_AXIS_SPEED_DEG_S,
    )
    yield PredefinedData("vmax", speed, vmax, constant=False)
    for v in _ROTATING_AXIS_SPEEDS:
        yield PredefinedData(f"vrot{v}", speed, SpeedData(0.0, 0.0, 0.0, float(v)))
    for v in _LINEAR_AXIS_SPEEDS:
        yield PredefinedData(f"vlin{v}", speed, SpeedData(0.0, 0.0, float(v), 0.0))
    yield PredefinedData("fine", zone, FINE)
    for n, tcp, axes, degrees in _ZONES:
        tcp, axes, degrees = single(tcp), single(axes), single(degrees)
        value = ZoneData(False, tcp, axes, axes, degrees, axes, degrees)
        yield PredefinedData(f"z{n}", zone, value)


def _stop_points() -> Iterator[PredefinedData]:
    of, none = TYPES["stoppointdata"], InPosData(0.0, 0.0, 0.0, 0.0)
    for n in (20, 50, 100):
        criteria = InPosData(float(n), float(n), 0.0, 2.0)
        value = StopPointData(1.0, True, criteria, 0.0, 0.0, "", 0.0, 0.0)
        yield PredefinedData(f"inpos{n}", of, value)
    for text, s in (("0_5", 0.5), ("1_0", 1.0), ("1_5", 1.5)):
        stop = StopPointData(2.0, False, none, s, 0.0, "", 0.0, 0.0)
        yield PredefinedData(f"stoptime{text}", of, stop)
        follow = StopPointData(3.0, True, none, 0.0, s, "", 0.0, 0.0)
        yield PredefinedData(f"fllwtime{text}", of, follow)


DATA: Mapping[str, PredefinedData] = MappingProxyType(
    {data.name.lower(): data for data in _all_data()}
)
"""Every predefined datum by folded name."""
