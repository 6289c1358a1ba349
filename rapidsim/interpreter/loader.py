"""A checked program made ready to run for one controller, and run.

Enters a `Program` and the `Controller` of its task; leaves a `Task`. Each routine is a Python code
object under the name of its RAPID file: tracebacks, debuggers, profilers and coverage tools speak
of RAPID lines.
"""

from __future__ import annotations

import linecache
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from types import CodeType, FunctionType
from typing import Any

from rapidsim.analysis.program import DataSymbol, Program, RoutineSymbol, Scope, Storage
from rapidsim.diagnostics import Source
from rapidsim.interpreter.constants import Constants
from rapidsim.interpreter.late_binding import LateBinding, UserRoutine
from rapidsim.interpreter.limits import RUNNING_DEPTH, recursion_limit
from rapidsim.interpreter.memory import ChangedPersistent, Memory, module_data
from rapidsim.interpreter.names import Fixed
from rapidsim.interpreter.recovery import GENERATED, Recovery, Unrecoverable, as_rapid_error
from rapidsim.interpreter.references import ABSENT
from rapidsim.interpreter.runtime import FUNCTIONS, task_functions
from rapidsim.interpreter.shared import SharedPersistents
from rapidsim.interpreter.stack import FatalError, Frame, Origin, rapid_stack
from rapidsim.interpreter.symbols import TaskSymbols
from rapidsim.interpreter.translation import INITIALISE, TranslatedModule, translate
from rapidsim.interpreter.values import Value, copied
from rapidsim.language.controller import Controller
from rapidsim.language.errors import RapidError
from rapidsim.library.predefined import DATA
from rapidsim.syntax.collection import uncollected

__all__ = ["FatalError", "Frame", "Task", "load"]

ERR_STACK_OVERFLOW = 40222.0
"""Not catchable, so the number is the controller's event, which no program compares with."""


@dataclass(frozen=True, slots=True)
class Task:
    """A program with its memory. Variables keep their values from one run to the next."""

    program: Program
    controller: Controller
    _functions: Mapping[RoutineSymbol, FunctionType]
    _memory: Memory
    _constants: Constants

    def run(self, entry: str = "main") -> None:
        """Execute a procedure without parameters.

        Args:
            entry: Its name, in any case.

        Raises:
            LookupError: If there is no such procedure.
            FatalError: If an error reaches no ERROR clause.
            Stopped: If the program, or a limit of the run, ends it; this passes through.
        """
        symbol = self.program.routines.get(entry.lower())
        if symbol is None or any(not parameter.optional for parameter in symbol.parameters):
            raise LookupError(f"there is no procedure {entry} without parameters")
        with _fatal_errors(), recursion_limit(RUNNING_DEPTH):
            self._functions[symbol](*_absent(symbol))

    def value(self, name: str, module: str | None = None) -> Value:
        """The value that declared or predefined data have now.

        Args:
            name: As in the program, in any case.
            module: Whose data; None looks at global data first, then at any module's.

        Returns:
            A float, bool, str, record tuple, or a list, which is a copy.

        Raises:
            LookupError: If there are no such data.
        """
        symbol = self._data(name.lower(), module.lower() if module else None)
        if symbol is None:
            predefined = DATA.get(name.lower())
            if predefined is None or module is not None:
                raise LookupError(f"there are no data named {name}")
            return self._memory.predefined(name.lower(), predefined.value)
        if symbol.storage is Storage.CONST:
            return copied(self._constants.value_of(symbol))
        return self._memory.value(symbol)

    def persistents(self) -> tuple[ChangedPersistent, ...]:
        """The PERS data whose value has changed since the program was loaded."""
        return self._memory.changed()

    def _data(self, key: str, module: str | None) -> DataSymbol | None:
        found: DataSymbol | None = None
        for symbol in module_data(self.program):
            if symbol.name.lower() != key or symbol.module is None:
                continue
            if module is not None:
                if symbol.module.name.key == module:
                    return symbol
            elif symbol.scope is not Scope.LOCAL:
                return symbol
            else:
                found = found or symbol
        return found


