"""What two programs must have in common, though nobody knows what they should do.

Names do not matter, nor whether statements stand in a procedure of their own, nor in which module
a routine stands, nor the order of declarations; what `check --fix` changes changes nothing in a
run. A run in another process is the same, and so is one on a controller that stays on.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from fuzzing.dice import Dice
from fuzzing.programs import STATION, Made
from fuzzing.scope import PREFIX
from fuzzing.sending import send
from rapidsim.cli.exit_codes import ExitCode
from rapidsim.interpreter.limits import RUNNING_DEPTH, recursion_limit
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.jobs.running.run_files import ProgramRejectedError
from rapidsim.json_records.encoding import json_of
from rapidsim.report.run.json_report import course_report
from rapidsim.server.loading import ready
from rapidsim.simulation.live.controller import LiveController
from rapidsim.simulation.live.states import Cycle

OTHER_PREFIX = "yw_"
_MOVE = ("task", "instruction", "start_s", "end_s", "length_mm", "corner", "joints_deg", "conf")
_HEARD = ("text", "signal")
_INLINED = re.compile(
    r"(?m)^  PROC (zq_p\w+)\(\)\n((?:    .*\n)+?)(  ERROR.*\n(?:    .*\n)+)?  ENDPROC\n"
)
_MAIN_ERROR = re.compile(
    r"(?m)(^  PROC main\(\)\n(?:    .*\n)+)  ERROR.*\n(?:    .*\n)*(?=  ENDPROC|  UNDO)"
)
# What calls by name may call itself: a call of it uses a tick, and main would be called so.
_NOT_INLINED = re.compile(r"(?m)^ *(VAR|RETURN|RAISE|GOTO|EXIT|%|\w+:$)")
_PLACE = re.compile(r"\w+\.mod:\d+")
_DATA = re.compile(r"(?m)^  (?:LOCAL )?(?:VAR|PERS|CONST) .*;\n")
_ASKS = re.compile(r"(?i)TPRead|UI[A-Z]|Hand_|g_[A-Z]")
"""Instructions that wait for an operator, or of a gripper whose signals a served cell declares."""
_OVERFLOW = "the stack overflowed"
_STEP_S = 0.5
_START = '[robot]\nmodel = "irb1600-6-1.2"\nstart = [0, 0, 0, 0, 30, 0]\n'
_ROUTINE = re.compile(r"(?ms)^  (PROC|FUNC|TRAP) (?!main\().*?^  END\1\n")


@dataclass(frozen=True)
class Law:
    """Two programs, one made from the other, that must have one journal."""

    name: str
    programs: Callable[[Made, Dice], tuple[Made, Made] | None]
    """None where the law says nothing of a program."""
    command: str = ""
    """What is done to the second before it runs."""
    undone: Callable[[str], str] = lambda out: out
    """What the output of both is turned into, so that it can be compared."""
    any_end: bool = True
    """Whether it also holds for programs that end with an error."""
    second: Callable[[Path, Sequence[Path], float], tuple[int, str]] | None = None
    """How the second runs for some seconds; None for as the first does."""
    ignored: tuple[str, ...] = ()
    """Keys of the journal that may differ."""
    only_end: str = ""
    """The only end of the first of which it says anything; empty for any."""
    goes_on: bool = False
    """Whether the second goes on when the first has ended, with more events."""


def journal(out: str) -> dict[str, object]:
    """What a run did, without places and names of routines."""
    result = json.loads(out) if out.startswith("{") else {}
    if any(_OVERFLOW in one["message"] for one in result.get("diagnostics", ())):
        # How deep Python calls varies by one: it counts calls of C that it has not specialised.
        return {"end": result["end"], "events": ()}
    return {
        "end": result.get("end"),
        "time_s": result.get("time_s"),
        "path_mm": result.get("path_mm"),
        "moves": [{key: move[key] for key in _MOVE} for move in result.get("moves", ())],
        "events": [
            (event["time_s"], event["task"], _PLACE.sub("PLACE", event["message"]))
            for event in result.get("events", ())
            if event["kind"] in _HEARD
        ],
        "persistents": sorted(
            (one["name"], one["old"], one["new"]) for one in result.get("persistents", ())
        ),
    }


def _renamed(made: Made, dice: Dice) -> tuple[Made, Made] | None:
    files = {file: text.replace(PREFIX, OTHER_PREFIX) for file, text in made.files.items()}
    return made, replace(made, files=files)


def _inlined(made: Made, dice: Dice) -> tuple[Made, Made] | None:
    """A procedure's statements instead of its calls in main.

    Both programs lose the ERROR clauses of main and of the procedure: what is left out after an
    error is the rest of the routine that has none.
    """
    for file, text in made.files.items():
        plain = _MAIN_ERROR.sub(r"\1", text)
        for match in _INLINED.finditer(plain):
            name, body, clause = match.groups()
            if _NOT_INLINED.search(body):
                continue
            procedure = match.group().replace(clause or "\0", "")
            begin = plain.replace(match.group(), procedure)
            head, found, main = begin.partition("  PROC main()\n")
            main, changes = re.subn(rf"(?m)^ +{name};\n", body.replace("\\", r"\\"), main)
            if found and changes:
                return made.with_text(file, begin), made.with_text(file, head + found + main)
    return None


def _split(made: Made, dice: Dice) -> tuple[Made, Made] | None:
    """Some routines of a module in a module of their own."""
    file = made.named[0]
    text = made.files[file]
    if "LOCAL " in text or len(made.named) > 1:
        return None
    moved = [m.group() for m in _ROUTINE.finditer(text)]
    moved = [routine for routine in moved if dice.chance(0.6)]
    if not moved:
        return None
    for routine in moved:
        text = text.replace(routine, "")
    other = f"MODULE zq_other\n{''.join(moved)}ENDMODULE\n"
    files = {**made.files, file: text, "other.mod": other}
    return made, Made(files, (*made.named, "other.mod"))


def _reordered(made: Made, dice: Dice) -> tuple[Made, Made] | None:
    """Data of modules and routines in another order."""
    files = dict(made.files)
    for file in made.named:
        text = _shuffled(files[file], _DATA, dice)
        files[file] = _shuffled(text, _ROUTINE, dice)
    other = replace(made, files=files)
    return None if other == made else (made, other)


def _shuffled(text: str, pattern: re.Pattern[str], dice: Dice) -> str:
    """A text with the matches of a pattern in each other's places."""
    found = [match.group() for match in pattern.finditer(text)]
    dice.shuffle(found)
    rest = iter(found)
    return pattern.sub(lambda match: next(rest), text)


