"""Data of a task as texts, as clients read and write them."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.program import DataSymbol, Scope, Storage
from rapidsim.interpreter.runtime.memory import module_data
from rapidsim.language.errors import RapidError
from rapidsim.language.initial_values import initial_value
from rapidsim.language.symbols import DataName
from rapidsim.language.types import ArrayOf, Type
from rapidsim.library.predefined import DATA, TYPES
from rapidsim.library.text import parsed_value, value_text
from rapidsim.simulation.live.live_task import LiveTask
from rapidsim.simulation.live.states import RefusalReason, RequestRefused
from rapidsim.values import value_class


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


def find(task: LiveTask, name: str, module: str | None = None) -> TaskDatum:
    """Return data by name, in any case.

    Raises:
        RequestRefused: If no data have this name.
    """
    if task.task is None:
        raise RequestRefused(
            RefusalReason.NO_SYMBOL, f"the data of {task.name} could not be initialised"
        )
    symbol = task.task.data(name, module)
    if symbol is not None:
        return _datum(symbol)
    predefined = DATA.get(name.lower())
    if predefined is None or module is not None:
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
    assert task.task is not None
    symbol = datum.symbol
    return task.task.value(datum.name) if symbol is None else task.task.value_of(symbol)


def write(task: LiveTask, datum: TaskDatum, text: str) -> None:
    """Set the value from a text; call `LiveController.wake_programs` to notify programs.

    Raises:
        RequestRefused: If the text is not a value of the type, or the data are constant.
    """
    assert task.task is not None
    if datum.storage is Storage.CONST or datum.symbol is None or datum.module is None:
        raise RequestRefused(RefusalReason.READ_ONLY, f"{datum.name} cannot be written")
    value = parsed_value(text, datum.type, task.task.value_of(datum.symbol))
    if value is None:
        raise RequestRefused(RefusalReason.VALUE, f"`{text}` is no {datum.type.name}")
    where = DataName(datum.name, datum.module)
    try:
        task.run.controller.concerns.symbols.write(datum.name, datum.type, where, value)
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
