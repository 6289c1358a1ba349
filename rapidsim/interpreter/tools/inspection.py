"""Inspection of a running routine by a debugger: its position, and the values of its data.

Data are found by their RAPID names, in any case, with the visibility of the routine, and shown in
RAPID syntax. References are followed.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from types import FrameType
from typing import Any, TypeAlias

from rapidsim.analysis.literals import Value, element_type
from rapidsim.analysis.program import (
    CounterSymbol,
    DataSymbol,
    ParameterSymbol,
    RoutineSymbol,
    Scope,
    Storage,
)
from rapidsim.analysis.tree_walk import descendants
from rapidsim.interpreter.runtime.call_stack import CLAUSES, Origin
from rapidsim.interpreter.runtime.error_recovery import GENERATED, is_generated
from rapidsim.interpreter.runtime.memory import module_data
from rapidsim.interpreter.runtime.references import ABSENT, ComponentReference, Element, position_of
from rapidsim.language.reference import Box
from rapidsim.language.types import NUM, ArrayOf, Record, Type, resolved
from rapidsim.library.predefined import DATA
from rapidsim.library.text import value_text
from rapidsim.syntax import tree

_PATH = re.compile(r"\s*([A-Za-z_]\w*)\s*((?:\{[^{}]*\}\s*|\.\s*[A-Za-z_]\w*\s*)*)$")
_STEP = re.compile(r"\{([^{}]*)\}|\.\s*(\w+)")

_NOTHING = object()

_Variable: TypeAlias = ParameterSymbol | CounterSymbol | DataSymbol


class NotShownError(Exception):
    """No value can be shown; the message has the reason."""


def is_rapid(frame: FrameType) -> bool:
    """Whether a frame executes a routine, or initial values, of a program."""
    return is_generated(frame) and frame.f_code.co_name != "<module>"


def routine_of(frame: FrameType) -> RoutineSymbol | None:
    """The routine that a frame executes; None for initial values."""
    origin: Origin = frame.f_globals[GENERATED]
    return origin.routines.get(frame.f_code.co_qualname.partition(".")[0])


def module_of(frame: FrameType) -> tree.Module:
    """The module whose code a frame executes, including modules loaded at run time."""
    origin: Origin = frame.f_globals[GENERATED]
    return origin.module


def place_of(frame: FrameType) -> str:
    """Describe the position of a frame: `weld`, `the ERROR clause of weld`, or `initial values`."""
    routine = routine_of(frame)
    clause = CLAUSES.get(frame.f_code.co_name)
    name = routine.name if routine else "initial values"
    return f"the {clause} clause of {name}" if clause else name


def rapid_text(path: str, frame: FrameType) -> str:
    """Return the value of data in RAPID syntax.

    Args:
        path: Data with indices and components: `n`, `p10.trans.x`, `a{i,2}`.
        frame: The frame of the routine whose scope applies.

    Raises:
        NotShownError: If there is no such value now.
    """
    value, of = _follow(path, frame)
    try:
        return value_text(value, of)
    except TypeError as error:
        raise NotShownError(str(error)) from error


def parameters(frame: FrameType) -> Iterator[str]:
    """The names of the parameters of the routine that a frame executes."""
    routine = routine_of(frame)
    if routine is not None:
        yield from (parameter.name for parameter in routine.parameters)


def _follow(path: str, frame: FrameType) -> tuple[Value, Type]:
    match = _PATH.match(path)
    if match is None:
        raise NotShownError(
            f"`{path}` is not the name of data, such as `n`, `p10.trans` or `a{{i}}`"
        )
    name, steps = match.groups()
    value, of = _data(name, frame)
    for indices, component in _STEP.findall(steps):
        if component:
            value, of = _component(value, resolved(of), component)
        else:
            for index in indices.split(","):
                value, of = _element(value, of, _index(index.strip(), frame))
    return value, of


def _index(text: str, frame: FrameType) -> int:
    number = text if text.isdigit() else _follow(text, frame)[0]
    try:
        return int(number)
    except (TypeError, ValueError) as error:
        raise NotShownError(f"`{text}` is not an index") from error


def _element(array: Value, of: Type, index: int) -> tuple[Value, Type]:
    if not isinstance(of, ArrayOf):
        raise NotShownError(f"data of type {of.name} have no elements")
    if not 1 <= index <= len(array):
        raise NotShownError(f"index {index} is outside the array, which has 1 to {len(array)}")
    return array[index - 1], element_type(of)


def _component(record: Value, of: Type, name: str) -> tuple[Value, Type]:
    if isinstance(of, Record):
        for value, component in zip(record, of.components, strict=True):
            if component.name.lower() == name.lower():
                return value, component.type
    raise NotShownError(f"data of type {of.name} have no component `{name}`")


def _data(name: str, frame: FrameType) -> tuple[Value, Type]:
    """Value and type of the data that a name refers to in the scope of a frame."""
    origin: Origin = frame.f_globals[GENERATED]
    program = origin.program()
    key = name.lower()
    routine = routine_of(frame)
    if routine is not None:
        symbols = [s for s in _in_scope(routine, frame) if s.name.lower() == key]
        if symbols:
            symbol = symbols[-1]
            if isinstance(symbol, DataSymbol) and symbol.storage is Storage.CONST:
                return origin.value_of(symbol), symbol.type
            value = _local_value(symbol.name, len(symbols), _locals(frame))
            return value, NUM if isinstance(symbol, CounterSymbol) else symbol.type
    named = [symbol for symbol in module_data(program) if symbol.name.lower() == key]
    own = [symbol for symbol in named if symbol.module is origin.module]
    for symbol in (*own, *(other for other in named if other.scope is not Scope.LOCAL)):
        return origin.value_of(symbol), symbol.type
    if key in DATA:
        held = frame.f_globals.get(key)
        value = held.value if isinstance(held, Box) else DATA[key].value
        return value, DATA[key].type
    raise NotShownError(f"`{name}` is not the name of data here")


def _in_scope(routine: RoutineSymbol, frame: FrameType) -> Iterator[_Variable]:
    """Yield the routine's data in scope at the position of a frame, the innermost last."""
    origin: Origin = frame.f_globals[GENERATED]
    program = origin.program()
    yield from routine.parameters
    source = routine.module.source
    for node in descendants(routine.node):
        if isinstance(node, tree.For):
            first, last = source.position(node.start)[0], source.position(node.end)[0]
            if not first <= frame.f_lineno <= last:
                continue
        if isinstance(node, tree.Data | tree.For):
            symbol = program.symbol_of[node]
            assert isinstance(symbol, DataSymbol | CounterSymbol)
            yield symbol


def _locals(frame: FrameType) -> dict[str, Any]:
    """Variables of a routine; for a clause's frame, also the variables of its routine."""
    variables = dict(frame.f_locals)
    outer = frame.f_back
    if frame.f_code.co_name in CLAUSES:
        name = frame.f_code.co_qualname.partition(".")[0]
        while outer is not None and outer.f_code.co_qualname != name:
            outer = outer.f_back
        if outer is not None:
            variables = {**outer.f_locals, **variables}
    return variables


def _local_value(name: str, depth: int, variables: dict[str, Any]) -> Value:
    """Return the value of a local variable; `depth` is the number of same-named locals up to it.

    `names.LocalNames` numbers these, and counts from 2 if a module has data of that name.
    """
    key = name.lower()
    for number in (depth, depth + 1):
        held = variables.get(key if number == 1 else f"{key}_{number}", _NOTHING)
        if held is ABSENT:
            raise NotShownError(f"the optional argument `{name}` was not given")
        if position_of(key) in variables:
            return held[variables[position_of(key)]]
        if held is not _NOTHING:
            return held.value if isinstance(held, Box | Element | ComponentReference) else held
    raise NotShownError(f"`{name}` has no value yet")
