"""Rule I804: signals in [[cross]] and [[stimulus]] that appear nowhere else."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from rapidsim.analysis.installed import installed_symbol
from rapidsim.analysis.names.signal_violations import UnknownSignal
from rapidsim.analysis.program import does
from rapidsim.analysis.suggestions import closest
from rapidsim.controller.cell.description import CellIo
from rapidsim.diagnostics import Diagnostic, Source, Span, Violation
from rapidsim.files import SourceFile, input_text
from rapidsim.jobs.inputs.job import Job
from rapidsim.jobs.inputs.text_identifiers import words_of
from rapidsim.library.traits import Trait


class MisspeltSignal(Violation, code="I804"):
    signal: str
    nearest: str | None = None

    @property
    def help(self) -> str:
        """Suggestion of the most similar signal, or of a declaration."""
        if self.nearest:
            return f"did you mean `{self.nearest}`?"
        return "declare it in [signals] if the name is intended"


def misspelt_in(job: Job, findings: Sequence[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Return misspelt signal names in a job's files; empty if only one of its tasks is checked."""
    if job.request.task is not None or not job.tables:
        return ()
    return tuple(find_misspelt(job.station.io, job.files, job.tables, findings))


def find_misspelt(
    io: CellIo,
    files: Iterable[SourceFile],
    tables: Sequence[Path],
    findings: Iterable[Diagnostic],
) -> Iterator[Diagnostic]:
    """Yield signals in connections or stimuli that no declaration, program or other table mentions.

    Args:
        io: Signals, connections and stimuli.
        files: All programs of the cell.
        tables: Files with these tables; a backup's have been checked by its controller.
        findings: The findings of the programs, for the undeclared signals that they use.
    """
    declared = [signal.name for signal in io.signals]
    written, read = ({name.lower() for name in names} for names in (io.written, io.read))
    there = {name.lower() for name in declared}
    alone = [name for name in io.wired if name.lower() not in there | (written & read)]
    if not alone:
        # The words of a long text take long to list.
        return
    used = frozenset[str]().union(*(words_of(file.text) for file in files))
    if any(Trait.LOAD in does(installed_symbol(name)) for name in used):
        # Modules loaded at run time may use more.
        return
    undeclared = (
        one.violation.signal for one in findings if isinstance(one.violation, UnknownSignal)
    )
    there |= used
    known = (name for name in io.wired if name.lower() in there)
    candidates = [*declared, *undeclared, *known]
    for name in alone:
        if name.lower() in used:
            continue
        span = _place(name, tables)
        if span is not None:
            yield Diagnostic(MisspeltSignal(name, closest(name, candidates)), span)


def _place(name: str, tables: Sequence[Path]) -> Span | None:
    """First occurrence of a name in the files; None if there is no occurrence."""
    for file in tables:
        text = input_text(file)
        match = re.search(rf"\b{re.escape(name)}\b", text)
        if match is not None:
            return Span(Source(str(file), text), match.start(), match.end())
    return None
