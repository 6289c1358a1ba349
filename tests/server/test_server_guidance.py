"""A served controller whose robot a sensor guides, over real datagrams in lock-step."""

from __future__ import annotations

import socket
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from multiprocessing.connection import wait
from pathlib import Path
from typing import Any

import pytest

from rapidsim.egm.codec import decode, encode
from rapidsim.egm.devices import Address, sensor_devices
from rapidsim.egm.messages import PATH_CORRECTION, ROBOT, SENSOR
from rapidsim.egm.udp import StepSensors
from rapidsim.interpreter.limits import RUNNING_DEPTH, recursion_limit
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.server.journal import read_journal
from rapidsim.server.loading import engine_of, ready
from rapidsim.server.messages import Answer, BeginFault, EndFaults, Request
from rapidsim.server.replay import replayed
from rapidsim.server.settings import EngineSettings

PROGRAM = r"""MODULE guided
  VAR egmident id;
  PERS string outcome := "";
  PERS num rounds := 0;
  PROC main()
    VAR egm_minmax near := [-0.01, 0.01];
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
    EGMGetId id;
    EGMSetupUC ROB_1, id, "default", "UCdevice" \Joint \CommTimeout:=0.3;
    EGMActJoint id \J1:=near \J2:=near \J3:=near \J4:=near \J5:=near \J6:=near
      \LpFilter:=100 \MaxSpeedDeviation:=90;
    EGMRunJoint id, EGM_STOP_HOLD \J1 \J2 \J3 \J4 \J5 \J6 \CondTime:=0.1 \RampInTime:=0.05;
    outcome := "there";
    EGMReset id;
    WaitTime 1000;
  ERROR
    outcome := "silent " + ValToStr(ERRNO = ERR_UDPUC_COMM);
    EGMReset id;
    WaitTime 1000;
  ENDPROC
ENDMODULE
"""
GOAL = (5.0, -5.0, 4.0, 3.0, 32.0, -7.0)


CORRECTED = r"""MODULE corrected
  VAR egmident id;
  PERS string outcome := "";
  PERS num rounds := 0;
  CONST robtarget p1 := [[800,-20,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    VAR robtarget there;
    MoveL p1, v1000, fine, tool0;
    EGMGetId id;
    EGMSetupUC ROB_1, id, "default", "UCdevice" \PathCorr \APTR \CommTimeout:=0.3;
    EGMActMove id, [[0,0,0],[1,0,0,0]] \SampleRate:=24;
    EGMMoveL id, Offs(p1, 0, 15, 0), v10, fine, tool0;
    there := CRobT();
    outcome := ValToStr(Round(there.trans.x));
    EGMReset id;
    WaitTime 1000;
  ENDPROC
ENDMODULE
"""
"""The tool points down, so y of a path along y of the base is x of that."""


class Sensor:
    """A client of EGM on a free port."""

    def __init__(self, corrects: bool = False) -> None:
        self.corrects = corrects
        self.stream = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.stream.bind(("127.0.0.1", 0))
        self.stream.settimeout(5.0)
        self.frames: list[dict[str, Any]] = []

    @property
    def address(self) -> Address:
        return Address(*self.stream.getsockname())

    def hear(self) -> tuple[str, int]:
        """The next frame; who has sent it."""
        data, controller = self.stream.recvfrom(65536)
        self.frames.append(decode(ROBOT, data))
        return controller  # type: ignore[no-any-return]

    def answer(self) -> None:
        controller = self.hear()
        if self.corrects:
            told = {"pos": {"x": 0.0, "y": 4.0, "z": 0.0}, "age": 1}
            correction = {"header": {"mtype": 4}, "pathCorr": told}
            self.stream.sendto(encode(PATH_CORRECTION, correction), controller)
            return
        message = {"header": {"mtype": 3}, "planned": {"joints": {"joints": GOAL}}}
        self.stream.sendto(encode(SENSOR, message), controller)


class Driven:
    """A controller in lock-step, its time in the hands of the test."""

    def __init__(self, folder: Path, sensor: Sensor) -> None:
        (folder / "main.mod").write_text(CORRECTED if sensor.corrects else PROGRAM)
        self.made = ready(RunRequest(paths=(str(folder / "main.mod"),), home=str(folder)))
        self.lines: list[str] = []
        self.sensors = StepSensors(sensor_devices([("UCDEVICE", sensor.address)], {}, frozenset()))
        self.engine = engine_of(
            self.made,
            EngineSettings(request_s=0.05),
            lambda told: None,
            self.lines.append,
            sensors=self.sensors,
        )

    def ask(self, action: str, **form: str) -> None:
        self.engine.reply(Request("POST", "/rw/rapid/execution", {"action": action}, form))

    def start(self) -> None:
        """Start the program and let time pass until a sensor guides the robot."""
        self.ask("start", cycle="once")
        for _ in range(40):
            if guided(self):
                return
            self.value("rounds")
        raise AssertionError("nobody guides")

    def value(self, name: str) -> str:
        reply = self.engine.reply(Request("GET", f"/rw/rapid/symbol/data/RAPID/T_ROB1/{name}"))
        assert isinstance(reply, Answer)
        return reply.items[0].fields["value"]

    def hear(self) -> None:
        """Let the answers that have come take effect."""
        passed_s = self.sensors.came(wait(self.sensors.sockets(), 5.0))
        self.engine.sensor_answered(passed_s)

    def guide(self, sensor: Sensor, until: Callable[[], bool]) -> None:
        for _ in range(1000):
            sensor.answer()
            self.hear()
            if until():
                return
        raise AssertionError("it never ends")

    def end(self) -> list[str]:
        """Switch off; the same life without a sensor gives the same journal."""
        self.engine.switch_off()
        told: list[str] = []
        replayed(self.made, read_journal(self.lines, "lines"), told.append)
        assert told == []
        return self.lines


