"""What a robot that moves together with others may be asked besides: no answer is a crash."""

import pytest
from laws import in_turn
from simulation_tasks import JOINTS, Ran, ran

DATA = """
PERS tasks both{2}:=[["T_ROB1"],["T_ROB2"]];
VAR syncident on;
VAR syncident off;
VAR robtarget found;
VAR triggdata near;
VAR wztemporary zone;
VAR shapedata box;
VAR intnum soon;
VAR jointtarget axes;
"""


def point(x: float, y: float, z: float) -> str:
    turn = -1 if y < 0 else 0
    return f"[[{x},{y},{z}],[0,0,1,0],[{turn},0,{turn},0],{JOINTS}]"


MOVE = "MoveL {there}\\ID:=10,v200,{zone},tool0;"
OPERATIONS = {
    "StorePath": "StorePath;",
    "RestoPath": "RestoPath;",
    "StorePath in step": r"StopMove; StorePath\KeepSync;",
    "stored in step": "StopMove; StorePath\\KeepSync; MoveL {here}\\ID:=15,v200,fine,tool0; "
    "MoveL {there}\\ID:=16,v200,z10,tool0; RestoPath; StartMove;",
    "stored and suspended": "StopMove; StorePath\\KeepSync; SyncMoveSuspend; "
    "MoveL {here},v200,fine,tool0; RestoPath; StartMove;",
    "stored and apart": "StopMove; StorePath\\KeepSync; SyncMoveOff off; RestoPath; StartMove;",
    "stored and undone": "StopMove; StorePath\\KeepSync; SyncMoveUndo; RestoPath; StartMove;",
    "stored twice": "StopMove; StorePath\\KeepSync; StorePath; StorePath; RestoPath; RestoPath; "
    "RestoPath; StartMove;",
    "stored and ended": "StopMove; StorePath\\KeepSync; EXIT;",
    "stored before": "StopMove; StorePath; RestoPath; StartMove;",
    "ClearPath": "StopMove; ClearPath; StartMove;",
    "ClearPath while it moves": "ClearPath;",
    "StopMove": "StopMove; StartMove;",
    "StopMove twice": "StopMove; WaitTime 0.2; StopMove; StartMove;",
    "StopMove for ever": "StopMove;",
    "PathLevel": "TPWrite NumToStr(PathLevel(),0);",
    "IsStopMoveAct": r"IF IsStopMoveAct(\FromMoveTask) StartMove;",
    "search": "SearchL\\Stop,diPart,found,{there}\\ID:=15,v100,tool0;",
    "search for a stop": "SearchL\\SStop,diPart,found,{there},v100,tool0;",
    "search of axes": "SearchExtJ diPart,axes,[[0,0,0,0,30,0],{out}],v100;",
    "trigger": "TriggIO near,5\\DOp:=doX,1; TriggL {there}\\ID:=15,v100,near,z10,tool0;",
    "output": "MoveLDO {there}\\ID:=15,v100,z10,tool0,doX,1;",
    "procedure": 'MoveLSync {there}\\ID:=15,v100,z10,tool0,"greet";',
    "zone": "WZBoxDef\\Inside,box,[0,-900,0],[900,900,1500]; WZDOSet\\Temp,zone\\Inside,box,doX,1;",
    "zone that stops": "WZBoxDef\\Inside,box,[0,-900,0],[900,900,1500]; WZLimSup\\Temp,zone,box;",
    "interrupt": "CONNECT soon WITH ring; ITimer\\Single,0.3,soon;",
    "position": "found:=CRobT(\\Tool:=tool0); axes:=CJointT();",
    "wait": "WaitRob\\InPos; WaitTime\\InPos,0.1;",
    "alone": "MoveJ {there},v100,fine,tool0;",
    "axes": "MoveAbsJ [[0,0,0,0,30,0],{out}]\\ID:=15,v100,fine,tool0;",
    "circle": "MoveC {there},{here}\\ID:=15,v100,fine,tool0;",
    "again": "SyncMoveOn on,both;",
    "suspended for ever": "SyncMoveSuspend;",
    "suspended": "SyncMoveSuspend; SyncMoveResume;",
    "undone": "SyncMoveUndo;",
    "ended": "EXIT;",
    "stopped": "Stop;",
    "cycle": "ExitCycle;",
}


def program(side: float, operation: str, zone: str) -> str:
    here, there = point(800, side * 200, 700), point(800, side * 150, 800)
    move = MOVE.format(there=there, zone=zone)
    asked = operation.format(here=here, there=there, out=JOINTS)
    return f"""{DATA}
PROC main()
  ConfL\\Off;
  ConfJ\\Off;
  MoveJ {here},v500,fine,tool0;
  SyncMoveOn on,both;
  {move}
  {asked}
  MoveL {here}\\ID:=30,v200,fine,tool0;
  SyncMoveOff off;
  TPWrite "alone again";
ENDPROC
PROC greet()
  TPWrite "greetings";
ENDPROC
TRAP ring
  StopMove;
  StorePath;
  RestoPath;
  StartMove;
ENDTRAP
"""


def asked(operation: str, sides: str, zone: str) -> Ran:
    left = program(-1, operation if sides != "right" else "", zone)
    right = program(1, operation if sides != "left" else "", zone)
    return ran({"T_ROB1": left, "T_ROB2": right}, max_time_s=30.0)


WAYS = (
    *(("both", "z20"), ("left", "fine"), ("right", "z20")),
    *(("both", "fine"), ("left", "z20"), ("right", "fine")),
)
"""Who asks, behind which zone; of two in a row one is at rest and one on the way."""


@pytest.mark.parametrize(
    ("operation", "sides", "zone"),
    [(one, *way) for turn, one in enumerate(OPERATIONS) for way in in_turn(WAYS, turn, 1)],
)
def test_a_team_ends_in_a_known_way(operation: str, sides: str, zone: str) -> None:
    it = asked(OPERATIONS[operation], sides, zone)
    assert it.end in ("ended", "stopped", "error", "time_limit", "cycle_limit")
    if it.end == "error":
        assert any(one.severity.value == "error" for one in it.run.diagnostics)


def test_a_path_kept_before_is_not_taken_up_within_a_team() -> None:
    kept = "StopMove; StorePath; StartMove; SyncMoveOn on,both;"
    programs = (program(side, "RestoPath;", "fine") for side in (-1, 1))
    left, right = (one.replace("SyncMoveOn on,both;", kept, 1) for one in programs)
    it = ran({"T_ROB1": left, "T_ROB2": right}, max_time_s=30.0)
    said = it.only("R101").violation.message
    assert "RestoPath while robots move together is not simulated" in said
