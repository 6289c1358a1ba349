"""Modes that a routine sets and that may still be in force where it ends."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping

from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.facts.known_values import known_value
from rapidsim.analysis.rules.facts.reached_routines import mask_of, reached
from rapidsim.library.table import LibraryRoutine
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class UnrestoredMode:
    """A mode left in force."""

    call: tree.Call
    """What set it."""
    ends: str
    """How the routine ends then: "ends", "returns on line 12"."""
    back: str
    """What puts the mode back."""


@value_class(frozen=True, slots=True)
class _Setting:
    """What an instruction sets: a mode, by what puts it back, and whether it does that itself."""

    mode: str
    is_back: bool


_NO_DISPLACEMENTS = (((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)), (0.0,) * 6)
"""A pose and offsets of axes that displace nothing."""

_Open = Mapping[str, tree.Call]
"""The modes that may be in force, each with the instruction that set it."""


def unrestored_modes(
    part: ProgramPart, facts: Facts, matters: Callable[[LibraryRoutine], bool]
) -> Iterator[UnrestoredMode]:
    """The modes that may be in force at some exit of a routine, each at the first such exit.

    Args:
        part: A routine; one with jumps yields nothing.
        facts: The task.
        matters: Which instructions to look at; those that restore their modes count as well.
    """
    settings = {
        call: setting
        for call in part.all(tree.Call)
        if (setting := _setting(call, facts)) is not None
    }
    modes = {
        setting.mode
        for call, setting in settings.items()
        if not setting.is_back and (row := facts.installed(call)) is not None and matters(row)
    }
    if not modes or not part.nodes.keys().isdisjoint((tree.Goto, tree.InvalidStatement)):
        return
    assert part.routine is not None
    ways = _PathWalker(
        part, {call: one for call, one in settings.items() if one.mode in modes}, facts
    )
    left = ways.follow(part.routine.body, {})
    if left is not None:
        ways.end(left, "ends")
    for mode, (call, ends) in ways.found.items():
        yield UnrestoredMode(call, ends, mode)


class _PathWalker:
    """Follows the ways through one routine and keeps what is in force where they end."""

    def __init__(
        self, part: ProgramPart, settings: Mapping[tree.Call, _Setting], facts: Facts
    ) -> None:
        self._part = part
        self._settings = settings
        self._facts = facts
        self._back: dict[str, int] = {}
        self.found: dict[str, tuple[tree.Call, str]] = {}

    def end(self, open_modes: _Open, ends: str) -> None:
        """Record an exit of the routine."""
        for mode, call in open_modes.items():
            self.found.setdefault(mode, (call, ends))

    def follow(self, body: tree.Body, open_modes: _Open) -> _Open | None:
        """What may be in force after a statement list; None if execution never gets there."""
        current: _Open | None = open_modes
        for statement in body:
            if current is None:
                return None
            current = self._step(statement, current)
        return current

    def _step(self, statement: tree.Statement, current: _Open) -> _Open | None:
        match statement:
            case tree.Call():
                setting = self._settings.get(statement)
                if setting is None:
                    return self._called(statement, current)
                rest = {mode: call for mode, call in current.items() if mode != setting.mode}
                return rest if setting.is_back else {**rest, setting.mode: statement}
            case tree.Return():
                line = self._part.module.span(statement).line
                self.end(current, f"returns on line {line}")
                return None
            case tree.Raise() | tree.Exit() | tree.Retry() | tree.TryNext():
                return None
            case tree.If(branches=branches, otherwise=otherwise):
                ways = [self.follow(branch.body, current) for branch in branches]
                ways.append(current if otherwise is None else self.follow(otherwise, current))
                return _joined(ways)
            case tree.CompactIf(statement=inner):
                return _joined([self._step(inner, current), current])
            case tree.Test(cases=cases, default=default):
                ways = [self.follow(case.body, current) for case in cases]
                ways.append(current if default is None else self.follow(default, current))
                return _joined(ways)
            case tree.For(body=body) | tree.While(body=body):
                return _joined([self.follow(body, current), current])
            case _:
                return current

    def _called(self, call: tree.Call, current: _Open) -> _Open | None:
        """What may be in force behind any other call: what it may put back counts as put back."""
        if Trait.LEAVE in self._facts.does(call):
            return None
        if not current or self._facts.routine_called(call) is None:
            return current
        within = reached([call], self._facts)
        return {mode: by for mode, by in current.items() if not within & self._putting_back(mode)}

    def _putting_back(self, mode: str) -> int:
        """The bits of the routines that put a mode back."""
        if mode not in self._back:
            self._back[mode] = routines_with(mode, self._facts, back=True)
        return self._back[mode]


def routines_with(mode: str, facts: Facts, *, back: bool) -> int:
    """The bits of the routines with a call that sets a mode, or puts it back."""
    setting = _Setting(mode, back)
    return mask_of(
        lambda part: any(_setting(call, facts) == setting for call in part.all(tree.Call)), facts
    )


def _joined(states: list[_Open | None]) -> _Open | None:
    """What may be in force where ways meet."""
    arriving = [way for way in states if way is not None]
    if not arriving:
        return None
    joined: dict[str, tree.Call] = {}
    for way in arriving:
        for mode, call in way.items():
            joined.setdefault(mode, call)
    return joined


def _setting(call: tree.Call, facts: Facts) -> _Setting | None:
    """What a call sets, if it sets a mode."""
    routine = facts.installed(call)
    if routine is None or not routine.back:
        return None
    return _Setting(routine.back, _puts_back(call, routine, facts))


def _puts_back(call: tree.Call, routine: LibraryRoutine, facts: Facts) -> bool:
    """Whether a call is as good as the one that puts its mode back."""
    name, *switches = routine.back.split("\\")
    if switches:
        given = {one.name.key for one in call.arguments if isinstance(one, tree.OptionalArgument)}
        return not given or switches[0].lower() in given
    name, *numbers = re.split("[ ,]", name)
    if not numbers:
        return routine.name == name or _displaces_nothing(call, facts)
    required = [one.value for one in call.arguments if isinstance(one, tree.RequiredArgument)]
    values = [known_value(value, facts) for value in required[: len(numbers)]]
    # The highest speed is another on each robot; what counts is in percent.
    in_percent = [value for value, normal in zip(values, numbers, strict=False) if normal == "100"]
    return None in values or in_percent == [100.0] * numbers.count("100")


def _displaces_nothing(call: tree.Call, facts: Facts) -> bool:
    """Whether a call has one argument, a displacement that is none: `EOffsSet [0,0,0,0,0,0]`."""
    match call.arguments:
        case (tree.RequiredArgument(value=given),):
            return known_value(given, facts, persistents=False) in _NO_DISPLACEMENTS
        case _:
            return False
