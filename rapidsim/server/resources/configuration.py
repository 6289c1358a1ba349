"""System parameters: domains, their types, the instances of each; names in any case."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Final

from rapidsim.server.messages import DONE, Answer, Item, Request
from rapidsim.server.resources.codes import BAD_PARAMETER, NOT_FOUND, refused
from rapidsim.server.resources.context import RequestContext

_VALUE: Final = re.compile(r"\[(.*),\s*\d+\]", re.DOTALL)
"""Format in which clients write the value of an attribute: `[value,1]`."""


def domains(context: RequestContext, request: Request) -> Answer:
    """All domains."""
    del request
    names = context.live.cell.parameters.domains
    items = (Item("cfg-domain-li", one, href=f"rw/cfg/{one}") for one in names)
    return Answer(resources=tuple(items))


def types(context: RequestContext, request: Request, domain: str) -> Answer:
    """The types of a domain."""
    del request
    names = context.live.cell.parameters.types(domain)
    if not names:
        raise refused(NOT_FOUND, f"the configuration has no domain {domain}")
    name = domain.upper()
    items = (Item("cfg-dt-li", one, href=f"rw/cfg/{name}/{one}") for one in names)
    return Answer(resources=tuple(items))


def type_(context: RequestContext, request: Request, domain: str, of: str) -> Answer:
    """A type, with a link to its instances."""
    del request
    _instances(context, domain, of)
    return Answer((Item("cfg-dt", of.upper()),), links=("instances",))


def instances(context: RequestContext, request: Request, domain: str, of: str) -> Answer:
    """The instances of a type with their attributes."""
    found = _instances(context, domain, of)
    items = (_item(request, domain, of, n, one, "-li") for n, one in enumerate(found))
    return Answer(resources=tuple(items))


def instance(context: RequestContext, request: Request, domain: str, of: str, name: str) -> Answer:
    """One instance, in RobotWare 7 as an element of their list."""
    number, found = _instance(context, domain, of, name)
    if request.generation == 2:
        return Answer(resources=(_item(request, domain, of, number, found, "-li"),))
    return Answer((_item(request, domain, of, number, found, ""),))


def change(context: RequestContext, request: Request, domain: str, of: str, name: str) -> Answer:
    """Change attributes of an instance; a restart would put them into effect.

    Raises:
        RefusedRequest: If an attribute is missing or a value is not valid; then nothing changes.
    """
    context.require_mastership("cfg", request)
    number, found = _instance(context, domain, of, name)
    changed = {}
    for attribute, text in request.form.items():
        if attribute not in found:
            raise refused(BAD_PARAMETER, f"{name} has no attribute {attribute}")
        matched = _VALUE.fullmatch(text.strip())
        if matched is None:
            raise refused(BAD_PARAMETER, f"`{text}` is no `[value,1]`")
        changed[attribute] = matched[1]
    for attribute, value in changed.items():
        context.live.cell.parameters.change(domain, of, number, attribute, value)
    return DONE


def _instances(context: RequestContext, domain: str, of: str) -> Sequence[Mapping[str, str]]:
    found = context.live.cell.parameters.instances(domain, of)
    if found is None:
        raise refused(NOT_FOUND, f"the configuration has no type {domain}/{of}")
    return found


def _instance(
    context: RequestContext, domain: str, of: str, name: str
) -> tuple[int, Mapping[str, str]]:
    for number, one in enumerate(_instances(context, domain, of)):
        if _name(number, one).lower() == name.lower():
            return number, one
    raise refused(NOT_FOUND, f"{domain}/{of} has no instance {name}")


def _name(number: int, record: Mapping[str, str]) -> str:
    """Return the name by which an instance is addressed; its index if it has none."""
    return record.get("name") or str(number)


def _item(
    request: Request, domain: str, of: str, number: int, record: Mapping[str, str], suffix: str
) -> Item:
    name = _name(number, record)
    kind, fields = "cfg-ia-t-li", dict[str, str]()
    if request.generation == 2:
        kind, fields = "cfg-ia-t", {"rdonly": "false"}
    attributes = (Item(kind, key, {"value": value}) for key, value in record.items())
    return Item(
        f"cfg-dt-instance{suffix}",
        name,
        fields,
        parts=tuple(attributes),
        href=f"rw/cfg/{domain.upper()}/{of.upper()}/instances/{name}",
    )
