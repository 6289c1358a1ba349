"""Emergency stops and guards of a controller that stays on, and what a program sees of them."""

import pytest
from live_controller import SIGNALS, Live, module

from rapidsim.controller.cell.description import CellIo, SignalDeclaration, SignalKind, Status
from rapidsim.simulation.live.panel import NEXT, PanelEvent
from rapidsim.simulation.live.states import (
    ControllerState,
    Cycle,
    Motors,
    OperatingMode,
    RequestRefused,
    SafetyStop,
)
from rapidsim.station.task_kind import TaskEvent

OUTPUTS = {
    "doChain": Status.RUN_CHAIN_OK,
    "doStop": Status.EMERGENCY_STOP,
    "doOn": Status.MOTOR_ON_STATE,
    "doRun": Status.CYCLE_ON,
}
IO = CellIo(
    signals=(
        *SIGNALS,
        *(
            SignalDeclaration(name, SignalKind.DO, status.at_start, status=status)
            for name, status in OUTPUTS.items()
        ),
    )
)
TURNS = module(
    """MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v200, fine, tool0;
    MoveAbsJ [[60,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v200, fine, tool0;
    n := n + 1;""",
    "PERS num n := 0;",
)


def outputs(live: Live) -> str:
    return "".join(f"{live.controller.cell.signals.read(name):g}" for name in OUTPUTS)


def state(live: Live) -> str:
    return live.controller.panel.state.value


def test_an_emergency_stop_halts_the_robot_on_its_path_which_is_resumed_after_its_reset() -> None:
    straight, live = Live(TURNS, io=IO), Live(TURNS, io=IO)
    for one in (straight, live):
        one.controller.start()
        one.after(0.8)
    panel = live.controller.panel
    assert outputs(live) == "1011"
    panel.open_chain(SafetyStop.EMERGENCY)
    assert (state(live), outputs(live)) == ("emergencystop", "0100")
    live.after(1.0)
    stopped_at = live.axis_1()
    live.after(5.0)
    assert live.axis_1() == stopped_at
    with pytest.raises(RequestRefused):
        live.controller.start()
    with pytest.raises(RequestRefused):
        panel.set_motors(Motors.ON)
    panel.close_chain(SafetyStop.EMERGENCY)
    assert (state(live), outputs(live)) == ("emergencystopreset", "1100")
    panel.handle(PanelEvent.CONFIRM)
    assert (state(live), outputs(live)) == ("motoroff", "1000")
    panel.set_motors(Motors.ON)
    live.controller.start()
    assert outputs(live) == "1011"
    live.after(20.0)
    straight.after(20.0)
    assert int(straight.value("n")) - int(live.value("n")) in (0, 1)
    codes = [entry.code for entry in live.entries if entry.type > 1 or entry.code < 10100]
    assert codes[2:] == [20202, 10013, 10010, 10011]


def test_the_automatic_stop_acts_in_automatic_mode_only_and_the_general_stop_always() -> None:
    live = Live(TURNS, io=IO)
    panel = live.controller.panel
    panel.set_mode(OperatingMode.REDUCED)
    panel.set_motors(Motors.ON)
    panel.open_chain(SafetyStop.AUTOMATIC)
    assert (state(live), outputs(live)[0]) == ("motoron", "1")
    panel.set_mode(OperatingMode.AUTO)
    assert (state(live), outputs(live)[0]) == ("guardstop", "0")
    panel.set_mode(OperatingMode.REDUCED)
    assert state(live) == "motoroff"
    panel.open_chain(SafetyStop.GENERAL)
    assert state(live) == "guardstop"
    # An emergency stop that is confirmed shows the guard again.
    panel.open_chain(SafetyStop.EMERGENCY)
    panel.close_chain(SafetyStop.EMERGENCY)
    panel.handle(PanelEvent.CONFIRM)
    assert state(live) == "guardstop"
    panel.close_chain(SafetyStop.GENERAL)
    assert state(live) == "motoroff"


def test_a_program_hears_of_a_stop_by_an_interrupt() -> None:
    body = "CONNECT i WITH count; IError COMMON_ERR, TYPE_ALL, i; WaitTime 100;"
    live = Live(
        module("WaitTime 1;"),
        background=module(
            body, "VAR intnum i; PERS num n := 0;", "TRAP count\nn := n + 1;\nENDTRAP"
        ),
        io=IO,
    )
    live.after(0.1)
    live.controller.panel.open_chain(SafetyStop.GENERAL)
    live.after(0.1)
    assert live.value("n", "T_BACK") == "1"


def test_event_routines_are_called_at_starts_and_stops() -> None:
    routines = {
        TaskEvent.START: "opened",
        TaskEvent.STOP: "paused",
        TaskEvent.QUICK_STOP: "alarmed",
        TaskEvent.RESTART: "resumed",
    }
    more = "\n".join(
        f'PROC {name}()\nWaitTime 0.2;\nsaid := said + "{name[0]}";\nENDPROC'
        for name in routines.values()
    )
    body = "MoveAbsJ [[30,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v50, fine, tool0;"
    live = Live(
        module(body, 'PERS string said := "";', more),
        io=IO,
        events=((TaskEvent.STOP, "lacking"), *routines.items()),
    )
    panel, controller = live.controller.panel, live.controller
    controller.start(Cycle.ONCE)
    live.after(1.0)
    controller.stop()
    # It executes until the routine has ended.
    assert (controller.executes, live.value("said")) == (True, '"o"')
    live.after(1.0)
    assert (controller.executes, live.value("said")) == (False, '"op"')
    stood_at = live.axis_1()
    controller.start()
    live.after(1.0)
    assert live.axis_1() > stood_at
    panel.open_chain(SafetyStop.EMERGENCY)
    live.after(1.0)
    assert live.value("said") == '"opra"'
    panel.close_chain(SafetyStop.EMERGENCY)
    panel.set_motors(Motors.ON)
    controller.start()
    live.after(60.0)
    # The end of main is no stop, and a start behind it no restart.
    assert (controller.executes, live.value("said")) == (False, '"oprar"')
    controller.start()
    live.after(60.0)
    assert live.value("said") == '"opraro"'


def test_motors_on_and_emergency_stop_are_reached_from_every_state() -> None:
    for state in ControllerState:
        assert ControllerState.EMERGENCY_STOP in {
            state,
            NEXT.get((state, PanelEvent.EMERGENCY_OPENED)),
        }
        reached, last = {state}, set[ControllerState]()
        while reached != last:
            last = set(reached)
            reached |= {after for (before, _), after in NEXT.items() if before in reached}
        assert ControllerState.MOTORS_ON in reached


def test_the_speed_ratio_is_from_0_to_100_in_automatic_mode() -> None:
    panel = Live(TURNS).controller.panel
    for percent, planned in ((0, 1.0), (1, 1.0), (50, 50.0), (100, 100.0)):
        panel.set_speed_ratio(percent)
        assert (panel.speed_ratio, panel.refresh_percent) == (percent, planned)
    for percent in (-1, 101):
        with pytest.raises(RequestRefused, match=f"a speed ratio of {percent} %; 0..100 are"):
            panel.set_speed_ratio(percent)
    panel.set_mode(OperatingMode.REDUCED)
    before = panel.speed_ratio
    with pytest.raises(RequestRefused, match="is set in automatic mode only"):
        panel.set_speed_ratio(50)
    assert panel.speed_ratio == before
