"""What two programs must have in common, though nobody knows what they should do.

Names do not matter, nor whether statements stand in a procedure of their own, nor in which module
a routine stands; and what `check --fix` changes changes nothing in a run.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from dataclasses import dataclass, replace

from fuzzing.dice import Dice
from fuzzing.programs import Made
from fuzzing.scope import PREFIX

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


def journal(out: str) -> dict[str, object]:
    """What a run did, without places and names of routines."""
    result = json.loads(out) if out.startswith("{") else {}
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
            main, changes = re.subn(rf"(?m)^    {name};\n", body.replace("\\", r"\\"), main)
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


def _same(made: Made, dice: Dice) -> tuple[Made, Made] | None:
    return made, made


LAWS = (
    Law("renaming", _renamed, undone=lambda out: out.replace(OTHER_PREFIX, PREFIX)),
    Law("inlining a procedure", _inlined),
    Law("splitting a module", _split),
    Law("fixing", _same, command="check --fix -v"),
    Law("running again", _same),
)
