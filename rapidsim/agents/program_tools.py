"""Tools that look at programs: check, run, fix, diff."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from rapidsim.agents.paging import Answer, paged
from rapidsim.agents.programs import SentProgram, sent_program
from rapidsim.applications.diff.compare import compare
from rapidsim.applications.diff.rendering import as_json
from rapidsim.controller.journal.events import EventKind
from rapidsim.diagnostics import Diagnostic
from rapidsim.jobs.checking.check_files import check_job, check_tasks
from rapidsim.jobs.checking.fixes import apply_fixes
from rapidsim.jobs.inputs.job import job
from rapidsim.jobs.running.run_files import ProgramRejectedError, run_job
from rapidsim.simulation.results.verdict import run_verdict


def check(
    files: Mapping[str, str],
    robot: str | None = None,
    station: str | None = None,
    strict: bool = True,
    cursor: int = 0,
) -> Answer:
    """Check a program: syntax, names, types, flow, motion data, reach.

    Returns:
        `ok`, `findings` (file, line, column, code, severity, message, help), `coverage` of moves,
        `qualifications` of the verdict, `next_cursor`.

    Raises:
        InputError: If the input cannot be used.
    """
    with sent_program(files, robot, station, strict=strict) as program:
        result = check_job(job(program.request))
        coverage = result.coverage
        unchecked = [
            {
                "file": program.text(move.span.file),
                "line": move.span.line,
                "reason": program.text(move.reason),
            }
            for move in coverage.unchecked
        ]
        answer = {
            "ok": result.ok,
            "findings": _findings(result.diagnostics, program),
            "unchecked": unchecked,
            "coverage": {"moves": coverage.moves, "checked": coverage.checked},
            "qualifications": [program.text(one) for one in result.qualifications],
        }
        return paged(answer, ("findings", "unchecked"), cursor)


def run(
    files: Mapping[str, str],
    robot: str | None = None,
    station: str | None = None,
    strict: bool = True,
    cursor: int = 0,
) -> Answer:
    """Run a program on the virtual controller, up to 600 s of virtual time.

    Returns:
        `ok`, `headline`, `end`, `time_s`, `moves`, `findings`, `texts` that the program wrote for
        the operator with their times, `next_cursor`.

    Raises:
        InputError: If the input cannot be used.
    """
    with sent_program(files, robot, station, strict=strict) as program:
        try:
            simulation = run_job(job(program.request)).simulation
        except ProgramRejectedError as error:
            answer: Answer = {
                "ok": False,
                "headline": "has errors and was not run",
                "end": "error",
                "time_s": 0.0,
                "moves": 0,
                "findings": _findings(error.diagnostics, program),
                "texts": [],
            }
            return paged(answer, ("findings", "texts"), cursor)
        verdict = run_verdict(simulation)
        texts = [
            {"time_s": round(event.time_s, 3), "task": event.task, "text": event.message}
            for event in simulation.events
            if event.kind is EventKind.TEXT
        ]
        answer = {
            "ok": verdict.failure is None,
            "headline": program.text(verdict.headline),
            "end": simulation.end.value,
            "time_s": round(simulation.time_s, 3),
            "moves": sum(len(one.moves) for one in simulation.robots),
            "findings": _findings(simulation.diagnostics, program),
            "texts": texts,
        }
        return paged(answer, ("findings", "texts"), cursor)


def fix(
    files: Mapping[str, str],
    robot: str | None = None,
    station: str | None = None,
    strict: bool = True,
    cursor: int = 0,
) -> Answer:
    """Apply the fixes of findings, also those that may change what the program does.

    Returns:
        `files` that have changed with their new texts, whole whatever their size; `fixed`, the
        number of findings that are gone; `findings` that are left; `next_cursor`.

    Raises:
        InputError: If the input cannot be used.
    """
    with sent_program(files, robot, station, strict=strict) as program:
        asked = job(program.request)
        found = check_job(asked).diagnostics
        cured = apply_fixes(
            asked.tasks, found, lambda tasks: check_tasks(tasks).diagnostics, unsafe=True
        )
        changed = {
            program.text(name): file.text
            for task in cured.tasks
            for file in task.files
            if (name := file.name) in cured.edits_of(asked.tasks)
        }
        for name, text in changed.items():
            (program.folder / name).write_text(text, encoding="utf-8", newline="")
        left = check_job(job(program.request)).diagnostics
        answer = {
            "ok": not any(one.severity.value == "error" for one in left),
            "files": changed,
            "fixed": cured.count,
            "findings": _findings(left, program),
        }
        return paged(answer, ("findings",), cursor)


def diff(
    before: Mapping[str, str],
    after: Mapping[str, str],
    robot: str | None = None,
    station: str | None = None,
    cursor: int = 0,
) -> Answer:
    """Compare two versions of a program: data, routines, times, findings.

    Returns:
        `same`, `changes` by kind, `next_cursor`.

    Raises:
        InputError: If the input cannot be used.
    """
    with (
        sent_program(before, robot, station, strict=False) as old,
        sent_program(after, robot, station, strict=False) as new,
    ):
        found = as_json(compare(old.request, new.request, run=True, answers=None))
        changes = [
            {"kind": kind, **_texts_of(entry, old, new)}
            for kind, entries in found.items()
            if isinstance(entries, list)
            for entry in entries
            if isinstance(entry, dict)
        ]
        return paged({"same": found.get("same"), "changes": changes}, ("changes",), cursor)


def _findings(diagnostics: Iterable[Diagnostic], program: SentProgram) -> list[Answer]:
    ordered = sorted(diagnostics, key=lambda one: (_rank(one), one.order, one.code))
    return [_finding(one, program) for one in ordered]


def _rank(diagnostic: Diagnostic) -> int:
    """Errors come first: a page may end before the notes."""
    return ("error", "warning", "note").index(diagnostic.severity.value)


def _finding(diagnostic: Diagnostic, program: SentProgram) -> Answer:
    span, violation = diagnostic.span, diagnostic.violation
    place = (
        {}
        if span is None
        else {"file": program.text(span.file), "line": span.line, "column": span.column}
    )
    help_text = {"help": program.text(violation.help)} if violation.help else {}
    return {
        "code": violation.code,
        "severity": diagnostic.severity.value,
        "message": program.text(violation.message),
        **place,
        **help_text,
        "fixable": diagnostic.fix is not None,
    }


def _texts_of(value: Any, old: SentProgram, new: SentProgram) -> Any:
    match value:
        case str():
            return new.text(old.text(value))
        case list():
            return [_texts_of(one, old, new) for one in value]
        case dict():
            return {key: _texts_of(one, old, new) for key, one in value.items()}
        case _:
            return value
