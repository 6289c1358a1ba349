"""Data of a task as texts, as clients read and write them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Final

from rapidsim.analysis.literals import Value
from rapidsim.analysis.program import DataSymbol, Scope, Storage
from rapidsim.interpreter.runtime.memory import module_data
from rapidsim.interpreter.tools.assignments import with_part
from rapidsim.interpreter.tools.inspection import NotShownError, follow_steps, name_and_steps
from rapidsim.language.errors import RapidError
from rapidsim.language.initial_values import initial_value
from rapidsim.language.symbols import DataName
from rapidsim.language.types import ArrayOf, Type
from rapidsim.library.predefined import DATA, TYPES
from rapidsim.library.text import parsed_value, value_text
from rapidsim.simulation.live.live_task import LiveTask
from rapidsim.simulation.live.states import RefusalReason, RequestRefused
from rapidsim.values import value_class

_OF_MODULES: Final = frozenset(("base", name) for name in ("tool0", "wobj0", "load0"))
"""Predefined data that controllers have in a module."""


@value_class(frozen=True, slots=True)
class TaskDatum:
    """Data that exist in a task."""

    name: str
    type: Type
    storage: Storage
    is_local: bool = False
    is_task_only: bool = False
    module: str | None = None
    """None for predefined data."""
    symbol: DataSymbol | None = None
    steps: str = ""
    """Indices and components of a part of the data: `{2}.trans`; `type` is that of the part."""

    @property
    def dimensions(self) -> tuple[int, ...]:
        """Sizes of an array; empty for other data."""
        return (
            tuple(size or 0 for size in self.type.dimensions)
            if isinstance(self.type, ArrayOf)
            else ()
        )

    @property
    def type_name(self) -> str:
        """Name of the type of the data, or of the elements of an array."""
        return (self.type.element if isinstance(self.type, ArrayOf) else self.type).name


def find(task: LiveTask, path: str, module: str | None = None) -> TaskDatum:
    """Return data, or a part of them such as `a{2}.trans`, by name in any case.

    Raises:
        RequestRefused: If no data have this name, or they have no such part.
    """
    name, steps = name_and_steps(path) or (path, "")
    whole = _find_whole(task, name, module)
    if not steps:
        return whole
    try:
        _, _, of = follow_steps(steps, value_of(task, whole), whole.type, _index)
    except NotShownError as error:
        raise RequestRefused(RefusalReason.NO_SYMBOL, str(error)) from None
    return replace(whole, name=f"{whole.name}{steps.strip()}", type=of, steps=steps)


def _index(text: str) -> int:
    if not (text.isascii() and text.isdecimal() and len(text) < 10):
        raise NotShownError(f"`{text}` is not an index")
    return int(text)


def _find_whole(task: LiveTask, name: str, module: str | None) -> TaskDatum:
    if task.task is None:
        raise RequestRefused(
            RefusalReason.NO_SYMBOL, f"the data of {task.name} could not be initialised"
        )
    symbol = task.task.data(name, module)
    if symbol is not None:
        return _datum(symbol)
    predefined = DATA.get(name.lower())
    is_elsewhere = module is not None and (module.lower(), name.lower()) not in _OF_MODULES
    if predefined is None or is_elsewhere:
        raise RequestRefused(RefusalReason.NO_SYMBOL, f"{task.name} has no data named {name}")
    storage = Storage.CONST if predefined.constant else Storage.VAR
    storage = Storage.PERS if predefined.persistent else storage
    return TaskDatum(predefined.name, predefined.type, storage)


def all_data(task: LiveTask) -> Iterator[TaskDatum]:
    """All data that the modules of a task declare, in the order of declaration."""
    if task.task is not None:
        yield from (_datum(symbol) for symbol in module_data(task.task.program))


def read(task: LiveTask, datum: TaskDatum) -> str:
    """Return the current value, in RAPID's notation.

    Raises:
        RequestRefused: If data of the type have no value.
    """
    try:
        return value_text(value_of(task, datum), datum.type)
    except TypeError as error:
        raise RequestRefused(RefusalReason.VALUE, str(error)) from None


def value_of(task: LiveTask, datum: TaskDatum) -> object:
    """Return a copy of the current value."""
    return _part(task, datum)[1]


def _part(task: LiveTask, datum: TaskDatum) -> tuple[tuple[int, ...], Value]:
    """Return the positions of a part in the data, none for all of them, and its value."""
    assert task.task is not None
    symbol = datum.symbol
    name, _ = name_and_steps(datum.name) or (datum.name, "")
    value: Value = task.task.value(name) if symbol is None else task.task.value_of(symbol)
    if not datum.steps:
        return (), value
    of = DATA[name.lower()].type if symbol is None else symbol.type
    parts, part, _ = follow_steps(datum.steps, value, of, _index)
    return parts, part


def write(task: LiveTask, datum: TaskDatum, text: str) -> None:
    """Set the value from a text; call `LiveController.wake_programs` to notify programs.

    Raises:
        RequestRefused: If the text is not a value of the type, or the data are constant.
    """
    assert task.task is not None
    if datum.storage is Storage.CONST or datum.symbol is None or datum.module is None:
        raise RequestRefused(RefusalReason.READ_ONLY, f"{datum.name} cannot be written")
    parts, old = _part(task, datum)
    value = parsed_value(text, datum.type, old)
    if value is None:
        raise RequestRefused(RefusalReason.VALUE, f"`{text}` is no {datum.type.name}")
    symbol = datum.symbol
    whole = with_part(task.task.value_of(symbol), parts, value)
    where = DataName(symbol.name, datum.module)
    try:
        task.run.controller.concerns.symbols.write(symbol.name, symbol.type, where, whole)
    except RapidError as error:
        raise RequestRefused(RefusalReason.VALUE, error.message) from None


def _datum(symbol: DataSymbol) -> TaskDatum:
    assert symbol.module is not None
    return TaskDatum(
        symbol.name,
        symbol.type,
        symbol.storage,
        symbol.scope is Scope.LOCAL,
        symbol.scope is Scope.TASK,
        symbol.module.name.text,
        symbol,
    )


def is_value(text: str, type_name: str) -> bool:
    """Whether a text is a value of a predefined type; False for an unknown type."""
    of = next((one for name, one in TYPES.items() if name.lower() == type_name.lower()), None)
    return of is not None and parsed_value(text, of, initial_value(of)) is not None
