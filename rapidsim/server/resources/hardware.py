"""The tree of devices of a controller: hardware and software."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from rapidsim.server.derived_parameters import robots
from rapidsim.server.messages import Answer, Item, Request
from rapidsim.server.resources.codes import NOT_FOUND, refused
from rapidsim.server.resources.context import RequestContext

_GROUPS: Final = MappingProxyType(
    {"HW_DEVICES": "Hardware devices", "SW_RESOURCES": "Software resources"}
)
_SOFTWARE: Final = MappingProxyType({"SYSTEM": "System", "RAPID": "RAPID", "ROBAPI": "RobAPI"})


def groups(context: RequestContext, request: Request) -> Answer:
    """The groups of devices."""
    del context
    return _answer(request, "devices", "rw/devices", _GROUPS)


def group(context: RequestContext, request: Request, name: str) -> Answer:
    """The devices of a group.

    Raises:
        RefusedRequest: If there is no such group.
    """
    key = name.upper()
    if key not in _GROUPS:
        raise refused(NOT_FOUND, f"there is no group of devices {name}")
    devices = _SOFTWARE
    if key == "HW_DEVICES":
        arms = {unit: one.robot.name for unit, one in robots(context.live.setups) if one.robot}
        devices = MappingProxyType({"CONTROLLER": "Virtual Controller", **arms})
    return _answer(request, key, f"rw/devices/{key}", devices)


def _answer(request: Request, title: str, address: str, names: Mapping[str, str]) -> Answer:
    """Return devices, which RobotWare 6 has as parts of one item."""
    items = tuple(
        Item("dev-id-li", key, {"name": name}, href=f"{address}/{key}")
        for key, name in names.items()
    )
    if request.generation == 2:
        return Answer(resources=items)
    return Answer((Item("dev-id", title, parts=items),))
