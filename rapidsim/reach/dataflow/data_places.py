"""Values of data as declared, and after assignments to a part of them."""

from __future__ import annotations

from collections.abc import Sequence
from math import prod

from rapidsim.analysis.evaluation import Evaluator, Known, NotStatic, component_index
from rapidsim.analysis.program import DataSymbol
from rapidsim.language.initial_values import initial_value
from rapidsim.language.types import ArrayOf, resolved
from rapidsim.syntax import tree

MOST_ELEMENTS = 20_000
"""Largest array whose elements are tracked; larger ones are not worth the time."""


def empty_data(symbol: DataSymbol) -> Known:
    """Return the initial value of data declared without a value."""
    of = resolved(symbol.type)
    if isinstance(of, ArrayOf) and prod(size or 1 for size in of.dimensions) > MOST_ELEMENTS:
        return NotStatic(f"`{symbol.name}` is too large an array to be followed")
    return initial_value(symbol.type)


def replaced(evaluator: Evaluator, path: tree.DataPath, value: Known) -> Known:
    """Return the value of the data at the root of a path, after an assignment to the path."""
    if isinstance(path, tree.DataReference) or isinstance(value, NotStatic):
        return value
    outer = path.array if isinstance(path, tree.Index) else path.record
    whole = evaluator.value(outer)
    if isinstance(whole, NotStatic):
        return whole
    if isinstance(path, tree.Index):
        places = [evaluator.value(index) for index in path.indices]
        return replaced(evaluator, outer, _with_element(whole, places, value))
    of = evaluator.tables.type_of.get(path.record)
    index = None if of is None else component_index(resolved(of), path.name.key)
    if index is None:
        return NotStatic("a component of data that are no record")
    parts = list(whole)
    parts[index] = value
    return replaced(evaluator, outer, tuple.__new__(type(whole), parts))


def _with_element(array: Known, places: Sequence[Known], value: Known) -> Known:
    """Array with one element replaced; unknown if the index is unknown or out of range."""
    place, *inner = places
    if isinstance(place, NotStatic):
        return place
    if place % 1.0 or not 1 <= place <= len(array):
        return NotStatic(f"there is no element {place:g}")
    at = int(place) - 1
    changed = _with_element(array[at], inner, value) if inner else value
    if isinstance(changed, NotStatic):
        return changed
    return [*array[:at], changed, *array[at + 1 :]]
