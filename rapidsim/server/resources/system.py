"""The controller itself: its identity, its clock, and the rights of sessions."""

from __future__ import annotations

from dataclasses import replace
from datetime import datetime
from typing import Final

from rapidsim import __version__
from rapidsim.server.derived_parameters import robots
from rapidsim.server.messages import DONE, Answer, Item, Request
from rapidsim.server.resources.codes import (
    BAD_PARAMETER,
    HELD_BY_ANOTHER,
    NOT_ALLOWED,
    NOT_FOUND,
    refused,
)
from rapidsim.server.resources.context import MASTERSHIPS, RequestContext, count
from rapidsim.server.resources.disks import DISKS

_OPTIONS: Final = "rw/system/options"
_USER: Final = "Default User"
"""Name of a client that has not registered."""
_APPLICATION: Final = "RobAPI2-Client"
"""Name under which controllers list clients of Robot Web Services."""


def controller(context: RequestContext, request: Request) -> Answer:
    """The identity of the controller, and what else it has."""
    return replace(identity(context, request), links=("identity", "clock", "backup"))


def identity(context: RequestContext, request: Request) -> Answer:
    """The identity of the controller; a virtual one has neither number nor address."""
    del context, request
    fields = {
        "ctrl-type": "Virtual Controller",
        "ctrl-name": "rapidsim",
        "ctrl-level": "System Level",
    }
    return Answer((Item("ctrl-identity-info", "identity", fields),))


def clock(context: RequestContext, request: Request) -> Answer:
    """Date and time of day, virtual."""
    del request
    stamp = context.live.date.strftime("%Y-%m-%d T %H:%M:%S")
    return Answer((Item("ctrl-clock-info", "clock", {"datetime": stamp}),))


def set_clock(context: RequestContext, request: Request) -> Answer:
    """Set date and time of day."""
    names = ("year", "month", "day", "hour", "min", "sec")
    parts = [count(request.form, f"sys-clock-{one}", -1) for one in names]
    try:
        context.live.set_date(datetime(*parts))  # type: ignore[arg-type]
    except ValueError:
        raise refused(BAD_PARAMETER, "there is no such date") from None
    return DONE


def disk(context: RequestContext, request: Request, name: str) -> Answer:
    """The path of a disk in addresses of files.

    Raises:
        RefusedRequest: If there is no such disk.
    """
    del context, request
    if name.upper() not in DISKS:
        raise refused(NOT_FOUND, f"there is no ${name}")
    return Answer((Item("ctrl-env", f"${name}", {"_value": f"${name}"}),))


def system(context: RequestContext, request: Request) -> Answer:
    """Name, version and options."""
    version = context.versions[request.generation]
    fields = {
        "name": f"rapidsim {__version__}",
        "rwversion": version.text,
        "sysid": "{00000000-0000-0000-0000-000000000000}",
        "starttm": context.live.cell.starts_at.strftime("%Y-%m-%d T %H:%M:%S"),
    }
    if request.generation == 1:
        item = Item("sys-system-li", "system", {**fields, "rwversionname": version.name})
        kind = "sys-option-li"
    else:
        numbers = {
            "major": str(version.robotware.major),
            "minor": str(version.robotware.minor),
        }
        later = {"rwversionname": version.name} if version.robotware.major > 7 else {}
        item, kind = Item("sys-system", "system", {**numbers, **fields, **later}), "sys-options"
    listed = Item("sys-options-li", "options", parts=_options(context, kind), href=_OPTIONS)
    return Answer((item,), (listed,), links=("options", "robottype", "license"))


def options(context: RequestContext, request: Request) -> Answer:
    """The options of the system."""
    items = _options(context, "sys-option-li")
    if request.generation == 2:
        return Answer(items)
    return Answer((Item("sys-options-li", "options", parts=items, href=_OPTIONS),))


def robot_type(context: RequestContext, request: Request) -> Answer:
    """The types of the robots; no content if there is none."""
    del request
    arms = (one.robot for _, one in robots(context.live.setups) if one.robot is not None)
    items = tuple(
        Item("sys-robottype", str(number), {"robot-type": arm.title.removeprefix("ABB ")})
        for number, arm in enumerate(arms, start=1)
    )
    return Answer(items) if items else DONE


def license_(context: RequestContext, request: Request) -> Answer:
    """The licence of the system, which a virtual controller does not need."""
    del context, request
    return Answer((Item("sys-license", "license", {"license": "Virtual Controller"}),))


def mastership(context: RequestContext, request: Request) -> Answer:
    """Which session holds the mastership of each domain."""
    names = MASTERSHIPS if request.generation == 1 else _SECOND_NAMES
    items = tuple(_domain_item(context, request, one) for one in names)
    links = ("request", "release") if request.generation == 2 else ()
    return Answer(resources=items, links=links)