@contextmanager
def driven(folder: Path, *, corrects: bool = False) -> Iterator[tuple[Driven, Sensor]]:
    sensor = Sensor(corrects)
    with recursion_limit(RUNNING_DEPTH):
        yield Driven(folder, sensor), sensor
    sensor.stream.close()


def test_answers_let_time_pass_and_are_lived_again(tmp_path: Path) -> None:
    # Until the condition is met; then the last frame says that nobody guides any more.
    with driven(tmp_path) as (controller, sensor):
        controller.start()
        live = controller.engine.live
        before_s = live.now_s
        controller.guide(sensor, lambda: not guided(controller))
        answers = len(sensor.frames)
        assert live.now_s - before_s == pytest.approx(0.004 * answers, abs=0.009)
        # What time has passed by a request has brought some frames more.
        while sensor.frames[-1]["mciState"]["state"] != 2:
            sensor.hear()
        count = len(sensor.frames) - 1
        assert controller.value("outcome") == '"there"'
        first, last = sensor.frames[0], sensor.frames[-1]
        assert [one["header"]["seqno"] for one in sensor.frames] == list(range(count + 1))
        assert first["mciState"]["state"] == 3
        assert last["mciState"]["state"] == 2
        assert last["mciConvergenceMet"] == 1
        assert last["feedBack"]["joints"]["joints"] == pytest.approx(GOAL, abs=0.01)
        assert last["header"]["tm"] - first["header"]["tm"] == 4 * count
        lines = controller.end()
    assert sum('"kind": "egm"' in line for line in lines) >= answers - 1


def guided(controller: Driven) -> bool:
    return controller.engine.live.task("T_ROB1").unit.member.is_guided


def test_a_path_is_corrected_and_that_is_lived_again(tmp_path: Path) -> None:
    with driven(tmp_path, corrects=True) as (controller, sensor):
        controller.start()
        controller.guide(sensor, lambda: not guided(controller))
        assert controller.value("outcome") == '"804"'
        first, second = sensor.frames[:2]
        assert first["mciState"]["state"] == 3
        assert second["header"]["tm"] - first["header"]["tm"] == 24
        controller.end()


def fail(controller: Driven, kind: str, **keys: object) -> None:
    reply = controller.engine.reply(BeginFault({"kind": kind, "on": "egm", **keys}))
    assert isinstance(reply, Answer)


def frames(controller: Driven, sensor: Sensor) -> list[int]:
    """Numbers of the frames of 0.05 s, in which nobody answers."""
    controller.value("rounds")
    sensor.frames.clear()
    sensor.stream.settimeout(0.05)
    with suppress(TimeoutError):
        while True:
            sensor.hear()
    sensor.stream.settimeout(5.0)
    return [int(frame["header"]["seqno"]) for frame in sensor.frames]


def test_datagrams_are_dropped_refused_and_repeated(tmp_path: Path) -> None:
    with driven(tmp_path) as (controller, sensor):
        controller.start()
        last = frames(controller, sensor)[-1]
        fail(controller, "duplicate")
        twice = frames(controller, sensor)
        assert twice == sorted([*twice[::2]] * 2)
        controller.engine.reply(EndFaults())
        fail(controller, "drop", count=6)
        assert frames(controller, sensor)[0] == twice[-1] + 7 > last + 7
        answers = sum('"kind": "egm"' in line for line in controller.lines)
        fail(controller, "refuse")
        for _ in range(6):
            controller.value("rounds")
            sensor.answer()
            if guided(controller):
                controller.hear()
        assert controller.value("outcome") == '"silent TRUE"'
        assert sum('"kind": "egm"' in line for line in controller.lines) <= answers + 1
        controller.end()


def test_datagrams_are_late(tmp_path: Path) -> None:
    with driven(tmp_path) as (controller, sensor):
        controller.start()
        last = frames(controller, sensor)[-1]
        fail(controller, "delay", by=0.06)
        assert frames(controller, sensor) == []
        assert frames(controller, sensor)[0] == last + 1
        controller.end()


def test_who_does_not_answer_is_silent_when_time_passes(tmp_path: Path) -> None:
    # Requests let time pass, too, and frames go out meanwhile.
    with driven(tmp_path) as (controller, sensor):
        controller.start()
        sensor.answer()
        controller.hear()
        sensor.stream.sendto(b"\x0anothing", ("127.0.0.1", 9))
        for _ in range(12):
            controller.value("rounds")
        assert controller.value("outcome") == '"silent TRUE"'
        controller.end()


def test_wrong_datagrams_are_dropped(tmp_path: Path) -> None:
    with driven(tmp_path) as (controller, sensor):
        controller.start()
        who = sensor.hear()
        for data in (b"\xff" * 100, b"\x0a\x05"):
            sensor.stream.sendto(data, who)
        now_s = controller.engine.live.now_s
        controller.hear()
        assert controller.engine.live.now_s == now_s
        assert guided(controller)
        controller.end()


def test_a_program_that_is_stopped_keeps_the_robot_where_it_is(tmp_path: Path) -> None:
    with driven(tmp_path) as (controller, sensor):
        controller.start()
        for _ in range(40):
            sensor.answer()
            controller.hear()
        controller.ask("stop", stopmode="stop")
        assert not guided(controller)
        live = controller.engine.live
        task = live.task("T_ROB1")
        unit = task.unit
        stands = unit.at_past(live.now_s + 1.0).joints[0]
        controller.ask("resetpp")
        controller.value("rounds")
        again = unit.at_past(live.now_s).joints[0]
        assert (stands == again).all()
        assert 0.0 < stands[0] < 0.087
        controller.end()
