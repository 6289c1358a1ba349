"""Names that nothing declares: signals, if they are used or named like one; mistakes else."""

from __future__ import annotations

from rapidsim.analysis.context import Analysis
from rapidsim.analysis.names.names import evident_signal, report_undefined
from rapidsim.analysis.names.signal_violations import UnknownSignal
from rapidsim.analysis.suggestions import closest
from rapidsim.analysis.types.assignability import agrees, report_mismatch
from rapidsim.language.types import BOOL, DNUM, NUM, resolved


def decide_undeclared(analysis: Analysis) -> None:
    """Take undeclared names for signals if they are used or named like one, report the others.

    A signal is reported where it stands first.
    """
    reported: set[str] = set()
    for reference, context in analysis.undeclared:
        name = reference.name
        of = analysis.signals.get(name.key) or evident_signal(name, context)
        wanted = analysis.wanted_of_undeclared.get(reference)
        if of is None:
            is_value = wanted is None or resolved(wanted.type) in (NUM, DNUM, BOOL)
            report_undefined(name, context, may_be_signal=is_value)
            continue
        if name.key not in reported and name.key not in analysis.cell.wired:
            declared = (one.name for one in analysis.cell.symbols.values() if one.type == of)
            nearest = closest(name.text, declared)
            context.report(UnknownSignal(name.text, of.name, nearest=nearest), name)
            reported.add(name.key)
        analysis.signals.setdefault(name.key, of)
        analysis.symbol_of[reference] = analysis.unknown_symbol(name.text)
        analysis.type_of.setdefault(reference, of)
        if wanted is not None and not agrees(of, wanted.type):
            report_mismatch(reference, of, wanted, context)