def _clear_of_operators(made: Made, dice: Dice) -> tuple[Made, Made] | None:
    """Programs of one task that ask nobody: a controller that stays on waits for an answer."""
    if len(made.named) > 1 or _ASKS.search("".join(made.files.values())):
        return None
    # A run begins above its first line; a controller does not know what will be started.
    station = _START + made.files.get(STATION, "")
    made = replace(made, files={**made.files, STATION: station})
    return made, made


def _in_a_process(folder: Path, named: Sequence[Path], seconds: float) -> tuple[int, str]:
    """Run in a process of its own, in which sets are hashed otherwise."""
    command = [sys.executable, "-m", "rapidsim", "run", *map(str, named), "--no-record", "-v"]
    limits = ["--max-time", str(seconds), "--home", str(folder / "home"), "--format", "json"]
    environment = {**os.environ, "PYTHONHASHSEED": "4711"}
    done = subprocess.run(
        [*command, *limits], capture_output=True, text=True, check=False, env=environment
    )
    return done.returncode, done.stdout


def _live(folder: Path, named: Sequence[Path], seconds: float) -> tuple[int, str]:
    """Run main once on a controller that stays on, step by step."""
    paths = tuple(map(str, named))
    try:
        controller = ready(RunRequest(paths=paths, home=str(folder / "home")))
    except ProgramRejectedError:
        return ExitCode.LIMIT, ""
    live = LiveController(controller.setups, controller.options, keeps_all=True)
    with recursion_limit(RUNNING_DEPTH):
        live.start(Cycle.ONCE)
        while live.executes and live.now_s < seconds:
            live.advance(live.now_s + _STEP_S)
        # The arm may still be on its way.
        live.advance(live.now_s + seconds)
        live.switch_off()
    run = live.finished().simulation
    return ExitCode.CLEAN, json.dumps(json_of(course_report(run, run.diagnostics)))


def _checked(_folder: Path, named: Sequence[Path], _seconds: float) -> tuple[int, str]:
    """Whether a check finds that the run ends with an error, as the journal of a run says it."""
    ended, _ = send("check", *named, "--output-format", "json")
    if '"main_left_out"' in ended.out:
        # It says why it ran no main, or not all of it.
        return ExitCode.LIMIT, ""
    end = "error" if ended.code == ExitCode.FINDINGS else ""
    return ended.code, json.dumps({"end": end, "models": {}})


def _same(made: Made, dice: Dice) -> tuple[Made, Made] | None:
    return made, made


LAWS = (
    Law("renaming", _renamed, undone=lambda out: out.replace(OTHER_PREFIX, PREFIX)),
    Law("inlining a procedure", _inlined, any_end=False),
    Law("splitting a module", _split),
    Law("fixing", _same, command="check --fix -v"),
    Law("running again", _same),
    Law("reordering", _reordered),
    Law(
        "a check finds what ends a run",
        _same,
        second=_checked,
        only_end="error",
        ignored=("code", "time_s", "path_mm", "moves", "events", "persistents"),
    ),
    Law("another process", _same, second=_in_a_process),
    Law(
        "a controller that stays on",
        _clear_of_operators,
        any_end=False,
        second=_live,
        ignored=("code", "end", "time_s", "persistents"),
        goes_on=True,
    ),
)
