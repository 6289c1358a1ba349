"""Where sensors are: on the command line, in the configuration, or nowhere in particular."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import pytest

from rapidsim.egm.devices import Address, read_device, sensor_devices
from rapidsim.files import InputError
from rapidsim.language.errors import NotAllowed

SIO: Mapping[str, Mapping[str, Sequence[Mapping[str, str]]]] = {
    "SIO": {
        "COM_TRP": [
            {"name": "UCdevice", "type": "UDPUC", "remoteadress": "127.0.0.1"},
            {
                "name": "Far",
                "type": "UDPUC",
                "remoteadress": "192.168.125.20",
                "remoteportnumber": "6599",
            },
            {"name": "COM1", "type": "Serial"},
        ]
    }
}


def test_robotware_7_has_devices_of_another_type() -> None:
    row = {"name": "ROB_1", "type": "UDPUC", "remoteaddress": "", "remoteportnumber": "6511"}
    devices = sensor_devices([], {"SIO": {"UDPUC_HOST": [row]}}, frozenset())
    assert devices.address("rob_1") == ("127.0.0.1", 6511)
    assert devices.addresses == {"ROB_1": ":6511"}


def test_the_command_line_counts_over_the_configuration() -> None:
    devices = sensor_devices([("ucDEVICE", Address("127.0.0.1", 7000))], SIO, frozenset())
    assert devices.address("UCdevice") == ("127.0.0.1", 7000)
    assert devices.address("unheard") == ("127.0.0.1", 6510)
    assert devices.addresses == {"ucDEVICE": "127.0.0.1:7000", "Far": "192.168.125.20:6599"}


def test_a_sensor_elsewhere_is_not_talked_to_unasked() -> None:
    with pytest.raises(NotAllowed, match=r"--network-host 192\.168\.125\.20"):
        sensor_devices([], SIO, frozenset()).address("far")
    allowed = sensor_devices([], SIO, frozenset({"192.168.125.20"}))
    assert allowed.address("far") == ("192.168.125.20", 6599)
    named = sensor_devices([("far", Address("10.0.0.1", 1))], SIO, frozenset())
    assert named.address("Far") == ("10.0.0.1", 1)


@pytest.mark.parametrize(
    "text", ["UCdevice", "=127.0.0.1:1", "a=1:x", "a=:6510", "a=h:0", "a=h:70000"]
)
def test_what_is_no_device_is_wrong_usage(text: str) -> None:
    with pytest.raises(InputError, match="NAME=HOST:PORT"):
        read_device(text)


def test_a_device_is_read() -> None:
    assert read_device("UCdevice:=localhost:6511") == ("UCdevice", ("localhost", 6511))
