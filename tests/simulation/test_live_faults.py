"""Faults of a controller that stays on: when they begin and end, and what a program sees."""

import math
from pathlib import Path

import pytest
from live_controller import SIGNALS, Live, module

from rapidsim.controller.cell.conditions import read_condition
from rapidsim.controller.cell.description import (
    CellIo,
    SignalDeclaration,
    SignalKind,
    SystemAction,
)
from rapidsim.controller.cell.faults import FailureKind, Fault
from rapidsim.simulation.live import signals
from rapidsim.simulation.live.states import RequestRefused
from rapidsim.station.faults import read_fault

TURNS = module(
    """MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
    MoveAbsJ [[60,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
    n := n + 1; k := k + 1; SetDO doDone, 1; SetDO doDone, 0;""",
    "PERS num n := 0; VAR num k := 0;",
)
INPUTS = {
    "diStart": SystemAction.START,
    "diMain": SystemAction.START_AT_MAIN,
    "diStop": SystemAction.STOP,
    "diOn": SystemAction.MOTORS_ON,
    "diOff": SystemAction.MOTORS_OFF,
    "diReset": SystemAction.RESET_EMERGENCY_STOP,
    "diRestart": SystemAction.RESTART,
}


def cell(*faults: Fault) -> CellIo:
    inputs = (SignalDeclaration(name, SignalKind.DI, action=one) for name, one in INPUTS.items())
    return CellIo(signals=(*SIGNALS, *inputs), faults=faults)


def push(live: Live, *names: str) -> None:
    """Let system inputs be 1 for a moment, one after the other."""
    for name in names:
        for level in (1.0, 0.0):
            signals.write(live.controller, name, level)


def state(live: Live) -> str:
    return live.controller.panel.state.value


def test_a_fault_of_the_station_begins_in_time_and_ends_and_inputs_reset_and_start() -> None:
    live = Live(TURNS, io=cell(Fault(kind=FailureKind.EMERGENCY_STOP, at_s=1.0, for_s=2.0)))
    push(live, "diStart")
    assert live.controller.executes
    live.after(1.0)
    assert (live.controller.executes, state(live)) == (False, "emergencystop")
    push(live, "diOn", "diStart", "diReset")
    assert state(live) == "emergencystop"
    live.after(2.1)
    assert state(live) == "emergencystopreset"
    push(live, "diReset", "diOn", "diStart")
    assert live.controller.executes
    live.after(20.0)
    assert int(live.value("n")) > 3
    rejected = [entry.code for entry in live.entries if "rejected" in entry.title]
    assert rejected == [20140, 20142]
    push(live, "diStop")
    before = live.value("k")
    push(live, "diOff")
    assert (live.controller.executes, state(live), live.value("k") != "0") == (
        False,
        "motoroff",
        True,
    )
    push(live, "diOn", "diMain")
    assert live.value("k") != before


def test_a_condition_begins_a_fault_at_the_occurrences_that_it_names() -> None:
    fault = Fault(
        kind=FailureKind.GUARD_STOP, when=read_condition("doDone"), after_s=0.1, nth=(2,), for_s=0.5
    )
    live = Live(TURNS, io=cell(fault))
    live.controller.start()
    live.after(60.0)
    assert (live.value("n"), state(live)) == ("2", "motoroff")
    push(live, "diOn", "diStart")
    live.after(60.0)
    assert (int(live.value("n")) > 4, state(live)) == (True, "motoron")


def test_a_fault_of_a_test_begins_at_once_and_all_end_on_request() -> None:
    live = Live(TURNS, io=cell())
    faults, panel = live.controller.faults, live.controller.panel
    for one in ({"kind": "emergency_stop"}, {"kind": "guard_stop"}, {"kind": "guard_stop"}):
        faults.add(read_fault(one))
    faults.add(read_fault({"kind": "general_stop", "at": 100.0}))
    live.controller.settle()
    assert state(live) == "emergencystop"
    faults.end_all()
    assert (state(live), panel.is_chain_closed) == ("emergencystopreset", True)
    live.after(200.0)
    assert panel.is_chain_closed


@pytest.mark.parametrize(("withdrawn", "ended"), [(False, "motoroff"), (True, "motoron")])
def test_a_fault_that_waits_for_a_condition_is_withdrawn_with_the_others(
    withdrawn: bool, ended: str
) -> None:
    live = Live(TURNS, io=cell())
    faults = live.controller.faults
    faults.add(read_fault({"kind": "guard_stop", "when": "doDone", "for": 0.1}))
    if withdrawn:
        faults.end_all()
    live.controller.start()
    live.after(20.0)
    assert state(live) == ended


