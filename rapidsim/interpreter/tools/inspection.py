"""Inspection of a running routine by a debugger: its position, and the values of its data.

Data are found by their RAPID names, in any case, with the visibility of the routine, and shown in
RAPID syntax. References are followed.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from types import FrameType
from typing import TypeAlias

from rapidsim.analysis.literals import Value, element_type
from rapidsim.analysis.program import (
    CounterSymbol,
    DataSymbol,
    ParameterSymbol,
    Program,
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


def program_of(frame: FrameType) -> Program:
    """The program that a frame belongs to, with its current modules."""
    origin: Origin = frame.f_globals[GENERATED]
    return origin.program()


def place_of(frame: FrameType) -> str:
    """Describe the position of a frame: `weld`, `the ERROR clause of weld`, or `initial values`."""
    routine = routine_of(frame)
    clause = CLAUSES.get(frame.f_code.co_name)
    name = routine.name if routine else "initial values"
    return f"the {clause} clause of {name}" if clause else name


def is_data_path(text: str) -> bool:
    """Whether a text has the form of data with indices and components."""
    return _PATH.match(text) is not None


def rapid_text(path: str, frame: FrameType) -> str:
    """Return the value of data in RAPID syntax.

    Args:
        path: Data with indices and components: `n`, `p10.trans.x`, `a{i,2}`.
        frame: The frame of the routine whose scope applies.

    Raises:
        NotShownError: If there is no such value now.
    """
    value, of = value_at(path, frame)
    try:
        return value_text(value, of)
    except TypeError as error:
        raise NotShownError(str(error)) from error


def parameters(frame: FrameType) -> Iterator[str]:
    """The names of the parameters of the routine that a frame executes."""
    routine = routine_of(frame)
    if routine is not None:
        yield from (parameter.name for parameter in routine.parameters)


def local_names(frame: FrameType) -> tuple[str, ...]:
    """The names of parameters and data of the routine that a frame executes, in source order."""
    routine = routine_of(frame)
    if routine is None:
        return ()
    return tuple(dict.fromkeys(symbol.name for symbol in _in_scope(routine, frame)))


def module_names(frame: FrameType, storage: Storage | None = None) -> tuple[str, ...]:
    """The names of the data of a frame's module; with a storage, of all modules' global data."""
    origin: Origin = frame.f_globals[GENERATED]
    return tuple(
        dict.fromkeys(
            symbol.name
            for symbol in module_data(origin.program())
            if (symbol.module is origin.module if storage is None else symbol.storage is storage)
            and (symbol.module is origin.module or symbol.scope is not Scope.LOCAL)
        )
    )


def value_at(path: str, frame: FrameType) -> tuple[Value, Type]:
    """Return value and type of data with indices and components: `n`, `p10.trans.x`, `a{i,2}`.

    Raises:
        NotShownError: If there is no such value now.
    """
    _, _, value, of = _followed(path, frame)
    return value, of


def parts_of(path: str, frame: FrameType) -> tuple[str, tuple[int, ...]]:
    """Return the name in a path, and the positions of the parts of its value, from 0.

    Raises:
        NotShownError: If there is no such value now.
    """
    name, parts, _, _ = _followed(path, frame)
    return name, parts


def _followed(path: str, frame: FrameType) -> tuple[str, tuple[int, ...], Value, Type]:
    match = _PATH.match(path)
    if match is None:
        raise NotShownError(
            f"`{path}` is not the name of data, such as `n`, `p10.trans` or `a{{i}}`"
        )
    name, steps = match.groups()
    value, of = data_of(name, frame)
    return name, *follow_steps(steps, value, of, lambda text: _index(text, frame))


def follow_steps(
    steps: str, value: Value, of: Type, index_of: Callable[[str], int]
) -> tuple[tuple[int, ...], Value, Type]:
    """Return a part of a value: its positions from 0, its value and its type.

    Args:
        steps: Indices and components: `{2}.trans.x`.
        value: The whole value.
        of: Its type.
        index_of: Evaluates an index.

    Raises:
        NotShownError: If there is no such part.
    """
    parts: list[int] = []
    for indices, component in _STEP.findall(steps):
        if component:
            part, found = _component(resolved(of), component)
            parts.append(part)
            value, of = value[part], found
        else:
            for text in indices.split(","):
                index = index_of(text.strip())
                value, of = _element(value, of, index)
                parts.append(index - 1)
    return tuple(parts), value, of


def name_and_steps(path: str) -> tuple[str, str] | None:
    """Split data with indices and components into name and the rest; None if they are none."""
    match = _PATH.match(path)
    return None if match is None else (match[1], match[2])


def _index(text: str, frame: FrameType) -> int:
    number = text if text.isdigit() else value_at(text, frame)[0]
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


def _component(of: Type, name: str) -> tuple[int, Type]:
    """Position and type of a component."""
    if isinstance(of, Record):
        for number, component in enumerate(of.components):
            if component.name.lower() == name.lower():
                return number, component.type
    raise NotShownError(f"data of type {of.name} have no component `{name}`")


def data_of(name: str, frame: FrameType) -> tuple[Value, Type]:
    """Return value and type of the data that a name refers to in the scope of a frame.

    Raises:
        NotShownError: If there is no such value now.
    """
    origin: Origin = frame.f_globals[GENERATED]
    symbol = _local(name, frame)
    if symbol is not None:
        if isinstance(symbol, DataSymbol) and symbol.storage is Storage.CONST:
            return origin.value_of(symbol), symbol.type
        owner, key, index = _variable(name, frame)
        held = owner.f_locals[key]
        of = NUM if isinstance(symbol, CounterSymbol) else symbol.type
        if index is not None:
            return held[index], of
        value = held.value if isinstance(held, Box | Element | ComponentReference) else held
        # Generated code keeps a num that is always whole as an integer.
        return float(value) if isinstance(value, int) and not isinstance(value, bool) else value, of
    known = global_data(name, frame)
    if known is not None:
        return origin.value_of(known), known.type
    key = name.lower()
    if key in DATA:
        held = frame.f_globals.get(key)
        value = held.value if isinstance(held, Box) else DATA[key].value
        return value, DATA[key].type
    raise NotShownError(f"`{name}` is not the name of data here")


def global_data(name: str, frame: FrameType) -> DataSymbol | None:
    """Data that a module declares, as seen from a frame's module; None without any."""
    origin: Origin = frame.f_globals[GENERATED]
    key = name.lower()
    named = [symbol for symbol in module_data(origin.program()) if symbol.name.lower() == key]
    own = [symbol for symbol in named if symbol.module is origin.module]
    seen = (*own, *(other for other in named if other.scope is not Scope.LOCAL))
    return seen[0] if seen else None


