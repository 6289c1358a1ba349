"""Networks and devices of signals in the I/O configuration, and write access to signals."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Final

from rapidsim.controller.cell.description import mapped_bits
from rapidsim.server.resources.context import RequestContext

VIRTUAL: Final = "Local"
"""Network of signals without a device."""
_DEVICE: Final = "_DEVICE"
"""Suffix of device types, after the name of their network: `DEVICENET_DEVICE`."""


def networks(context: RequestContext) -> tuple[str, ...]:
    """Return all networks."""
    found = context.live.cell.parameters.instances("EIO", "INDUSTRIAL_NETWORK") or ()
    named = (one["Name"] for one in found if one.get("Name"))
    return tuple(dict.fromkeys((VIRTUAL, *named)))


def devices(context: RequestContext) -> Iterator[tuple[str, Mapping[str, str]]]:
    """Yield each device with its network."""
    parameters = context.live.cell.parameters
    spelled = {one.lower(): one for one in networks(context)}
    for of in parameters.types("EIO"):
        if of.endswith(_DEVICE):
            network = of.removesuffix(_DEVICE)
            for one in parameters.instances("EIO", of) or ():
                yield spelled.get(network.lower(), network), one


def inputs_of(context: RequestContext, device: str) -> Iterator[tuple[str, tuple[int, ...]]]:
    """Yield the digital and group inputs of a device, with the bits that it maps to them."""
    for one in context.live.cell.parameters.instances("EIO", "EIO_SIGNAL") or ():
        is_input = one.get("SignalType", "").upper() in ("DI", "GI")
        if is_input and one.get("Device", "").lower() == device.lower():
            yield one.get("Name", ""), mapped_bits(one.get("DeviceMap", ""))


class SignalAddresses:
    """Addresses of all signals, created per request: a list reads the configuration once."""

    def __init__(self, context: RequestContext) -> None:
        """Read the configuration."""
        found = context.live.cell.parameters.instances("EIO", "EIO_SIGNAL") or ()
        self._signals = {one.get("Name", "").lower(): one for one in found}
        named = ((one.get("Name", ""), network) for network, one in devices(context))
        self._devices = {name.lower(): f"{network}/{name}/" for name, network in named}

    def prefix(self, signal: str) -> str:
        """Return network and device of a signal, as in its address; empty without a device."""
        device = self._signals.get(signal.lower(), {}).get("Device", "")
        return self._devices.get(device.lower(), "")

    def may_be_written(self, signal: str) -> bool:
        """Whether the configuration lets clients write an output: with access level `All` only."""
        found = self._signals.get(signal.lower())
        return found is None or found.get("Access", "Default").lower() == "all"
