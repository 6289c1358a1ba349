"""Signals, time, interrupts, the operator, files, errors, flow: what they ask of the controller."""

from typing import Any

import pytest
from library_controller import RecordingController

from rapidsim.language import error_numbers as errors
from rapidsim.language.data import ClockState, Orient, Pos, Signal
from rapidsim.language.errors import CycleEnded, RapidError, Stopped
from rapidsim.language.reference import Box
from rapidsim.language.single_precision import single

GUN: Box[Any] = Box(Signal("doGun"))
PART: Box[Any] = Box(Signal("diPart"))


@pytest.fixture
def controller() -> RecordingController:
    return RecordingController()


# --- signals


def test_outputs(controller: RecordingController) -> None:
    controller.call("SetDO", GUN, 1.0)
    controller.call("SetDO", GUN, 0.0, s_delay=0.5)
    controller.call("SetDO", GUN, 1.0, sync=True)
    controller.call("Reset", GUN)
    controller.call("Set", GUN)
    controller.call("InvertDO", GUN)
    controller.call("SetAO", Box(Signal("aoFlow")), 2.5)
    controller.call("SetGO", Box(Signal("goJob")), 5.0)
    assert controller.log == [
        *("doGun := 1", "doGun := 0 after 0.5", "doGun := 1", "doGun := 0", "doGun := 1"),
        *("doGun := 0", "aoFlow := 2.5", "goJob := 5"),
    ]
    assert controller.call("DOutput", GUN) == 0.0
    assert controller.call("GOutput", Box(Signal("goJob"))) == 5.0


def test_pulses(controller: RecordingController) -> None:
    controller.call("PulseDO", GUN)
    assert controller.log == ["doGun := 1", "doGun := 0 after 0.2"]
    controller.signals["dogun"] = 1.0
    controller.log.clear()
    controller.call("PulseDO", GUN, p_length=1.0)
    controller.call("PulseDO", GUN, high=True, p_length=2.0)
    assert controller.log == [
        *("doGun := 0", "doGun := 1 after 1", "doGun := 1", "doGun := 0 after 2"),
    ]


def test_inputs(controller: RecordingController) -> None:
    assert controller.call("TestDI", PART) is False
    controller.signals["dipart"] = 1.0
    assert controller.call("TestDI", PART) is True
    assert controller.call("DInput", PART) == 1.0


def test_waits_for_signals(controller: RecordingController) -> None:
    flag: Box[bool] = Box(False)
    controller.call("WaitDI", PART, 1.0, max_time=2.0, time_flag=flag)
    assert flag.value is True
    with pytest.raises(RapidError, match=r"WaitDI diPart waited 2 s in vain") as caught:
        controller.call("WaitDI", PART, 1.0, max_time=2.0)
    assert caught.value.errno == errors.ERR_WAIT_MAXTIME
    controller.signals["dipart"] = 1.0
    controller.call("WaitDI", PART, 1.0, max_time=2.0, time_flag=flag)
    assert flag.value is False
    controller.call("WaitAI", PART, 0.5, gt=True)
    controller.call("WaitGI", PART, 3.0, noteq=True)
    reached: Box[float] = Box(0.0)
    with pytest.raises(RapidError):
        controller.call("WaitAO", PART, 0.5, lt=True, max_time=1.0, value_at_timeout=reached)
    assert reached.value == 1.0


def test_a_window_of_a_wait_is_shown_where_it_takes_long(controller: RecordingController) -> None:
    controller.call("WaitDI", PART, 0.0, visualize=True, header="Waiting", visualize_time=2.0)
    assert controller.log[-1] == "wait for diPart, max 2.0"
    assert not controller.unsimulated


def test_signal_variables_mean_what_they_are_connected_to(controller: RecordingController) -> None:
    alias: Box[Any] = Box(Signal(""))
    assert controller.call("ValidIO", alias) is False
    with pytest.raises(RapidError, match="connected to no signal") as caught:
        controller.call("Set", alias)
    assert caught.value.errno == errors.ERR_NO_ALIASIO_DEF
    controller.call("AliasIO", "doGun", alias)
    controller.call("Set", alias)
    controller.call("AliasIO", PART, alias)
    assert controller.call("ValidIO", alias) is True
    controller.call("AliasIOReset", alias)
    assert alias.value == Signal("")
    assert controller.log == ["doGun := 1"]


# --- time


