"""Initial values of a program's data."""

from __future__ import annotations

from collections.abc import Callable
from typing import NoReturn

from rapidsim.analysis.program import DataSymbol, Program
from rapidsim.files import InputError
from rapidsim.interpreter.linking.loader import FatalError, load
from rapidsim.language.controller import uniform_controller
from rapidsim.language.errors import Stopped


def start_values(program: Program) -> Callable[[DataSymbol], object]:
    """Initialise the data of a program without running it.

    Returns:
        A function from the symbol of module data to its value.

    Raises:
        InputError: If an initial value cannot be computed without a running controller.
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
    """Controller on which nothing runs: any access by an initial value ends the attempt."""

    def __init__(self) -> None:
        self.ticks_left = 0
        self.place: object = None
        self.errno = 0.0
        self.intno = 0.0

    def __getattr__(self, name: str) -> NoReturn:
        raise Stopped(f"it needs a running controller (`{name}`)")
