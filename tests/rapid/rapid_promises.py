"""What the comments of a program promise, and what happened when it was checked and run.

    TPWrite "hello";    ! -> hello          this line shows exactly this; one such comment a time
    b:=1;               ! error: T301       checking or running reports exactly this on this line
    n:=1/zero;          ! stops: division by zero
    EXIT;               ! ends: stopped     how the run ends, where it is not by reaching the end
    n:=1/zero;          ! answered: ERR_DIVZERO next by main
                                            what became of an error; a program that says it of one
                                            says it of all

A comment on a line of its own belongs to the line of code above it. A folder with a station file is
run in that cell; its `answers.txt` holds what the operator answers.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from rapidsim.cli.options.answers import answers_from
from rapidsim.controller.journal.events import ErrorTally, EventKind
from rapidsim.diagnostics import Diagnostic, Severity, Source
from rapidsim.files import SourceFile, decode
from rapidsim.jobs.checking.checked_program import load
from rapidsim.jobs.inputs.job import job
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.jobs.running.run_files import ProgramRejectedError, run_job
from rapidsim.motion.robot.robot import Robot, load_robot
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.simulate import simulate
from rapidsim.syntax.lexer import lex

ROBOT = "irb1600-6-1.2"
MAX_TIME_S = 60.0

_PROMISE = re.compile(
    r"! (?:(?P<shows>->)|(?P<severity>error|warning|note):|(?P<stops>stops):"
    r"|(?P<ends>ends):|(?P<answered>answered):)"
    r" ?(?P<text>.*)"
)
_NEXT = re.compile(r"\s*(?=! (?:->|error:|warning:|note:|stops:|ends:|answered:))")

MODULES = frozenset({".mod", ".modx", ".sys", ".sysx", ".prg"})

Fact = tuple[str, int, str, str]
"""File, line (0 for none), kind, text; facts of one line keep their order."""


@dataclass(frozen=True, slots=True)
class Comment:
    """A comment and the line of code it belongs to."""

    line: int
    text: str


def comments(source: Source) -> list[Comment]:
    """All comments of a file in order; strings and broken text are understood."""
    found = []
    code_line = 1
    next_line = 1
    for comment in lex(source.text).comments:
        line, column = source.position(comment.start)
        for number in range(next_line, line):
            code = source.line(number).strip()
            if code and not code.startswith("!"):
                code_line = number
        if source.line(line)[: column - 1].strip():
            code_line = line
        next_line = line
        found.append(Comment(code_line, comment.text))
    return found


def promises(source: Source) -> list[Fact]:
    """What a file says must happen."""
    facts: list[Fact] = []
    for comment in comments(source):
        for part in _NEXT.split(comment.text):
            match = _PROMISE.match(part)
            if match is None:
                continue
            text = match["text"].rstrip()
            if match["severity"]:
                codes = text.split(", ")
                facts += [(source.file, comment.line, match["severity"], code) for code in codes]
            elif match["shows"]:
                facts.append((source.file, comment.line, "shows", text))
            elif match["answered"]:
                facts.append((source.file, comment.line, "answered", text))
            elif match["stops"]:
                facts.append((source.file, comment.line, "stops", text))
            else:
                facts.append(("", 0, "ends", text))
    return facts


def sources(task: Path) -> list[Source]:
    """The modules of a program: one file, or all of a folder; not what lies in its home folder."""
    inside = sorted(task.rglob("*")) if task.is_dir() else [task]
    inside = [path for path in inside if task / "home" not in path.parents]
    paths = [path for path in inside if path.is_file() and path.suffix in MODULES]
    return [Source(path.name, decode(path.read_bytes())[0]) for path in paths]


def promised(texts: Iterable[Source]) -> list[Fact]:
    """What the comments of a program say must happen, by file and line."""
    return _ordered(fact for source in texts for fact in promises(source))


def happened_in_cell(folder: Path) -> list[Fact]:
    """What happens when a folder with a station file is checked and, if it can be, run."""
    answers = folder / "answers.txt"
    with TemporaryDirectory() as fresh:
        home = folder / "home"
        asked = RunRequest(
            paths=(str(folder),),
            robot=robot(),
            answers=answers_from(str(answers)) if answers.exists() else None,
            home=str(home) if home.is_dir() else fresh,
            max_time_s=MAX_TIME_S,
        )
        try:
            run = run_job(job(asked)).simulation
        except ProgramRejectedError as rejected:
            facts = [_finding(diagnostic) for diagnostic in rejected.diagnostics]
        else:
            facts = _run(run, answers=_says_answers(sources(folder)))
    return _ordered((Path(fact[0]).name, *fact[1:]) for fact in facts)


def happened(texts: Sequence[Source], home: Path | None = None) -> list[Fact]:
    """What happens when a program is checked and, if it can be, run."""
    loaded = load([SourceFile(source.file, source.text, "utf-8") for source in texts])
    facts = [_finding(diagnostic) for diagnostic in loaded.diagnostics]
    if loaded.program is not None:
        options = RunOptions(max_time_s=MAX_TIME_S, home=home)
        run = simulate(loaded.program, robot(), options=options)
        facts += _run(run, answers=_says_answers(texts))
    return _ordered(facts)


@cache
def robot() -> Robot:
    """The arm that all programs run on."""
    return load_robot(ROBOT)


def _says_answers(texts: Iterable[Source]) -> bool:
    """Whether a program says what became of its errors."""
    return any(fact[2] == "answered" for text in texts for fact in promises(text))


def _answered(tally: ErrorTally) -> Fact:
    error = tally.error
    text = f"{error.name} {error.outcome}"
    text += f" by {error.clause.routine}" if error.clause else ""
    text += f" {tally.count} times" if tally.count > 1 else ""
    return (error.raised.span.file, error.raised.span.line, "answered", text)


def _run(run: Simulation, *, answers: bool) -> list[Fact]:
    facts: list[Fact] = [_answered(tally) for tally in run.errors] if answers else []
    for event in run.events:
        if event.kind is EventKind.TEXT and event.place is not None:
            span = event.place.span
            facts.append((span.file, span.line, "shows", event.message.rstrip()))
    facts += [_finding(diagnostic) for diagnostic in run.diagnostics]
    if run.end.value not in ("ended", "error"):
        facts.append(("", 0, "ends", run.end.value))
    return facts


def _finding(diagnostic: Diagnostic) -> Fact:
    place = (diagnostic.span.file, diagnostic.span.line) if diagnostic.span else ("", 0)
    violation = diagnostic.violation
    if violation.code.startswith(("R101", "R106", "K")) and diagnostic.severity is Severity.ERROR:
        return (*place, "stops", violation.message)
    return (*place, diagnostic.severity.value, violation.code)


def _ordered(facts: Iterable[Fact]) -> list[Fact]:
    """By file and line; what a line shows stays in order, findings are sorted."""
    return sorted(facts, key=lambda fact: (*fact[:3], "" if fact[2] == "shows" else fact[3]))
