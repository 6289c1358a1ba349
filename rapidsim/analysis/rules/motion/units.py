"""Rule M516: metres and radians in place of millimetres and degrees.

A single target may have any position in its work object; an export in metres is recognised because
all its targets are within a few millimetres, including approach and retreat.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING

from rapidsim.analysis.program import DataSymbol, Scope, Storage, Symbol
from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.facts.instruction_questions import MoveCall, arguments_of, moves
from rapidsim.analysis.rules.facts.known_values import Value, known_value, numbers
from rapidsim.analysis.rules.facts.taught_targets import taught_target
from rapidsim.analysis.tree_walk import descendants
from rapidsim.diagnostics import Diagnostic, Related, Severity, Violation
from rapidsim.library.predefined import DATA
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree
from rapidsim.syntax.tree.bulk_statements import TRANS

if TYPE_CHECKING:
    from rapidsim.syntax.bulk_reading import Mask
    from rapidsim.syntax.tree.bulk_statements import Numbers

_NEAREST_TARGET_MM = 10.0
"""Distance to the centre of its base within which no arm can move a tool."""
_SHORTEST_TOOL_MM = 1.0
_SLOWEST_MM_S = 1.0
"""Slower speeds are far more often mistakes than intended."""
_SLOWEST_TURN_DEG_S = 2.0
_LARGEST_COORDINATE_MM = 5.0
_SHORTEST_STEP_MM = 0.02
_MANY_TARGETS = 20
"""Number of different targets in one routine from which their unit can be inferred."""
_LONG_ENOUGH = {
    1.0 / 2.0: 2,
    1.0: 2,
    2.0: 2,
    1.0 / 3.0: 3,
    1.0 / 4.0: 3,
    1.0 / 6.0: 3,
    3.0 / 2.0: 3,
}
"""Multiples of pi, with the number of decimals from which a number is recognised as one."""
_PI = "pi"
_SPEEDS = frozenset({"speed", "v"})
"""Parameters of moves with a speed of the TCP."""


class MetresOrRadians(Violation, code="M516"):
    subject: str
    unit: str
    suggestion: str
    is_certain: bool = False

    @property
    def severity(self) -> Severity:
        """Error if a whole routine shows it."""
        return Severity.ERROR if self.is_certain else self.rule.severity


def are_away_from_base(targets: Numbers) -> Mask:
    """Return which targets (k,) of numbers (k, 17) are written in mm, by a margin."""
    distance_mm = (targets[:, TRANS] ** 2).sum(axis=1) ** 0.5
    away: Mask = distance_mm >= 1.01 * _NEAREST_TARGET_MM
    return away


def find_metres(facts: Facts) -> Iterator[Diagnostic]:
    """Report targets at the base of the arm, and tools shorter than a millimetre."""
    reported: set[object] = set()
    whole = dict(facts.in_parts(_of_whole_routine))
    yield from whole.values()
    for part, found in facts.in_parts(_at_foot):
        for symbol, finding in () if part in whole else found:
            if symbol not in reported:
                yield finding
            if symbol is not None:
                reported.add(symbol)
    for _, tools in facts.in_parts(_short_tools):
        yield from tools


def _short_tools(part: ProgramPart, facts: Facts) -> list[Diagnostic]:
    found: list[Diagnostic] = []
    for node in part.all(tree.Data):
        if node.type.key != "tooldata" or node.dimensions or node.value is None:
            continue
        value = known_value(node.value, facts)
        frame = value[1] if isinstance(value, tuple) and len(value) == 3 else None
        length = _length(frame, 0)
        if length is not None and 0.0 < length < _SHORTEST_TOOL_MM:
            what = f"the TCP of `{node.name.text}` is {length:.3g} mm from the flange"
            found.append(part.finding(_metres(what), node.name))
    return found


def _at_foot(part: ProgramPart, facts: Facts) -> list[tuple[Symbol | None, Diagnostic]]:
    """Findings of targets at the foot of the arm, with their data."""
    found: list[tuple[Symbol | None, Diagnostic]] = []
    for move in moves(part, facts):
        target = move.arguments.get("topoint")
        if target is None or not _is_from_base(move, facts):
            continue
        taught = taught_target(target, facts)
        symbol = facts.symbol(taught)
        is_variable = isinstance(symbol, DataSymbol) and symbol.storage is Storage.VAR
        if is_variable:
            continue
        distance = _length(known_value(taught, facts), 0)
        if distance is None or not 0.0 < distance < _NEAREST_TARGET_MM:
            continue
        shown = part.module.span(taught).one_line
        named = f"`{shown}`" if len(shown) < 40 else "this target"
        what = f"{named} is {distance:.3g} mm from the robot's base"
        found.append((symbol, part.finding(_metres(what), taught, *_declared(symbol, part))))
    return found


def find_slow_speeds(facts: Facts) -> Iterator[Diagnostic]:
    """Report speeds of the TCP below 1 mm/s, except for searches, where they are intended."""
    searching = {node for _, speeds in facts.in_parts(_speeds_of_searches) for node in speeds}
    for _, slow in facts.in_parts(_slow_speeds):
        for node, finding in slow:
            if node not in searching:
                yield finding


def _slow_speeds(part: ProgramPart, facts: Facts) -> list[tuple[tree.Node, Diagnostic]]:
    """Slow speeds that are declared or given to moves, with their nodes."""
    found: list[tuple[tree.Node, Diagnostic]] = []
    for node in part.all(tree.Data):
        if node.type.key == "speeddata" and not node.dimensions and node.value is not None:
            speed = _slow_speed(known_value(node.value, facts))
            if speed is not None:
                what = f"the speed of the TCP in `{node.name.text}`"
                found.append((node, part.finding(_metres_per_second(what, speed), node.name)))
    for move in moves(part, facts):
        if Trait.SEARCH in move.does:
            continue
        for key in _SPEEDS & move.arguments.keys():
            value = move.arguments[key]
            if value is None or isinstance(value, tree.DataReference):
                continue
            speed = _slow_speed(known_value(value, facts))
            if speed is not None:
                violation = _metres_per_second("this speed", speed)
                found.append((value, part.finding(violation, value)))
    return found


def _speeds_of_searches(part: ProgramPart, facts: Facts) -> frozenset[tree.Node]:
    """Declarations of the speeds of searches."""
    searches = (move for move in moves(part, facts) if Trait.SEARCH in move.does)
    symbols = (facts.symbol(move.arguments.get("speed")) for move in searches)
    return frozenset(
        symbol.node
        for symbol in symbols
        if isinstance(symbol, DataSymbol) and symbol.node is not None
    )


def find_radians(facts: Facts) -> Iterator[Diagnostic]:
    """Report angles that are computed with pi, or are fractions of it."""
    for part in facts.parts:
        for node in part.all(tree.Data):
            if node.type.key == "jointtarget" and not node.dimensions and node.value is not None:
                declared = known_value(node.value, facts)
                axes = numbers(declared[0], 6) if isinstance(declared, tuple) and declared else None
                if axes is not None and _are_radians(axes):
                    what = f"the axes of `{node.name.text}`"
                    yield part.finding(_radians(what), node.name)
        for call in part.all(tree.FunctionCall):
            if Trait.ANGLES not in facts.does(call):
                continue
            for formal, value in arguments_of(call, facts):
                if formal is None or value is None or not _is_angle(formal.key):
                    continue
                if _is_made_with_pi(value, facts) or _is_part_of_pi(known_value(value, facts)):
                    shown = part.module.span(value).one_line
                    what = f"`{shown}` for {formal.spelled} of {call.name.text}"
                    yield part.finding(_radians(what), value)


def _of_whole_routine(part: ProgramPart, facts: Facts) -> Diagnostic | None:
    """Finding that the targets of a routine are in metres; None if they do not show it."""
    positions = list(_positions(part, facts))
    is_call = (run for run in part.module.runs if isinstance(run.like, tree.Call))
    runs = [run for run in is_call if part.contains(run.like)]
    many = len({position for _, position in positions}) + sum(map(len, runs))
    if not positions or many < _MANY_TARGETS:
        return None
    count = len(positions)
    if runs:
        # Targets near the origin are among the statements, so bulk targets are not all near it.
        steps_mm = [_longest_step_mm(run) for run in runs]
        count += sum(map(len, runs))
    else:
        steps_mm = [math.dist(one, other) for (_, one), (_, other) in pairwise(positions)]
    largest_mm = max(abs(coordinate) for _, position in positions for coordinate in position)
    if not runs and largest_mm < _LARGEST_COORDINATE_MM:
        what = f"all {count} targets lie within {_LARGEST_COORDINATE_MM:g} mm of an origin"
    elif max(steps_mm) < _SHORTEST_STEP_MM:
        what = f"all {count} moves are shorter than {_SHORTEST_STEP_MM:g} mm"
    else:
        return None
    return part.finding(_metres(what, is_certain=True), positions[0][0])


def _positions(
    part: ProgramPart, facts: Facts
) -> Iterator[tuple[tree.Expression, tuple[float, ...]]]:
    """Targets of moves with their positions [mm], if these are known."""
    for move in moves(part, facts):
        target = move.arguments.get("topoint")
        value = known_value(target, facts)
        position = numbers(value[0], 3) if isinstance(value, tuple) and value else None
        if target and position is not None:
            yield target, position


def _longest_step_mm(run: tree.BulkStatements) -> float:
    """Longest distance [mm] between consecutive targets of bulk statements."""
    places = run.numbers[:, :3]
    squares = ((places[1:] - places[:-1]) ** 2).sum(axis=1)
    return math.sqrt(squares.max(initial=0.0))


def _metres(subject: str, *, is_certain: bool = False) -> MetresOrRadians:
    cure = "RAPID counts in millimetres: multiply by 1000"
    return MetresOrRadians(subject, "metres", cure, is_certain)


def _metres_per_second(subject: str, speed: float) -> MetresOrRadians:
    cure = f"RAPID counts in mm/s: {speed:g} m/s are {1000.0 * speed:g}"
    return MetresOrRadians(f"{subject} is {speed:g} mm/s", "metres per second", cure)


def _radians(subject: str) -> MetresOrRadians:
    return MetresOrRadians(subject, "radians", "RAPID counts in degrees: multiply by 180/pi")


def _is_from_base(move: MoveCall, facts: Facts) -> bool:
    """Whether a target refers to the base of the arm, as far as the program shows."""
    if "wobj" not in move.arguments:
        return True
    symbol = facts.symbol(move.arguments["wobj"])
    return isinstance(symbol, DataSymbol) and symbol.scope is Scope.INSTALLED


def _length(value: object, position: int) -> float | None:
    """Distance [mm] of a position component of a record from its origin."""
    if not isinstance(value, tuple) or len(value) <= position:
        return None
    place = numbers(value[position], 3)
    return None if place is None else math.hypot(*place)


def _slow_speed(value: object) -> float | None:
    """Speed [mm/s] of the TCP, or of speed data, if it is suspiciously slow; else None.

    If the tool reorients as slowly, as in milling, it is intended.
    """
    speed, *others = value if isinstance(value, tuple) and value else (value,)
    turning = others[0] if others else None
    if isinstance(turning, float) and turning <= _SLOWEST_TURN_DEG_S:
        return None
    return speed if isinstance(speed, float) and 0.0 < speed < _SLOWEST_MM_S else None


def _declared(symbol: object, part: ProgramPart) -> tuple[Related, ...]:
    if not isinstance(symbol, DataSymbol) or symbol.node is None or symbol.module is None:
        return ()
    module = part.module if symbol.scope is Scope.ROUTINE else symbol.module
    return (Related(module.span(symbol.node), "declared here"),)


def _are_radians(axes: tuple[float, ...]) -> bool:
    """Whether axis positions are within a revolution in radians, and parts of pi."""
    telling = [axis for axis in axes if axis != 0.0]
    return max(map(abs, axes)) < 2.1 * math.pi and sum(map(_is_part_of_pi, telling)) >= 2


def _is_angle(key: str) -> bool:
    return key in ("rx", "ry", "rz") or key.endswith("angle")


def _is_made_with_pi(expression: tree.Expression, facts: Facts) -> bool:
    """Whether an angle is a multiple of pi, and not divided by it."""
    match expression:
        case tree.DataReference():
            return facts.symbol(expression) is not None and _is_predefined_pi(expression, facts)
        case tree.Parenthesised(inner=inner) | tree.Unary(operand=inner):
            return _is_made_with_pi(inner, facts)
        case tree.Binary(left=left, operator="*", right=right):
            sides = (left, right)
            by_pi = any(
                isinstance(node, tree.Binary) and node.operator == "/" and _names_pi(node.right)
                for node in descendants(expression)
            )
            return not by_pi and any(_is_made_with_pi(side, facts) for side in sides)
        case tree.Binary(left=left, operator="/" | "+" | "-", right=right):
            return _is_made_with_pi(left, facts) and not _names_pi(right)
        case _:
            return False


def _is_predefined_pi(reference: tree.DataReference, facts: Facts) -> bool:
    symbol = facts.symbol(reference)
    is_installed = isinstance(symbol, DataSymbol) and symbol.scope is Scope.INSTALLED
    return is_installed and reference.name.key == _PI and _PI in DATA


def _names_pi(expression: tree.Expression) -> bool:
    return any(
        isinstance(node, tree.DataReference) and node.name.key == _PI
        for node in descendants(expression)
    )


def _is_part_of_pi(value: Value | None) -> bool:
    """Whether a number is a fraction of pi, or twice pi, to the precision of its digits."""
    if not isinstance(value, float):
        return False
    angle = abs(value)
    decimals = len(f"{angle:.7g}".partition(".")[2])
    return any(
        decimals >= needed and abs(angle - multiple * math.pi) < 10.0**-decimals
        for multiple, needed in _LONG_ENOUGH.items()
    )
