"""Undeclared names: signals if they are used or spelt like one, otherwise errors."""

from __future__ import annotations

from collections.abc import Iterable

from rapidsim.analysis.context import Analysis, Context
from rapidsim.analysis.names.names import evident_signal, report_undefined
from rapidsim.analysis.names.signal_violations import UnknownSignal
from rapidsim.analysis.suggestions import closest
from rapidsim.analysis.types.assignability import agrees, report_mismatch
from rapidsim.language.types import BOOL, DNUM, NUM, SIGNAL_DI, Type, resolved
from rapidsim.library.system_signals import system_signal
from rapidsim.syntax import tree


def decide_undeclared(
    uses: Iterable[tuple[tree.DataReference, Context]],
    analysis: Analysis,
    reported: set[str],
    compared: frozenset[str],
) -> None:
    """Resolve undeclared names to signals if used or spelt like one; report the others.

    Args:
        uses: The uses in one unit, in source order.
        analysis: Receives the results.
        reported: Folded names of the signals that were reported at their first use.
        compared: Folded names that are compared as signals are, if the cell assumes them.
    """
    for reference, context in uses:
        name = reference.name
        key = name.key
        of = (
            analysis.signals.get(key)
            or evident_signal(name, context)
            or _of_siblings(key, analysis)
            or (SIGNAL_DI if key in compared else None)
        )
        wanted = analysis.wanted_of_undeclared.get(reference)
        if of is None:
            is_value = wanted is None or resolved(wanted.type) in (NUM, DNUM, BOOL)
            report_undefined(name, context, may_be_signal=is_value)
            continue
        if key not in reported and key not in analysis.cell.wired:
            declared = (one.name for one in analysis.cell.symbols.values() if one.type == of)
            nearest = closest(name.text, declared)
            closed = analysis.cell.has_signals and not analysis.cell.assumes
            # The controller makes it, whatever its configuration lists.
            closed &= system_signal(name.text) is None
            violation = UnknownSignal(name.text, of.name, nearest=nearest, is_closed=closed)
            context.report(violation, name, fix=context.respelling(name, nearest))
            reported.add(key)
        analysis.signals.setdefault(key, of)
        analysis.symbol_of[reference] = analysis.unknown_symbol(name.text)
        analysis.type_of.setdefault(reference, of)
        if wanted is not None and not agrees(of, wanted.type):
            report_mismatch(reference, of, wanted, context)


def _of_siblings(key: str, analysis: Analysis) -> Type | None:
    """Kind of the signals whose names share the first word, if that word indicates a kind.

    For example, `WaitDI DIPLC_Ready,1` makes `DIPLC_Service` a signal as well.
    """
    word, underscore, _ = key.partition("_")
    if not underscore:
        return None
    for sibling, of in analysis.signals.items():
        if sibling.startswith(f"{word}_") and word.startswith(of.name[-2:]):
            return of
    return None
