"""Whether the statements kept for runs of alike moves may represent all of them."""

from __future__ import annotations

from bisect import bisect_right
from collections import Counter
from collections.abc import Iterator, Sequence

from rapidsim.analysis.cell_names import CellNames
from rapidsim.analysis.installed import installed_symbol, installed_type
from rapidsim.analysis.program import does
from rapidsim.analysis.rules.motion.target_data import tells_of_axes
from rapidsim.analysis.tree_walk import descendants
from rapidsim.diagnostics import Diagnostic, Span
from rapidsim.jobs.text_words import words_of
from rapidsim.library.traits import Does
from rapidsim.syntax import tree

_BY_NAME = Does.READ_BY_NAME | Does.WRITE_BY_NAME


def stand_for_all(files: Sequence[tree.File], found: Sequence[Diagnostic], cell: CellNames) -> bool:
    """Whether no finding is about a statement that represents others, or about one of these.

    Such a statement has alike ones on both sides. So a finding that does not apply to it, because
    of what it is or what is next to it, applies to none of those it represents.
    """
    stretches = {
        file.source.file: sorted(
            (run.like.start, run.end) for module in file.modules for run in module.runs
        )
        for file in files
    }
    if any(_touches(stretches.get(span.file, []), span) for one in found for span in _places(one)):
        return False
    homes = [module for file in files for module in file.modules if _declared(module)]
    if not homes:
        return True
    names = frozenset[str]().union(*map(_declared, homes))
    # What was meant by a wrong name may be one of them.
    if any("nearest" in one.violation.facts for one in found) or _asks_by_name(files):
        return False
    if not names.isdisjoint((*cell.symbols, *cell.wired)) or any(map(_is_predefined, names)):
        return False
    said_in = Counter(word for file in files for word in words_of(file.source.text) & names)
    return max(said_in.values()) == 1 and all(map(_has_alike_axes, homes))


def _declared(module: tree.Module) -> frozenset[str]:
    """The names that runs of a module declare."""
    return frozenset(name for run in module.runs for name in run.names)


def _asks_by_name(files: Sequence[tree.File]) -> bool:
    """Whether an instruction finds data by names that are made while the program runs."""
    nodes = descendants(*(module for file in files for module in file.modules))
    calls = (node for node in nodes if isinstance(node, tree.Call | tree.FunctionCall))
    return any(_BY_NAME & does(installed_symbol(call.name.key)) for call in calls)


def _places(one: Diagnostic) -> Iterator[Span]:
    if one.span is not None:
        yield one.span
    for related in one.related:
        yield related.span
    for edit in one.fix.edits if one.fix else ():
        yield edit.span


def _touches(stretches: Sequence[tuple[int, int]], span: Span) -> bool:
    """Whether a place lies in a stretch, or has one of its ends there."""
    for offset in (span.start, max(span.start, span.end - 1)):
        at = bisect_right(stretches, (offset, offset)) - 1
        for start, end in stretches[max(at, 0) : at + 2]:
            if start <= offset < end:
                return True
    return False


def _has_alike_axes(module: tree.Module) -> bool:
    """Whether all targets of a module say of external axes what those say that a run declares."""
    axes = next(run.numbers_of_like[-6:].tolist() for run in module.runs if run.names)
    inside = (node for node in descendants(module) if isinstance(node, tree.Data))
    return all(tells_of_axes(node, axes) for node in inside)


def _is_predefined(name: str) -> bool:
    return installed_symbol(name) is not None or installed_type(name) is not None
