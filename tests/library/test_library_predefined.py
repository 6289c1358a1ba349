"""Predefined types and data: names, values, what may be changed."""

import json
from pathlib import Path
from typing import Any

import pytest

from rapidsim.language.data import FINE, TOOL0, SpeedData, ZoneData
from rapidsim.language.initial_values import initial_value
from rapidsim.language.records import RECORD_CLASSES, record_of
from rapidsim.language.single_precision import single
from rapidsim.language.types import Alias, ArrayOf, Kind, Record, resolved
from rapidsim.library.catalogue import ROUTINES
from rapidsim.library.named_numbers import ENUMERATIONS
from rapidsim.library.predefined import DATA, TYPES
from rapidsim.library.versions import SINCE

REFERENCE = Path(__file__).parents[2].parent / "shared" / "reference" / "rapid_predefined.json"


def _reference() -> dict[str, Any]:
    if not REFERENCE.exists():
        pytest.skip(f"{REFERENCE} is not here")
    reference: dict[str, Any] = json.loads(REFERENCE.read_text(encoding="utf-8"))
    return reference


def _plain(value: object) -> object:
    """A value with tuples as lists and whole numbers as such, as JSON has them."""
    if isinstance(value, tuple):
        return [_plain(part) for part in value]
    return value


def _rounded(value: object) -> object:
    if isinstance(value, list):
        return [_rounded(part) for part in value]
    if isinstance(value, int | float) and not isinstance(value, bool):
        return single(float(value))
    return value


@pytest.mark.parametrize(
    "kind", ["speeddata", "zonedata", "stoppointdata", "tooldata", "wobjdata", "loaddata"]
)
def test_records_have_their_values(kind: str) -> None:
    for name, value in _reference()[kind].items():
        data = DATA[name.lower()]
        assert data.name == name
        assert data.type.name == kind
        assert _plain(data.value) == _rounded(value), name


def test_constants_have_their_values() -> None:
    for constant in _reference()["constants"]:
        data = DATA[constant["name"].lower()]
        assert (data.name, data.type.name) == (constant["name"], constant["type"])
        assert data.value == _rounded(constant["value"]), data.name
        assert data.constant


def test_every_routine_is_at_least_declared() -> None:
    for row in _reference()["routines"]:
        routine = ROUTINES[row["name"].lower()]
        is_function = routine.signature.result is not None
        assert is_function == (row["kind"] == "function"), row["name"]


def test_names_of_a_version_are_known_names() -> None:
    for name in SINCE:
        routine, _, option = name.partition("\\")
        assert routine in ROUTINES or routine in DATA, name
        if option:
            parameters = ROUTINES[routine].signature.parameters
            assert option in {parameter.name.lower() for parameter in parameters}, name


def test_every_error_name_is_there() -> None:
    for error in _reference()["error_constants"]:
        assert DATA[error["name"].lower()].type.name == "errnum"


def test_every_type_is_there() -> None:
    reference = _reference()
    for name, record in reference["record_types"].items():
        of = TYPES[name]
        assert isinstance(of, Record)
        assert [(c.name, resolved(c.type).name) for c in of.components] == [
            (c["name"], reference["alias_types"].get(c["type"], c["type"]))
            for c in record["components"]
        ]
    for name, base in reference["alias_types"].items():
        of = TYPES[name]
        assert isinstance(of, Alias)
        assert of.of.name == base
    assert set(reference["atomic_types"]) <= set(TYPES)


def test_speeds_and_zones() -> None:
    assert DATA["v100"].value == SpeedData(100.0, 500.0, 5000.0, 1000.0)
    assert DATA["vrot20"].value == SpeedData(0.0, 0.0, 0.0, 20.0)
    assert DATA["vlin50"].value == SpeedData(0.0, 0.0, 50.0, 0.0)
    assert DATA["z10"].value == ZoneData(False, 10.0, 15.0, 15.0, 1.5, 15.0, 1.5)
    assert DATA["fine"].value == FINE
    assert "v2" not in DATA


def test_only_what_the_controller_lets_change_is_no_constant() -> None:
    variables = {d.name for d in DATA.values() if not d.constant and not d.persistent}
    assert variables == {
        *("vmax", "reg1", "reg2", "reg3", "reg4", "reg5", "clock1", "ERRNO", "INTNO"),
        *("ROB_ID", "ROB_1", "C_MOTSET", "C_PROGDISP"),
    }
    assert {d.name for d in DATA.values() if d.persistent} == {"tool0", "wobj0", "load0"}
    assert DATA["tool0"].value == TOOL0