def local_variable(name: str, frame: FrameType) -> tuple[FrameType, str, int | None] | None:
    """Python variable of local data: its frame, its name, and the index of an element in it.

    Returns:
        None if the name is not that of local data.

    Raises:
        NotShownError: If they are constant, or have no value now.
    """
    symbol = _local(name, frame)
    if symbol is None:
        return None
    if isinstance(symbol, CounterSymbol):
        raise NotShownError(f"`{name}` is the counter of a FOR")
    if isinstance(symbol, DataSymbol) and symbol.storage is Storage.CONST:
        raise NotShownError(f"`{name}` is a constant")
    return _variable(name, frame)


def _local(name: str, frame: FrameType) -> _Variable | None:
    """The innermost local data of a name in scope."""
    routine = routine_of(frame)
    symbols = () if routine is None else tuple(_named(name, routine, frame))
    return symbols[-1] if symbols else None


def _named(name: str, routine: RoutineSymbol, frame: FrameType) -> Iterator[_Variable]:
    return (one for one in _in_scope(routine, frame) if one.name.lower() == name.lower())


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


def _frames(frame: FrameType) -> Iterator[FrameType]:
    """Yield a frame; for one of a clause, also that of its routine."""
    yield frame
    if frame.f_code.co_name in CLAUSES:
        name = frame.f_code.co_qualname.partition(".")[0]
        outer = frame.f_back
        while outer is not None and outer.f_code.co_qualname != name:
            outer = outer.f_back
        if outer is not None:
            yield outer


def _variable(name: str, frame: FrameType) -> tuple[FrameType, str, int | None]:
    """Python variable of local data: its frame, its name, and the index of an element in it.

    `names.LocalNames` numbers same-named locals, and counts from 2 if a module has data of that
    name.
    """
    routine = routine_of(frame)
    assert routine is not None
    key, depth = name.lower(), sum(1 for _ in _named(name, routine, frame))
    for number in (depth, depth + 1):
        variable = key if number == 1 else f"{key}_{number}"
        for owner in _frames(frame):
            held = owner.f_locals.get(variable, _NOTHING)
            if held is ABSENT:
                raise NotShownError(f"the optional argument `{name}` was not given")
            if held is not _NOTHING:
                index = owner.f_locals.get(position_of(key))
                return owner, variable, index
    raise NotShownError(f"`{name}` has no value yet")
