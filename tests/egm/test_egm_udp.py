"""Whose datagrams count."""

from __future__ import annotations

import select
import socket
import threading
from dataclasses import replace
from time import monotonic, sleep

import pytest

from rapidsim.egm import sensor_host
from rapidsim.egm.codec import encode
from rapidsim.egm.devices import Address, SensorDevices
from rapidsim.egm.messages import SENSOR
from rapidsim.egm.udp import PacedSensors, Ports
from rapidsim.motion.guidance.feedback import Feedback, Guided

STANDING = Feedback(
    0.0, (0.0,) * 6, (), (0.0,) * 3, (1.0, 0.0, 0.0, 0.0), Guided.NOT_YET, False, 0.0
)

ANSWER = encode(SENSOR, {"planned": {"joints": {"joints": [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]}}})


def _heard(host: str) -> tuple[int, int]:
    """What a program hears whose sensor is on a host, when this computer answers: counted, not."""
    ports = Ports()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        sensor = ports.to(Address(host, 6510))
        sender.sendto(ANSWER, ("127.0.0.1", sensor.stream.getsockname()[1]))
        assert select.select([sensor.stream], [], [], 10.0)[0]
        answers = sensor.receive()
        ports.close()
        return answers, sensor.dropped


def test_a_sensor_keeps_the_port_of_its_first_answer() -> None:
    # Another program of the same computer does not take the robot over, unless that is permitted.
    ports = Ports()
    address = Address("127.0.0.1", 6510)
    with (
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as first,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as second,
    ):
        for any_port, counted in ((False, (2, 1)), (True, (3, 0))):
            sensor = ports.to(address, any_port=any_port)
            answers = 0
            for sender in (first, second, first):
                sender.sendto(ANSWER, ("127.0.0.1", sensor.stream.getsockname()[1]))
                assert select.select([sensor.stream], [], [], 10.0)[0]
                answers += sensor.receive()
            assert (answers, sensor.dropped) == counted
        # A later program, or the same after EGMReset, may have another sensor.
        second.sendto(ANSWER, ("127.0.0.1", ports.to(address).stream.getsockname()[1]))
        assert ports.to(address).take() is None
    ports.close()


def test_a_stream_that_nobody_answers_takes_no_time() -> None:
    # Where cycles end with their answers, as at `--speed max`, only an answer is worth a wait.
    stream = [replace(STANDING, time_s=0.004 * k) for k in range(250)]
    sensors = PacedSensors(SensorDevices({"dev": Address("127.0.0.1", 9)}), waits_full=False)
    began_s = monotonic()
    sensors.open("dev").stream(stream)
    sensors.close()
    assert monotonic() - began_s < 0.5


def test_only_the_computer_of_the_sensor_guides_the_robot() -> None:
    assert _heard("127.0.0.1") == (1, 0)
    assert _heard("localhost") == (1, 0)
    # An address that no computer has.
    assert _heard("192.0.2.1") == (0, 1)


def test_a_host_without_an_address_delays_no_cycle(monkeypatch: pytest.MonkeyPatch) -> None:
    # A name server that takes its time, and does not know the host before the third attempt.
    attempts: list[str] = []

    def slowly(host: str) -> str:
        attempts.append(host)
        gate.wait(10.0)
        if len(attempts) < 3:
            raise OSError
        return "127.0.0.1"

    gate = threading.Event()
    monkeypatch.setattr(socket, "gethostbyname", slowly)
    monkeypatch.setattr(sensor_host, "_AGAIN_S", 0.0)
    ports = Ports(patience_s=0.0)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as device:
        device.bind(("127.0.0.1", 0))
        device.settimeout(10.0)
        sensor = ports.to(Address("driver", device.getsockname()[1]))
        sensor.send(STANDING)
        gate.set()
        while sensor.host.numeric is None:
            sleep(0.001)
        sensor.send(replace(STANDING, time_s=0.004))
        device.recvfrom(65536)
        device.setblocking(False)
        with pytest.raises(BlockingIOError):
            device.recvfrom(65536)
    ports.close()
    assert attempts == ["driver"] * 3
