"""The event log by domain: in RobotWare 6 the newest entry first, later the oldest, by pages."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

from rapidsim.server.messages import DONE, Answer, Item, Request
from rapidsim.server.resources.codes import NO_PAGE, NOT_FOUND, refused
from rapidsim.server.resources.context import RequestContext, count
from rapidsim.simulation.live.event_log import COMMON, DOMAINS, MOST_ENTRIES, LogEntry

_PAGE: Final = 50
"""Most entries of a page."""


def domains(context: RequestContext, request: Request) -> Answer:
    """All domains; with the number of entries of each in RobotWare 7, or by `resource=count`."""
    log, items = context.live.log, []
    is_first = request.generation == 1
    for one in DOMAINS:
        fields = {}
        if not is_first or request.query.get("resource") == "count":
            fields["numevts"] = str(len(list(log.entries(one))))
        if not is_first:
            fields["buffsize"] = str(MOST_ENTRIES)
        title = f"/rw/elog/{one}" if is_first else str(one)
        items.append(Item("elog-domain-li", title, fields, href=f"rw/elog/{one}"))
    return Answer(resources=tuple(items))


def entries(context: RequestContext, request: Request, domain: str) -> Answer:
    """The entries of a domain, ordered as `order` says: fifo or lifo.

    RobotWare 7 has pages: `start` is the number of one, from 1.

    Raises:
        RefusedRequest: If there is no such domain or page.
    """
    query = request.query
    is_first = request.generation == 1
    order = query.get("order", "lifo" if is_first else "fifo")
    found = [*context.live.log.entries(_domain(domain))]
    if order == "fifo":
        found.reverse()
    if is_first:
        return Answer(resources=tuple(_item(context, request, domain, one) for one in found))
    most = max(1, min(_PAGE, count(query, "limit", _PAGE)))
    page = count(query, "start", 1)
    shown = found[most * (page - 1) : most * page] if page else []
    if not shown and page != 1:
        raise refused(NO_PAGE, "wrong uri due to invalid page num")
    following = ""
    if most * page < len(found):
        language = f"lang={query['lang']}&" if "lang" in query else ""
        rest = f"{language}start={page + 1}&limit={most}"
        following = f"rw/elog/{domain}?order={order}&{rest}"
    items = (_item(context, request, domain, one) for one in shown)
    return Answer(resources=tuple(items), following=following)


def entry(
    context: RequestContext, request: Request, number: str, domain: str = str(COMMON)
) -> Answer:
    """One entry.

    Raises:
        RefusedRequest: If no entry has this number.
    """
    for one in context.live.log.entries(_domain(domain)):
        if str(one.number) == number:
            item = replace(_item(context, request, domain, one), kind="elog-message")
            return Answer((item,))
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
