"""The modules of one task linked into Python functions, and their memory.

`link` takes a program and prepares the new modules in it; the remaining ones keep their functions
and variables. A task starts in this way, and loads and unloads modules while it runs: the program
is an immutable value, checked as a whole each time, and only this object changes.
"""

from __future__ import annotations

import linecache
import sys
from collections.abc import Mapping, Sequence, Set
from types import CodeType, FrameType, FunctionType
from typing import Any, cast, overload
from weakref import finalize, ref

from rapidsim.analysis.literals import Value
from rapidsim.analysis.program import DataSymbol, Program, RoutineSymbol, Storage
from rapidsim.analysis.tree_walk import data_of, descendants
from rapidsim.diagnostics import Source
from rapidsim.interpreter.codegen.intervals import Interval
from rapidsim.interpreter.codegen.names import TaskIndependent
from rapidsim.interpreter.linking.constants import Constants
from rapidsim.interpreter.linking.namespace import FUNCTIONS, task_functions
from rapidsim.interpreter.linking.translation import (
    INITIALISE,
    TranslatedModule,
    Translation,
    translate,
)
from rapidsim.interpreter.runtime.arrays import copied
from rapidsim.interpreter.runtime.call_stack import Origin
from rapidsim.interpreter.runtime.error_recovery import GENERATED, Recovery, is_generated
from rapidsim.interpreter.runtime.error_trace import ErrorTrace
from rapidsim.interpreter.runtime.late_binding import LateBinding, UserRoutine
from rapidsim.interpreter.runtime.local_arrays import LocalArrays
from rapidsim.interpreter.runtime.memory import Memory
from rapidsim.interpreter.runtime.shared_persistents import SharedPersistents
from rapidsim.language.controller import Controller
from rapidsim.syntax import tree
from rapidsim.syntax.garbage_collection import gc_paused


class LinkedProgram:
    """A program that can be called, and changed while it runs."""

    def __init__(
        self,
        program: Program,
        controller: Controller,
        shared: SharedPersistents | None = None,
    ) -> None:
        """Link the first program; `shared` has the data that other tasks share.

        Raises:
            NotExecutableError: If it needs something that cannot be simulated.
            RapidError: If a constant or an initial value fails.
        """
        self.controller = controller
        self.program = program
        self.memory = Memory(program) if shared is None else Memory(program, shared.home)
        self._shared = shared
        self.recovery = Recovery(controller.error_numbers, ErrorTrace(controller.errors))
        self.late = LateBinding(controller)
        self._local_arrays = LocalArrays()
        self._constants = Constants(program)
        self._integers: Mapping[tree.Node, Interval] = {}
        self._persistents: Set[tree.Node] = frozenset()
        self._functions: dict[tree.Routine, FunctionType] = {}
        self._namespaces: dict[tree.Module, dict[str, Any]] = {}
        self.link(program)

    # Until the translation is dropped, so that the collector never traverses it.
    @gc_paused(of_known_program=True)
    def link(self, program: Program) -> None:
        """Replace the program: prepare new modules, and drop removed ones.

        An exception leaves everything unchanged.

        Raises:
            NotExecutableError: If a new module needs something that cannot be simulated.
            RapidError: If a constant or an initial value of a new module fails.
        """
        added = [module for module in program.modules if module not in self._namespaces]
        gone = [module for module in self._namespaces if module not in program.modules]
        translation = translate(program, added, shares=self._shared is not None)
        if self._namespaces and not self._is_compatible(translation, added):
            translation = translate(program, shares=self._shared is not None)
        codes = [_compiled(module) for module in translation.modules]
        before = self.program, self._constants
        self.program, self._constants = program, translation.constants
        self._integers, self._persistents = translation.integers, translation.persistents
        try:
            for module, code in zip(translation.modules, codes, strict=True):
                self._define(module, code)
            for module in translation.modules:
                self._bind(module)
            for one in added:
                namespace = self._namespaces[one]
                if INITIALISE in namespace:
                    _function(namespace, INITIALISE)()
        except BaseException:
            self.program, self._constants = before
            for one in added:
                self._drop(one)
            raise
        for one in gone:
            self._drop(one)
        self._name_routines()

    def _is_compatible(self, translation: Translation, added: Sequence[tree.Module]) -> bool:
        """Whether new modules keep the assumptions valid under which the others were compiled.

        Queries after the end of a program may call its functions with any number. For programs that
        load modules at run time, no assumptions are made about calls.
        """
        own = {node for module in added for node in descendants(*module.routines)}
        known = translation.integers
        kept = {node: integer for node, integer in known.items() if node not in own}
        lent = translation.persistents - own
        known_before = self._integers, self._persistents
        return self.program.loads_modules or (kept, lent) == known_before

    def function(self, symbol: RoutineSymbol) -> FunctionType:
        """The function of a routine."""
        return self._functions[symbol.node]

    def value_of(self, symbol: DataSymbol) -> Value:
        """A copy of the current value of declared data, constants included."""
        if symbol.storage is Storage.CONST and symbol.node is not None:
            return copied(self._constants.value_of(symbol))
        return self.memory.value(symbol)

    def executing(self) -> frozenset[tree.Module]:
        """The modules with a routine on the call stack."""
        found = set()
        frame: FrameType | None = sys._getframe()
        while frame is not None:
            if is_generated(frame):
                origin: Origin = frame.f_globals[GENERATED]
                found.add(origin.module)
            frame = frame.f_back
        return frozenset(found)

    def _define(self, module: TranslatedModule, code: CodeType) -> None:
        """Create the functions of a new module."""
        namespace = self._namespaces[module.module] = {
            **FUNCTIONS,
            **task_functions(self.controller, self.recovery, self.late, module.module.name.key),
            "_local_array": self._local_arrays.copy,
            GENERATED: Origin(module.module, module.functions, self.value_of, lambda: self.program),
        }
        show_lines_of(module.module.source)
        exec(code, namespace)
        for name, symbol in module.functions.items():
            self._functions[symbol.node] = _function(namespace, name)
        for name, shown in module.shown_as.items():
            function = _function(namespace, name)
            own = shown.rpartition(".")[2]
            function.__code__ = function.__code__.replace(co_name=own, co_qualname=shown)
        for name, numbers in module.long_jumps:
            jumper = _function(namespace, name)
            self.recovery.long_jumps[jumper.__code__] = _function(namespace, numbers)

    def _bind(self, module: TranslatedModule) -> None:
        """Bind the names of a module's namespace to their objects."""
        namespace = self._namespaces[module.module]
        for name, binding in module.bindings.items():
            match binding:
                case DataSymbol():
                    namespace[name] = self.memory.home(binding)
                case RoutineSymbol():
                    namespace[name] = self.function(binding)
                case TaskIndependent(value=value):
                    namespace[name] = value

    def _drop(self, module: tree.Module) -> None:
        """Remove a module; calls that are still running in it keep their data."""
        self._namespaces.pop(module, None)
        self.memory.forget(module)
        if self._shared is not None:
            for data in data_of(module):
                self._shared.release(data)
        for routine in module.routines:
            function = self._functions.pop(routine, None)
            if function is not None:
                self.recovery.long_jumps.pop(function.__code__, None)

    def _name_routines(self) -> None:
        """Update the routines that late binding can call by name."""
        symbols = self.program.symbol_of
        by_module: dict[str, dict[str, UserRoutine]] = {}
        for module in self.program.modules:
            of_module = by_module.setdefault(module.name.key, {})
            for routine in module.routines:
                symbol = symbols[routine]
                assert isinstance(symbol, RoutineSymbol)
                of_module[symbol.name.lower()] = UserRoutine(symbol, self.function(symbol))
        self.late.module_routines = by_module
        self.late.global_routines = {
            key: UserRoutine(symbol, self.function(symbol))
            for key, symbol in self.program.routines.items()
        }


