"""One program through every command, and what a campaign of many has seen."""

from __future__ import annotations

import json
import math
import operator
import re
import shutil
import sys
import tempfile
from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from itertools import count
from pathlib import Path
from types import FrameType
from typing import Any

from fuzzing.dice import Dice
from fuzzing.expressions import PLACED
from fuzzing.laws import LAWS, Law, journal
from fuzzing.programs import Made, make
from fuzzing.sending import GRACE, MAX_WALL, Ended, Failure, send
from rapidsim.cli.exit_codes import ExitCode
from rapidsim.library.catalogue import ROUTINES

RARELY = 50
"""One program in so many is drawn, recorded and reported."""
RARE_GRACE = 60.0
"""Pictures and recordings are made when the run has ended; seconds of the processor for them."""
MAX_TIME = 30
FOLDER = "FOLDER"
"""What stands for the folder of the program in the arguments of a failure."""
SIMULATED = tuple(sorted(k for k, row in ROUTINES.items() if row.simulated and k not in PLACED))
LAW = "law"
COUNTED = 20
LAWS_EACH = 2
"""Laws that a program is tried with, of those that say something of it."""
_STAGES = 1e-4
"""Share by which times of plans made in other steps may differ."""
_CALLS = 4
_FORMATS = ("full", "concise", "json", "sarif", "github", "junit")
_TRACES = ("t.csv", "t.parquet", "t.json", "t.ros.json")


@dataclass
class Tally:
    """What a campaign has seen."""

    programs: int = 0
    accepted: int = 0
    """Without an error that the checker finds."""
    clean: int = 0
    """Ran, and ended with exit code 0."""
    laws: int = 0
    """Comparisons that could be made."""
    lawful: int = 0
    """Programs of which a law could be tried."""
    statements: int = 0
    """Executed, estimated from one program of `COUNTED`."""
    seconds: dict[str, float] = field(default_factory=lambda: defaultdict(float))
    """Of the processor, by command."""
    codes: Counter[tuple[str, int]] = field(default_factory=Counter)
    """Commands by exit code."""
    called: Counter[str] = field(default_factory=Counter)
    """Routines of the library in programs without errors."""
    failures: dict[str, list[tuple[int, Failure]]] = field(default_factory=dict)
    """Numbers of programs by signature."""

    def note(self, number: int, ended: Ended, failure: Failure | None) -> Ended:
        """Count a command."""
        self.seconds[ended.arguments[0]] += ended.seconds
        self.codes[ended.arguments[0], ended.code] += 1
        if failure is not None:
            self.fail(number, failure)
        return ended

    def add(self, other: Tally) -> None:
        """Add what another campaign has seen."""
        for name in ("programs", "accepted", "clean", "laws", "lawful", "statements"):
            setattr(self, name, getattr(self, name) + getattr(other, name))
        for command, seconds in other.seconds.items():
            self.seconds[command] += seconds
        self.codes += other.codes
        self.called += other.called
        for signature, found in other.failures.items():
            self.failures.setdefault(signature, []).extend(found)

    def fail(self, number: int, failure: Failure) -> None:
        """Keep a failure."""
        self.failures.setdefault(failure.signature, []).append((number, failure))


def program(seed: int, number: int) -> Made:
    """The program of a number: each calls a few routines of the library in their turn."""
    first = _CALLS * number
    wanted = [SIMULATED[(first + n) % len(SIMULATED)] for n in range(_CALLS)]
    return make(f"{seed} {number}", wanted)


def try_program(seed: int, number: int, tally: Tally) -> None:
    """Send a program through all commands; a clean one through one of the laws."""
    made = program(seed, number)
    dice = Dice(f"how {seed} {number}")
    tally.programs += 1
    with written(made) as folder:
        note = _Noting(tally, number, folder)
        named = [folder / file for file in made.named]
        note(*send("check", *named, "--output-format", dice.of(_FORMATS), "-v"))
        outputs = ["--trace", folder / dice.of(_TRACES), "--events", folder / "e.jsonl"]
        grace = GRACE
        if number % RARELY == 0:
            outputs += ["--report", folder / "r.html", "--plots", folder / "plots"]
            outputs += ["--record", folder / "r.rrd"]
            grace = RARE_GRACE
        ended = note(*run(folder, named, "--format", "json", *outputs, "--dt", 0.05, grace=grace))
        result = json.loads(ended.out) if ended.out.startswith("{") else {}
        if not result.get("models"):
            return
        tally.accepted += 1
        tally.called.update(_library_calls(made))
        if number % COUNTED == 0:
            with _counting_lines() as lines:
                run(folder, named, "--format", "none")
            tally.statements += COUNTED * next(lines)
        duration = result["time_s"] or 1.0
        cut = dice.of((1e-9, dice.random() * duration, dice.random() * duration))
        note(*run(folder, named, "--max-time", max(cut, 1e-9), "--format", "table"))
    tally.clean += ended.code == 0
    if ended.code not in (0, 1):
        return
    # Programs that end with an error keep most laws, too; each program is tried with two.
    laws = [law for law in LAWS if law.any_end or ended.code == 0]
    dice.shuffle(laws)
    compared = 0
    for law in laws:
        before = tally.laws
        told = difference(made, law, tally, number)
        if told is not None:
            tally.fail(number, Failure(f"{LAW}: {law.name}", (LAW, law.name), told))
        compared += tally.laws > before
        if compared == LAWS_EACH:
            break
    tally.lawful += bool(compared)