def test_waits(controller: RecordingController) -> None:
    controller.call("WaitTime", 0.5)
    controller.call("WaitTime", 0.0, in_pos=True)
    controller.call("WaitRob", zero_speed=True)
    controller.call("WaitUntil", lambda: True, poll_rate=0.01)
    assert controller.log == [
        *("wait 0.5", "wait 0 in position", "wait 0 in position"),
        "wait until, max None, every 0.04",
    ]
    with pytest.raises(RapidError, match="WaitUntil waited 3 s in vain"):
        controller.call("WaitUntil", lambda: False, max_time=3.0)
    with pytest.raises(RapidError, match="-1 s lies in the past"):
        controller.call("WaitTime", -1.0)


def test_clocks_count_virtual_time(controller: RecordingController) -> None:
    clock = Box(ClockState())
    controller.call("ClkStart", clock)
    controller.time_s = 1.2345678
    assert controller.call("ClkRead", clock) == single(1.234)
    assert controller.call("ClkRead", clock, high_res=True) == single(1.234567)
    controller.call("ClkStop", clock)
    controller.time_s = 5.0
    controller.call("ClkStart", clock)
    controller.call("ClkStart", clock)
    controller.time_s = 6.0
    assert controller.call("ClkRead", clock) == single(2.234)
    controller.call("ClkReset", clock)
    controller.time_s = 9.0
    assert controller.call("ClkRead", clock) == 0.0


def test_date_and_time_are_what_the_clock_shows(controller: RecordingController) -> None:
    controller.time_s = 3661.5
    assert controller.call("CDate") == "2025-03-01"
    assert controller.call("CTime") == "01:01:01"
    assert controller.call("GetTime", min_=True) == 1.0
    assert controller.call("GetTime", w_day=True) == 6.0
    assert not controller.unsimulated


# --- interrupts


def test_interrupts(controller: RecordingController) -> None:
    number: Box[float] = Box(3.0)
    controller.call("ITimer", 0.5, number)
    controller.call("ITimer", 0.5, number, single=True)
    controller.call("ISignalDI", PART, 1.0, number, single=True)
    controller.call("ISignalDO", GUN, 2.0, number)
    controller.call("ISleep", number)
    controller.call("IWatch", number)
    controller.call("IDisable")
    controller.call("IEnable")
    controller.call("IDelete", number)
    assert controller.log == [
        *("timer 3 0.5 again", "timer 3 0.5 once"),
        *("on 3 diPart 1 once", "on 3 doGun 0/1 again"),
        *("sleep 3", "watch 3", "hold", "serve", "delete 3"),
    ]


# --- operator


WRITTEN: list[tuple[dict[str, object], str]] = [
    ({}, "x="),
    ({"num": single(0.1)}, "x=0.1"),
    ({"num": single(1 / 3)}, "x=0.333333"),
    ({"num": 1000000.0}, "x=1E+06"),
    ({"bool_": False}, "x=FALSE"),
    ({"pos": Pos(1.0, 2.5, -3.0)}, "x=[1,2.5,-3]"),
    ({"orient": Orient(1.0, 0.0, 0.0, 0.0)}, "x=[1,0,0,0]"),
    ({"dnum": 1 / 3}, "x=0.333333333333333"),
]


@pytest.mark.parametrize(("options", "text"), WRITTEN)
def test_writing_values(
    controller: RecordingController, options: dict[str, object], text: str
) -> None:
    controller.call("TPWrite", "x=", **options)
    assert controller.log == [f"show {text}"]
    device: Box[Any] = Box(None)
    controller.call("Open", "HOME:", device, file="log.txt", write=True)
    controller.call("Write", device, "x=", **options)
    assert controller.files["HOME:/log.txt"] == f"{text}\n".encode()


def test_questions(controller: RecordingController) -> None:
    answer: Box[float] = Box(0.0)
    flag: Box[float] = Box(7.0)
    controller.number = 0.1
    controller.call("TPReadNum", answer, "How many?", break_flag=flag)
    assert (answer.value, flag.value) == (single(0.1), 0.0)
    controller.choice = 2
    controller.call("TPReadFK", answer, "Go on?", "", "", "Yes", "No", "", max_time=5.0)
    assert answer.value == 3.0
    controller.call("TPErase")
    assert controller.log == ["number? How many?", "Go on? ||Yes|No|", "clear"]
    assert not controller.unsimulated


# --- files


def opened(controller: RecordingController, content: bytes) -> Box[Any]:
    controller.files["HOME:/in.txt"] = bytearray(content)
    device: Box[Any] = Box(None)
    controller.call("Open", "HOME:/in.txt", device, read=True)
    return device


