"""Whatever leaves a routine as a `num` has passed single precision, inside of records too."""

from collections.abc import Iterator
from typing import Any

import library_controller
import numpy as np
import pytest
from library_controller import RecordingController

from rapidsim.language.annotations import ParameterMode
from rapidsim.language.data import JointTarget, Pos, RobTarget, ToolData
from rapidsim.language.error_numbers import ERR_OVERFLOW
from rapidsim.language.errors import RapidError
from rapidsim.language.initial_values import initial_value
from rapidsim.language.records import record_of
from rapidsim.language.reference import Box
from rapidsim.language.types import DNUM, NUM, ArrayOf, Record, Type, resolved
from rapidsim.library.catalogue import ROUTINES
from rapidsim.library.precision import rounding_of
from rapidsim.library.table import LibraryRoutine, Parameter

THIRD = 1.0 / 3.0
BY_INTERPRETER = {"ArgName", "Dim", "IsPers", "IsVar", "Present", "Type"}
NEEDS_MORE = {
    *("GetDataVal", "GetSysData", "SetAllDataVal"),
    *("SocketGetStatus", "SocketPeek", "SocketReceive", "SocketReceiveFrom"),
    *("GetTaskName", "TasksInSync"),
    *("MToolTCPCalib", "UIListView", "ReadAnyBin", "ReadBin", "ReadNum", "TextTabGet"),
    *("ModTime", "ReadErrData", "WZDOSet", "WZLimSup", "ReadStr", "ReadCfgData", "WriteCfgData"),
    "GetNextMechUnit",
    *("GetJointData", "TestSignRead", "CorrRead", "IRMQMessage", "RMQGetMsgHeader"),
}
"""They want a program, a connection, an open file or a list of things around them."""
WHOLE = {"BitPos", "ShiftSteps", "TargetsInList", "ChPos"}
"""Numbers that count; parameters by name."""
OPTIONS: dict[str, dict[str, Any]] = {"EulerZYX": {"y": True}, "GetTime": {"hour": True}}
"""One of theirs is needed."""


def sample(of: Type, name: str = "") -> Any:
    """A value whose numbers no single can hold, but for those that count things."""
    if of.name in ("aiotrigg", "opnum"):
        return 1.0
    of = resolved(of)
    if isinstance(of, ArrayOf):
        return [at(sample(of.element), k) for k in range(4)]
    if isinstance(of, Record) and of.name == "orient":
        # About a unit, or it is no orientation.
        return tuple.__new__(of.python, [0.5 + 1e-9 * THIRD] * 4)
    if isinstance(of, Record):
        return tuple.__new__(of.python, [sample(one.type) for one in of.components])
    if of in (NUM, DNUM):
        return 3.0 if name in WHOLE or name.startswith("BitData") else THIRD
    if of.name == "string":
        return "0123"
    if of.name.startswith("signal"):
        return type(initial_value(of))("aoSome")  # type: ignore[call-arg]
    return initial_value(NUM if of.name == "anytype" else of)


def at(value: Any, place: int) -> Any:
    """The value; positions stand on a curve, for routines that look for a plane or a sphere."""
    match value:
        case Pos():
            return Pos(place * place / 3.0, place / 7.0, place**3 / 11.0)
        case RobTarget():
            return value._replace(trans=at(value.trans, place))
        case _:
            return value


def argument(parameter: Parameter, place: int = 0) -> Any:
    value = at(sample(parameter.types[0], parameter.name), place)
    return value if parameter.mode is ParameterMode.IN or isinstance(value, list) else Box(value)


def numbers(value: Any, of: Type) -> Iterator[float]:
    """All that is a `num` in a value."""
    of = resolved(of)
    if isinstance(of, ArrayOf):
        for one in value:
            yield from numbers(one, of.element)
    elif isinstance(of, Record):
        for part, component in zip(value, of.components, strict=True):
            yield from numbers(part, component.type)
    elif of == NUM:
        yield value


def tells_numbers(row: LibraryRoutine) -> bool:
    if row.name in BY_INTERPRETER | NEEDS_MORE or not row.simulated:
        return False
    signature = row.signature
    types = [
        p.types[0]
        for p in signature.parameters
        if p.mode in (ParameterMode.INOUT, ParameterMode.VAR)
    ]
    types += [signature.result] if signature.result is not None else []
    return any(rounding_of(of) is not None for of in types)


class Uneven(RecordingController):
    """A controller whose robot stands where no single is."""

    def read_signal(self, name: str) -> float:
        return THIRD

    def ask_number(self, prompt: str, *, ends: bool = False) -> float | None:
        return THIRD

    def length(self) -> float:
        return THIRD

    def finger_position(self) -> float:
        return THIRD

    def finger_speed(self) -> float:
        return THIRD


@pytest.mark.parametrize(
    "row", [row for row in ROUTINES.values() if tells_numbers(row)], ids=lambda row: row.name
)
def test_results_are_singles(row: LibraryRoutine, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(library_controller, "HOME", sample(record_of(RobTarget)))
    monkeypatch.setattr(library_controller, "JOINTS", sample(record_of(JointTarget)))
    signature = row.signature
    given = {
        p.name: argument(p, place) for place, p in enumerate(signature.parameters) if not p.optional
    }
    options = OPTIONS.get(row.name, {}) | {
        p.python: given.setdefault(p.name, argument(p))
        for p in signature.parameters
        if p.by_keyword
        and (
            not p.optional
            or (p.mode in (ParameterMode.INOUT, ParameterMode.VAR) and not p.is_switch)
        )
    }
    required = [given[p.name] for p in signature.parameters if not p.by_keyword]
    controller = Uneven()
    controller.files["0123"] = bytearray(b"1")
    result = controller.call(row.name, *required, **options)
    found: list[float] = []
    if signature.result is not None:
        found += numbers(result, signature.result)
    for parameter in signature.parameters:
        one = given.get(parameter.name)
        if parameter.mode not in (ParameterMode.INOUT, ParameterMode.VAR) or not isinstance(
            one, Box
        ):
            continue
        if one.value != sample(parameter.types[0], parameter.name):
            found += numbers(one.value, parameter.types[0])
    assert all(type(one) is float and one == float(np.float32(one)) for one in found), found


def test_routines_without_such_results_cost_nothing_more() -> None:
    for name in ("SinDnum", "StrPart", "BitCheck", "MoveL", "SetDO"):
        row = ROUTINES[name.lower()]
        assert row.body is row.function


@pytest.mark.parametrize("value", [1e39, float("inf"), float("nan")])
def test_what_is_too_large_for_a_num_is_an_error_in_records_too(value: float) -> None:
    for of in (record_of(Pos), record_of(RobTarget), record_of(ToolData), NUM):
        rounding = rounding_of(of)
        assert rounding is not None
        bad = spoilt(sample(of), value)
        with pytest.raises(RapidError) as caught:
            rounding(bad)
        assert caught.value.errno == ERR_OVERFLOW


def spoilt(value: Any, number: float) -> Any:
    """The value with another last number."""
    if not isinstance(value, tuple):
        return number
    return tuple.__new__(type(value), [*value[:-1], spoilt(value[-1], number)])
