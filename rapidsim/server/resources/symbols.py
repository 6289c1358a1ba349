"""Data of programs by address: `RAPID/task/module/name`; task and module are optional."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from rapidsim.analysis.program import Storage
from rapidsim.language.name_pattern import NamePattern, PatternError
from rapidsim.server.messages import DONE, Answer, Item, Request
from rapidsim.server.resources.codes import BAD_PARAMETER, LATER_NO_SYMBOL, NO_SYMBOL, refused
from rapidsim.server.resources.context import RequestContext, required_value
from rapidsim.simulation.live import symbols
from rapidsim.simulation.live.live_task import LiveTask
from rapidsim.simulation.live.states import RequestRefused
from rapidsim.simulation.live.symbols import TaskDatum

_STORAGES: Final = {Storage.VAR: "var", Storage.PERS: "per", Storage.CONST: "con"}
_KINDS: Final = {
    Storage.VAR: "rap-sympropvar",
    Storage.PERS: "rap-symproppers",
    Storage.CONST: "rap-sympropconstant",
}


def value(context: RequestContext, request: Request, symbol: str) -> Answer:
    """The value of data, in RAPID's notation."""
    del request
    return Answer((value_item(context, symbol),))


def value_item(context: RequestContext, symbol: str) -> Item:
    """Return the value of data as an item."""
    address = symbol.removesuffix(";value")
    task, datum = _find(context, address)
    title = f"RAPID/{address}"
    return Item("rap-data", title, {"value": symbols.read(task, datum)})


def set_value(context: RequestContext, request: Request, symbol: str) -> Answer:
    """Change the value of data."""
    task, datum = _find(context, symbol.removesuffix(";value"))
    context.require_mastership("rapid", request)
    symbols.write(task, datum, required_value(request.form, "value"))
    context.live.wake_programs()
    return DONE


def properties(context: RequestContext, request: Request, symbol: str) -> Answer:
    """The properties of data: storage class and type; in RobotWare 7 they stand in a list."""
    task, datum = _find(context, symbol)
    items = (_properties_item(task, datum, ""),)
    return Answer(items) if request.generation == 1 else Answer(resources=items)


def search(context: RequestContext, request: Request) -> Answer:
    """The data declared in modules that match by kind, type and name."""
    form = request.form
    _, _, address = form.get("blockurl", "RAPID").partition("/")
    task_name, _, module = address.partition("/")
    live = context.live
    tasks = [live.task(task_name)] if task_name else list(live.tasks.values())
    storage, type_ = form.get("symtyp", "any").lower(), form.get("dattyp", "").lower()
    try:
        pattern = NamePattern(form.get("regexp") or ".*")
        return Answer(
            resources=tuple(
                _properties_item(task, datum, "-li")
                for task in tasks
                for datum in symbols.all_data(task)
                if storage in ("any", "", _STORAGES[datum.storage])
                and type_ in ("", datum.type_name.lower())
                and module.lower() in ("", (datum.module or "").lower())
                and pattern.matches(datum.name)
            )
        )
    except PatternError as error:
        raise refused(BAD_PARAMETER, f"`regexp` is no regular expression: {error}") from None


def validate(context: RequestContext, request: Request) -> Answer:
    """Check that a text is a value of a type.

    Raises:
        RefusedRequest: If it is not, or there is no such type.
    """
    context.live.task(required_value(request.form, "task"))
    name, text = required_value(request.form, "datatype"), required_value(request.form, "value")
    if not symbols.is_value(text, name):
        raise refused(BAD_PARAMETER, f"`{text}` is no {name}")
    return DONE


def _find(context: RequestContext, address: str) -> tuple[LiveTask, TaskDatum]:
    """Return data and their task; if the address names no task, the first that has the data.

    Raises:
        RefusedRequest: If there are no such data.
    """
    *outer, name = [part for part in address.split("/") if part]
    for task, module in _places(context, outer):
        try:
            return task, symbols.find(task, name, module)
        except RequestRefused:
            continue
    raise refused(NO_SYMBOL, f"there are no data RAPID/{address}", LATER_NO_SYMBOL)


def _places(context: RequestContext, outer: list[str]) -> Iterator[tuple[LiveTask, str | None]]:
    """Yield the tasks and modules to search for an address with task, module, both or neither."""
    tasks = context.live.tasks
    match outer:
        case []:
            yield from ((task, None) for task in tasks.values())
        case [one] if one.lower() in tasks:
            yield tasks[one.lower()], None
        case [module]:
            yield from ((task, module) for task in tasks.values())
        case [task, module] if task.lower() in tasks:
            yield tasks[task.lower()], module
        case _:
            return


def _properties_item(task: LiveTask, datum: TaskDatum, suffix: str) -> Item:
    parts = ("RAPID", task.name, datum.module, datum.name)
    address = "/".join(part for part in parts if part)
    shape = datum.dimensions
    fields = {
        "symburl": address,
        "name": datum.name,
        "symtyp": _STORAGES[datum.storage],
        "named": "true",
        "dattyp": datum.type_name,
        "ndim": str(len(shape)),
        "dim": " ".join(map(str, shape)),
        "local": str(datum.is_local).lower(),
        "rdonly": str(datum.storage is Storage.CONST).lower(),
        "taskvar": str(datum.is_task_only).lower(),
        "typurl": f"RAPID/{datum.type_name}",
    }
    return Item(_KINDS[datum.storage] + suffix, address, fields)
