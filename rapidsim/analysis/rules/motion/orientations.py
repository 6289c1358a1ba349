"""Rule M501 for literal quaternions."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.facts.known_values import numbers
from rapidsim.analysis.rules.facts.written_numbers import part_span
from rapidsim.diagnostics import Diagnostic, Edit, Fix
from rapidsim.language.target_violations import TOLERATED_NORM_ERROR, QuaternionNotUnit
from rapidsim.language.types import ArrayOf, Record, Type, resolved
from rapidsim.syntax import tree
from rapidsim.syntax.tree.bulk_statements import ROT

if TYPE_CHECKING:
    from rapidsim.syntax.bulk_reading import Mask
    from rapidsim.syntax.tree.bulk_statements import Numbers

_TYPO = 0.1
"""Deviation of the length from 1 beyond which a number is wrong; normalising would hide that."""


def have_unit_length(targets: Numbers) -> Mask:
    """Return which targets (k,) of numbers (k, 17) have orientations of length 1, by a margin."""
    length = (targets[:, ROT] ** 2).sum(axis=1) ** 0.5
    good: Mask = abs(length - 1.0) <= 0.9 * TOLERATED_NORM_ERROR
    return good


def find_bad_orientations(facts: Facts) -> Iterator[Diagnostic]:
    """Report literal quaternions in declarations and statements, in any record."""
    paths: dict[type, tuple[tuple[int, ...], ...]] = {}
    for part in facts.parts:
        declared = {node.value: node for node in part.all(tree.Data) if node.value is not None}
        for node in part.all(tree.LiteralAggregate):
            of = facts.analysis.type_of.get(node)
            if of is not None:
                yield from _in_value(node, node.value, of, declared.get(node), part, paths)


def _in_value(
    node: tree.Node,
    value: object,
    of: Type,
    declared: tree.Data | None,
    part: ProgramPart,
    paths: dict[type, tuple[tuple[int, ...], ...]],
    prefix: tuple[int, ...] = (),
) -> Iterator[Diagnostic]:
    base = resolved(of)
    if isinstance(base, ArrayOf):
        element: Type = base.element
        if len(base.dimensions) > 1:
            element = ArrayOf(base.element, base.dimensions[1:])
        for k, inner in enumerate(value if isinstance(value, tuple) else ()):
            yield from _in_value(node, inner, element, declared, part, paths, (*prefix, k))
        return
    if not isinstance(base, Record):
        return
    # Two records of one name have different classes, and a class hashes faster than its type.
    if base.python not in paths:
        paths[base.python] = tuple(_orientations(base))
    for path in paths[base.python]:
        quaternion = numbers(_inner(value, path), 4)
        if quaternion is None:
            continue
        length = math.hypot(*quaternion)
        if abs(length - 1.0) <= TOLERATED_NORM_ERROR:
            continue
        if length == 0.0 and declared is not None and declared.storage == "VAR":
            # The default value until the program assigns one.
            continue
        place = part_span(part.module, node, (*prefix, *path))
        name = " ".join(place.text.split()) if declared is None else declared.name.text
        violation = QuaternionNotUnit(name, length)
        fix = None
        if abs(length - 1.0) < _TYPO:
            text = ",".join(f"{q / length:.9g}" for q in quaternion)
            fix = Fix("divide by the length", (Edit(place, f"[{text}]"),))
        yield part.finding_at(violation, place, fix=fix)


def _orientations(of: Type) -> Iterator[tuple[int, ...]]:
    """Return the paths to the components of a record that are orientations."""
    base = resolved(of)
    if not isinstance(base, Record):
        return
    if base.name == "orient":
        yield ()
        return
    for k, component in enumerate(base.components):
        for path in _orientations(component.type):
            yield (k, *path)


def _inner(value: object, path: tuple[int, ...]) -> object:
    for k in path:
        if not isinstance(value, tuple) or k >= len(value):
            return None
        value = value[k]
    return value
