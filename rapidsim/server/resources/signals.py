"""Signals by their names, alone or behind a network and a device, which no signal has here."""

from __future__ import annotations

from rapidsim.controller.cell.description import SignalDeclaration, SignalKind
from rapidsim.server.messages import DONE, Answer, Item, Request
from rapidsim.server.resources.context import Context, count, number


def signals(context: Context, request: Request) -> Answer:
    """All signals, or so many from one on."""
    found = context.live.signals()
    first, most = count(request.query, "start", 0), count(request.query, "limit", len(found))
    return Answer(tuple(signal_item(context, one) for one in found[first : first + most]))


def search(context: Context, request: Request) -> Answer:
    """The signals whose names hold a text."""
    part = request.form.get("name", "").lower()
    kind = request.form.get("type", "").lower()
    return Answer(
        tuple(
            signal_item(context, one)
            for one in context.live.signals()
            if part in one.name.lower() and kind in ("", one.kind.value)
        )
    )


def signal(
    context: Context, request: Request, name: str, network: str = "", device: str = ""
) -> Answer:
    """One signal; a signal without a device answers under any."""
    del request, network, device
    return Answer((signal_item(context, context.live.signal(name)),))


def set_signal(
    context: Context, request: Request, name: str, network: str = "", device: str = ""
) -> Answer:
    """Change a signal."""
    del network, device
    context.live.signal(name)
    context.live.set_signal(name, number(request.form, "lvalue"))
    return DONE


def signal_item(context: Context, one: SignalDeclaration) -> Item:
    """A signal as it is shown."""
    value = value_text(one, context.live.signal_value(one.name))
    fields = {
        "name": one.name,
        "type": one.kind.value.upper(),
        "category": "",
        "lvalue": value,
        "lstate": "not simulated",
    }
    return Item("ios-signal-li", one.name, fields, href=f"rw/iosystem/signals/{one.name}")


def value_text(one: SignalDeclaration, value: float) -> str:
    """A value as a controller writes it: whole numbers but for analog signals."""
    analog = one.kind in (SignalKind.AI, SignalKind.AO)
    return f"{value:.10g}" if analog else str(int(value))
