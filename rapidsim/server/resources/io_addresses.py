"""Networks and devices of signals, by the I/O configuration, and who may write them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Final

from rapidsim.controller.cell.description import mapped_bits
from rapidsim.server.resources.context import RequestContext

VIRTUAL: Final = "Local"
"""The network of signals without a device."""
_DEVICE: Final = "_DEVICE"
"""The names of device types end so, after the name of their network: `DEVICENET_DEVICE`."""


def networks(context: RequestContext) -> tuple[str, ...]:
    """All networks."""
    found = context.live.cell.parameters.instances("EIO", "INDUSTRIAL_NETWORK") or ()
    named = (one["Name"] for one in found if one.get("Name"))
    return tuple(dict.fromkeys((VIRTUAL, *named)))


def devices(context: RequestContext) -> Iterator[tuple[str, Mapping[str, str]]]:
    """Each device with its network."""
    parameters = context.live.cell.parameters
    spelled = {one.lower(): one for one in networks(context)}
    for of in parameters.types("EIO"):
        if of.endswith(_DEVICE):
            network = of.removesuffix(_DEVICE)
            for one in parameters.instances("EIO", of) or ():
                yield spelled.get(network.lower(), network), one


def inputs_of(context: RequestContext, device: str) -> Iterator[tuple[str, tuple[int, ...]]]:
    """The digital and group inputs of a device, with the bits that it maps to them."""
    for one in context.live.cell.parameters.instances("EIO", "EIO_SIGNAL") or ():
        is_input = one.get("SignalType", "").upper() in ("DI", "GI")
        if is_input and one.get("Device", "").lower() == device.lower():
            yield one.get("Name", ""), mapped_bits(one.get("DeviceMap", ""))


class SignalAddresses:
    """Where all signals are; made for a request, so that a list reads the configuration once."""

    def __init__(self, context: RequestContext) -> None:
        """Read the configuration."""
        found = context.live.cell.parameters.instances("EIO", "EIO_SIGNAL") or ()
        self._signals = {one.get("Name", "").lower(): one for one in found}
        named = ((one.get("Name", ""), network) for network, one in devices(context))
        self._devices = {name.lower(): f"{network}/{name}/" for name, network in named}

    def prefix(self, signal: str) -> str:
        """Network and device of a signal, as in its address; empty if it has none."""
        device = self._signals.get(signal.lower(), {}).get("Device", "")
        return self._devices.get(device.lower(), "")

    def may_be_written(self, signal: str) -> bool:
        """Whether the configuration lets clients write an output: only access level `All` does."""
        found = self._signals.get(signal.lower())
        return found is None or found.get("Access", "Default").lower() == "all"
