"""The event log: by domain, the newest entry first."""

from __future__ import annotations

from rapidsim.server.messages import DONE, Answer, Item, Request
from rapidsim.server.resources.codes import NOT_FOUND, refused
from rapidsim.server.resources.context import RequestContext
from rapidsim.simulation.live.event_log import DOMAINS, LogEntry


def domains(context: RequestContext, request: Request) -> Answer:
    """All domains, with the number of entries of each."""
    del request
    log = context.live.log
    items = (
        Item(
            "elog-domain-li",
            f"/rw/elog/{one}",
            {"elog-domain-name": str(one), "numevts": str(len(list(log.entries(one))))},
            href=f"rw/elog/{one}",
        )
        for one in DOMAINS
    )
    return Answer(tuple(items))


def entries(context: RequestContext, request: Request, domain: str) -> Answer:
    """The entries of a domain."""
    del request
    found = context.live.log.entries(_domain(domain))
    return Answer(tuple(entry_item(context, domain, one) for one in found))


def entry(context: RequestContext, request: Request, domain: str, number: str) -> Answer:
    """One entry.

    Raises:
        RefusedRequest: If no entry has this number.
    """
    del request
    for one in context.live.log.entries(_domain(domain)):
        if str(one.number) == number:
            return Answer((entry_item(context, domain, one),))
    raise refused(NOT_FOUND, f"domain {domain} has no entry {number}")


def clear(context: RequestContext, request: Request, domain: str) -> Answer:
    """Delete the entries of a domain."""
    del request
    context.live.log.clear(_domain(domain))
    return DONE


def clear_all(context: RequestContext, request: Request) -> Answer:
    """Delete all entries."""
    del request
    context.live.log.clear()
    return DONE


def entry_item(context: RequestContext, domain: str, record: LogEntry) -> Item:
    """An entry as clients see it."""
    address = f"/rw/elog/{domain}/{record.number}"
    # Two spaces, as controllers write it; a public client parses exactly this.
    stamp = context.live.date_at(record.time_s).strftime("%Y-%m-%d T  %H:%M:%S")
    fields = {
        "msgtype": str(record.type),
        "code": str(record.code),
        "src-name": "rapidsim",
        "tstamp": stamp,
        "title": record.title,
        "desc": record.text,
        "conseqs": "",
        "causes": "",
        "actions": "",
        "argc": str(len(record.arguments)),
    }
    return Item("elog-message-li", address, fields, record.arguments, href=address[1:])


def _domain(text: str) -> int:
    if text not in map(str, DOMAINS):
        raise refused(NOT_FOUND, f"the event log has no domain {text}")
    return int(text)
