"""A controller that writes down what programs do, and a way to run program texts on it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from rapidsim.analysis.cell_names import CellNames
from rapidsim.analysis.passes.checker import check
from rapidsim.analysis.program import Program
from rapidsim.diagnostics import Severity, Source, Span
from rapidsim.interpreter.linking.loader import FatalError, Task, load
from rapidsim.language.controller import uniform_controller
from rapidsim.language.error_answers import AnsweredError
from rapidsim.language.errors import Stopped
from rapidsim.language.moves import MotionSettings, Move, Place
from rapidsim.syntax.parser import parse

TICKS = 1000
"""Ticks of a slice."""


@dataclass
class RecordingController:
    """Virtual time is counted in slices; every text, move and wait is noted."""

    texts: list[str] = field(default_factory=list)
    moves: list[Move] = field(default_factory=list)
    places: list[Place] = field(default_factory=list)
    skipped: list[tuple[str, str]] = field(default_factory=list)
    answers: list[AnsweredError] = field(default_factory=list)
    signals: dict[str, float] = field(default_factory=dict)
    traps: dict[float, Callable[[], None]] = field(default_factory=dict)
    raise_at_service: list[float] = field(default_factory=list)
    """Interrupt numbers to raise, one at each service."""
    ticks_left: int = TICKS
    watches: bool = False
    effect_count: int = 0
    settings: MotionSettings = field(default_factory=MotionSettings)
    place: Place = field(default_factory=lambda: Place(Span(Source("", ""), 0, 0), ""))
    errno: float = 0.0
    retries: int = 0
    handler: float = 0.0
    intno: float = 0.0
    slices: int = 0
    max_slices: int = 100
    waited_s: float = 0.0

    def service(self) -> None:
        self.ticks_left = TICKS
        self.slices += 1
        if self.slices > self.max_slices:
            raise Stopped("time limit")
        if self.raise_at_service:
            self.interrupt(self.raise_at_service.pop(0))

    def interrupt(self, number: float) -> None:
        self.intno = number
        self.traps[number]()

    def show(self, text: str) -> None:
        self.texts.append(text)
        self.places.append(self.place)

    def move(self, move: Move) -> None:
        self.moves.append(move)
        self.places.append(self.place)

    def now(self) -> float:
        return self.waited_s

    def note_unknown(self) -> None:
        """Nobody polls here."""

    def hold_until(self, time_s: float) -> None:
        pass

    def wait(self, seconds: float, *, in_position: bool = False) -> None:
        self.waited_s += seconds
        self.service()

    def wait_until(
        self, condition: Callable[[], bool], *, max_time: float | None = None, poll_s: float = 0.1
    ) -> bool:
        while not condition():
            self.wait(poll_s)
        return True

    def read_signal(self, name: str) -> float:
        return self.signals.get(name.lower(), 0.0)

    def write_signal(self, name: str, value: float, *, delay_s: float = 0.0) -> None:
        self.signals[name.lower()] = value

    def connect(self, trap: Callable[[], None], trap_name: str) -> float:
        number = float(len(self.traps) + 1)
        self.traps[number] = trap
        return number

    def is_connected(self, interrupt: float) -> bool:
        return interrupt in self.traps

    def delete_interrupt(self, interrupt: float) -> None:
        self.traps.pop(interrupt, None)

    def book_error_number(self) -> float:
        return 20501.0

    def error_mark(self) -> object:
        return None

    def answered(self, mark: object, error: AnsweredError) -> None:
        self.answers.append(error)

    def not_simulated(self, routine: str, treated_as: str, *, is_unknown: bool = False) -> None:
        self.skipped.append((routine, treated_as))


@dataclass
class Ran:
    """What a program did."""

    controller: RecordingController
    task: Task
    fatal: FatalError | None
    stopped: Stopped | None

    @property
    def texts(self) -> list[str]:
        return self.controller.texts


def checked(text: str, *more: str, assumes: bool = False) -> Program:
    """A program of one or several files without errors, on request with what it lacks assumed."""
    files = []
    for number, one in enumerate((text, *more)):
        parsed = parse(Source(f"cell{number or ''}.mod", one))
        assert not parsed.diagnostics, [d.violation.message for d in parsed.diagnostics]
        files.append(parsed.file)
    result = check(files, cell=CellNames(assumes=assumes))
    errors = [d for d in result.diagnostics if d.severity is Severity.ERROR]
    assert result.program is not None, [(d.span and d.span.line, d.violation) for d in errors]
    return result.program


def loaded(text: str, *more: str) -> tuple[Task, RecordingController]:
    controller = RecordingController()
    return load(checked(text, *more), uniform_controller(controller)), controller


def run(
    text: str,
    *more: str,
    controller: RecordingController | None = None,
    assumes: bool = False,
) -> Ran:
    """Run main of a program."""
    controller = controller or RecordingController()
    task = load(checked(text, *more, assumes=assumes), uniform_controller(controller))
    fatal: FatalError | None = None
    stopped: Stopped | None = None
    try:
        task.run()
    except FatalError as error:
        fatal = error
    except Stopped as error:
        stopped = error
    return Ran(controller, task, fatal, stopped)


def module(body: str, data: str = "") -> str:
    """A module with data and routines."""
    return f"MODULE cell\n{data}\n{body}\nENDMODULE\n"


def main(statements: str, data: str = "", more: str = "") -> str:
    """A module whose main has some statements."""
    return module(f"PROC main()\n{statements}\nENDPROC\n{more}", data)


def texts(text: str, *more: str) -> list[str]:
    """What a program that ends normally shows on the screen."""
    ran = run(text, *more)
    assert ran.fatal is None, (ran.fatal.error.message, ran.fatal.stack)
    assert ran.stopped is None
    return ran.texts
