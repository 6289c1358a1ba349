"""The event log: by domain, the newest entry first."""

from __future__ import annotations

from rapidsim.server.messages import DONE, Answer, Item, Request
from rapidsim.server.resources.codes import NOT_FOUND, refused
from rapidsim.server.resources.context import RequestContext
from rapidsim.simulation.live.event_log import DOMAINS, MOST_ENTRIES, LogEntry


def domains(context: RequestContext, request: Request) -> Answer:
    """All domains, with the number of entries of each."""
    log, items = context.live.log, []
    for one in DOMAINS:
        fields = {"numevts": str(len(list(log.entries(one))))}
        if request.generation == 2:
            title, fields["buffsize"] = str(one), str(MOST_ENTRIES)
        else:
            title, fields["elog-domain-name"] = f"/rw/elog/{one}", str(one)
        items.append(Item("elog-domain-li", title, fields, href=f"rw/elog/{one}"))
    return Answer(resources=tuple(items))


def entries(context: RequestContext, request: Request, domain: str) -> Answer:
    """The entries of a domain."""
    entries = context.live.log.entries(_domain(domain))
    return Answer(resources=tuple(_item(context, request, domain, one) for one in entries))


def entry(context: RequestContext, request: Request, domain: str, number: str) -> Answer:
    """One entry.

    Raises:
        RefusedRequest: If no entry has this number.
    """
    for one in context.live.log.entries(_domain(domain)):
        if str(one.number) == number:
            return Answer((_item(context, request, domain, one),))
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


def _item(context: RequestContext, request: Request, domain: str, record: LogEntry) -> Item:
    """An entry as clients see it."""
    address = f"/rw/elog/{domain}/{record.number}"
    # Two spaces, as RobotWare 6 writes it; a public client parses exactly this.
    space = "  " if request.generation == 1 else " "
    source = {"src-name": "MC0"} if request.generation == 1 else {}
    fields = {
        "msgtype": str(record.type),
        "code": str(record.code),
        **source,
        "tstamp": context.live.date_at(record.time_s).strftime(f"%Y-%m-%d T{space}%H:%M:%S"),
        "title": record.title,
        "desc": record.text,
        "conseqs": "",
        "causes": "",
        "actions": "",
        "argc": str(len(record.arguments)),
    }
    language = request.query.get("lang")
    href = address[1:] if language is None else f"{address[1:]}?lang={language}"
    return Item("elog-message-li", address, fields, record.arguments, href=href)


def _domain(text: str) -> int:
    if text not in map(str, DOMAINS):
        raise refused(NOT_FOUND, f"the event log has no domain {text}")
    return int(text)
