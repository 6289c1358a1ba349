"""Rule F411: settings of the motion that a routine does not put back on every way out."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from rapidsim.analysis.program_parts import ENTRY, Facts, Part
from rapidsim.analysis.rules.facts.known_values import known_value
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.library.table import LibraryRoutine
from rapidsim.library.traits import Does
from rapidsim.syntax import tree


class ModeLeak(Violation, code="F411"):
    setting: str
    routine: str
    ends: str
    back: str


@dataclass(frozen=True, slots=True)
class _Setting:
    """What an instruction sets: a mode, by what puts it back, and whether it does that itself."""

    mode: str
    is_back: bool


_Open = Mapping[str, tree.Call]
"""The modes that may be in force, each with the instruction that set it."""


def find_mode_leaks(facts: Facts) -> Iterator[Diagnostic]:
    """For each routine and mode the first way out on which the mode may be left on."""
    for part in facts.routine_parts:
        routine = part.routine
        if not isinstance(routine, tree.Proc | tree.Func) or routine.name.key == ENTRY:
            continue
        calls = part.all(tree.Call)
        if not any(_setting(call, facts) for call in calls):
            continue
        if not part.nodes.keys().isdisjoint((tree.Goto, tree.Broken)):
            continue
        leaks = _Leaks(part, facts)
        left = leaks.follow(routine.body, {})
        if left is not None:
            leaks.end(left, "ends")
        moves = [call.start for call in calls if Does.MOVE in facts.does(call)]
        for mode, (call, ends) in leaks.found.items():
            if any(start > call.start for start in moves):
                shown = " ".join(part.module.span(call).text.split())
                violation = ModeLeak(shown, routine.name.text, ends, mode)
                yield part.finding(violation, call)


class _Leaks:
    """Follows the ways through one routine and keeps what is in force where they end."""

    def __init__(self, part: Part, facts: Facts) -> None:
        self._part = part
        self._facts = facts
        self.found: dict[str, tuple[tree.Call, str]] = {}

    def end(self, open_modes: _Open, ends: str) -> None:
        """A way out of the routine."""
        for mode, call in open_modes.items():
            self.found.setdefault(mode, (call, ends))

    def follow(self, body: tree.Body, open_modes: _Open) -> _Open | None:
        """What may be in force behind a list; None where execution never gets there."""
        current: _Open | None = open_modes
        for statement in body:
            if current is None:
                return None
            current = self._step(statement, current)
        return current

    def _step(self, statement: tree.Statement, current: _Open) -> _Open | None:
        match statement:
            case tree.Call():
                setting = _setting(statement, self._facts)
                if setting is None:
                    return current
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


def _joined(ways: list[_Open | None]) -> _Open | None:
    """What may be in force where ways meet."""
    arriving = [way for way in ways if way is not None]
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
        given = {one.name.key for one in call.arguments if isinstance(one, tree.Optional)}
        return not given or switches[0].lower() in given
    name, *numbers = re.split("[ ,]", name)
    if not numbers:
        return routine.name == name
    required = [one.value for one in call.arguments if isinstance(one, tree.Required)]
    values = [known_value(value, facts) for value in required[: len(numbers)]]
    # The highest speed is another on each robot; what counts is in percent.
    in_percent = [value for value, normal in zip(values, numbers, strict=False) if normal == "100"]
    return None in values or in_percent == [100.0] * numbers.count("100")
