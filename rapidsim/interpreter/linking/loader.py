"""Loads a checked program for one controller, and runs it.

Input is a `Program` and the `Controller` of its task; output is a `Task`. Each routine is a Python
code object under the name of its RAPID file, so tracebacks, debuggers, profilers and coverage tools
refer to RAPID lines.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from rapidsim.analysis.literals import Value
from rapidsim.analysis.program import DataSymbol, Program, RoutineSymbol, Scope
from rapidsim.interpreter.limits import RUNNING_DEPTH, recursion_limit
from rapidsim.interpreter.linking.linker import LinkedProgram
from rapidsim.interpreter.linking.saved_text import saved_text
from rapidsim.interpreter.linking.symbols import TaskSymbols
from rapidsim.interpreter.linking.task_modules import TaskModules
from rapidsim.interpreter.runtime.arrays import assign_array
from rapidsim.interpreter.runtime.call_stack import CallFrame, FatalError, rapid_stack
from rapidsim.interpreter.runtime.error_recovery import Unrecoverable, as_rapid_error
from rapidsim.interpreter.runtime.idle_state import idle_state
from rapidsim.interpreter.runtime.memory import ChangedPersistent, module_data
from rapidsim.interpreter.runtime.references import ABSENT
from rapidsim.interpreter.runtime.shared_persistents import SharedPersistents
from rapidsim.language.controller import Controller
from rapidsim.language.errors import RapidError
from rapidsim.library.predefined import DATA
from rapidsim.syntax import tree
from rapidsim.values import value_class

__all__ = ["CallFrame", "FatalError", "Task", "load", "running"]

ERR_STACK_OVERFLOW = 40222.0
"""Number of the controller's event; ERROR clauses cannot catch it, so no program tests for it."""


@value_class(frozen=True, slots=True)
class Task:
    """A program with its memory. Variables keep their values between runs."""

    _linked: LinkedProgram

    @property
    def program(self) -> Program:
        """The program with its current modules."""
        return self._linked.program

    def text_of(self, module: tree.Module) -> str:
        """Text of a module with the current values of its persistents."""
        return saved_text(module, self._linked)

    def run(self, entry: str = "main") -> None:
        """Execute a procedure without parameters.

        Args:
            entry: Its name, in any case.

        Raises:
            LookupError: If there is no such procedure.
            FatalError: If an error reaches no ERROR clause.
            Stopped: If the program or a limit of the run ends it; not caught here.
        """
        symbol = self.program.routines.get(entry.lower())
        if symbol is None or any(not parameter.optional for parameter in symbol.parameters):
            raise LookupError(f"there is no procedure {entry} without parameters")
        with running():
            self._linked.function(symbol)(*_absent(symbol))

    @property
    def has_ended_within(self) -> bool:
        """Whether it has ended with an error in routines with UNDO clauses."""
        return bool(self._linked.recovery.ended)

    def undo_ended(self) -> None:
        """Run these clauses, the innermost first.

        Raises:
            FatalError: If an error occurs in one.
            Stopped: If EXIT or a limit of the run ends them.
        """
        with running():
            self._linked.recovery.undo_ended()

    def take(self, program: Program) -> None:
        """Continue with a changed set of modules; remaining modules keep their values.

        Raises:
            FatalError: If a constant or an initial value of a new module fails.
            NotExecutableError: If a new module needs something that cannot be simulated.
        """
        with _fatal_errors():
            self._linked.link(program)

    def call(self, function: RoutineSymbol) -> Value:
        """Return the value of a function without parameters.

        Raises:
            FatalError: If an error reaches no ERROR clause.
        """
        with running():
            value: Value = self._linked.function(function)()
            return value

    def value(self, name: str, module: str | None = None) -> Value:
        """Return the current value of declared or predefined data.

        Args:
            name: As in the program, in any case.
            module: The module that declares them; None tries global data first, then any module's.

        Returns:
            A float, bool, str, record tuple, or a list, which is a copy.

        Raises:
            LookupError: If there are no such data.
        """
        symbol = self.data(name, module)
        if symbol is not None:
            return self.value_of(symbol)
        predefined = DATA.get(name.lower())
        if predefined is None or module is not None:
            raise LookupError(f"there are no data named {name}")
        return self._linked.memory.predefined(name.lower(), predefined.value)

    def value_of(self, symbol: DataSymbol) -> Value:
        """Return a copy of the current value of declared data."""
        return self._linked.value_of(symbol)

    def keep(self, before: Task) -> None:
        """Copy the persistents of an earlier run of the same program."""
        for symbol in before._linked.memory.persistents():
            kept, home = before.value_of(symbol), self._linked.memory.home(symbol)
            if isinstance(home, list):
                assign_array(home, kept)
            else:
                home.value = kept

    def persistents(self) -> tuple[ChangedPersistent, ...]:
        """Return the PERS data of the initial modules whose values have changed since loading."""
        return self._linked.memory.changed()

    def data(self, name: str, module: str | None = None) -> DataSymbol | None:
        """Return declared data by name, found as by `value`; None without a match."""
        key, module = name.lower(), module.lower() if module else None
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
        program: An error-free program from analysis.
        controller: The controller of the task that will run it.
        shared: The persistents it shares with other tasks.

    Raises:
        NotExecutableError: If it needs something that cannot be simulated; nothing has run then.
        FatalError: If an initial value fails, as a division by zero does.
    """
    with _fatal_errors():
        linked = LinkedProgram(program, controller, shared)
    linked.memory.remember()

    def call_procedure(name: str) -> None:
        # It runs like a trap, so its errors do not reach the interrupted statement.
        late, main_module = linked.late, linked.program.modules[0].name.key
        linked.recovery.trap(lambda: late.call(main_module, controller.clock.place, name, (), ()))()

    def beside() -> object:
        return controller.error_numbers.errno, controller.motion.settings

    controller.clock.program_state = lambda: idle_state(linked.memory.homes, beside)
    controller.interrupts.call_procedure = call_procedure
    controller.modules = TaskModules(linked)
    controller.symbols = TaskSymbols(linked)
    return Task(linked)


@contextmanager
def running() -> Iterator[None]:
    """The context in which routines of a program, including traps, may run.

    Raises:
        FatalError: If an error reaches no ERROR clause.
    """
    with _fatal_errors(), recursion_limit(RUNNING_DEPTH):
        yield


def _absent(symbol: RoutineSymbol) -> list[object]:
    return [False if parameter.is_switch else ABSENT for parameter in symbol.parameters]


@contextmanager
def _fatal_errors() -> Iterator[None]:
    """Convert an error that no ERROR clause handled to a `FatalError`."""
    try:
        yield
    except Unrecoverable as last:
        raise FatalError(last.error, rapid_stack(last)) from last
    except (RapidError, ZeroDivisionError) as error:
        raise FatalError(as_rapid_error(error), rapid_stack(error)) from error
    except RecursionError as error:
        stack = rapid_stack(error)
        raise FatalError(_stack_overflow(stack), stack) from None


def _stack_overflow(stack: tuple[CallFrame, ...]) -> RapidError:
    innermost = f" in {stack[-1].routine}" if stack else ""
    # Rounded, because the depth that Python reaches depends slightly on its version.
    depth = round(len(stack), -2)
    return RapidError(
        ERR_STACK_OVERFLOW,
        f"the stack overflowed{innermost}: routines call each other about {depth} deep",
        cf="ABB 40222",
    )