def test_clients_set_signals_within_their_limits() -> None:
    either = (None, None), (2.0, 9.0)
    found = {
        (kind.name, low): signals.limits(SignalDeclaration("s", kind, lowest=low, highest=high))
        for kind in (SignalKind.DI, SignalKind.GI, SignalKind.GO, SignalKind.AI, SignalKind.AO)
        for low, high in either
    }
    group, analog = (0.0, 2.0**32 - 1), (-math.inf, math.inf)
    assert found == {
        ("DI", None): (0.0, 1.0),
        ("DI", 2.0): (0.0, 1.0),
        ("GI", None): group,
        ("GI", 2.0): (2.0, 9.0),
        ("GO", None): group,
        ("GO", 2.0): (2.0, 9.0),
        ("AI", None): analog,
        ("AI", 2.0): (2.0, 9.0),
        ("AO", None): analog,
        ("AO", 2.0): (2.0, 9.0),
    }


def test_a_warm_restart_keeps_data_and_pointers_and_a_cold_one_does_not() -> None:
    live = Live(TURNS, io=cell(), background=module("b := b + 1; WaitTime 1;", "PERS num b := 0;"))
    live.controller.start()
    live.after(3.0)
    done, background = live.value("n"), int(live.value("b", "T_BACK"))
    assert (done, background) == ("2", 3)
    push(live, "diRestart")
    live.after(3.0)
    assert (live.controller.executes, state(live)) == (False, "motoroff")
    assert int(live.value("b", "T_BACK")) > background
    push(live, "diOn", "diStart")
    live.after(3.0)
    assert int(live.value("k")) > 1
    live.controller.faults.add(read_fault({"kind": "restart", "mode": "cold"}))
    live.controller.settle()
    assert (live.value("n"), live.value("k"), state(live)) == ("0", "0", "motoroff")
    push(live, "diOn", "diStart")
    live.after(3.0)
    assert live.value("n") == live.value("k") != "0"
    codes = [entry.code for entry in live.entries]
    assert [code for code in codes if 10045 <= code <= 10046] == [10045, 10046]


def test_a_full_disk_and_a_lost_device_are_errors_that_a_program_can_handle(
    tmp_path: Path,
) -> None:
    body = """Open "HOME:" \\File:="log.txt", f \\Write;
    WHILE TRUE DO
    Write f, "a line";
    SetDO doDone, 1;
    n := n + 1;
    WaitTime 0.1;
    ENDWHILE
    ERROR
    errors := errors + 1;
    IF ERRNO = ERR_FILEACC full := full + 1;
    IF ERRNO = ERR_NORUNUNIT lost := lost + 1;
    TRYNEXT;"""
    counts = "".join(f"PERS num {name} := 0; " for name in ("n", "errors", "full", "lost"))
    data = f"VAR iodev f; {counts}"
    live = Live(module(body, data), io=cell(), home=tmp_path)
    live.controller.start()
    live.after(1.0)
    assert live.value("errors") == "0"
    live.controller.faults.add(read_fault({"kind": "full_disk", "for": 0.5}))
    live.after(2.0)
    full = live.value("full")
    assert full == live.value("errors") in ("4", "5")
    live.controller.faults.add(read_fault({"kind": "device_lost", "device": "board10", "for": 0.5}))
    live.after(2.0)
    assert int(live.value("lost")) == int(live.value("errors")) - int(full) in (4, 5)
    codes = [entry.code for entry in live.entries if entry.code > 70_000]
    assert codes == [70058, 70059]


def test_entries_of_the_event_log_are_heard_by_programs() -> None:
    body = "CONNECT i WITH count; IError COMMON_ERR, TYPE_ALL, i; WaitTime 100;"
    heard = module(body, "VAR intnum i; PERS num n := 0;", "TRAP count\nn := n + 1;\nENDTRAP")
    live = Live(heard, io=cell())
    live.controller.start()
    live.after(0.1)
    one = {"kind": "elog", "code": 50204, "severity": "warning", "title": "A title", "texts": ["a"]}
    live.controller.faults.add(read_fault(one))
    live.after(0.1)
    entry = live.entries[-1]
    assert (entry.domain, entry.code, entry.type, entry.title) == (5, 50204, 2, "A title")
    assert live.value("n") == "1"


def test_too_many_faults_are_refused() -> None:
    live = Live(TURNS, io=cell())
    for _ in range(1000):
        live.controller.faults.add(read_fault({"kind": "full_disk"}))
        live.controller.settle()
    with pytest.raises(RequestRefused):
        live.controller.faults.add(read_fault({"kind": "full_disk"}))
