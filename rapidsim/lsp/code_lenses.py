"""Run and record above the entry of a program and other procedures without parameters."""

from __future__ import annotations

from lsprotocol import types as lsp

from rapidsim.analysis.program_parts import ENTRY
from rapidsim.lsp.run_results import NO_RESULTS, RunResults
from rapidsim.lsp.view import Document
from rapidsim.syntax import tree

RUN, RECORD = "rapidsim.run", "rapidsim.record"
"""Commands; each takes the URI of a document and the name of a procedure.

A third argument of the second is the path of an HTML report to write as well.
"""


def code_lenses(document: Document, results: RunResults = NO_RESULTS) -> list[lsp.CodeLens]:
    """Return the lenses of a document."""
    lenses: list[lsp.CodeLens] = []
    for module in document.file.modules:
        for routine in module.routines:
            if not isinstance(routine, tree.Proc) or routine.parameters:
                continue
            place = document.node_range(routine.name)
            arguments: list[lsp.LSPAny] = [document.uri, routine.name.text]
            lenses.append(lsp.CodeLens(place, lsp.Command("Run", RUN, arguments=arguments)))
            if routine.name.key == ENTRY:
                record = lsp.Command("Record", RECORD, arguments=arguments)
                lenses.append(lsp.CodeLens(place, record))
            summary = results.summary
            if summary is not None and summary.entry.lower() == routine.name.key:
                title = summary.problem or f"{summary.time_s:.3f} s in the last run"
                lenses.append(lsp.CodeLens(place, lsp.Command(title, "")))
    return lenses
