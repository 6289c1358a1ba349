"""Renaming of a symbol at all its occurrences, refused where the program would mean another thing.

The rule is strict: a name that is used or declared anywhere in view is refused, also where only a
warning would follow. So a renamed program has the findings that it had, but for the name.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from rapidsim.analysis.cell_names import ConfiguredSymbol
from rapidsim.analysis.installed import installed_symbol, installed_type
from rapidsim.analysis.names.names import kind_of
from rapidsim.analysis.occurrences.names import NamesOfNodes, Occurrence, declared_name
from rapidsim.analysis.occurrences.search import names_spelled
from rapidsim.analysis.occurrences.symbols import (
    ComponentSymbol,
    InstalledParameterSymbol,
    InstalledTypeSymbol,
    LabelSymbol,
    ModuleSymbol,
    NamedSymbol,
)
from rapidsim.analysis.program import (
    CounterSymbol,
    DataSymbol,
    LibrarySymbol,
    ParameterSymbol,
    RoutineSymbol,
    Scope,
    TypeSymbol,
    UnknownSymbol,
)
from rapidsim.analysis.program_parts import ENTRY, Facts
from rapidsim.analysis.suggestions import reserved_words
from rapidsim.diagnostics import Span
from rapidsim.syntax import tree
from rapidsim.values import value_class

LONGEST_NAME = 32
"""Maximum number of characters of a name in RAPID."""
_NAME = re.compile(r"[^\W\d_]\w*")
_STRING = re.compile(r'"(?P<text>(?:[^"\r\n]|"")*)"|![^\r\n]*')
_SHORTEST_PREFIX = 2
"""Characters of a string from which it may be the beginning of a composed name."""


class RenameRefusedError(Exception):
    """A name cannot be changed; the text is a sentence for the user."""


@value_class(frozen=True, slots=True)
class Renaming:
    """The places of a name, and what is written there."""

    spans: tuple[Span, ...]
    name: str


def require_renameable(symbol: NamedSymbol | None) -> None:
    """Raise if a symbol has no declaration in the program that could be changed.

    Raises:
        RenameRefusedError: If it has none, or a name that the controller expects.
    """
    match symbol:
        case None:
            raise RenameRefusedError("this name is not declared, so its uses are not known")
        case LibrarySymbol() | InstalledTypeSymbol() | InstalledParameterSymbol():
            raise RenameRefusedError(f"`{symbol.name}` is predefined by the controller")
        case DataSymbol(module=None) | ComponentSymbol(record=InstalledTypeSymbol()):
            raise RenameRefusedError(f"`{symbol.name}` is predefined by the controller")
        case ConfiguredSymbol():
            raise RenameRefusedError(
                f"`{symbol.name}` is declared by the configuration of the cell, not by a module"
            )
        case UnknownSymbol():
            raise RenameRefusedError(f"`{symbol.name}` is declared by no module")
        case RoutineSymbol(name=name) if name.lower() == ENTRY:
            raise RenameRefusedError("`main` is the name that the controller starts with")
        case _:
            pass


def plan_rename(symbol: NamedSymbol | None, new: str, names: NamesOfNodes) -> Renaming:
    """Return the places to change for a new name of a symbol.

    Args:
        symbol: The symbol.
        new: Its new name.
        names: Resolves the names of the task.

    Raises:
        RenameRefusedError: If the new name is none, or would change the meaning of the program.
    """
    require_renameable(symbol)
    assert symbol is not None
    _require_name(new)
    facts, old, key = names.facts, symbol.name.lower(), new.lower()
    if facts.analysis.may_be_unread(old) or facts.analysis.may_be_unread(key):
        raise RenameRefusedError(
            f"`{symbol.name}` or `{new}` occurs in text with a syntax error, which must be "
            "corrected first"
        )
    if old != key:
        _require_free(symbol, new, names)
    _require_no_text(symbol, facts)
    found = tuple(_all_places(symbol, names))
    if not any(one.is_declaration for one in found):
        raise RenameRefusedError(f"the declaration of `{symbol.name}` cannot be changed")
    return Renaming(tuple(one.module.span(one.name).written for one in found), new)


def _all_places(symbol: NamedSymbol, names: NamesOfNodes) -> Iterator[Occurrence]:
    """Yield the occurrences; refuse if there are others of which the meaning is not known."""
    key = symbol.name.lower()
    for file in names.facts.files:
        for found in names_spelled(key, file, names):
            if found.symbol == symbol:
                yield found
            elif found.is_declaration and _is_in_same_scope(found, symbol, names.facts):
                raise RenameRefusedError(
                    f"`{symbol.name}` is declared twice, so which one is meant is not known"
                )
            elif found.symbol is None:
                line = found.module.span(found.name).line
                raise RenameRefusedError(
                    f"line {line} of {file.source.file} uses `{found.name.text}` in a way that "
                    "has an error, so whether it is meant is not known"
                )


def _require_name(new: str) -> None:
    if not _NAME.fullmatch(new):
        raise RenameRefusedError(
            f"`{new}` is no name: a name begins with a letter and contains letters, digits and _"
        )
    if len(new) > LONGEST_NAME:
        raise RenameRefusedError(
            f"`{new}` has {len(new)} characters; a name in RAPID has at most {LONGEST_NAME}"
        )
    if new.upper() in reserved_words():
        raise RenameRefusedError(f"`{new}` is a reserved word of RAPID")


def _require_free(symbol: NamedSymbol, new: str, names: NamesOfNodes) -> None:
    """Refuse a name that is in use where the symbol, or its new name, is visible."""
    key, facts = new.lower(), names.facts
    match symbol:
        case ComponentSymbol(record=record):
            if names.component(record.type, key) is not None:
                raise RenameRefusedError(f"`{record.name}` has a component `{new}` already")
            return
        case LabelSymbol(routine=routine):
            _require_unused(new, names, _of_routine(routine, new, names))
            return
        case _:
            pass
    if installed_symbol(key) is not None or installed_type(key) is not None:
        raise RenameRefusedError(f"`{new}` is predefined by the controller; the new name hides it")
    if (configured := facts.analysis.cell.find(key)) is not None:
        raise RenameRefusedError(f"`{new}` is {kind_of(configured)}; the new name hides it")
    declared = declared_name(symbol, facts)
    home = None if declared is None else facts.analysis.home_of.get(declared[0])
    hidden = None if home is None else home.scope.find(key)
    if hidden is not None:
        raise RenameRefusedError(f"`{new}` is the name of {kind_of(hidden)}")
    _require_unused(new, names, _in_view(symbol, new, names))


def _in_view(symbol: NamedSymbol, new: str, names: NamesOfNodes) -> Iterator[Occurrence]:
    """Yield the uses of a name in all text that sees a symbol."""
    key, facts = new.lower(), names.facts
    routine = _home_routine(symbol, facts)
    if isinstance(symbol, CounterSymbol) and routine is not None:
        yield from _of_loop(symbol.node, routine, new, names)
        return
    if routine is not None:
        yield from _of_routine(routine, new, names)
        return
    declared = declared_name(symbol, facts)
    module = declared[0] if declared is not None and _is_local(symbol) else None
    for file in facts.files:
        for found in names_spelled(key, file, names):
            if module is None or found.module is module:
                yield found


def _of_loop(
    loop: tree.For, routine: tree.RoutineNode, new: str, names: NamesOfNodes
) -> Iterator[Occurrence]:
    """Yield the uses of a name in a loop, and its declarations around the loop."""
    for found in _of_routine(routine, new, names):
        inner = found.symbol
        if isinstance(inner, CounterSymbol):
            around = inner.node.start <= loop.start < inner.node.end
        else:
            around = found.is_declaration
        if around or loop.start <= found.name.start < loop.end:
            yield found


def _of_routine(routine: tree.RoutineNode, new: str, names: NamesOfNodes) -> Iterator[Occurrence]:
    for file in names.facts.files:
        if any(routine in module.items for module in file.modules):
            for found in names_spelled(new.lower(), file, names):
                if routine.start <= found.name.start < routine.end:
                    yield found


def _require_unused(new: str, names: NamesOfNodes, uses: Iterator[Occurrence]) -> None:
    """Refuse a name that is used, other than as a component or an argument of its own name."""
    for found in uses:
        if isinstance(found.symbol, ComponentSymbol | InstalledParameterSymbol):
            continue
        if isinstance(found.symbol, ParameterSymbol) and not _is_inside(found, names.facts):
            continue
        span = found.module.span(found.name)
        what = "is declared" if found.is_declaration else "is used"
        raise RenameRefusedError(f"`{new}` {what} in line {span.line} of {span.file}")
    for home in names.facts.analysis.home_of:
        if home.name.key == new.lower():
            raise RenameRefusedError(f"`{new}` is the name of a module")


def _is_inside(occurrence: Occurrence, facts: Facts) -> bool:
    """Whether the name of a parameter is in its own routine, not in a call."""
    assert occurrence.symbol is not None
    routine = _home_routine(occurrence.symbol, facts)
    return routine is not None and routine.start <= occurrence.name.start < routine.end


def _is_in_same_scope(found: Occurrence, symbol: NamedSymbol, facts: Facts) -> bool:
    """Whether a declaration is next to that of a symbol, which is an error."""
    inner = (DataSymbol, ParameterSymbol)
    if not isinstance(found.symbol, inner) or not isinstance(symbol, inner):
        return False
    routine = _home_routine(symbol, facts)
    return routine is not None and routine is _home_routine(found.symbol, facts)


def _is_local(symbol: NamedSymbol) -> bool:
    match symbol:
        case DataSymbol(scope=scope) | RoutineSymbol(scope=scope):
            return scope is Scope.LOCAL
        case TypeSymbol(node=node):
            return node.scope == "LOCAL"
        case _:
            return False


def _home_routine(symbol: NamedSymbol, facts: Facts) -> tree.RoutineNode | None:
    """Return the routine in which alone a symbol is visible; None for others."""
    is_inner = isinstance(symbol, CounterSymbol | ParameterSymbol) or (
        isinstance(symbol, DataSymbol) and symbol.scope is Scope.ROUTINE
    )
    declared = declared_name(symbol, facts) if is_inner else None
    if declared is None:
        return None
    module, name = declared
    return next((one for one in module.routines if one.start <= name.start < one.end), None)


def _require_no_text(symbol: NamedSymbol, facts: Facts) -> None:
    """Refuse if a string may name the symbol: calls and access by name."""
    if not isinstance(symbol, RoutineSymbol | DataSymbol | ModuleSymbol | TypeSymbol):
        return
    if isinstance(symbol, DataSymbol) and symbol.scope is Scope.ROUTINE:
        return
    key = symbol.name.lower()
    composes = isinstance(symbol, RoutineSymbol) and _composes(facts)
    for text in _strings(facts):
        if any(word == key for word in re.split(r"[:%\s]+", text)):
            raise RenameRefusedError(
                f'the string "{text}" may refer to `{symbol.name}` by name; change both by hand'
            )
        if composes and len(text) >= _SHORTEST_PREFIX and key.startswith(text):
            raise RenameRefusedError(
                f'a call composes names that begin with "{text}", perhaps `{symbol.name}`; change '
                "both by hand"
            )


def _strings(facts: Facts) -> Iterator[str]:
    """Yield the folded contents of all strings, also of those in literal aggregates."""
    for file in facts.files:
        for match in _STRING.finditer(file.source.written.text):
            if (text := match["text"]) is not None:
                yield text.lower()


def _composes(facts: Facts) -> bool:
    """Whether a call by name computes the name instead of giving it."""
    calls = (call for part in facts.parts for call in part.all(tree.LateCall))
    return any(not isinstance(call.routine, tree.StringLiteral) for call in calls)
