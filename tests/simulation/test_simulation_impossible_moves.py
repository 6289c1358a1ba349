"""Moves that stop a controller stop a check, a run, Python and a served controller.

Each kind of mistake in each cell, with ERROR clauses of all forms around it: none helps.
"""

from __future__ import annotations

import random
from itertools import product
from pathlib import Path

import pytest
from laws import PROFILE
from live_controller import Live
from simulation_program import arm, ran

import rapidsim
from rapidsim.files import SourceFile
from rapidsim.jobs.checking.checked_program import load
from rapidsim.reach import trial_run
from rapidsim.reach.reach import check_reach

NO_AXES = "[9E9,9E9,9E9,9E9,9E9,9E9]"
MISTAKES = {
    "out of reach, joints": ("K601", "MoveJ Offs(pHere,{far},0,0),v500,fine,{on};"),
    "out of reach, line": ("K601", "MoveL Offs(pHere,0,{far},0),v500,z10,{on};"),
    "out of reach, arc": (
        "K601",
        "MoveC Offs(pHere,50,50,0),Offs(pHere,{far},0,0),v500,fine,{on};",
    ),
    "axis past its limit": ("K602", "MoveAbsJ [[0,0,0,0,{past},0],{axes}],v500,fine,{tool};"),
    "another branch": ("K603", "MoveJ pOther,v500,fine,{on};"),
    "a line to another branch": ("K60", "MoveL pOther,v500,fine,{on};"),
    "no orientation": ("M501", "MoveJ pNone,v500,fine,{on};"),
    "a tool without orientation": ("M501", "MoveL pHere,v500,fine,tNone;"),
    "a path past a limit": ("K604", "MoveL pBehind,v500,fine,tool0;"),
    "no circle": ("M506", "MoveC Offs(pHere,10,0,0),Offs(pHere,20,0,0),v500,fine,{on};"),
}
CLAUSES = {
    "none": ("", "", ""),
    "trynext": ("", "ERROR\n    TRYNEXT;", ""),
    "retry": ("", "ERROR\n    RETRY;", ""),
    "return": ("", "ERROR\n    RETURN;", ""),
    "empty": ("", 'ERROR\n    TPWrite "caught";', ""),
    "by number": ("", "ERROR (ERR_ROBLIMIT,ERR_OUTSIDE_REACH)\n    TRYNEXT;", ""),
    "raised on": ("", "ERROR\n    RAISE;", "ERROR\n    TRYNEXT;"),
    "up the stack": ("", "", "ERROR\n    TRYNEXT;"),
    "long jump": ("", "", "ERROR (LONG_JMP_ALL_ERR)\n    TRYNEXT;"),
}
CELLS = ("tool0", "tGrip", r"tool0\WObj:=wTable", r"tGrip\WObj:=wTable", r"tGrip\WObj:=wTurned")


def program(mistake: str, clause: str, on: str, seed: int) -> tuple[str, str]:
    """A program with a mistake, and the code that it must stop with."""
    drawn = random.Random(seed)
    code, move = MISTAKES[mistake]
    move = move.format(
        far=drawn.randint(1500, 9000),
        past=drawn.choice((-130, 125, 300)),
        axes=NO_AXES,
        on=on,
        tool=on.partition("\\")[0],
    )
    _, local, outer = CLAUSES[clause]
    text = f"""MODULE cell
  PERS tooldata tGrip:=[TRUE,[[0,0,120],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  PERS tooldata tNone:=[TRUE,[[0,0,120],[0,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  PERS wobjdata wTable:=[FALSE,TRUE,"",[[40,-30,20],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  PERS wobjdata wTurned:=[FALSE,TRUE,"",[[0,0,0],[0.9961947,0,0,0.0871557]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget pHere:=[[700,200,600],[0,0,1,0],[0,0,0,0],{NO_AXES}];
  CONST robtarget pOther:=[[700,250,600],[0,0,1,0],[0,0,0,{drawn.choice((2, 3))}],{NO_AXES}];
  CONST robtarget pNone:=[[700,200,600],[0,0,0,0],[0,0,0,0],{NO_AXES}];
  CONST robtarget pBehind:=[[-700,200,600],[0,0,1,0],[1,0,1,0],{NO_AXES}];
  PROC main()
    MoveJ pHere,v500,fine,{on};
    work;
    TPWrite "went on";
  {outer}
  ENDPROC
  PROC work()
    {move}
    TPWrite "went on";
  {local}
  ENDPROC
ENDMODULE
"""
    return text, code


CASES = list(product(MISTAKES, CLAUSES, CELLS))
SAMPLE = CASES if PROFILE != "fast" else CASES[::9]


@pytest.fixture(autouse=True)
def patient(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the run of a check end however busy the computer is."""
    monkeypatch.setattr(trial_run, "LONGEST_WORK_FOR_ERRORS_S", 60.0)


@pytest.mark.parametrize(("mistake", "clause", "on"), SAMPLE)
def test_no_clause_makes_it_green(mistake: str, clause: str, on: str) -> None:
    text, code = program(mistake, clause, on, CASES.index((mistake, clause, on)))
    it = ran(text)
    assert it.end == "error"
    assert it.texts == []
    told = [one for one in it.run.diagnostics if one.severity == "error"]
    assert [one.code.startswith(code) for one in told] == [True]
    loaded = load([SourceFile("cell.mod", text, "utf-8")])
    assert loaded.program is not None
    found = check_reach(loaded.program, arm()).diagnostics
    errors = sorted((one for one in found if one.severity == "error"), key=lambda one: one.order)
    assert (errors[0].line, errors[0].message) == (told[0].line, told[0].message)


@pytest.mark.parametrize(("mistake", "clause", "on"), CASES[:: 45 if PROFILE == "fast" else 9])
def test_python_and_a_served_controller_say_it_too(
    mistake: str, clause: str, on: str, tmp_path: Path
) -> None:
    text, code = program(mistake, clause, on, CASES.index((mistake, clause, on)))
    file = tmp_path / "cell.mod"
    file.write_text(text)
    cell = rapidsim.load(file, robot="irb1600")
    run = cell.run()
    assert not run.ok
    assert any(one.severity == "error" for one in cell.check().diagnostics)
    live = Live(text)
    live.controller.start()
    live.after(30.0)
    assert not live.controller.executes
    assert not live.controller.task("T_ROB1").has_pointer
    (entry,) = [entry for entry in live.entries if entry.type == 3 and entry.domain != 1]
    (told,) = [one for one in run.diagnostics if one.severity == "error"]
    assert told.code.startswith(code)
    assert told.message in entry.text


def test_a_corner_does_not_change_the_configuration() -> None:
    """At the end of the first line axis 3 would be past its limit; the corner cuts that off."""
    program = f"""MODULE cell
      CONST robtarget pThere:=[[450.5,172.8,369.3],[0,0,1,0],[0,0,0,0],{NO_AXES}];
      PROC main()
        ConfJ\\Off;
        ConfL\\Off;
        MoveJ [[599.9,273.6,398.0],[0,0,1,0],[0,0,0,0],{NO_AXES}],v1000,fine,tool0;
        MoveL pThere,v1000,z50,tool0;
        MoveL [[607.6,122.4,336.5],[0,0,1,0],[0,0,0,0],{NO_AXES}],v1000,fine,tool0;
      ENDPROC
    ENDMODULE
    """
    refused = ran(program)
    assert refused.end == "error"
    assert "in the corner axis 3 would have to jump from 53.7 deg" in refused.only("K604").message
