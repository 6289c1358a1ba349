"""Modes that a routine sets and that may still be set at its exits."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from functools import cache
from math import inf
from typing import TypeAlias

from rapidsim.analysis.flow.graph import ENTRY, EXIT
from rapidsim.analysis.flow.solve import after_steps, forward
from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.facts.known_values import known_value
from rapidsim.library.table import LibraryRoutine
from rapidsim.syntax import tree
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class UnrestoredMode:
    """A mode that is set at an exit."""

    call: tree.Call
    """The call that set it."""
    ends: str
    """Description of the exit: "ends", "returns on line 12"."""
    back: str
    """The call that restores the mode."""


@value_class(frozen=True, slots=True)
class _Setting:
    """A mode that an instruction sets or restores, identified by its restoring call."""

    mode: str
    is_back: bool


_NO_DISPLACEMENTS = (((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)), (0.0,) * 6)
"""A pose and offsets of axes without displacement."""

_Open: TypeAlias = frozenset[tuple[str, tree.Call]]
"""Modes that may be set, each with an instruction that set it."""


def unrestored_modes(
    part: ProgramPart, facts: Facts, matters: Callable[[LibraryRoutine], bool]
) -> Iterator[UnrestoredMode]:
    """Yield the modes that may be set at some exit of a routine, each at the first such exit.

    Args:
        part: A routine; one with text that could not be read yields nothing.
        facts: The task.
        matters: Selects instructions; calls that restore their modes are included.
    """
    settings = facts.of_part(settings_of, part)
    modes = {
        setting.mode
        for call, setting in settings.items()
        if not setting.is_back and (row := facts.installed(call)) is not None and matters(row)
    }
    if not modes or tree.InvalidStatement in part.nodes:
        return
    exits = sorted(_exits(part, facts, settings, modes), key=lambda one: one.position)
    found: dict[str, UnrestoredMode] = {}
    for one in exits:
        for mode, call in sorted(one.open_modes, key=lambda pair: pair[1].start):
            found.setdefault(mode, UnrestoredMode(call, one.ends, mode))
    yield from found.values()


@value_class(frozen=True, slots=True)
class _RoutineExit:
    """An exit of a routine, with the modes that may be set there."""

    position: float
    ends: str
    open_modes: _Open


def _exits(
    part: ProgramPart, facts: Facts, settings: Mapping[tree.Call, _Setting], modes: AbstractSet[str]
) -> Iterator[_RoutineExit]:
    """Yield the exits of a routine at which some of `modes` may be set."""

    @cache
    def restoring(mode: str) -> int:
        return routines_with(mode, facts, back=True)

    def step(node: tree.Node, state: _Open) -> _Open | None:
        if not isinstance(node, tree.Call | tree.FunctionCall):
            return state
        setting = settings.get(node) if isinstance(node, tree.Call) else None
        if setting is not None and isinstance(node, tree.Call):
            if setting.mode not in modes:
                return state
            rest = frozenset(pair for pair in state if pair[0] != setting.mode)
            return rest if setting.is_back else rest | {(setting.mode, node)}
        if not facts.can_return(node):
            return None
        callee = facts.callee_of(node)
        if not state or callee is None:
            return state
        # Modes that a callee may restore count as restored.
        within = facts.reached_from[callee]
        return frozenset(pair for pair in state if not within & restoring(pair[0]))

    graph = facts.flow(part)
    nothing: _Open = frozenset()
    for index, state in forward(graph, {ENTRY: nothing}, step, frozenset.union).items():
        block = graph.blocks[index]
        for edge in block.edges:
            if edge.to == EXIT:
                at_end = after_steps(block.steps, state, step)
                if at_end:
                    yield _exit_at(part, edge.by, at_end)


def _exit_at(part: ProgramPart, by: tree.Node | None, open_modes: _Open) -> _RoutineExit:
    if by is None:
        return _RoutineExit(inf, "ends", open_modes)
    return _RoutineExit(by.start, f"returns on line {part.module.span(by).line}", open_modes)


def routines_with(mode: str, facts: Facts, *, back: bool) -> int:
    """Bits of the routines with a call that sets a mode, or restores it."""
    setting = _Setting(mode, back)
    return facts.bits_of(
        part for part, found in facts.in_parts(settings_of) if setting in found.values()
    )


def settings_of(part: ProgramPart, facts: Facts) -> Mapping[tree.Call, _Setting]:
    """Calls of a part that set or restore a mode."""
    found = ((call, _setting(call, facts)) for call in part.all(tree.Call))
    return {call: setting for call, setting in found if setting is not None}


def _setting(call: tree.Call, facts: Facts) -> _Setting | None:
    """Mode that a call sets or restores; None if it does neither."""
    routine = facts.installed(call)
    if routine is None or not routine.back:
        return None
    return _Setting(routine.back, _puts_back(call, routine, facts))


def _puts_back(call: tree.Call, routine: LibraryRoutine, facts: Facts) -> bool:
    """Whether a call is equivalent to the one that restores its mode."""
    name, *switches = routine.back.split("\\")
    if switches:
        given = {one.name.key for one in call.arguments if isinstance(one, tree.OptionalArgument)}
        return not given or switches[0].lower() in given
    name, *numbers = re.split("[ ,]", name)
    if not numbers:
        return routine.name == name or _displaces_nothing(call, facts)
    required = [one.value for one in call.arguments if isinstance(one, tree.RequiredArgument)]
    values = [known_value(value, facts) for value in required[: len(numbers)]]
    # The maximum speed differs between robots; only percentages are compared.
    in_percent = [value for value, normal in zip(values, numbers, strict=False) if normal == "100"]
    return None in values or in_percent == [100.0] * numbers.count("100")


def _displaces_nothing(call: tree.Call, facts: Facts) -> bool:
    """Whether the only argument of a call is a null displacement: `EOffsSet [0,0,0,0,0,0]`."""
    match call.arguments:
        case (tree.RequiredArgument(value=given),):
            return known_value(given, facts, persistents=False) in _NO_DISPLACEMENTS
        case _:
            return False
