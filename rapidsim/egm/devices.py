"""Addresses of sensors: UDPUC devices from the command line and the configuration."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import field
from typing import Final, NamedTuple

from rapidsim.controller.cell.system_parameters import SystemParameters
from rapidsim.files import InputError
from rapidsim.language.equipment import Configured
from rapidsim.language.errors import NotAllowed
from rapidsim.values import value_class

_LOOPBACK: Final = frozenset({"", "localhost", "127.0.0.1"})
_DOMAIN = "SIO"
_ADDRESSES: Final = (("COM_TRP", "remoteadress"), ("UDPUC_HOST", "remoteaddress"))
"""Types with devices, and their attribute with the host: of RobotWare 6 (so spelled), and of 7."""


class Address(NamedTuple):
    """The address of a sensor."""

    host: str
    port: int

    def __str__(self) -> str:
        """Address as text: `127.0.0.1:6510`."""
        return f"{self.host}:{self.port}"


DEFAULT: Final = Address("127.0.0.1", 6510)
"""Address of an unknown device."""


@value_class(frozen=True, slots=True)
class SensorDevices:
    """The known devices, by folded name."""

    named: Mapping[str, Address] = field(default_factory=dict)
    """Addresses from the command line, of any host."""
    configured: Mapping[str, Address] = field(default_factory=dict)
    """Addresses from SIO.cfg, only of this computer and of allowed hosts."""
    names: tuple[str, ...] = ()
    """Names as written."""
    hosts: frozenset[str] = frozenset()
    any_port: bool = False
    """Whether a sensor may answer from any port of its computer."""

    def address(self, device: str) -> Address:
        """The address of a device's sensor.

        Raises:
            NotAllowed: If it is on another computer that was not allowed.
        """
        key = device.lower()
        if key in self.named:
            return self.named[key]
        found = self.configured.get(key, DEFAULT)
        if found.host not in _LOOPBACK and found.host not in self.hosts:
            raise NotAllowed(
                f"the sensor of `{device}` is on another computer, {found}: `--network-host "
                f"{found.host}` lets the program talk to it"
            )
        return Address(found.host or DEFAULT.host, found.port)

    @property
    def addresses(self) -> dict[str, str]:
        """Names and addresses, for display."""
        both = {**self.configured, **self.named}
        return {name: str(both[name.lower()]) for name in self.names}


def sensor_devices(
    addresses: Iterable[tuple[str, Address]],
    configured: Configured,
    hosts: frozenset[str],
    *,
    any_port: bool = False,
) -> SensorDevices:
    """The devices of a controller.

    Args:
        addresses: Devices from the command line, which override the configuration.
        configured: The system parameters.
        hosts: Other computers that programs may connect to.
        any_port: Whether a sensor may answer from any port of its computer.
    """
    parameters = SystemParameters(configured)
    found = {
        row.get("name", ""): Address(row.get(host, DEFAULT.host), port)
        for type_, host in _ADDRESSES
        for row in parameters.instances(_DOMAIN, type_) or ()
        if row.get("type", "").upper() == "UDPUC"
        and (port := _port(row.get("remoteportnumber", str(DEFAULT.port))))
    }
    named = dict(addresses)
    names = {name.lower(): name for name in (*found, *named)}
    return SensorDevices(
        {name.lower(): address for name, address in named.items()},
        {name.lower(): address for name, address in found.items()},
        tuple(names.values()),
        hosts,
        any_port,
    )


def read_device(text: str) -> tuple[str, Address]:
    """Parse a device of the command line, such as `UCdevice=127.0.0.1:6510`.

    Raises:
        InputError: If it has another form.
    """
    name, _, address = text.partition("=")
    host, _, port = address.rpartition(":")
    number = _port(port)
    if not name or not host or not number:
        raise InputError(f"--egm: `{text}` is not NAME=HOST:PORT", "--egm UCdevice=127.0.0.1:6510")
    return name.rstrip(":"), Address(host, number)


def _port(text: str) -> int:
    """A port number; 0 if the text is not one."""
    return int(text) if text.isascii() and text.isdigit() and int(text) < 65536 else 0