def show_lines_of(source: Source) -> None:
    """Make Python's tools print RAPID lines; otherwise they would expect a UTF-8 file.

    They do so as long as the source is in use.
    """
    shown = _shown_lines(source.file)
    if shown is not None and shown.source() is source:
        return
    # Python declares a list here, but only reads it.
    lines = cast("list[str]", _Lines(ref(source)))
    linecache.cache[source.file] = (len(source.text), None, lines, source.file)
    finalize(source, _hide_lines, source.file)


def _shown_lines(file: str) -> _Lines | None:
    shown = linecache.cache.get(file)
    lines: object = None if shown is None or len(shown) != 4 else shown[2]
    return lines if isinstance(lines, _Lines) else None


def _hide_lines(file: str) -> None:
    shown = _shown_lines(file)
    if shown is not None and shown.source() is None:
        del linecache.cache[file]


class _Lines(Sequence[str]):
    """The lines of a source, each created on demand, because there may be a million."""

    def __init__(self, source: ref[Source]) -> None:
        self.source = source

    @overload
    def __getitem__(self, index: int) -> str: ...
    @overload
    def __getitem__(self, index: slice) -> list[str]: ...
    def __getitem__(self, index: int | slice) -> str | list[str]:
        numbers = range(1, len(self) + 1)[index]
        if isinstance(numbers, int):
            return self._line(numbers)
        return [self._line(number) for number in numbers]

    def _line(self, number: int) -> str:
        source = self.source()
        return "" if source is None else source.line(number) + "\n"

    def __len__(self) -> int:
        source = self.source()
        return 0 if source is None else len(source.line_starts)


def _compiled(module: TranslatedModule) -> CodeType:
    return compile(module.code, module.module.source.file, "exec")


def _function(namespace: Mapping[str, Any], name: str) -> FunctionType:
    function = namespace[name]
    assert isinstance(function, FunctionType)
    return function
