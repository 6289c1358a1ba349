"""`rapidsim run --assert` and the cycle budget: read before a run and judged after it."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from rapidsim.analysis.names.name_violations import UndefinedName
from rapidsim.analysis.names.signal_violations import UnknownSignal
from rapidsim.analysis.program import Program, UnknownSymbol
from rapidsim.cli.terminal import Terminal, echo
from rapidsim.controller.cell.description import CellIo
from rapidsim.diagnostics import Diagnostic
from rapidsim.files import InputError, did_you_mean
from rapidsim.interpreter.tools.expression_queries import (
    ExpressionQuery,
    QueryError,
    answers,
    check_query,
    own_names,
)
from rapidsim.report.findings.source_frame import source_frame
from rapidsim.report.run.assertion_figures import ASKED_FIGURES
from rapidsim.report.run.verdicts import AssertionVerdict, BudgetVerdict
from rapidsim.simulation.result_builder import FinishedRun
from rapidsim.simulation.results.simulation import End
from rapidsim.values import value_class

LABEL = "--assert"
_MAIN = "main"
_PREFIX = re.compile(r"\s*([A-Za-z]\w*)\s*:(?!=)")
_CUT = {
    End.ERROR: "the run stopped with an error",
    End.TIME_LIMIT: "the run was cut off",
}
"""Ends after which nothing is judged: what the program would have left is not known."""


@value_class(frozen=True, slots=True)
class Assertion:
    """An expression, and the task in which to evaluate it."""

    text: str
    """The text as typed."""
    task: str
    question: ExpressionQuery


def read_assertions(
    texts: Sequence[str],
    programs: Mapping[str, Program],
    io: CellIo,
    terminal: Terminal,
) -> tuple[Assertion, ...]:
    """Check expressions before the run.

    Args:
        texts: As the user gave them.
        programs: Of the tasks, by name.
        io: The signals that the station declares.
        terminal: Where mistakes in them are shown.

    Raises:
        InputError: If one is wrong.
    """
    return tuple(_read(text, programs, io, terminal) for text in texts)


def judge_assertions(
    assertions: Sequence[Assertion], run: FinishedRun, figures: Mapping[str, float]
) -> tuple[AssertionVerdict, ...]:
    """Judge expressions after the run, in the order of the command line."""
    reason = _CUT.get(run.simulation.end)
    if reason is not None:
        return tuple(AssertionVerdict(one.text, one.task, None, {}, reason) for one in assertions)
    verdicts: dict[int, AssertionVerdict] = {}
    for name, task in run.tasks.items():
        asked = [(place, one) for place, one in enumerate(assertions) if one.task == name]
        if not asked:
            continue
        found = answers(task, [one.question for _, one in asked], figures)
        for (place, one), answer in zip(asked, found, strict=True):
            verdicts[place] = AssertionVerdict(
                one.text, name, answer.holds, dict(answer.values), answer.error
            )
    return tuple(verdicts[place] for place in range(len(assertions)))


def judge_budget(
    budget_s: float | None, run: FinishedRun, cycles: int, entry: str
) -> BudgetVerdict | None:
    """Whether a cycle of main keeps its budget; None if the station file has no budget."""
    if budget_s is None:
        return None
    end, time_s = run.simulation.end, run.simulation.time_s
    model = run.simulation.model.version
    reason = _CUT.get(end)
    if entry.lower() != _MAIN:
        reason = f"it is about `main`, and `{entry}` was run"
    elif end is End.STOPPED and (cycles > 1 or time_s <= budget_s):
        reason = "the program stopped itself before the end of its cycle"
    if reason is not None:
        return BudgetVerdict(budget_s, None, cycles, model, None, reason)
    cycle_s = time_s / cycles
    return BudgetVerdict(budget_s, cycle_s, cycles, model, cycle_s <= budget_s, None)


def _read(text: str, programs: Mapping[str, Program], io: CellIo, terminal: Terminal) -> Assertion:
    expression, asked = _tasks(text, programs)
    good: dict[str, ExpressionQuery] = {}
    bad: dict[str, tuple[Diagnostic, ...]] = {}
    for name, program in asked.items():
        try:
            found = check_query(expression, LABEL, program, ASKED_FIGURES)
        except QueryError as error:
            raise InputError(f"{LABEL} `{text}`: {error}") from None
        if found.question is None or found.findings:
            bad[name] = found.findings
        else:
            good[name] = found.question
    if not good:
        name, (first, *_) = min(bad.items(), key=lambda item: len(item[1]))
        _show_place(first, terminal)
        nowhere = f"; in the other task{'s' if len(bad) > 2 else ''} neither"
        raise InputError(
            f"{LABEL}: {_words(first)}{nowhere if len(bad) > 1 else ''}",
            _suggestion(first, asked[name], io),
        )
    name, question = next(iter(good.items()))
    if len(good) > 1 and any(one.is_of_task for one in good.values()):
        raise InputError(
            f"{LABEL} `{text}`: the tasks {', '.join(good)} may each answer it otherwise",
            f"name one: {LABEL} '{name}:{expression.strip()}'",
        )
    _echo_shadowed_names(expression, asked[name])
    return Assertion(text.strip(), name, question)


def _tasks(text: str, programs: Mapping[str, Program]) -> tuple[str, Mapping[str, Program]]:
    """The expression without its task prefix, and the tasks in which to evaluate it."""
    match = _PREFIX.match(text)
    if match is None:
        return text, programs
    named = {name: one for name, one in programs.items() if name.lower() == match[1].lower()}
    if not named:
        raise InputError(
            f"{LABEL} `{text.strip()}`: there is no task `{match[1]}`",
            did_you_mean(match[1], programs) or f"the run has {', '.join(programs)}",
        )
    return text[match.end() :], named


def _show_place(finding: Diagnostic, terminal: Terminal) -> None:
    """Show the expression with carets under what is wrong."""
    if finding.span is not None:
        palette, width = terminal.palette, terminal.width
        frame = source_frame(finding.span, "", palette, colour=palette.error, width=width)
        echo("\n".join(frame), palette=palette, err=True)


def _words(finding: Diagnostic) -> str:
    """The error, without the function that was wrapped around the expression."""
    violation = finding.violation
    if isinstance(violation, UnknownSignal):
        return f"neither the station nor the program has a signal `{violation.signal}`"
    text = violation.message.replace("`;` is expected", "its end is expected")
    text = text.replace(" in the RETURN statement", "")
    return re.sub(r"RETURN in `\w+`|the RETURN statement", "the expression", text)


def _suggestion(finding: Diagnostic, program: Program, io: CellIo) -> str | None:
    """Suggestion for the expression; None without one."""
    violation = finding.violation
    if isinstance(violation, UndefinedName) and violation.nearest is None:
        return f"it may name data and signals of the program, and {', '.join(ASKED_FIGURES)}"
    if not isinstance(violation, UnknownSignal):
        return violation.help
    used = {one.name for one in program.symbol_of.values() if isinstance(one, UnknownSymbol)}
    known = sorted((used | {one.name for one in io.signals}) - {violation.signal})
    return did_you_mean(violation.signal, known)


def _echo_shadowed_names(expression: str, program: Program) -> None:
    """Say which names mean the program's own data and not the figure of the run."""
    words = {word.lower() for word in re.findall(r"[A-Za-z]\w*", expression)}
    for name in ASKED_FIGURES:
        if name in words & own_names(program):
            echo(
                f"note: {LABEL}: `{name}` is the program's own here, not the figure of the run",
                err=True,
            )
