"""The event log of a controller that stays on, and the outputs that show its state."""

from __future__ import annotations

import pytest
from live_controller import Live, module

from rapidsim.controller.cell.description import Status
from rapidsim.diagnostics import Diagnostic, Source, Span
from rapidsim.findings.runs import CutOff
from rapidsim.language.error_log import LoggedError
from rapidsim.simulation.live import event_log
from rapidsim.simulation.live.event_log import COMMON, MOST_ENTRIES, EventLog, LogEntry
from rapidsim.simulation.live.states import ControllerState, OperatingMode
from rapidsim.simulation.live.system_outputs import status_value

NUMBERS = {
    10010: "Motors OFF state",
    10011: "Motors ON state",
    10012: "Safety guard stop state",
    10013: "Emergency stop state",
    10015: "Manual mode selected",
    10017: "Automatic mode confirmed",
    10020: "Execution error state",
    10045: "System restarted",
    10046: "System cold started",
    10123: "Program stopped",
    10125: "Program stopped",
    10150: "Program started",
    10151: "Program restarted",
}


def test_operations_have_the_numbers_and_titles_of_a_controller() -> None:
    log = EventLog(lambda _: None)
    for number, (code, title) in enumerate(NUMBERS.items(), start=1):
        log.operational(code, 1.5, "said", "a", "b")
        entry = next(iter(log.entries(1)))
        assert entry == LogEntry(number, 1, 1, code, 1.5, title, "said", ("a", "b"))
    states = {state.name: code for state, code in event_log.OF_STATE.items()}
    assert states == {
        "MOTORS_OFF": 10010,
        "MOTORS_ON": 10011,
        "GUARD_STOP": 10012,
        "EMERGENCY_STOP": 10013,
    }
    assert event_log.OF_MODE[OperatingMode.AUTO] == 10017
    assert event_log.OF_MODE[OperatingMode.REDUCED] == 10015


def test_entries_are_in_their_domain_and_in_the_common_one() -> None:
    told: list[LogEntry] = []
    log = EventLog(told.append)
    log.operational(10011, 0.0, "on")
    log.written(LoggedError(4.0, 123.0, 2.0, "Odd", ("x", "y")), 1.0)
    log.execution_error(2.0, "T_ROB1", "division by zero")
    assert [one.number for one in told] == [1, 2, 3]
    assert [one.number for one in log.entries(COMMON)] == [3, 2, 1]
    assert [one.number for one in log.entries(1)] == [3, 1]
    assert [one.number for one in log.entries(4)] == [2]
    assert list(log.entries(5)) == []
    written, error = told[1:]
    assert written == LogEntry(2, 4, 2, 40123, 1.0, "Odd", "x y", ("Odd", "x", "y"))
    assert (error.domain, error.type, error.code) == (1, 3, 10020)
    assert error.text == "The program of T_ROB1 has stopped: division by zero"
    log.clear(4)
    assert [one.number for one in log.entries(COMMON)] == [3, 2, 1]
    assert list(log.entries(4)) == []
    log.clear(COMMON)
    assert list(log.entries(COMMON)) == list(log.entries(1)) == []
    log.operational(10010, 3.0, "off")
    assert told[-1].number == 4
    log.clear()
    assert list(log.entries(COMMON)) == []


def test_only_the_newest_entries_are_kept() -> None:
    log = EventLog(lambda _: None)
    for _ in range(MOST_ENTRIES + 5):
        log.operational(10010, 0.0, "")
    numbers = [one.number for one in log.entries(1)]
    assert (len(numbers), numbers[0], numbers[-1]) == (1000, 1005, 6)


def test_a_finding_is_logged_with_its_rule_and_its_place() -> None:
    told: list[LogEntry] = []
    log = EventLog(told.append)
    span = Span(Source("/home/me/cell.mod", "one\ntwo\n"), 4, 7)
    finding = Diagnostic(CutOff("x" * 100), span)
    error = log.finding(finding, 2.5, "T_ROB1")
    (entry,) = told
    rule = finding.violation.rule.name.replace("-", " ")
    assert entry.title == error.title == rule[0].upper() + rule[1:]
    assert (entry.code, entry.domain, entry.type) == (40_000, 4, 3)
    assert entry.text == f"{finding.message} (cell.mod, line 2)"
    assert (entry.rule, entry.file, entry.line) == ("R109", "/home/me/cell.mod", 2)
    assert (error.domain, error.number, error.type) == (4.0, 0.0, 3.0)
    assert error.texts == ("T_ROB1", finding.message[:80])
    log.finding(Diagnostic(CutOff("y"), None), 2.5, "T_ROB1")
    assert (told[1].text, told[1].file, told[1].line) == (
        Diagnostic(CutOff("y"), None).message,
        "",
        0,
    )


SHOWN: dict[Status, tuple[float, float, float]] = {
    Status.TASK_EXECUTING: (0.0, 1.0, 0.0),
    Status.CYCLE_ON: (0.0, 1.0, 0.0),
    Status.ERROR: (0.0, 0.0, 1.0),
    Status.EXECUTION_ERROR: (0.0, 0.0, 1.0),
    Status.MOTOR_ON: (1.0, 1.0, 0.0),
    Status.MOTOR_ON_STATE: (1.0, 1.0, 0.0),
    Status.MOTOR_OFF: (0.0, 0.0, 1.0),
    Status.MOTOR_OFF_STATE: (0.0, 0.0, 1.0),
    Status.AUTO_ON: (1.0, 1.0, 0.0),
    Status.RUN_CHAIN_OK: (1.0, 1.0, 0.0),
    Status.EMERGENCY_STOP: (0.0, 0.0, 1.0),
}
"""At rest; while a program executes; after an error, in manual mode, with an emergency stop."""


@pytest.mark.parametrize("status", list(Status))
def test_an_output_shows_its_state(status: Status) -> None:
    panel = Live(module("WaitTime 1;")).controller.panel
    rest = status_value(status, executes=False, failed=False, panel=panel)
    busy = status_value(status, executes=True, failed=False, panel=panel)
    panel.set_mode(OperatingMode.REDUCED)
    panel.press_emergency_stop(is_pressed=True)
    bad = status_value(status, executes=False, failed=True, panel=panel)
    assert panel.state is ControllerState.EMERGENCY_STOP
    assert (rest, busy, bad) == SHOWN.get(status, (None, None, None))
    assert status_value(None, executes=True, failed=True, panel=panel) is None
