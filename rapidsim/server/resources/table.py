"""Every resource of Robot Web Services 1.0 that is there, and who answers for it.

An address is parted at its slashes; `{name}` takes one part, `{name...}` all that are left. Names
compare as they are written, but for the actions of older clients, which have two.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Final

from rapidsim.server.messages import Answer, Request
from rapidsim.server.resources import (
    event_log,
    files,
    motion,
    panel,
    programs,
    queues,
    signals,
    symbols,
    system,
)
from rapidsim.server.resources.codes import BAD_PARAMETER, NOT_FOUND, as_answered, refused
from rapidsim.server.resources.context import Context, Resource
from rapidsim.simulation.live.states import Refused


@dataclass(frozen=True)
class Route:
    """A resource, and what is done with it."""

    method: str
    address: str
    resource: Resource
    action: str = ""

    @cached_property
    def parts(self) -> tuple[str, ...]:
        """The address, parted."""
        return tuple(self.address.split("/"))

    def matched(self, parts: list[str]) -> dict[str, str] | None:
        """What stands in the places of an address; None if it is another."""
        found: dict[str, str] = {}
        for index, part in enumerate(self.parts):
            if part.endswith("...}"):
                rest = "/".join(parts[index:])
                return {**found, part[1:-4]: rest} if rest else None
            if index >= len(parts):
                return None
            if part.startswith("{"):
                found[part[1:-1]] = parts[index]
            elif part.startswith("$"):
                if not parts[index].startswith("$"):
                    return None
                found[part[2:-1]] = parts[index][1:]
            elif part != parts[index]:
                return None
        return found if len(parts) == len(self.parts) else None


_SIGNAL: Final = ("rw/iosystem/signals/{name}", "rw/iosystem/signals/{network}/{device}/{name}")
_UNIT: Final = "rw/motionsystem/mechunits/{unit}"
_EXECUTION: Final = "rw/rapid/execution"
_FILE: Final = "fileservice/{address...}"
_SYMBOL: Final = "rw/rapid/symbol/data/RAPID/{symbol...}"

ROUTES: Final = (
    Route("GET", "ctrl", system.controller),
    Route("GET", "ctrl/identity", system.controller),
    Route("GET", "ctrl/clock", system.clock),
    Route("GET", "ctrl/${name}", system.disk),
    Route("GET", "rw/system", system.system),
    Route("GET", "rw/panel/ctrlstate", panel.state),
    Route("POST", "rw/panel/ctrlstate", panel.set_state, "setctrlstate"),
    Route("GET", "rw/panel/opmode", panel.mode),
    Route("POST", "rw/panel/opmode", panel.set_mode, "setopmode"),
    Route("GET", "rw/panel/speedratio", panel.speed_ratio),
    Route("POST", "rw/panel/speedratio", panel.set_speed_ratio, "setspeedratio"),
    Route("GET", "rw/panel/coldetstate", panel.collision_detection),
    Route("GET", _EXECUTION, programs.execution),
    Route("POST", _EXECUTION, programs.start, "start"),
    Route("POST", _EXECUTION, programs.start_production, "startprodentry"),
    Route("POST", _EXECUTION, programs.stop, "stop"),
    Route("POST", _EXECUTION, programs.reset_pointers, "resetpp"),
    Route("POST", _EXECUTION, programs.set_cycle, "setcycle"),
    Route("GET", "rw/rapid/tasks", programs.tasks),
    Route("POST", "rw/rapid/tasks", programs.activate, "activate"),
    Route("POST", "rw/rapid/tasks", programs.deactivate, "deactivate"),
    Route("GET", "rw/rapid/tasks/{task}", programs.task),
    Route("POST", "rw/rapid/tasks/{task}", programs.activate, "activate"),
    Route("POST", "rw/rapid/tasks/{task}", programs.deactivate, "deactivate"),
    Route("GET", "rw/rapid/tasks/{task}/pcp", programs.pointers),
    Route("GET", "rw/rapid/modules", programs.modules),
    Route("GET", "rw/rapid/modules/{module}", programs.module),
    Route("GET", _SYMBOL, symbols.value),
    Route("POST", _SYMBOL, symbols.set_value, "set"),
    Route("POST", "rw/rapid/symbol/data", symbols.validate, "validate"),
    Route("GET", "rw/rapid/symbol/properties/RAPID/{symbol...}", symbols.properties),
    Route("POST", "rw/rapid/symbols", symbols.search, "search-symbols"),
    Route("GET", "rw/iosystem/signals", signals.signals),
    Route("POST", "rw/iosystem/signals", signals.search, "signal-search"),
    *(Route("GET", one, signals.signal) for one in _SIGNAL),
    *(Route("POST", one, signals.set_signal, "set") for one in _SIGNAL),
    Route("GET", "rw/motionsystem/mechunits", motion.units),
    Route("GET", _UNIT, motion.unit),
    Route("GET", f"{_UNIT}/jointtarget", motion.joint_target),
    Route("GET", f"{_UNIT}/robtarget", motion.rob_target),
    Route("GET", f"{_UNIT}/cartesian", motion.cartesian),
    Route("GET", f"{_UNIT}/baseframe", motion.base_frame),
    Route("GET", "rw/elog", event_log.domains),
    Route("POST", "rw/elog", event_log.clear_all, "clearall"),
    Route("GET", "rw/elog/{domain}", event_log.entries),
    Route("POST", "rw/elog/{domain}", event_log.clear, "clear"),
    Route("GET", "rw/elog/{domain}/{number}", event_log.entry),
    Route("GET", "rw/dipc", queues.queues),
    Route("POST", "rw/dipc", queues.create, "dipc-create"),
    Route("POST", "rw/dipc", queues.create, "create"),
    Route("GET", "rw/dipc/{queue}", queues.read, "dipc-read"),
    Route("GET", "rw/dipc/{queue}", queues.read, "read"),
    Route("GET", "rw/dipc/{queue}", queues.queue),
    Route("POST", "rw/dipc/{queue}", queues.send, "dipc-send"),
    Route("POST", "rw/dipc/{queue}", queues.send, "send"),
    Route("GET", _FILE, files.read),
    Route("PUT", _FILE, files.write),
    Route("DELETE", _FILE, files.remove),
    Route("POST", _FILE, files.change),
    Route("GET", "rw/mastership", system.mastership),
    Route("POST", "rw/mastership", system.take_mastership, "request"),
    Route("POST", "rw/mastership", system.give_mastership, "release"),
    Route("GET", "rw/mastership/{domain}", system.mastership_of),
    Route("POST", "rw/mastership/{domain}", system.take_mastership, "request"),
    Route("POST", "rw/mastership/{domain}", system.give_mastership, "release"),
    Route("POST", "users", system.register),
    Route("POST", "users/rmmp", system.remote_rights),
    Route("POST", "users/rmmp", system.rights_given_back, "cancel"),
    Route("GET", "users/rmmp", system.rights_granted),
    Route("GET", "users/rmmp/poll", system.rights_granted),
)


def answered(context: Context, request: Request) -> Answer:
    """Do what is asked.

    Raises:
        RefusedRequest: If there is no such resource or action, or it is refused.
    """
    parts = [part for part in request.path.split("/") if part]
    there = False
    for route in ROUTES:
        places = route.matched(parts)
        if places is None:
            continue
        there = True
        if route.method == request.method and route.action == request.action:
            try:
                return route.resource(context, request, **places)
            except Refused as refusal:
                raise as_answered(refusal) from None
    if there:
        raise refused(BAD_PARAMETER, f"{request.method} {request.path}: no such action here")
    below = tuple(dict.fromkeys(_below(parts)))
    if below and request.method == "GET":
        return Answer(links=below)
    raise refused(NOT_FOUND, f"there is no resource {request.path}")


def _below(parts: list[str]) -> Iterator[str]:
    """The names of resources below an address that is none itself."""
    for route in ROUTES:
        if len(route.parts) > len(parts) and list(route.parts[: len(parts)]) == parts:
            name = route.parts[len(parts)]
            if not name.startswith(("{", "$")):
                yield name
