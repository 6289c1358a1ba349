"""Sensors that guide robots, over real datagrams: of a served controller, and of a run."""

from __future__ import annotations

import json
import socket
import sys
import urllib.request
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Thread

import pytest
from command_line import call

from rapidsim.controller.cell.network import Network
from rapidsim.egm.codec import decode, encode
from rapidsim.egm.devices import Address, sensor_devices
from rapidsim.egm.messages import ROBOT, SENSOR
from rapidsim.egm.udp import PacedSensors
from rapidsim.files import SourceFile
from rapidsim.jobs.checking.checked_program import load
from rapidsim.motion.robot.robot import load_robot
from rapidsim.pytest_plugin import ServedController
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.simulate import simulate

PROGRAM = r"""MODULE guided
  VAR egmident id;
  PROC main()
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
    EGMGetId id;
    EGMSetupUC ROB_1, id, "default", "UCdevice" \Joint \CommTimeout:=60;
    EGMActJoint id \J1:=[-0.1,0.1] \MaxSpeedDeviation:=90;
    EGMRunJoint id, EGM_STOP_HOLD \J1 \CondTime:=0.02 \RampInTime:=0;
    TPWrite "there";
    EGMReset id;
  ENDPROC
ENDMODULE
"""


@contextmanager
def sensor() -> Iterator[tuple[Address, list[int]]]:
    """One that wants axis 1 at 2 degrees, until the controller says that nobody guides any more.

    It gives its address, and the states of guidance that it was told of.
    """
    states: list[int] = []
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as stream:
        stream.bind(("127.0.0.1", 0))
        stream.settimeout(60.0)

        def answer() -> None:
            message = {"planned": {"joints": {"joints": (2.0, 0, 0, 0, 30.0, 0)}}}
            while 2 not in states:
                data, controller = stream.recvfrom(65536)
                states.append(decode(ROBOT, data)["mciState"]["state"])
                stream.sendto(encode(SENSOR, message), controller)

        thread = Thread(target=answer, daemon=True)
        thread.start()
        yield Address(*stream.getsockname()), states
        thread.join(60.0)


@pytest.mark.process
@pytest.mark.skipif(sys.platform == "win32", reason="ends it by a signal")
def test_a_served_controller_is_guided_from_its_start_to_its_end(
    tmp_path: Path, controller: Callable[..., ServedController]
) -> None:
    (tmp_path / "job.mod").write_text(PROGRAM)
    journal = tmp_path / "a.jsonl"
    with sensor() as (address, states):
        served = controller(
            tmp_path / "job.mod", "--journal", journal, "--egm", f"UCdevice={address}"
        )
        passwords = urllib.request.HTTPPasswordMgrWithDefaultRealm()
        passwords.add_password(None, served.rws1, "Default User", "robotics")
        opener = urllib.request.build_opener(urllib.request.HTTPDigestAuthHandler(passwords))
        opener.open(f"{served.rws1}/rw/rapid/execution?action=start", b"cycle=once").close()
    assert set(states) == {3, 2}
    assert served.end() == 0
    # A busy computer may say that time is behind its pace.
    assert "error" not in served.errors
    lines = [json.loads(line) for line in journal.read_text().splitlines()]
    assert any(line["kind"] == "egm" for line in lines)
    replayed = call(
        *("run", str(tmp_path / "job.mod"), "--replay", str(journal), "--no-record"), cwd=tmp_path
    )
    assert "s  there" in replayed.out
    assert "departs" not in replayed.err


def test_a_run_may_be_guided_over_the_network() -> None:
    loaded = load([SourceFile("guided.mod", PROGRAM, "utf-8")])
    assert loaded.program is not None
    with sensor() as (address, states):
        devices = sensor_devices([("ucdevice", address)], {}, frozenset())
        network = Network(sensors=PacedSensors(devices, waits_full=False))
        run = simulate(loaded.program, load_robot("irb1600"), options=RunOptions(network=network))
    assert run.end.value == "ended"
    assert set(states) == {3, 2}


def test_a_device_without_an_address_is_wrong_usage(tmp_path: Path) -> None:
    (tmp_path / "job.mod").write_text(PROGRAM)
    done = call("serve", "job.mod", "--egm", "UCdevice", cwd=tmp_path)
    assert done.code == 2
    assert "--egm UCdevice=127.0.0.1:6510" in done.err
