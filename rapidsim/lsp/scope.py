"""Names, types and callees at a place of a document that may be half typed."""

from __future__ import annotations

from functools import cached_property

from rapidsim.analysis.cell_names import ConfiguredSymbol
from rapidsim.analysis.context import Context, SymbolTable
from rapidsim.analysis.installed import installed_symbol
from rapidsim.analysis.names.names import is_procedure
from rapidsim.analysis.occurrences.locate import Location, locate
from rapidsim.analysis.occurrences.scopes import symbols_in_scope
from rapidsim.analysis.parameters import Callee, Formal
from rapidsim.analysis.program import (
    CounterSymbol,
    DataSymbol,
    LibrarySymbol,
    ParameterSymbol,
    RoutineSymbol,
    Symbol,
)
from rapidsim.analysis.types.callees import callee_of
from rapidsim.language import types
from rapidsim.language.types import ArrayOf, Record, Type, resolved
from rapidsim.lsp.call_context import CallContext, StatementContext, call_context
from rapidsim.lsp.view import Document
from rapidsim.syntax import tree


class PlaceScope:
    """The names visible at an offset."""

    def __init__(self, document: Document, offset: int) -> None:
        """Find the place in the tree; a repair may have moved it."""
        self.facts = document.view.workspace.facts(document.path)
        place = document.file.source.address(offset)
        self.location = locate(document.file, place) or _nearest(document.file, place)

    @cached_property
    def symbols(self) -> dict[str, Symbol]:
        """Symbols of the program and the cell, by folded name, innermost first."""
        if self.location is None:
            return {}
        return {one.name.lower(): one for one in symbols_in_scope(self.location, self.facts)}

    def find(self, key: str) -> Symbol | None:
        """Return the symbol of a folded name, also a predefined one."""
        return self.symbols.get(key) or installed_symbol(key)

    def is_procedure(self, key: str) -> bool:
        """Whether a folded name can be called as a statement."""
        symbol = self.find(key)
        return symbol is not None and is_procedure(symbol)

    def call(self, statement: StatementContext) -> CallContext | None:
        """Return the call in which a statement continues."""
        return call_context(statement.tokens, self.is_procedure)

    def callee(self, call: CallContext) -> tuple[Symbol, Callee] | None:
        """Return the routine of a call with its parameters; None if it is not known."""
        symbol = self.find(call.name.text.lower())
        if isinstance(symbol, ConfiguredSymbol):
            symbol = installed_symbol(call.name.text.lower())
        if not isinstance(symbol, RoutineSymbol | LibrarySymbol):
            return None
        callee = callee_of(symbol, self._context())
        return None if callee is None else (symbol, callee)

    def type_of_path(self, path: list[str]) -> Type | None:
        """Return the type of data and components: `["p10", "trans"]`; elements count as written.

        Args:
            path: Folded names; `{}` behind a name means an element.
        """
        of: Type | None = None
        for index, name in enumerate(path):
            if name == "{}":
                target = None if of is None else resolved(of)
                of = target.element if isinstance(target, ArrayOf) else None
            elif index == 0:
                of = self._type_of(self.find(name))
            else:
                of = _component_type(of, name)
            if of is None:
                return None
        return of

    def _type_of(self, symbol: Symbol | None) -> Type | None:
        match symbol:
            case DataSymbol(type=of) | ParameterSymbol(type=of) | ConfiguredSymbol(type=of):
                return of
            case CounterSymbol():
                return types.NUM
            case _:
                return None

    def _context(self) -> Context:
        analysis = self.facts.analysis
        if self.location is not None and self.location.module in analysis.home_of:
            return analysis.home_of[self.location.module]
        nowhere = tree.Module(0, 0, self.facts.files[0].source, tree.Name(0, 0, ""), (), ())
        return Context(analysis, nowhere, SymbolTable({}))


def formal_at(call: CallContext, callee: Callee) -> tuple[int, Formal] | None:
    """Return the parameter that a call is at, with its index; None past the last."""
    if call.option is not None:
        key = call.option.lower()
        for index, formal in enumerate(callee.parameters):
            if formal.optional and formal.key == key:
                return index, formal
        return None
    required = [(k, one) for k, one in enumerate(callee.parameters) if not one.optional]
    return required[call.required] if call.required < len(required) else None


def _component_type(of: Type | None, name: str) -> Type | None:
    target = None if of is None else resolved(of)
    if not isinstance(target, Record):
        return None
    return next((one.type for one in target.components if one.name.lower() == name), None)


def _nearest(file: tree.File, place: int) -> Location | None:
    """Return the last module that begins before a place, or the first."""
    before = [module for module in file.modules if module.start <= place]
    module = before[-1] if before else next(iter(file.modules), None)
    return None if module is None else Location(module, (module,))
