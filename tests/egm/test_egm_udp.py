"""Whose datagrams count."""

from __future__ import annotations

import select
import socket

from rapidsim.egm.codec import encode
from rapidsim.egm.devices import Address
from rapidsim.egm.messages import SENSOR
from rapidsim.egm.udp import Ports

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


def test_only_the_computer_of_the_sensor_guides_the_robot() -> None:
    assert _heard("127.0.0.1") == (1, 0)
    assert _heard("localhost") == (1, 0)
    # An address that no computer has.
    assert _heard("192.0.2.1") == (0, 1)