def test_reading_lines(controller: RecordingController) -> None:
    device = opened(controller, b"one\r\ntwo\n" + b"x" * 100 + b"\n\nend")
    assert controller.call("ReadStr", device, remove_cr=True) == "one"
    assert controller.call("ReadStr", device) == "two"
    assert controller.call("ReadStr", device) == "x" * 80
    assert controller.call("ReadStr", device) == "x" * 20
    assert controller.call("ReadStr", device) == ""
    assert controller.call("ReadStr", device) == "end"
    assert controller.call("ReadStr", device) == "EOF"
    controller.call("ClearIOBuff", device)
    controller.call("Rewind", device)
    assert controller.call("ReadStr", device, line=2.0) == "two"


def test_reading_numbers(controller: RecordingController) -> None:
    device = opened(controller, b"1.5\n 2e1 ,, 0.1,abc\n")
    assert controller.call("ReadNum", device) == 1.5
    assert controller.call("ReadNum", device, delim=",") == 20.0
    assert controller.call("ReadNum", device, delim=",") == single(0.1)
    with pytest.raises(RapidError, match='"abc" is not a number') as caught:
        controller.call("ReadNum", device)
    assert caught.value.errno == errors.ERR_RCVDATA
    assert controller.call("ReadNum", device) == single(9.998e36)


def test_bytes(controller: RecordingController) -> None:
    device: Box[Any] = Box(None)
    controller.call("Open", "HOME:/out.bin", device, bin_=True)
    controller.call("WriteBin", device, [1.0, 255.0, 3.0], 2.0)
    controller.call("WriteStrBin", device, "Å\n")
    controller.call("Close", device)
    assert controller.files["HOME:/out.bin"] == b"\x01\xff\xc5\n"
    controller.call("Open", "HOME:/out.bin", device, read=True)
    assert controller.call("ReadBin", device) == 1.0
    assert controller.call("ReadStrBin", device, 2.0) == "ÿÅ"
    controller.call("ReadBin", device)
    assert controller.call("ReadBin", device) == -1.0
    with pytest.raises(RapidError, match="300 is not a byte"):
        controller.call("WriteBin", device, [300.0], 1.0)


def test_a_device_is_opened_once_and_used_open(controller: RecordingController) -> None:
    device = opened(controller, b"")
    with pytest.raises(RapidError, match="open already") as caught:
        controller.call("Open", "HOME:/in.txt", device, read=True)
    assert caught.value.errno == errors.ERR_FILEOPEN
    controller.call("Close", device)
    controller.call("Close", device)
    with pytest.raises(RapidError, match="not open") as caught:
        controller.call("Write", device, "x")
    assert caught.value.errno == errors.ERR_FILEACC
    with pytest.raises(RapidError, match="missing"):
        controller.call("Open", "HOME:/none.txt", device, read=True)


def test_no_new_line(controller: RecordingController) -> None:
    device: Box[Any] = Box(None)
    controller.call("Open", "HOME:/a.txt", device, append=True)
    controller.call("Write", device, "a", no_new_line=True)
    controller.call("Write", device, "b")
    assert controller.files["HOME:/a.txt"] == b"ab\n"


# --- errors and flow


def test_booking_error_numbers(controller: RecordingController) -> None:
    first, second = Box(-1.0), Box(-1.0)
    controller.call("BookErrNo", first)
    controller.call("BookErrNo", second)
    controller.call("BookErrNo", first)
    assert (first.value, second.value) == (20501.0, 20502.0)


def test_messages(controller: RecordingController) -> None:
    controller.call("ErrWrite", "Gripper", "no part", rl2="check air")
    controller.call("ErrWrite", "Gripper", "slow", w=True)
    controller.call("ErrLog", 5210.0, "a", "", "b", "", "", i=True)
    assert controller.log == [
        "show error Gripper: no part / check air",
        "error 8 1",
        "show warning Gripper: slow",
        "error 8 2",
        "show information 5210: a / b",
        "error 11 5210",
    ]


def test_ends_of_a_run(controller: RecordingController) -> None:
    with pytest.raises(Stopped, match="Stop"):
        controller.call("Stop")
    assert controller.log == ["wait 0 in position"]
    with pytest.raises(Stopped, match="Break"):
        controller.call("Break")
    with pytest.raises(CycleEnded):
        controller.call("ExitCycle")


def test_the_system_a_run_is(controller: RecordingController) -> None:
    assert controller.call("OpMode") == 1.0
    assert controller.call("RunMode") == 1.0
    assert controller.call("RobOS") is False
    assert controller.call("CSpeedOverride") == 100.0
