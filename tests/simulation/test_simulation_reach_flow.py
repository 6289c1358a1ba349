"""What is known of each move without a run: where it goes, from where, under which settings.

A case of `reach_flow.txt` is a line with the body of main, and other items behind `||`; `@5;` goes
to x = 5. The lines below it are the answer: each known move as `from>to`, where `start` is the
start of main and `?` a place that is not known, with the settings that are not as at the start, or
may be others (`?`); then each move that is not known on some path, with the reason.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from rapidsim.files import SourceFile
from rapidsim.jobs.checking.checked_program import load
from rapidsim.language.data import RobTarget
from rapidsim.language.moves import MotionSettings
from rapidsim.reach.dataflow.known_moves import KnownMove
from rapidsim.reach.dataflow.program_walk import walk_program
from rapidsim.reach.dataflow.written_moves import targets_by_wobj

CASES = [
    tuple(case.split("\n", 1))
    for case in Path(__file__).with_name("reach_flow.txt").read_text("utf-8").strip().split("\n\n")
]
HEAD = """MODULE cell
  CONST robtarget p:=[[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num n:=3;
  VAR num m;
  PERS num shared;
  VAR robtarget places{3};
"""
PLAIN = MotionSettings()


def known_moves(body: str, others: str) -> Iterator[str]:
    """The answer, line by line."""
    text = f"{HEAD}PROC main()\n{with_moves(body)}\nENDPROC\n{with_moves(others)}\nENDMODULE\n"
    loaded = load([SourceFile("cell.mod", text, "utf-8")])
    assert loaded.program is not None, [one.message for one in loaded.diagnostics]
    walked = walk_program(loaded.program)
    told = []
    for known in walked.moves:
        before = "start" if known.begins else "?"
        if known.previous is not None:
            before = end_of(walked.moves[known.previous])
        told.append(f"{before}>{end_of(known)}{settings_of(known)}")
    yield f"  {' '.join(told) or 'none'}"
    for number, why in sorted(walked.unknown.items()):
        call, module = walked.written[number]
        yield f"  {module.span(call).one_line.removeprefix('MoveJ Offs(p,')[:12]}: {why}"


def with_moves(text: str) -> str:
    return re.sub(r"@([^;]*);", r"MoveJ Offs(p,\1,0,0),v50,z10,tool0;", text)


def end_of(known: KnownMove) -> str:
    return f"{known.move.to.trans.x:g}" if isinstance(known.move.to, RobTarget) else "axes"


def settings_of(known: KnownMove) -> str:
    found = [
        f"{name}={getattr(known.settings, name)}"
        for name in MotionSettings.__dataclass_fields__
        if name not in known.uncertain and getattr(known.settings, name) != getattr(PLAIN, name)
    ]
    found += [f"{name}?" for name in sorted(known.uncertain)]
    return f"[{','.join(found)}]" if found else ""


@pytest.mark.parametrize(("program", "answer"), CASES, ids=range(1, len(CASES) + 1))
def test_what_is_known_of_each_move(program: str, answer: str) -> None:
    body, _, others = program.partition(" || ")
    assert list(known_moves(body, others)) == answer.split("\n")


def test_targets_by_work_object() -> None:
    text = f"""{HEAD}  CONST robtarget far:=p;
  PERS wobjdata table:=[FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  PERS wobjdata bench:=[FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  PROC main()
    VAR jointtarget joints;
    MoveJ p,v50\\T:=2,z10,tool0\\WObj:=table;
    MoveL Offs(far,n,0,0),v50,z10,tool0\\WObj:=Table;
    MoveC p,RelTool(places{{1}},0,0,n),v50,z10,tool0;
    joints:=CalcJointT(far,tool0\\WObj:=bench);
    go far\\WObj:=bench;
  ENDPROC
  PROC go(robtarget q\\wobjdata WObj)
    MoveL q,v50,z10,tool0\\WObj?WObj;
  ENDPROC
ENDMODULE
"""
    program = load([SourceFile("cell.mod", text, "utf-8")]).program
    assert program is not None
    assert targets_by_wobj(program) == {"table": ("p", "far"), "wobj0": ("p",)}
