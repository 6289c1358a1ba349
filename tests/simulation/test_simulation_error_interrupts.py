"""IError and the event log, outputs named by text on a move, and StartMoveRetry."""

import pytest
from simulation_program import Ran, ran

from rapidsim.controller.journal.events import EventKind
from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.files import SourceFile
from rapidsim.jobs.checking.checked_program import load
from rapidsim.motion.model import MODELS

FRAME = r"""MODULE cell
  CONST robtarget a:=[[800,-300,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget b:=[[800,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget c:=[[800,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum wrong;
  VAR triggios plain{2}:=[[TRUE,100,FALSE,0,"doGlue",1,0],[FALSE,50,FALSE,0,"doOff",1,0]];
  VAR triggstrgo digits{1}:=[[TRUE,50,TRUE,0,"goType","4000000000",0]];
  PROC main()
    CONNECT wrong WITH note;
    %s
  ENDPROC
  TRAP note
    VAR trapdata cause;
    VAR errdomain domain;
    VAR num id;
    VAR errtype kind;
    VAR string title;
    VAR string first;
    GetTrapData cause;
    ReadErrData cause,domain,id,kind \Title:=title \Str1:=first;
    TPWrite NumToStr(domain,0)+"/"+NumToStr(id,0)+"/"+NumToStr(kind,0)+" "+title+": "+first;
  ENDTRAP
ENDMODULE
"""


def notes(done: Ran) -> list[str]:
    """What the trap has written."""
    return [text for text in done.texts if text[0].isdigit()]


@pytest.mark.parametrize(
    ("order", "heard"),
    [
        ("IError COMMON_ERR,TYPE_ALL,wrong;", ["8/1/3 Gripper: lost", "8/2/2 Gripper: weak"]),
        ("IError USER_DEF_ERR,TYPE_WARN,wrong;", ["8/2/2 Gripper: weak"]),
        (r"IError USER_DEF_ERR\ErrorId:=1,TYPE_ALL,wrong;", ["8/1/3 Gripper: lost"]),
        ("IError MOTION_ERR,TYPE_ALL,wrong;", []),
        ("IError COMMON_ERR,TYPE_ALL,wrong; IDelete wrong;", []),
    ],
)
def test_a_trap_runs_for_the_entries_it_was_ordered_for(order: str, heard: list[str]) -> None:
    writes = r'ErrWrite "Gripper","lost"; WaitTime 1; ErrWrite\W,"Gripper","weak";'
    done = ran(FRAME % f"{order}\n{writes}")
    assert notes(done) == heard
    traps = [event.time_s for event in done.run.events if event.kind is EventKind.INTERRUPT]
    assert traps == [
        time_s for text, time_s in (("lost", 0.0), ("weak", 1.0)) if text in "".join(heard)
    ]


def test_a_corner_path_failure_is_a_warning_that_a_trap_hears() -> None:
    done = ran(
        FRAME
        % """IError MOTION_ERR,TYPE_WARN,wrong;
        MoveJ a,v500,fine,tool0;
        MoveL b,v500,z10,tool0;
        WaitTime 3;
        MoveL c,v500,fine,tool0;"""
    )
    assert done.run.moves[1].corner is CornerKind.STOP_CORNER_PATH_FAILURE
    assert notes(done) == ["5/24/2 Corner path failure: "]


def test_trap_data_without_an_error_are_refused() -> None:
    done = ran(FRAME % "ITimer\\Single,0.5,wrong;\nWaitTime 1;")
    assert done.end == "error"
    assert "ReadErrData" in done.run.diagnostics[-1].violation.message


def test_outputs_are_set_where_the_records_say() -> None:
    done = ran(
        FRAME
        % r"""
        MoveJ a,v500,fine,tool0;
        TriggLIOs b,v200\TriggData1:=plain\TriggData2:=digits,z10,tool0;
        MoveL c,v200,fine,tool0;""",
        model=MODELS["1"],
    )
    signals = [event for event in done.run.events if event.kind is EventKind.SIGNAL]
    assert [event.message for event in signals] == ["goType = 4e+09", "doGlue = 1"]
    for event, y in zip(signals, (-250.0, -100.0), strict=True):
        there = done.run.only.robot.forward(done.run.only.sample(event.time_s).joints).translation[
            0
        ]
        assert 1e3 * there[1] == pytest.approx(y, abs=1e-5)
    assert done.run.moves[1].move.instruction == "TriggLIOs"


RETRIED = r"""MODULE cell
  VAR num tries;
  PROC main()
    weld;
    TPWrite "moving "\Bool:=NOT IsStopMoveAct(\FromMoveTask);
  ENDPROC
  PROC weld()
    ignite;
    TPWrite "tries "\Num:=tries;
  ERROR
    StopMove;
    StartMoveRetry;
  ENDPROC
  PROC ignite()
    tries:=tries+1;
    IF tries<3 RAISE 5;
  ERROR
    RAISE;
  ENDPROC
ENDMODULE
"""


def test_start_move_retry_starts_the_robot_and_the_statement_again() -> None:
    assert ran(RETRIED).texts == ["tries 3", "moving TRUE"]


def test_start_move_retry_outside_an_error_clause_is_refused() -> None:
    text = RETRIED.replace("tries:=tries+1;", "StartMoveRetry;")
    found = load([SourceFile("cell.mod", text, "utf-8")]).diagnostics
    assert [
        (d.violation.code, d.span.line) for d in found if d.span and d.violation.code == "F406"
    ] == [("F406", 15)]