def mastership_of(context: RequestContext, request: Request, domain: str) -> Answer:
    """Which session holds the mastership of a domain."""
    item = _domain_item(context, request, domain.lower())
    holder = _master(context, request, domain.lower())
    is_own = holder is not None and holder == request.session
    fields = {
        "uid": "" if holder is None else str(holder),
        "application": "" if holder is None else _APPLICATION,
        "location": "",
        "alias": "" if holder is None else context.sessions.get(holder, ""),
        **item.fields,
        "mastershipheldbyme": str(is_own).upper(),
    }
    return Answer((Item("msh-resource", item.title, fields),))


def take_mastership(context: RequestContext, request: Request, domain: str | None = None) -> Answer:
    """Take the mastership of a domain, or of all.

    Raises:
        RefusedRequest: If another session holds it.
    """
    wanted = _domains(domain, request)
    for one in wanted:
        if context.masters.get(one, request.session) != request.session:
            raise refused(HELD_BY_ANOTHER, f"another session has the mastership of {one}")
    context.masters |= dict.fromkeys(wanted, request.session)
    return DONE


def give_mastership(context: RequestContext, request: Request, domain: str | None = None) -> Answer:
    """Release the mastership of a domain, or of all."""
    for one in _domains(domain, request):
        if context.masters.get(one) == request.session:
            del context.masters[one]
    return DONE


def nothing_to_end(context: RequestContext, request: Request) -> Answer:
    """End a stream; rapidsim has none."""
    del context, request
    return DONE


def users(context: RequestContext, request: Request) -> Answer:
    """The clients that have a session; with `user-type=self`, the one that asks."""
    sessions = context.sessions
    if request.query.get("user-type") == "self":
        sessions = {request.session: sessions[request.session]}
    items = (Item("user", name or _USER) for name in sessions.values())
    return Answer(tuple(items), links=("rmmp",))


def register(context: RequestContext, request: Request) -> Answer:
    """Register a client under a name."""
    context.sessions[request.session] = request.form.get("username", "")
    return Answer(status=201)


def remote_rights(context: RequestContext, request: Request) -> Answer:
    """Request a right in manual mode, which rapidsim always grants."""
    context.rights[request.session] = request.form.get("privilege", "modify")
    return Answer(status=202)


def rights(context: RequestContext, request: Request) -> Answer:
    """The session that has a right in manual mode: the one that asks, or else the first."""
    holders = tuple(context.rights)
    session = request.session if request.session in holders or not holders else holders[0]
    fields = {
        "userid": str(session),
        "alias": context.sessions.get(session, ""),
        "location": "",
        "application": "",
        "privilege": context.rights.get(session, "none"),
        "rmmpheldbyme": str(session == request.session).lower(),
    }
    return Answer((Item("user-rmmp", "state", fields),), links=("poll",))


def rights_granted(context: RequestContext, request: Request) -> Answer:
    """Whether the requested right in manual mode was granted."""
    status = "GRANTED" if request.session in context.rights else "NO SUCH REQUEST"
    return Answer((Item("user-rmmp-poll", "poll", {"status": status}),))


def release_rights(context: RequestContext, request: Request) -> Answer:
    """Release the right in manual mode."""
    context.rights.pop(request.session, None)
    return DONE


_SECOND_NAMES: Final = {"edit": ("cfg", "rapid"), "motion": ("motion",)}
"""Domains of RobotWare 6 by their names in RobotWare 7."""


def _domains(domain: str | None, request: Request) -> tuple[str, ...]:
    """Return the domains of a name; all if it is None."""
    if domain is None:
        return MASTERSHIPS
    name = domain.lower()
    if request.generation == 2 and name in _SECOND_NAMES:
        return _SECOND_NAMES[name]
    if name not in MASTERSHIPS:
        raise refused(NOT_FOUND, f"there is no mastership of {domain}")
    return (name,)


def _domain_item(context: RequestContext, request: Request, domain: str) -> Item:
    held = "nomaster" if _master(context, request, domain) is None else "remote"
    return Item("msh-resource-li", domain, {"mastership": held}, href=f"rw/mastership/{domain}")


def _master(context: RequestContext, request: Request, domain: str) -> int | None:
    """Return the session that holds the mastership of a domain; None if none does."""
    holders = (context.masters.get(one) for one in _domains(domain, request))
    return next((one for one in holders if one is not None), None)


def _options(context: RequestContext, kind: str) -> tuple[Item, ...]:
    options = context.live.cell.parameters.instances("SYS", "PRESENT_OPTIONS") or ()
    return tuple(
        Item(kind, str(number), {"option": one.get("desc") or one.get("name", "")})
        for number, one in enumerate(options)
    )


def for_administrators(context: RequestContext, request: Request) -> Answer:
    """Refuse access to the settings of authentication, as to the default user of a controller.

    Raises:
        RefusedRequest: Always.
    """
    del context, request
    raise refused(NOT_ALLOWED, "the user is not allowed access")
