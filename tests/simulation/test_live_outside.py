"""Somebody outside sets signals and data while programs of a controller that stays on wait."""

import pytest
from live_controller import SIGNALS, Live, module

from rapidsim.controller.cell.conditions import read_condition
from rapidsim.controller.cell.description import CellIo, Stimulus
from rapidsim.simulation.live import position, signals
from rapidsim.simulation.live.position import Coordinates
from rapidsim.simulation.live.states import RequestRefused


def test_a_signal_from_outside_ends_a_wait_at_its_instant() -> None:
    body = "ClkStart c; WaitDI diGo, 1; n := ClkRead(c); WaitTime 100;"
    live = Live(module(body, "PERS num n := 0; VAR clock c;"))
    live.controller.start()
    live.after(1.47)
    signals.write(live.controller, "diGo", 1.0)
    assert float(live.value("n")) == pytest.approx(1.47, abs=1e-3)


def test_a_signal_from_outside_ends_a_loop_that_looks_for_it() -> None:
    body = "WHILE diGo = 0 DO ENDWHILE n := 1; WaitTime 100;"
    live = Live(module(body, "PERS num n := 0;"))
    live.controller.start()
    live.after(10.0)
    assert live.value("n") == "0"
    signals.write(live.controller, "diGo", 1.0)
    live.after(0.02)
    assert live.value("n") == "1"


def test_a_signal_from_outside_raises_an_interrupt_while_the_robot_moves() -> None:
    body = """CONNECT part WITH count; ISignalDI diPart, 1, part;
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;
    MoveAbsJ [[60,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;"""
    live = Live(
        module(body, "VAR intnum part; PERS num n := 0;", "TRAP count\nn := n + 1;\nENDTRAP")
    )
    live.controller.start()
    live.after(0.5)
    for level in (1.0, 0.0, 1.0):
        signals.write(live.controller, "diPart", level)
    assert live.value("n") == "2"
    # What comes while the program stands is lost, as the order is no safe one.
    live.controller.stop()
    for level in (0.0, 1.0):
        signals.write(live.controller, "diPart", level)
    live.controller.start()
    live.after(0.1)
    assert live.value("n") == "2"


def test_interrupts_end_with_the_pointer() -> None:
    body = "CONNECT part WITH count; ISignalDI diPart, 1, part; n := 0; WaitTime 1000;"
    live = Live(
        module(body, "VAR intnum part; PERS num n := 0;", "TRAP count\nn := n + 1;\nENDTRAP")
    )
    for _ in range(3):
        live.controller.reset_pointers()
        live.controller.start()
        live.after(0.1)
        signals.write(live.controller, "diPart", 1.0)
        live.after(0.1)
        assert live.value("n") == "1"
        signals.write(live.controller, "diPart", 0.0)
        live.controller.stop()


def test_data_written_from_outside_end_a_wait_and_raise_interrupts() -> None:
    body = "CONNECT i WITH told; IPers go, i; WaitUntil go; n := n + 1; WaitTime 100;"
    data = "PERS bool go := FALSE; PERS num n := 0; VAR intnum i;"
    live = Live(module(body, data, "TRAP told\nn := n + 10;\nENDTRAP"))
    live.controller.start()
    live.after(1.0)
    assert live.value("n") == "0"
    live.write("go", "TRUE")
    live.after(0.2)
    assert live.value("n") == "11"


@pytest.mark.parametrize("value", ["", "[1,2]", "TRUE", '"a"', "1 2", "[[[[", "nan"])
def test_what_is_no_value_is_refused(value: str) -> None:
    live = Live(module("", "PERS num n := 7; CONST num c := 1;"))
    with pytest.raises(RequestRefused):
        live.write("n", value)
    assert live.value("n") == "7"
    with pytest.raises(RequestRefused, match="cannot be written"):
        live.write("c", "2")
    with pytest.raises(RequestRefused, match="no data named"):
        live.value("nobody")


def test_arrays_and_records_are_read_and_written_as_in_a_program() -> None:
    live = Live(
        module(
            "",
            'PERS num a{2,2} := [[1,2],[3,4]]; PERS pos p := [1,2,3]; PERS string s := "a ""b""";',
        )
    )
    live.write("a", "[[5,6],[7,8.5]]")
    live.write("p", "[0,-1,1E3]")
    assert (live.value("a"), live.value("p")) == ("[[5,6],[7,8.5]]", "[0,-1,1000]")
    assert live.value("s") == '"a ""b"""'
    assert live.value("v100") == "[100,500,5000,1000]"


@pytest.mark.parametrize(
    ("name", "value"),
    [("diGo", 2.0), ("diGo", 0.5), ("aoFlow", 11.0), ("doRuns", 1.0), ("diNone", 1.0)],
)
def test_a_signal_takes_no_value_beyond_its_kind_and_limits(name: str, value: float) -> None:
    live = Live(module(""))
    with pytest.raises(RequestRefused):
        signals.write(live.controller, name, value)


def test_the_station_drives_inputs_while_nothing_executes() -> None:
    when = read_condition("diGo = 1")
    stimuli = (Stimulus(values={"diPart": 1.0}, when=when, after_s=0.5, pulse_s=1.0),)
    live = Live(module(""), io=CellIo(signals=SIGNALS, stimuli=stimuli))
    signals.write(live.controller, "diGo", 1.0)
    seen = []
    for _ in range(4):
        live.after(0.4)
        seen.append(signals.value_of(live.controller, "diPart"))
    assert seen == [0.0, 1.0, 1.0, 0.0]


def test_where_the_robot_is_is_told_in_several_frames() -> None:
    live = Live(module(""))
    task = live.controller.task("T_ROB1")
    base = position.target(task, "tool0", "wobj0", Coordinates.BASE)
    world = position.target(task, "tool0", "wobj0", Coordinates.WORLD)
    assert base.trans == pytest.approx(world.trans)
    assert base.rot == pytest.approx(world.rot)
    assert position.joints(task).robax[4] == pytest.approx(30.0)
    with pytest.raises(RequestRefused):
        position.target(task, "nothing", "wobj0", Coordinates.BASE)
    with pytest.raises(RequestRefused):
        position.target(task, "wobj0", "wobj0", Coordinates.BASE)


def test_a_storm_of_interrupts_is_refused_and_stops_the_program() -> None:
    body = "CONNECT part WITH count; ISignalDI diPart, 1, part; IDisable; WaitTime 1000;"
    live = Live(module(body, "VAR intnum part;", "TRAP count\nENDTRAP"))
    live.controller.start()
    live.after(0.1)
    with pytest.raises(RequestRefused, match="interrupts wait"):
        _toggle(live, 2000)
    assert not live.controller.executes


def _toggle(live: Live, times: int) -> None:
    for _ in range(times):
        signals.write(live.controller, "diPart", 1.0)
        signals.write(live.controller, "diPart", 0.0)
