"""The panel: motors, operating mode, speed ratio."""

from __future__ import annotations

from dataclasses import replace
from enum import StrEnum
from typing import Final

from rapidsim.controller.cell.faults import FailureKind, Fault
from rapidsim.server.messages import DONE, Answer, Item, Request
from rapidsim.server.resources.codes import BAD_PARAMETER, refused
from rapidsim.server.resources.context import RequestContext, chosen, number
from rapidsim.simulation.live.states import Motors, OperatingMode

_MODES: Final = {
    "auto": OperatingMode.AUTO,
    "man": OperatingMode.REDUCED,
    "manr": OperatingMode.REDUCED,
    "manf": OperatingMode.FULL,
    "manfs": OperatingMode.FULL,
}


class _RestartMode(StrEnum):
    """Restarts in the words of clients; all but the first are cold."""

    WARM = "restart"
    RESET_RAPID = "pstart"
    RESET_SYSTEM = "istart"


def state(context: RequestContext, request: Request) -> Answer:
    """The state of the controller."""
    title = "ctrlstate" if request.generation == 1 else "ctrl-state"
    return Answer((replace(state_item(context), title=title),))


def state_item(context: RequestContext) -> Item:
    """Return the state of the controller as an item."""
    return Item("pnl-ctrlstate", "ctrlstate", {"ctrlstate": context.live.panel.state.value})


def set_state(context: RequestContext, request: Request) -> Answer:
    """Switch the motors on or off."""
    context.live.panel.set_motors(chosen(request.form, "ctrl-state", Motors))
    return DONE


class _Button(StrEnum):
    """States of the button of the emergency stop, in our own words: no client has one."""

    PRESSED = "pressed"
    RELEASED = "released"


def set_emergency_stop(context: RequestContext, request: Request) -> Answer:
    """Press or release the button of the emergency stop."""
    button = chosen(request.form, "emergency-stop", _Button)
    context.live.panel.press_emergency_stop(is_pressed=button is _Button.PRESSED)
    return DONE


def restart(context: RequestContext, request: Request) -> Answer:
    """Restart the controller: warm, or cold with programs and data as at the start."""
    if request.generation == 2:
        context.require_mastership("rapid", request)
    is_warm = chosen(request.form, "restart-mode", _RestartMode) is _RestartMode.WARM
    context.live.faults.add(Fault(kind=FailureKind.RESTART, mode="warm" if is_warm else "cold"))
    context.live.settle()
    return DONE


def mode(context: RequestContext, request: Request) -> Answer:
    """The operating mode."""
    del request
    return Answer((mode_item(context),))


def mode_item(context: RequestContext) -> Item:
    """Return the operating mode as an item."""
    return Item("pnl-opmode", "opmode", {"opmode": context.live.panel.mode.value})


def set_mode(context: RequestContext, request: Request) -> Answer:
    """Turn the mode key, which a virtual controller allows clients."""
    asked = request.form.get("opmode", "").lower()
    if asked not in _MODES:
        raise refused(BAD_PARAMETER, f"`opmode` cannot be `{asked}`")
    context.live.panel.set_mode(_MODES[asked])
    return DONE


def speed_ratio(context: RequestContext, request: Request) -> Answer:
    """The speed ratio in percent."""
    del request
    return Answer((speed_item(context),))


def speed_item(context: RequestContext) -> Item:
    """Return the speed ratio as an item."""
    return Item("pnl-speedratio", "speedratio", {"speedratio": str(context.live.panel.speed_ratio)})


def set_speed_ratio(context: RequestContext, request: Request) -> Answer:
    """Set the speed ratio of later moves."""
    context.require_mastership("rapid", request)
    percent = number(request.form, "speed-ratio")
    context.live.panel.set_speed_ratio(round(percent))
    return DONE


def collision_detection(context: RequestContext, request: Request) -> Answer:
    """The state of collision detection."""
    del request
    return Answer((collision_item(context),))


def collision_item(context: RequestContext) -> Item:
    """Return the state of collision detection, which never triggers here, as an item."""
    del context
    return Item("pnl-coldetstate", "collisiondetectstate", {"coldetstate": "INIT"})