def load(program: Program, controller: Controller, shared: SharedPersistents | None = None) -> Task:
    """Compile a program and set up its memory.

    Args:
        program: Without errors, as analysis makes it.
        controller: Of the task that will run it.
        shared: The persistents it has in common with other tasks.

    Raises:
        NotExecutableError: If it needs something that cannot be simulated; nothing has run then.
        FatalError: If an initial value fails, as a division by zero does.
    """
    with _fatal_errors(), uncollected():
        translation = translate(program)
        codes = [_compiled(module) for module in translation.modules]
    memory = Memory(program) if shared is None else Memory(program, shared.home)
    recovery = Recovery(controller)
    functions: dict[RoutineSymbol, FunctionType] = {}
    by_module: dict[str, dict[str, UserRoutine]] = {}
    by_name: dict[str, UserRoutine] = {}
    late = LateBinding(controller, by_name, by_module)

    def call_procedure(name: str) -> None:
        module = program.modules[0].name.key
        # It runs like a trap, so its errors do not reach the statement that it interrupts.
        recovery.trap(lambda: late.call(module, controller.place, name, (), ()))()

    controller.call_procedure = call_procedure

    def value_of(symbol: DataSymbol) -> Value:
        if symbol.storage is Storage.CONST and symbol.node is not None:
            return copied(translation.constants.value_of(symbol))
        return memory.value(symbol)

    controller.symbols = TaskSymbols(program, memory, value_of)
    namespaces = [
        {
            **FUNCTIONS,
            **task_functions(controller, recovery, late, module.module.name.key),
            GENERATED: Origin(module.module, module.functions, value_of),
        }
        for module in translation.modules
    ]
    for module, code, namespace in zip(translation.modules, codes, namespaces, strict=True):
        show_lines_of(module.module.source)
        exec(code, namespace)
        functions.update({s: _function(namespace, name) for name, s in module.functions.items()})
        for name, numbers in module.long_jumps:
            recovery.long_jumps[_function(namespace, name).__code__] = _function(namespace, numbers)
    for symbol, function in functions.items():
        routines = by_module.setdefault(symbol.module.name.key, {})
        routines[symbol.name.lower()] = UserRoutine(symbol, function)
    for key, symbol in program.routines.items():
        by_name[key] = UserRoutine(symbol, functions[symbol])
    for module, namespace in zip(translation.modules, namespaces, strict=True):
        by_module.setdefault(module.module.name.key, {})
        _bind(module, namespace, memory, functions)
    with _fatal_errors():
        for namespace in namespaces:
            if INITIALISE in namespace:
                _function(namespace, INITIALISE)()
    memory.remember()
    return Task(program, controller, functions, memory, translation.constants)


def _bind(
    module: TranslatedModule,
    namespace: dict[str, Any],
    memory: Memory,
    functions: Mapping[RoutineSymbol, FunctionType],
) -> None:
    """Give the names of a module's namespace their objects."""
    for name, binding in module.bindings.items():
        match binding:
            case DataSymbol():
                namespace[name] = memory.home(binding)
            case RoutineSymbol():
                namespace[name] = functions[binding]
            case Fixed(value=value):
                namespace[name] = value


def _compiled(module: TranslatedModule) -> CodeType:
    return compile(module.code, module.module.source.file, "exec")


def _function(namespace: Mapping[str, Any], name: str) -> FunctionType:
    function = namespace[name]
    assert isinstance(function, FunctionType)
    return function


def _absent(symbol: RoutineSymbol) -> list[object]:
    return [False if parameter.is_switch else ABSENT for parameter in symbol.parameters]


def show_lines_of(source: Source) -> None:
    """Let Python's tools print RAPID lines: they would look for a UTF-8 file of that name."""
    lines = [source.line(number) + "\n" for number in range(1, len(source.line_starts) + 1)]
    linecache.cache[source.file] = (len(source.text), None, lines, source.file)


@contextmanager
def _fatal_errors() -> Iterator[None]:
    """Turn what no ERROR clause dealt with into a `FatalError`."""
    try:
        yield
    except Unrecoverable as last:
        raise FatalError(last.error, rapid_stack(last)) from last
    except (RapidError, ZeroDivisionError) as error:
        raise FatalError(as_rapid_error(error), rapid_stack(error)) from error
    except RecursionError as error:
        stack = rapid_stack(error)
        raise FatalError(_stack_overflow(stack), stack) from None


def _stack_overflow(stack: tuple[Frame, ...]) -> RapidError:
    innermost = f" in {stack[-1].routine}" if stack else ""
    # In round figures: how deep Python comes depends a little on its version.
    depth = round(len(stack), -2)
    return RapidError(
        ERR_STACK_OVERFLOW,
        f"the stack overflowed{innermost}: routines call each other about {depth} deep",
        cf="ABB 40222",
    )
