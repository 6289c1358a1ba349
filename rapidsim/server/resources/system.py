"""The controller itself: what it is, its clock, sessions' rights."""

from __future__ import annotations

from typing import Final

from rapidsim import __version__
from rapidsim.server.messages import DONE, Answer, Item, Request
from rapidsim.server.resources.codes import HELD_BY_ANOTHER, NOT_FOUND, refused
from rapidsim.server.resources.context import MASTERSHIPS, Context
from rapidsim.server.resources.disks import DISKS

ROBOTWARE: Final = "6.16.2027"
ROBOTWARE_NAME: Final = "6.16.02.00"


def controller(context: Context, request: Request) -> Answer:
    """Which controller this is."""
    del context, request
    fields = {"ctrl-type": "Virtual Controller", "ctrl-name": "rapidsim"}
    return Answer((Item("ctrl-identity-info", "identity", fields),), links=("identity", "clock"))


def clock(context: Context, request: Request) -> Answer:
    """Date and time of day, virtual."""
    del request
    stamp = context.live.date.strftime("%Y-%m-%d T %H:%M:%S")
    return Answer((Item("ctrl-clock-info", "clock", {"datetime": stamp}),))


def disk(context: Context, request: Request, name: str) -> Answer:
    """What stands for a disk in addresses of files.

    Raises:
        RefusedRequest: If there is no such disk.
    """
    del context, request
    if name.upper() not in DISKS:
        raise refused(NOT_FOUND, f"there is no ${name}")
    return Answer((Item("ctrl-env", f"${name}", {"_value": f"${name}"}),))


def system(context: Context, request: Request) -> Answer:
    """Name, version and options."""
    started = context.live.cell.starts_at.strftime("%Y-%m-%d T %H:%M:%S")
    del request
    fields = {
        "name": f"rapidsim {__version__}",
        "rwversion": ROBOTWARE,
        "rwversionname": ROBOTWARE_NAME,
        "sysid": "{00000000-0000-0000-0000-000000000000}",
        "starttm": started,
    }
    return Answer((Item("sys-system-li", "system", fields),))


def mastership(context: Context, request: Request) -> Answer:
    """Who has the mastership of which domain."""
    del request
    return Answer(tuple(_domain_item(context, one) for one in MASTERSHIPS))


def mastership_of(context: Context, request: Request, domain: str) -> Answer:
    """Who has the mastership of a domain."""
    del request
    return Answer((_domain_item(context, _known(domain)),))


def take_mastership(context: Context, request: Request, domain: str | None = None) -> Answer:
    """Take the mastership of a domain, or of all.

    Raises:
        RefusedRequest: If another session holds it.
    """
    wanted = MASTERSHIPS if domain is None else (_known(domain),)
    for one in wanted:
        if context.masters.get(one, request.session) != request.session:
            raise refused(HELD_BY_ANOTHER, f"another session has the mastership of {one}")
    context.masters |= dict.fromkeys(wanted, request.session)
    return DONE


def give_mastership(context: Context, request: Request, domain: str | None = None) -> Answer:
    """Give the mastership of a domain, or of all, back."""
    for one in MASTERSHIPS if domain is None else (_known(domain),):
        if context.masters.get(one) == request.session:
            del context.masters[one]
    return DONE


def register(context: Context, request: Request) -> Answer:
    """Note who a client is."""
    del context, request
    return Answer(status=201)


def remote_rights(context: Context, request: Request) -> Answer:
    """Ask for the right to modify in manual mode, which nobody at a pendant refuses here."""
    del context, request
    return Answer(status=202)


def rights_granted(context: Context, request: Request) -> Answer:
    """Whether that right was granted."""
    del context, request
    return Answer((Item("user-rmmp-poll", "poll", {"status": "GRANTED"}),))


def rights_given_back(context: Context, request: Request) -> Answer:
    """Give that right back."""
    del context, request
    return DONE


def _known(domain: str) -> str:
    if domain.lower() not in MASTERSHIPS:
        raise refused(NOT_FOUND, f"there is no mastership of {domain}")
    return domain.lower()


def _domain_item(context: Context, domain: str) -> Item:
    held = "mastership held" if domain in context.masters else "nomaster"
    return Item("msh-resource-li", domain, {"mastership": held})
