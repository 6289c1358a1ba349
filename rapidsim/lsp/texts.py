"""Texts about a symbol: its declaration in RAPID, its kind, its documentation."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from inspect import cleandoc

from rapidsim.analysis.cell_names import ConfiguredSymbol
from rapidsim.analysis.names.names import kind_of
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
    TypeSymbol,
    UnknownSymbol,
)
from rapidsim.analysis.program_parts import Facts
from rapidsim.analysis.types.callees import callee_of_installed
from rapidsim.language.annotations import ParameterMode
from rapidsim.language.types import Alias, ArrayOf, Record, Type, spelling
from rapidsim.library.catalogue import CHAPTERS
from rapidsim.library.table import LibraryRoutine, Parameter
from rapidsim.library.traits import LIMITS, Trait
from rapidsim.library.versions import SINCE
from rapidsim.syntax import tree

_LONGEST_VALUE = 120
UNITS = {
    "pos": "mm",
    "robtarget": "mm, quaternion, configuration",
    "jointtarget": "degrees; mm of axes that slide",
    "speeddata": "mm/s, degrees/s",
    "zonedata": "mm, degrees",
    "loaddata": "kg, mm, kg m2",
    "tooldata": "mm, kg",
    "wobjdata": "mm",
}
"""Units of the values of types, as RAPID writes them."""
_UNITS_OF_NUMS = {
    **dict.fromkeys(("t", "time", "sdelay", "plength", "pollrate", *LIMITS), "s"),
    **dict.fromkeys(("xoffset", "yoffset", "zoffset", "dx", "dy", "dz"), "mm"),
}
"""Units of arguments of type num, by folded name."""
_UNITS_IN_MOVES = {"v": "mm/s", "z": "mm"}
_ANGLES = ("rx", "ry", "rz")


def declaration(symbol: NamedSymbol) -> str:
    """Return the declaration of a symbol in the notation of RAPID, in one line."""
    match symbol:
        case DataSymbol(node=tree.Data(scope=word)):
            scope = f"{word} " if word else ""
            return f"{scope}{symbol.storage.value} {_typed(symbol.type, symbol.name)}"
        case DataSymbol():
            return f"{symbol.storage.value} {_typed(symbol.type, symbol.name)}"
        case ParameterSymbol():
            return parameter_text(symbol)
        case CounterSymbol():
            return f"num {symbol.name}"
        case RoutineSymbol():
            return routine_text(symbol)
        case LibrarySymbol():
            return installed_text(symbol)
        case TypeSymbol(type=Alias() as of):
            return f"ALIAS {of.of.name} {symbol.name}"
        case TypeSymbol():
            return f"RECORD {symbol.name}"
        case InstalledTypeSymbol():
            return spelling(symbol.type)
        case ComponentSymbol():
            return f"{symbol.component.type.name} {symbol.name}"
        case ConfiguredSymbol():
            return f"{symbol.type.name} {symbol.name}"
        case ModuleSymbol():
            return f"MODULE {symbol.name}"
        case LabelSymbol():
            return f"{symbol.name}:"
        case InstalledParameterSymbol():
            return installed_parameter_text(symbol.parameter)
        case UnknownSymbol():
            return symbol.name


def remark(symbol: NamedSymbol, facts: Facts) -> str:
    """Return a sentence about a symbol: its kind and where it is declared."""
    match symbol:
        case LibrarySymbol(routine=routine):
            return chapter_remark(routine)
        case RoutineSymbol(module=module):
            return f"{kind_of(symbol)[2:].capitalize()} of module {module.name.text}."
        case InstalledTypeSymbol():
            return "Predefined type."
        case TypeSymbol(module=module):
            return f"Type of module {module.name.text}."
        case ComponentSymbol(record=record):
            return f"Component of {record.name}."
        case InstalledParameterSymbol(routine=of):
            unit = unit_of(symbol.parameter, of.routine)
            return f"Argument of {of.name}{f' [{unit}]' if unit else ''}."
        case UnknownSymbol():
            of_signal = facts.analysis.signals.get(symbol.name.lower())
            if of_signal is not None:
                return f"Taken for a {of_signal.name}; declared neither here nor in the cell."
            return "Declared by no module."
        case ModuleSymbol() | LabelSymbol():
            return ""
        case DataSymbol(module=None):
            return f"Predefined: {kind_of(symbol)}."
        case DataSymbol(module=tree.Module() as home):
            return f"{kind_of(symbol)[2:].capitalize()} of module {home.name.text}."
        case _:
            return f"{kind_of(symbol)[0].upper()}{kind_of(symbol)[1:]}."


def value_text(symbol: NamedSymbol) -> str:
    """Return the initial value of data as written; empty without one, cut if it is long."""
    match symbol:
        case DataSymbol(node=tree.Data(value=tree.Node() as value), module=tree.Module() as home):
            text = home.span(value).one_line
        case DataSymbol(module=None, value=float() as number):
            text = f"{number:g}"
        case DataSymbol(module=None, value=str() as characters):
            text = f'"{characters}"'
        case DataSymbol(module=None, value=tuple() as record):
            # A record is shown with the name of its class before the bracket.
            text = repr(record)
            text = text[text.find("[") :]
        case _:
            return ""
    return text if len(text) <= _LONGEST_VALUE else f"{text[:_LONGEST_VALUE]} ..."


def documentation(symbol: NamedSymbol) -> str:
    """Return words about an installed routine: what it does, its arguments, what a run does."""
    match symbol:
        case LibrarySymbol(routine=routine):
            return "\n\n".join(_routine_paragraphs(symbol, routine))
        case TypeSymbol(type=Record() as of) | InstalledTypeSymbol(type=Record() as of):
            return "\n".join(f"- `{one.type.name} {one.name}`" for one in of.components)
        case _:
            return ""


def _routine_paragraphs(symbol: LibrarySymbol, routine: LibraryRoutine) -> Iterator[str]:
    text = cleandoc(routine.function.__doc__ or "").split("\n\n")[0]
    if text and routine.simulated:
        yield " ".join(text.split())
    if routine.treated_as is not None:
        yield f"Not simulated; a run treats it as: {routine.treated_as}."
    parameters = routine.signature.parameters
    if parameters:
        yield "\n".join(f"- {_parameter_line(one, routine)}" for one in parameters)
    if (since := SINCE.get(symbol.name.lower())) is not None:
        yield f"Since RobotWare {since}."


def _parameter_line(parameter: Parameter, routine: LibraryRoutine) -> str:
    unit = unit_of(parameter, routine)
    return f"`{installed_parameter_text(parameter)}`" + (f" [{unit}]" if unit else "")


def unit_of(parameter: Parameter, routine: LibraryRoutine) -> str:
    """Return the unit of an argument in RAPID; empty if it has none or it is not known."""
    (of, *others) = parameter.types
    if others or parameter.is_switch or isinstance(of, ArrayOf):
        return ""
    name = parameter.name.lower()
    if of.name != "num":
        return UNITS.get(of.name, "")
    if Trait.ANGLES in routine.traits and (name in _ANGLES or "angle" in name):
        return "degrees"
    if Trait.MOVE in routine.traits and name in _UNITS_IN_MOVES:
        return _UNITS_IN_MOVES[name]
    return _UNITS_OF_NUMS.get(name, "")


def chapter_remark(routine: LibraryRoutine) -> str:
    """Return the kind and chapter of an installed routine."""
    kind = "Instruction" if routine.signature.result is None else "Function"
    chapter = chapter_of(routine.name.lower())
    return f"{kind}, {chapter.lower()}." if chapter else f"{kind}, predefined."


@cache
def chapter_of(key: str) -> str:
    """Return the chapter of an installed routine by folded name; empty if it is only declared."""
    return next((name for name, rows in CHAPTERS.items() if key in rows), "")


def routine_text(symbol: RoutineSymbol) -> str:
    """Return the header of a routine of the user."""
    parameters = ", ".join(_grouped(symbol))
    scope = f"{symbol.node.scope} " if symbol.node.scope else ""
    match symbol.node:
        case tree.Func(type=of):
            return f"{scope}FUNC {of.text} {symbol.name}({parameters})"
        case tree.Trap():
            return f"{scope}TRAP {symbol.name}"
        case _:
            return f"{scope}PROC {symbol.name}({parameters})"


def _grouped(symbol: RoutineSymbol) -> Iterator[str]:
    r"""Yield the parameters, alternatives as one: `\num a | num b`."""
    last: int | None = None
    text = ""
    for one in symbol.parameters:
        if one.group == last:
            text += f" | {parameter_text(one).lstrip(chr(92))}"
            continue
        if text:
            yield text
        text, last = parameter_text(one), one.group
    if text:
        yield text


def parameter_text(symbol: ParameterSymbol) -> str:
    r"""Return a parameter of a routine of the user as declared: `\VAR num x{*}`."""
    mode = "" if symbol.mode is ParameterMode.IN else f"{symbol.mode.value} "
    return f"{chr(92) if symbol.optional else ''}{mode}{_typed(symbol.type, symbol.name)}"


def installed_text(symbol: LibrarySymbol) -> str:
    """Return the call of an installed routine in the notation of the manual."""
    signature = symbol.routine.signature
    order = symbol.name if signature.is_open else callee_of_installed(symbol).order
    if signature.result is None:
        return order
    head, _, rest = order.partition(" ")
    return f"{signature.result.name} {head}({rest})"


def installed_parameter_text(parameter: Parameter) -> str:
    """Return a parameter of an installed routine: its name with the types it accepts."""
    if parameter.only is not None:
        accepted = parameter.only.words
    else:
        accepted = " or ".join(dict.fromkeys(of.name for of in parameter.types))
    mode = ""
    if parameter.mode in (ParameterMode.VAR, ParameterMode.INOUT, ParameterMode.PERS):
        mode = f"{parameter.mode.value} "
    return f"{chr(92) if parameter.optional else ''}{parameter.name}: {mode}{accepted}"


def _typed(of: Type, name: str) -> str:
    """Return type and name as a declaration has them: `num x{3}`."""
    if isinstance(of, ArrayOf):
        sizes = ",".join("*" if size is None else str(size) for size in of.dimensions)
        return f"{of.element.name} {name}{{{sizes}}}"
    return f"{of.name} {name}"
