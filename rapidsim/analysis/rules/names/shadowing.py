"""Rules N203 and N206: names that hide other names."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.installed import installed_symbol
from rapidsim.analysis.program import DataSymbol, LibrarySymbol
from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.diagnostics import Diagnostic, Related, Violation
from rapidsim.library.named_numbers import OF_OPTIONS
from rapidsim.syntax import tree

_OF_MOTION = frozenset({"speeddata", "zonedata", "tooldata", "wobjdata", "loaddata"})
"""Types with well-known predefined data; `low` and `edge` are reasonable names of other things."""
_VOWELS = "aeiou"
_OF_OTHERS = ("err_hand_", "err_glueflow")
"""Prefixes of error names that modules of an option declare, or programs that book them."""


class ShadowedName(Violation, code="N203"):
    hidden: str
    type: str
    location: str


class RedefinedBuiltin(Violation, code="N206"):
    defined: str
    subject: str


def find_shadowed(facts: Facts) -> Iterator[Diagnostic]:
    """Report local or LOCAL data that hide data of an outer scope."""
    outside: dict[str, list[tuple[tree.Module, tree.Data]]] = {}
    declared = facts.in_parts(_data_by_name)
    for part, nodes in declared:
        if part.routine is None:
            for key, node in nodes:
                outside.setdefault(key, []).append((part.module, node))
    for part, nodes in declared:
        for key, node in nodes:
            if part.routine is None and node.scope != "LOCAL":
                continue
            for module, hidden in outside.get(key, ()):
                here = module is part.module
                if hidden is node or (hidden.scope == "LOCAL" and not here):
                    continue
                if part.routine is None and here:
                    continue
                place = Related(module.span(hidden.name), "this one is hidden")
                where = "this module" if here else f"module {module.name.text}"
                violation = ShadowedName(node.name.text, hidden.type.text, where)
                yield part.finding(violation, node.name, place)
                break


def _data_by_name(part: ProgramPart, facts: Facts) -> list[tuple[str, tree.Data]]:
    """Declarations of data with their folded names."""
    del facts
    return [(node.name.key, node) for node in part.all(tree.Data)]


def find_redefined(facts: Facts) -> Iterator[Diagnostic]:
    """Report declarations of names that the controller predefines."""
    for part in facts.parts:
        # Names visible in one routine or module only may hide names that it does not use.
        declared = [(node.name, node.scope == "LOCAL") for node in part.all(tree.Data)]
        if part.routine is not None:
            declared = [(name, True) for name, _ in declared]
            declared.append((part.routine.name, False))
        for name, is_local in declared:
            if name.key in OF_OPTIONS or name.key.startswith(_OF_OTHERS):
                continue
            match installed_symbol(name.key):
                case DataSymbol(type=of) if not is_local or of.name in _OF_MOTION:
                    what = f"{'an' if of.name[0] in _VOWELS else 'a'} {of.name}"
                case LibrarySymbol(routine=routine) if not (is_local or routine.signature.is_open):
                    is_function = routine.signature.result is not None
                    what = "a function" if is_function else "an instruction"
                case _:
                    continue
            if not _is_their_home(part.module):
                yield part.finding(RedefinedBuiltin(name.text, what), name)


def _is_their_home(module: tree.Module) -> bool:
    """Whether a module is one in which the controller ships predefined data."""
    return module.name.key in ("base", "user")
