"""Check that the statements kept of bulk statements may represent all of them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from rapidsim.analysis.cell_names import CellNames
from rapidsim.analysis.context import MOST_COMPARED
from rapidsim.analysis.installed import has_installed, installed_symbol
from rapidsim.analysis.names.name_violations import UndefinedName, UnseenName
from rapidsim.analysis.program import does
from rapidsim.analysis.rules.motion.target_data import declares_axes_alike_targets
from rapidsim.analysis.suggestions import closest
from rapidsim.analysis.tree_walk import descendants
from rapidsim.diagnostics import Diagnostic
from rapidsim.jobs.checking.row_findings import repeat_findings
from rapidsim.jobs.inputs.text_identifiers import words_of
from rapidsim.language.single_precision import LARGEST_SINGLE
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree
from rapidsim.syntax.bulk_reading import BulkReading

if TYPE_CHECKING:
    from rapidsim.analysis.rules.table import Detector
    from rapidsim.syntax.bulk_reading import Mask
    from rapidsim.syntax.tree.bulk_statements import Numbers

_SMALLEST = 1e-30
"""Smaller numbers lose digits in single precision."""
_BY_NAME = Trait.READ_BY_NAME | Trait.WRITE_BY_NAME | Trait.LOAD


def bulk_reading(more_than: int, *, keeps_data: bool = False) -> BulkReading:
    """Return how bulk statements are read; see `BulkReading`.

    Rules declare in their table which targets they have no reason to look at by themselves.
    """
    return BulkReading(more_than, _are_plain, _are_plain_data, _is_plain_output, keeps_data)


def _is_plain_output(instruction: str) -> bool:
    """Whether an installed instruction sets an output, and nothing else."""
    traits = does(installed_symbol(instruction.lower()))
    return Trait.OUTPUT in traits and Trait.MOVE not in traits


def _are_plain(targets: Numbers) -> Mask:
    """Which targets (k,) of numbers (k, 17), as written, are of no interest by themselves."""
    size = abs(targets)
    plain: Mask = ((size < LARGEST_SINGLE) & ((size >= _SMALLEST) | (size == 0.0))).all(axis=1)
    for detector in _detectors():
        if detector.of_targets is not None:
            plain &= detector.of_targets(targets)
    return plain


def _are_plain_data(targets: Numbers) -> Mask:
    """Which declared targets (k,) of numbers (k, 17) are of no interest by themselves."""
    plain = _are_plain(targets)
    for detector in _detectors():
        if detector.of_declared is not None:
            plain &= detector.of_declared(targets)
    return plain


def _detectors() -> Sequence[Detector]:
    # A run needs the rules only for a long file.
    from rapidsim.analysis.rules.table import DETECTORS

    return DETECTORS


def findings_of_all(
    files: Sequence[tree.File], findings: Sequence[Diagnostic], cell: CellNames
) -> tuple[Diagnostic, ...] | None:
    """Return the findings of a task, including those of the bulk statements that its trees omit.

    A statement that represents others has statements of its shape on both sides. A finding that
    does not apply to it, because of its text or its neighbours, applies to none of those it
    represents. An undeclared name in it is undeclared in each of these. For any other finding about
    it, each statement must be examined.

    Args:
        files: The files of the task.
        findings: The findings about the statements of the tree, in order.
        cell: Names that the configuration declares in addition to the modules.

    Returns:
        The findings in order; None if the statements of the tree may not represent the others.
    """
    repeated = repeat_findings(files, findings)
    if repeated is None or not _calls_between(files).isdisjoint(_routines(files, cell)):
        return None
    homes = [module for file in files for module in file.modules if _declared(module)]
    if not homes:
        return repeated
    names = frozenset[str]().union(*map(_declared, homes))
    if _may_be_meant(names, findings) or _searches_by_name(files):
        return None
    if not names.isdisjoint((*cell.symbols, *cell.wired)) or has_installed(names):
        return None
    if len(files) > 1:
        said_in = Counter(word for file in files for word in words_of(file.source.text) & names)
        if max(said_in.values()) > 1:
            return None
    return repeated if all(map(_has_uniform_axes, homes)) else None


def _calls_between(files: Sequence[tree.File]) -> frozenset[str]:
    """Folded names of the instructions between bulk moves, as installed."""
    runs = (run for file in files for module in file.modules for run in module.runs)
    return frozenset(one.like.name.key for run in runs for one in run.between)


def _routines(files: Sequence[tree.File], cell: CellNames) -> frozenset[str]:
    """Folded names that hide installed ones."""
    modules = (module for file in files for module in file.modules)
    return (
        frozenset(one.name.key for module in modules for one in module.routines)
        | cell.symbols.keys()
    )


def _may_be_meant(names: Iterable[str], findings: Sequence[Diagnostic]) -> bool:
    """Whether an unknown name in the findings may be a misspelling of one of the names."""
    suggestions = [one.violation for one in findings if "nearest" in one.violation.facts]
    kinds = UndefinedName | UnseenName
    unknown = {one.undefined for one in suggestions if isinstance(one, kinds)}
    is_other = any(not isinstance(one, kinds) for one in suggestions)
    # With so many names, not all are compared.
    return (
        is_other
        or len(unknown) >= MOST_COMPARED
        or any(closest(name, names) is not None for name in unknown)
    )


def _declared(module: tree.Module) -> frozenset[str]:
    """Names that bulk statements of a module declare."""
    return frozenset(name for run in module.runs for name in run.names)


def _searches_by_name(files: Sequence[tree.File]) -> bool:
    """Whether an instruction finds data by names that only a run knows, or loads a text of them."""
    nodes = descendants(*(module for file in files for module in file.modules))
    calls = (node for node in nodes if isinstance(node, tree.Call | tree.FunctionCall))
    return any(_BY_NAME & does(installed_symbol(call.name.key)) for call in calls)


def _has_uniform_axes(module: tree.Module) -> bool:
    """Whether all targets of a module have the external axes of the bulk targets."""
    axes = next(run.numbers_of_like[-6:].tolist() for run in module.runs if run.names)
    inside = (node for node in descendants(module) if isinstance(node, tree.Data))
    return all(declares_axes_alike_targets(node, axes) for node in inside)