@contextmanager
def _counting_lines() -> Iterator[count[int]]:
    """Count the lines of RAPID that are executed in here."""
    lines = count()

    def line(_frame: FrameType, event: str, _argument: object) -> Any:
        if event == "line":
            next(lines)
        return line

    def call(frame: FrameType, _event: str, _argument: object) -> Any:
        return line if frame.f_code.co_filename.endswith(".mod") else None

    before = sys.gettrace()
    sys.settrace(call)
    try:
        yield lines
    finally:
        sys.settrace(before)


@dataclass(frozen=True)
class _Noting:
    """Counts what commands say, with the folder that is soon gone named in their arguments."""

    tally: Tally
    number: int
    folder: Path

    def __call__(self, ended: Ended, failure: Failure | None) -> Ended:
        """Count a command."""
        if failure is not None:
            arguments = tuple(a.replace(str(self.folder), FOLDER) for a in failure.arguments)
            failure = replace(failure, arguments=arguments)
        return self.tally.note(self.number, ended, failure)


def difference(made: Made, law: Law, tally: Tally, number: int = 0) -> str | None:
    """Where the journals of two programs part that a law makes of one; None if it holds."""
    pair = law.programs(made, Dice(law.name))
    if pair is None:
        return None
    journals: list[dict[str, Any]] = []
    for is_second, one in enumerate(pair):
        with written(one) as folder:
            note = _Noting(tally, number, folder)
            named = [folder / file for file in one.named]
            if law.command and is_second:
                note(*send(*law.command.split(), *named))
            if law.second is not None and is_second:
                (folder / "home").mkdir()
                code, out = law.second(folder, named, MAX_TIME)
            else:
                ended = note(*run(folder, named, "--format", "json"))
                code, out = ended.code, ended.out
        may_end_so = code == 0 or is_second or (code == 1 and law.any_end)
        if code == ExitCode.LIMIT or not may_end_so:
            # Where the wall cut a run off is no matter of the program.
            return None
        noted = {"code": code, **journal(law.undone(out))}
        if law.only_end and noted["end"] != law.only_end and not is_second:
            return None
        journals.append({key: noted[key] for key in noted if key not in law.ignored})
    tally.laws += 1
    if law.goes_on:
        count = len(journals[0]["events"])
        journals[1]["events"] = journals[1]["events"][:count]
    holds = _close if law.goes_on else operator.eq
    one_journal, other = (json.dumps(j, indent=1).splitlines() for j in journals)
    return None if holds(*journals) else _first_difference(one_journal, other)


def _close(one: Any, other: Any) -> bool:
    """Whether two values of JSON are equal but for what stages lose that lie elsewhere.

    A plan made in other steps has other stages, each of which may lose a hundred thousandth of its
    segment's time (`motion/timing/time_optimal.py`).
    """
    match one, other:
        case float(), float():
            return math.isclose(one, other, rel_tol=_STAGES, abs_tol=_STAGES)
        case dict(), dict():
            return one.keys() == other.keys() and all(_close(one[k], other[k]) for k in one)
        case ((list() | tuple()), (list() | tuple())):
            return len(one) == len(other) and all(map(_close, one, other))
        case _:
            return bool(one == other)


def run(
    folder: Path, named: Sequence[Path], *options: object, grace: float = GRACE
) -> tuple[Ended, Failure | None]:
    """Run a program within limits, in an empty home."""
    home = folder / "home"
    shutil.rmtree(home, ignore_errors=True)
    home.mkdir()
    limits = () if "--max-time" in options else ("--max-time", MAX_TIME)
    record = () if "--record" in options else ("--no-record",)
    wall = ("--max-wall", MAX_WALL)
    given = ("run", *named, "--home", home, *limits, *wall, *record, *options, "-v")
    return send(*given, limit=MAX_WALL + grace)


@contextmanager
def written(made: Made) -> Iterator[Path]:
    """A program's files in a folder of their own."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file, text in made.files.items():
            (folder / file).write_text(text, encoding="utf-8")
        yield folder


def _library_calls(made: Made) -> set[str]:
    words = {w.lower() for text in made.files.values() for w in re.findall(r"[A-Za-z]\w*", text)}
    return words & set(SIMULATED)


def _first_difference(one: list[str], other: list[str]) -> str:
    for line, (a, b) in enumerate(zip(one, other, strict=False)):
        if a != b:
            return "\n".join(["one:", *one[line - 8 : line + 4], "other:", *other[line : line + 4]])
    return f"{len(one)} and {len(other)} lines"