def test_numbers_are_singles() -> None:
    assert DATA["pi"].value == single(3.1415926)
    zone = DATA["z0"].value
    assert isinstance(zone, ZoneData)
    assert zone.pzone_tcp == single(0.3) != 0.3


def test_kinds_of_types() -> None:
    assert getattr(TYPES["signaldi"], "kind", None) is Kind.SEMI_VALUE
    assert getattr(TYPES["clock"], "kind", None) is Kind.NON_VALUE
    assert getattr(TYPES["num"], "kind", None) is Kind.VALUE


@pytest.mark.parametrize("python", RECORD_CLASSES, ids=lambda c: c.__name__)
def test_every_record_starts_as_zeros(python: type[tuple[object, ...]]) -> None:
    value = initial_value(record_of(python))
    assert type(value) is python
    assert len(value) == len(record_of(python).components)
    assert record_of(python) is record_of(python)


def test_arrays_start_as_nested_lists() -> None:
    value = initial_value(ArrayOf(TYPES["pos"], (2, 3)))  # type: ignore[arg-type]
    assert isinstance(value, list)
    assert value == [[(0.0, 0.0, 0.0)] * 3] * 2
    assert value[0] is not value[1]
    with pytest.raises(ValueError, match="no size of its own"):
        initial_value(ArrayOf(TYPES["pos"], (None,)))  # type: ignore[arg-type]


FIRST_NUMBERS = {
    "resUnkwn": 0,
    "btnNone": -1,
    "iconNone": 0,
    "TP_LATEST": 1,
    "OPTIMAL_CYCLE_TIME_MODE": 1,
    "inpos": 1,
    "TRIGG_MODE1": 1,
    "TUNE_DF": 0,
    "MASS_KNOWN": 1,
    "TOOL_LOAD_ID": 1,
    "ROB_LOAD_VAL": 10,
    "AIO_ABOVE_HIGH": 1,
    "BUSSTATE_HALTED": 0,
    "IOBUS_LOG_STATE_STOPPED": 10,
    "IOBUS_PHYS_STATE_HALTED": 20,
    "low": 0,
    "IOUNIT_RUNNING": 1,
    "IOUNIT_LOG_STATE_DISABLED": 10,
    "IOUNIT_PHYS_STATE_DEACTIVATED": 20,
    "SIGORIG_NONE": 0,
    "SOCKET_CREATED": 1,
    "ALL_DOMAINS": 0,
    "COMMON_ERR": 0,
    "PROCESS_ERR": 11,
    "TYPE_ALL": 0,
    "EVENT_NONE": 0,
    "LEVEL_NORMAL": 0,
    "HANDLER_NONE": 0,
    "OpAdd": 1,
    "LT": 1,
    "OP_UNDEF": 0,
    "RUN_UNDEF": 0,
    "TSP_STATUS_NOT_NORMAL_TASK": 0,
    "TSP_UNCHECKED_RUN_SERV_ROUT": 10,
    "resolver_angle": 1,
    "speed_ref": 4,
    "speed": 6,
    "torque_ref": 9,
    "dig_input1": 102,
    "RampTorqRefOpen": 1,
    "EGM_FRAME_BASE": 0,
    "EGM_STATE_DISCONNECTED": 0,
    "EGM_STOP_HOLD": 0,
    "STATE_ERROR": -1,
    "LTAPP__RESET": 3,
    "LTAPP__APM_P1": 31,
    "LTAPP__ROT_Y": 51,
    "LTAPP__X0": 54,
    "CSS_POSX": 1,
    "CSS_X": 1,
    "CSS_REFFRAME_TOOL": 0,
    "CAP_START": 0,
}
"""Of each row of names; those behind a first name, and rows that go on, are counted through."""


def test_named_numbers_are_counted_from_their_first() -> None:
    first: dict[str, int] = {}
    after: dict[str, int] = {}
    for type_name, number, names in ENUMERATIONS:
        one, *_ = names.split()
        if after.get(type_name) != number:
            first[one] = number
        after[type_name] = number + len(names.split())
        for at, name in enumerate(names.split(), start=number):
            data = DATA[name.lower()]
            assert (data.name, data.type.name, data.value) == (name, type_name, float(at))
            assert data.constant
            assert not data.persistent
    assert first == FIRST_NUMBERS
