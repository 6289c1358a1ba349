"""Signals by their names, with or without network and device; networks and devices."""

from __future__ import annotations

from typing import Final

from rapidsim.controller.cell.description import SignalDeclaration, SignalKind
from rapidsim.server.messages import DONE, Answer, Item, Request
from rapidsim.server.resources import io_addresses
from rapidsim.server.resources.codes import BAD_PARAMETER, NOT_FOUND, READ_ONLY, refused
from rapidsim.server.resources.context import RequestContext, count, number, required_value
from rapidsim.server.resources.io_addresses import SignalAddresses
from rapidsim.simulation.live import signals as live_signals

_PAGE: Final = 100
"""Largest number of signals that RobotWare 7 returns at once."""


def signals(context: RequestContext, request: Request) -> Answer:
    """All signals, or a page of them."""
    found = live_signals.declared(context.live)
    first, most = count(request.query, "start", 0), count(request.query, "limit", len(found))
    if request.generation == 2:
        most = min(most, _PAGE)
    places = SignalAddresses(context)
    shown = tuple(signal_item(context, one, places) for one in found[first : first + most])
    is_last = request.generation == 1 or not most or first + most >= len(found)
    following = "" if is_last else f"rw/iosystem/signals?start={first + most}&limit={most}"
    return Answer(resources=shown, following=following)


def search(context: RequestContext, request: Request) -> Answer:
    """The signals whose names contain a text."""
    part = request.form.get("name", "").lower()
    kind = request.form.get("type", "").lower()
    places = SignalAddresses(context)
    return Answer(
        resources=tuple(
            signal_item(context, one, places)
            for one in live_signals.declared(context.live)
            if part in one.name.lower() and kind in ("", one.kind.value)
        )
    )


def signal(
    context: RequestContext, request: Request, name: str, network: str = "", device: str = ""
) -> Answer:
    """One signal; a signal without a device answers under any device."""
    del request, network, device
    return Answer((signal_item(context, live_signals.find(context.live, name)),))


def set_signal(
    context: RequestContext, request: Request, name: str, network: str = "", device: str = ""
) -> Answer:
    """Change a signal."""
    del network, device
    found = live_signals.find(context.live, name)
    # Clients may always write inputs: there are no real devices that drive them.
    is_output = found.kind.value.endswith("o")
    if is_output and not SignalAddresses(context).may_be_written(name):
        raise refused(READ_ONLY, f"the configuration gives clients no access to {found.name}")
    live_signals.write(context.live, name, number(request.form, "lvalue"))
    return DONE


def set_device_inputs(
    context: RequestContext, request: Request, network: str, device: str
) -> Answer:
    """Set the inputs that a device maps to bytes of a request, from the highest bit of each."""
    del network
    named = {one.get("Name", "").lower() for _, one in io_addresses.devices(context)}
    if device.lower() not in named:
        raise refused(NOT_FOUND, f"there is no device {device}")
    first, mask = 8 * count(request.form, "startbyte", 0), count(request.form, "datamask", 255)
    data = required_value(request.form, "signaldata")
    if not data or set(data) - set("01") or len(data) % 8:
        raise refused(BAD_PARAMETER, "`signaldata` takes bytes of eight bits, such as 01111111")
    bits = {
        first + 8 * byte + bit: data[8 * byte + 7 - bit] == "1"
        for byte in range(len(data) // 8)
        for bit in range(8)
        if mask >> bit & 1
    }
    for name, places in io_addresses.inputs_of(context, device):
        if not bits.keys().isdisjoint(places):
            old = int(live_signals.value_of(context.live, name))
            told = (bits.get(at, bool(old >> k & 1)) for k, at in enumerate(places))
            live_signals.write(
                context.live, name, float(sum(one << k for k, one in enumerate(told)))
            )
    return DONE


def networks(context: RequestContext, request: Request) -> Answer:
    """The networks of the configuration, and the network of signals without a device."""
    del request
    fields = {"pstate": "running", "lstate": "started"}
    items = (
        Item("ios-network-li", one, {"name": one, **fields}, href=f"rw/iosystem/networks/{one}")
        for one in io_addresses.networks(context)
    )
    return Answer(resources=tuple(items))


def devices(context: RequestContext, request: Request) -> Answer:
    """The I/O devices of the configuration, or of one network."""
    wanted = request.query.get("network", "").lower()
    items = []
    for network, one in io_addresses.devices(context):
        if wanted in ("", network.lower()):
            name = one.get("Name", "")
            enabled = name.lower() not in context.live.cell.disabled_devices
            fields = {
                "name": name,
                "lstate": "enabled" if enabled else "disabled",
                "pstate": _physical_state(context, name, enabled=enabled),
                "address": one.get("Address", ""),
            }
            title = f"{network}/{name}"
            items.append(Item("ios-device-li", title, fields, href=f"rw/iosystem/devices/{title}"))
    return Answer(resources=tuple(items))


def _physical_state(context: RequestContext, device: str, *, enabled: bool) -> str:
    if device.lower() in context.live.cell.lost_devices:
        return "error"
    return "running" if enabled else "stopped"


def signal_item(
    context: RequestContext, declaration: SignalDeclaration, places: SignalAddresses | None = None
) -> Item:
    """Return a signal as clients see it."""
    value = value_text(declaration, live_signals.value_of(context.live, declaration.name))
    fields = {
        "name": declaration.name,
        "type": declaration.kind.value.upper(),
        "category": "",
        "lvalue": value,
        "lstate": "not simulated",
    }
    places = places or SignalAddresses(context)
    address = f"{places.prefix(declaration.name)}{declaration.name}"
    return Item("ios-signal-li", address, fields, href=f"rw/iosystem/signals/{address}")


def value_text(declaration: SignalDeclaration, value: float) -> str:
    """Return a value as a controller writes it: an integer unless the signal is analog."""
    analog = declaration.kind in (SignalKind.AI, SignalKind.AO)
    return f"{value:.10g}" if analog else str(int(value))
