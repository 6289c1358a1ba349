"""Resolution of names at their uses, with findings for undeclared names and wrong kinds."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from itertools import chain

from rapidsim.analysis.cell_names import ConfiguredSymbol
from rapidsim.analysis.context import Context, SymbolTable
from rapidsim.analysis.installed import (
    installed_data_names,
    installed_routine_names,
    installed_symbol,
)
from rapidsim.analysis.names.name_violations import (
    LOOKS_FOR_IT,
    SKIPS,
    STOPS_THERE,
    UndefinedName,
    UnknownRoutine,
    UnresolvedReference,
    UnseenName,
    WrongKind,
)
from rapidsim.analysis.program import (
    CounterSymbol,
    DataSymbol,
    LibrarySymbol,
    ParameterSymbol,
    RoutineSymbol,
    Storage,
    Symbol,
    TypeSymbol,
    UnknownSymbol,
)
from rapidsim.analysis.suggestions import reserved_words
from rapidsim.analysis.syntax_violations import UnfinishedCode
from rapidsim.language import types
from rapidsim.language.annotations import ParameterMode
from rapidsim.language.types import Type
from rapidsim.library.other_languages import rapid_word_for
from rapidsim.library.predefined import SET_BY_CONTROLLER
from rapidsim.library.system_signals import system_signal
from rapidsim.library.versions import SINCE
from rapidsim.syntax import tree

DataLike = DataSymbol | ParameterSymbol | CounterSymbol | ConfiguredSymbol


# Programmers put the kind of a signal into its name: diStart, DO10_1, gi_part.
_SIGNAL_NAME = re.compile(
    r"(di|do|ai|ao|gi|go)(?=[A-Z0-9_])|(DI|DO|AI|AO|GI|GO)(?=[0-9_])|(?i:[dag][io])(?=_)"
)
_SIGNAL_INSIDE = re.compile(r"(?<=[a-z])(DI|DO|AI|AO|GI|GO)(?=_?\d+$)")
"""Names such as `EntDI_1`: the kind follows a word of another language."""
_SIGNAL_OF_KIND = {signal.name[-2:]: signal for signal in types.SIGNALS}


def find(key: str, context: Context) -> Symbol | None:
    """Return the symbol of a folded name: of the program, else the cell, else the controller."""
    declared = context.scope.find(key) or context.analysis.cell.find(key)
    return declared or installed_symbol(key)


def data_named(reference: tree.DataReference, context: Context) -> DataLike | None:
    """Return the data that a reference refers to; None if it refers to no data.

    An undeclared name may still be a signal: this is decided when the whole task is known, see
    `undeclared`.
    """
    symbol = find(reference.name.key, context)
    if symbol is None or _may_be_older(symbol, context):
        context.analysis.unit.undeclared.append((reference, context))
        return None
    return as_data(symbol, reference, context)


def is_undeclared(name: tree.Name, context: Context) -> bool:
    """Whether nothing has a name, or only an instruction that the assumed RobotWare lacks."""
    symbol = find(name.key, context)
    return symbol is None or _may_be_older(symbol, context)


def _may_be_older(symbol: Symbol, context: Context) -> bool:
    """Whether an instruction is newer than the assumed RobotWare, as with a signal `Continue`."""
    if not (isinstance(symbol, LibrarySymbol) and is_procedure(symbol)):
        return False
    has, since = context.analysis.cell.robotware, SINCE.get(symbol.name.lower())
    return since is not None and (has is None or has < since)


def type_of_undeclared(reference: tree.DataReference, context: Context) -> Type | None:
    """Kind of signal that an undeclared name evidently refers to."""
    if find(reference.name.key, context) is not None:
        return None
    return evident_signal(reference.name, context)


def as_data(symbol: Symbol, reference: tree.DataReference, context: Context) -> DataLike | None:
    """Return the symbol if it is data; otherwise report a finding."""
    if isinstance(symbol, DataLike):
        context.analysis.symbol_of[reference] = symbol
        return symbol
    name, cure = reference.name.text, ""
    if is_function(symbol):
        cure = f"call it with its arguments in parentheses, as in `{name}(...)`"
    wrong = WrongKind(name, kind_of(symbol), "data", cure)
    context.report(wrong, reference, *context.declaration(symbol))
    return None


def routine_named(name: tree.Name, context: Context, *, function: bool) -> Symbol | None:
    """Return the routine that a call names: `RoutineSymbol`, `LibrarySymbol` or `UnknownSymbol`.

    Returns:
        None, after a finding, if the name is not a routine that can be called like this.
    """
    symbol = find(name.key, context)
    if isinstance(symbol, ConfiguredSymbol):
        # A signal may have the name of an instruction; in a call, the name refers to the
        # instruction.
        symbol = installed_symbol(name.key) or symbol
    if symbol is None:
        return _unknown_routine(name, context, function=function)
    if function and is_function(symbol):
        return symbol
    if not function and is_procedure(symbol):
        return symbol
    wanted = "a function" if function else "a procedure"
    wrong = WrongKind(name.text, kind_of(symbol), wanted, _suggestion(symbol, name.text, function))
    context.report(wrong, name, *context.declaration(symbol))
    return None


def report_undefined(
    name: tree.Name,
    context: Context,
    *,
    may_be_signal: bool = False,
    kind: str = "data",
    assumed: str | None = None,
) -> None:
    """Report an undeclared name, unless its declaration may be in unread text."""
    analysis = context.analysis
    if analysis.may_be_unread(name.key):
        return
    nearest = _nearest_data(name, context)
    if analysis.cell.unseen:
        context.report(UnseenName(name.text, analysis.cell.unseen, nearest), name)
        analysis.runs = False
        return
    if analysis.cell.refers_late:
        context.report(UnresolvedReference(name.text), name)
        analysis.runs = False
        return
    reserved = nearest in reserved_words()
    loads = analysis.loads_modules
    violation = UndefinedName(name.text, nearest, reserved, loads, may_be_signal, kind, assumed)
    context.report(violation, name, fix=context.respelling(name, nearest))


def take_for_signal(reference: tree.DataReference, of: Type, context: Context) -> None:
    """Treat an undeclared name as a signal of that name."""
    analysis = context.analysis
    analysis.unit.signals.setdefault(reference.name.key, of)
    analysis.unit.undeclared.append((reference, context))
    analysis.symbol_of[reference] = analysis.unknown_symbol(reference.name.text)
    analysis.type_of[reference] = of


def take_for_unknown(reference: tree.DataReference, context: Context) -> None:
    """Treat an undeclared name as unknown in the arguments of a call that is skipped anyway."""
    context.analysis.symbol_of[reference] = context.analysis.unknown_symbol(reference.name.text)


def evident_signal(name: tree.Name, context: Context) -> Type | None:
    """Kind of signal of an undeclared name, from its use in the cell or its spelling."""
    if name.key in context.analysis.cell.wired:
        return types.SIGNAL_DI
    if (of := system_signal(name.text)) is not None:
        return of
    match = _SIGNAL_NAME.match(name.text) or _SIGNAL_INSIDE.search(name.text)
    return None if match is None else _SIGNAL_OF_KIND[match.group().lower()]


def kind_of(symbol: Symbol) -> str:
    """Describe the kind of a symbol."""
    match symbol:
        case DataSymbol(storage=Storage.CONST):
            return "a constant"
        case DataSymbol(storage=Storage.PERS):
            return "a persistent"
        case DataSymbol(module=None, name=name) if name in SET_BY_CONTROLLER:
            return "a variable that only the controller sets"
        case DataSymbol():
            return "a variable"
        case ParameterSymbol(mode=ParameterMode.PERS):
            return "a persistent parameter"
        case ParameterSymbol():
            return "a parameter"
        case CounterSymbol():
            return "the counter of a FOR loop"
        case RoutineSymbol(node=tree.Func()):
            return "a function"
        case RoutineSymbol(node=tree.Trap()):
            return "a trap"
        case RoutineSymbol():
            return "a procedure"
        case LibrarySymbol(routine=routine):
            return "an instruction" if routine.signature.result is None else "a function"
        case TypeSymbol():
            return "a type"
        case ConfiguredSymbol(type=of):
            return f"a {of.name} of the cell"
        case UnknownSymbol():
            return "not declared"


def is_function(symbol: Symbol) -> bool:
    """Whether a symbol can be called in expressions."""
    match symbol:
        case RoutineSymbol(node=node):
            return isinstance(node, tree.Func)
        case LibrarySymbol(routine=routine):
            return routine.signature.result is not None
        case _:
            return False


def is_procedure(symbol: Symbol) -> bool:
    """Whether a symbol can be called as a statement."""
    match symbol:
        case RoutineSymbol(node=node):
            return isinstance(node, tree.Proc)
        case LibrarySymbol(routine=routine):
            return routine.signature.result is None
        case _:
            return False


def _unknown_routine(name: tree.Name, context: Context, *, function: bool) -> UnknownSymbol | None:
    """Report an undeclared routine; return its symbol if the program can run with it."""
    analysis = context.analysis
    cell = analysis.cell
    # The parser inserts a name without text where one is missing, and reports that.
    if not name.text or analysis.may_be_unread(name.key):
        return None
    if name.text.startswith("<"):
        context.report(UnfinishedCode(name.text), name)
        return analysis.unknown_symbol(name.text)
    foreign = rapid_word_for(name.key)
    nearest = None if foreign else _nearest_routine(name, context, function=function)
    kind = "function" if function else "procedure"
    if cell.unseen:
        context.report(UnseenName(name.text, cell.unseen, nearest, kind), name)
        return analysis.unknown_symbol(name.text)
    instead = ""
    if analysis.loads_modules and (cell.assumes or cell.refers_late):
        instead = LOOKS_FOR_IT
    elif cell.refers_late:
        instead = STOPS_THERE
    elif cell.assumes:
        instead = SKIPS
    reserved = nearest in reserved_words()
    violation = UnknownRoutine(
        name.text, nearest, instead, reserved, function, foreign, analysis.loads_modules
    )
    context.report(violation, name, fix=context.respelling(name, nearest))
    return analysis.unknown_symbol(name.text)


def _suggestion(symbol: Symbol, name: str, function: bool) -> str:
    match symbol:
        case _ if function and is_procedure(symbol):
            return f"call `{name}` in a separate statement; it has no value"
        case _ if is_function(symbol):
            return f"assign its value to data, as in `x:={name}(...)`"
        case RoutineSymbol(node=tree.Trap()):
            return f"connect it to an interrupt, as in `CONNECT i WITH {name}`"
        case DataSymbol() | ParameterSymbol() if not function:
            return f"give it a value with `{name}:=...`"
        case ConfiguredSymbol():
            return ""
        case DataSymbol() | ParameterSymbol():
            return f"array elements are written with braces, as in `{name}{{1}}`"
        case _:
            return ""


def _nearest_data(name: tree.Name, context: Context) -> str | None:
    """Known name of data or routines nearest to an unknown one; ties go to local data."""
    analysis, module = context.analysis, context.module
    home = analysis.home_of[module].scope
    of_module = analysis.find_nearest(name, module, _known_names(home, context))
    if context.routine is None:
        return of_module
    local = (symbol.name for symbol in context.scope.symbols(home))
    known = (*local, *([of_module] if of_module else ()))
    return analysis.find_nearest(name, context.routine, known)


def _known_names(home: SymbolTable, context: Context) -> Iterator[str]:
    """Names of data and routines visible in a module, of the program and of the controller."""
    for symbol in home.symbols():
        if not isinstance(symbol, TypeSymbol):
            yield symbol.name
    for configured in context.analysis.cell.symbols.values():
        yield configured.name
    yield from installed_data_names()
    yield from reserved_words()


def _nearest_routine(name: tree.Name, context: Context, *, function: bool) -> str | None:
    """Known function, or else procedure, nearest to an unknown name."""
    home = context.analysis.home_of[context.module].scope
    is_meant = is_function if function else is_procedure
    own = (symbol.name for symbol in home.symbols() if is_meant(symbol))
    installed = (
        routine for routine in installed_routine_names() if _is_installed(routine, is_meant)
    )
    known = chain(own, installed, reserved_words())
    return context.analysis.find_nearest(name, (context.module, function), known)


def _is_installed(name: str, is_meant: Callable[[Symbol], bool]) -> bool:
    symbol = installed_symbol(name.lower())
    return symbol is not None and is_meant(symbol)
