"""Rules M510, M511 and M514: data of targets, individually and in comparison."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, TypeAlias

from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.facts.known_values import Value, known_value, numbers
from rapidsim.analysis.rules.facts.written_numbers import part_span
from rapidsim.diagnostics import Diagnostic, Related, Violation
from rapidsim.syntax import tree
from rapidsim.syntax.tree.bulk_statements import EXTAX, ROBCONF
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.syntax.bulk_reading import Mask
    from rapidsim.syntax.tree.bulk_statements import Numbers

_UNUSED = 8.9e9
"""Value from which external axes are not connected: 9E9, written in various forms."""
_ALSO_UNUSED = (0.0, 9999.0)
"""Values that other tools write for axes that are not connected."""
_CONFIGURATION, _EXTERNAL = 2, 3
_QUARTERS = 12
"""Three revolutions of an axis in either direction; robot axes turn no further."""
_LAST_BRANCH = 7
"""Largest number of the eight branches of an arm with six axes."""


class ExternalAxisValue(Violation, code="M510"):
    target: str
    actual: str
    axis: str
    other_text: str
    usual: str


class BadConfdata(Violation, code="M511"):
    component: str
    target: str
    value: str
    allowed: str


class DuplicateTargets(Violation, code="M514"):
    target: str
    other_name: str


@value_class(frozen=True, slots=True)
class _Target:
    """A declared target with the value in the text."""

    part: ProgramPart
    node: tree.Data
    value: tuple[Value, ...]


_AxisUses: TypeAlias = "dict[tuple[int, bool], list[_Target]]"


def have_equal_axes(targets: Numbers) -> Mask:
    """Return which targets (k,) of numbers (k, 17) have the external axes of the first."""
    equal: Mask = (targets[:, EXTAX] == targets[0, EXTAX]).all(axis=1)
    return equal


def have_good_confdata(targets: Numbers) -> Mask:
    """Return which targets (k,) of numbers (k, 17) have valid configuration data of six axes."""
    confdata = targets[:, ROBCONF]
    turns, branch = confdata[:, :3], confdata[:, 3]
    good: Mask = (confdata % 1.0 == 0.0).all(axis=1)
    good &= (abs(turns) <= _QUARTERS).all(axis=1) & (branch >= 0.0) & (branch <= _LAST_BRANCH)
    return good


def find_external_axes(facts: Facts) -> Iterator[Diagnostic]:
    """Report targets of a module whose use of an external axis differs from most others."""
    by_module: dict[tree.Module, list[_AxisUses]] = {}
    for part, uses in facts.in_parts(_axis_uses):
        by_module.setdefault(part.module, []).append(uses)
    for of_parts in by_module.values():
        for k, letter in enumerate("abcdef"):
            unused, used = (
                [target for uses in of_parts for target in uses.get((k, is_unused), ())]
                for is_unused in (True, False)
            )
            if not unused or not used or len(unused) == len(used):
                continue
            usual = len(unused) > len(used)
            count = max(len(unused), len(used))
            others = f"{count} others" if count > 1 else "the other"
            for target in used if usual else unused:
                here = ("a position", "9E9") if usual else ("9E9", "a position")
                words = target.node.name.text, here[0], letter, others, f"give {here[1]}"
                place = part_span(target.part.module, _value(target.node), (_EXTERNAL, k))
                yield target.part.finding_at(ExternalAxisValue(*words), place)


def _axis_uses(part: ProgramPart, facts: Facts) -> _AxisUses:
    """Targets by number of an external axis, and whether they do not use it.

    Zero may be a position on a track or undefined, so it never counts.
    """
    found: _AxisUses = {}
    for target in facts.of_part(_targets_of, part):
        axes = numbers(target.value[_EXTERNAL], 6)
        for k, value in enumerate(axes or ()):
            if value not in _ALSO_UNUSED:
                found.setdefault((k, value >= _UNUSED), []).append(target)
    return found


def declares_axes_alike_targets(node: tree.Data, usual: Sequence[float]) -> bool:
    """Whether a declaration uses the same external axes as targets with these positions.

    If so, the number of such declarations does not change the findings.
    """
    if node.type.key != "robtarget" or node.dimensions or node.value is None:
        return True
    if not isinstance(node.value, tree.LiteralAggregate) or len(node.value.value) != 4:
        return False
    axes = numbers(node.value.value[_EXTERNAL], 6)
    return axes is not None and all(
        own in _ALSO_UNUSED or other in _ALSO_UNUSED or (own >= _UNUSED) == (other >= _UNUSED)
        for own, other in zip(axes, usual, strict=True)
    )


def find_bad_confdata(facts: Facts) -> Iterator[Diagnostic]:
    """Report declared targets with invalid configuration data."""
    for target in _targets(facts):
        configuration = numbers(target.value[_CONFIGURATION], 4)
        if configuration is None or max(abs(cf) for cf in configuration) >= _UNUSED:
            continue
        for k, (component, cf) in enumerate(
            zip(("cf1", "cf4", "cf6", "cfx"), configuration, strict=True)
        ):
            allowed = _allowed(component, cf)
            if allowed is not None:
                name = target.node.name.text
                place = part_span(target.part.module, _value(target.node), (_CONFIGURATION, k))
                violation = BadConfdata(component, name, f"{cf:g}", allowed)
                yield target.part.finding_at(violation, place)


def find_duplicates(facts: Facts) -> Iterator[Diagnostic]:
    """Report declared targets with the same value as an earlier one."""
    first: dict[tuple[Value, ...], _Target] = {}
    for target in _targets(facts):
        other = first.setdefault(target.value, target)
        if other is not target:
            name = other.node.name
            place = Related(other.part.module.span(name), "the first one")
            violation = DuplicateTargets(target.node.name.text, name.text)
            yield target.part.finding(violation, target.node.name, place)


def _targets(facts: Facts) -> Iterator[_Target]:
    for part in facts.parts:
        yield from facts.of_part(_targets_of, part)


def _targets_of(part: ProgramPart, facts: Facts) -> list[_Target]:
    found: list[_Target] = []
    for node in part.all(tree.Data):
        if node.type.key != "robtarget" or node.dimensions:
            continue
        if not isinstance(node.value, tree.LiteralAggregate | tree.Aggregate):
            continue
        value = known_value(node.value, facts)
        if isinstance(value, tuple) and len(value) == 4:
            found.append(_Target(part, node, value))
    return found


def _value(node: tree.Data) -> tree.Node:
    assert node.value is not None
    return node.value


def _allowed(component: str, cf: float) -> str | None:
    """Description of the valid values of a component; None if its value is valid."""
    if component == "cfx":
        digits = f"{cf:.0f}".zfill(4)
        # Arms with seven axes: four binary choices, one digit each.
        is_seven = cf.is_integer() and len(digits) == 4 and digits[0] in "0145"
        is_seven = is_seven and set(digits[1:]) <= {"0", "1", "4", "5"}
        fits = cf.is_integer() and (0 <= cf <= _LAST_BRANCH or is_seven)
        return None if fits else f"0 to {_LAST_BRANCH}"
    fits = cf.is_integer() and abs(cf) <= _QUARTERS
    return None if fits else "a whole number of quarter turns"
