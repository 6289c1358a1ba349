"""The values of a program's data before it runs."""

from __future__ import annotations

from collections.abc import Callable
from typing import NoReturn

from rapidsim.analysis.program import DataSymbol, Program
from rapidsim.files import InputError
from rapidsim.interpreter.linking.loader import FatalError, load
from rapidsim.language.controller import uniform_controller
from rapidsim.language.errors import Stopped


def start_values(program: Program) -> Callable[[DataSymbol], object]:
    """Initialise the data of a program and run nothing.

    Returns:
        The value of module data by its symbol.

    Raises:
        InputError: If an initial value cannot be computed without a robot that stands somewhere.
    """
    try:
        task = load(program, uniform_controller(_NotRunning()))
    except FatalError as fatal:
        raise InputError(f"an initial value cannot be computed: {fatal.error.message}") from fatal
    except Stopped as stopped:
        raise InputError(f"an initial value cannot be computed: {stopped.reason}") from stopped

    def value_of(symbol: DataSymbol) -> object:
        module = symbol.module.name.text if symbol.module else None
        return task.value(symbol.name, module)

    return value_of


class _NotRunning:
    """A controller on which nothing runs: whatever an initial value asks of it ends the attempt."""

    def __init__(self) -> None:
        self.ticks_left = 0
        self.place: object = None
        self.errno = 0.0
        self.intno = 0.0

    def __getattr__(self, name: str) -> NoReturn:
        raise Stopped(f"it asks a running controller (`{name}`)")
