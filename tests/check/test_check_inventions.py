"""Sixty-odd inventions that no controller accepts: rejected by default, with line and meaning."""

from dataclasses import replace
from pathlib import Path

import pytest
from command_line import call

from rapidsim.analysis.cell_names import cell_names
from rapidsim.diagnostics import Severity
from rapidsim.files import SourceFile
from rapidsim.jobs.checking.checked_program import load
from rapidsim.language.types import SIGNAL_AO, SIGNAL_DI, SIGNAL_DO, SIGNAL_GO

LINE = 13
PROGRAM = r"""MODULE cell
  CONST robtarget pPick:=[[600,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget pPlace:=[[600,200,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget jHome:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS tooldata tGrip:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  PERS wobjdata wTable:=[FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  VAR num nParts;
  VAR bool bDone;
  VAR string sName;
  VAR pose frame;
  VAR intnum iStop;
  PROC main()
    @;
  ENDPROC
  PROC PickPart(num height\switch Slow)
  ENDPROC
  FUNC num Area(num a,num b)
    RETURN a*b;
  ENDFUNC
  TRAP tStop
  ENDTRAP
ENDMODULE
"""
CELL = replace(
    cell_names(
        [
            ("doGrip", SIGNAL_DO),
            ("diPart", SIGNAL_DI),
            ("aoFlow", SIGNAL_AO),
            ("goCode", SIGNAL_GO),
        ]
    ),
    has_signals=True,
)
STATION = """[signals]
doGrip = { type = "do" }
diPart = { type = "di" }
aoFlow = { type = "ao" }
"""
INVENTIONS = [
    # Instructions and functions that no controller has
    ("MovJ pPick,v500,z10,tGrip", "N209", "MoveJ"),
    ("MovL pPick,v500,z10,tGrip", "N209", "MoveL"),
    ("MoveJoint pPick,v500,z10,tGrip", "N209", "MoveJ"),
    ("MoveLinear pPick,v500,z10,tGrip", "N209", "MoveL"),
    ("MoveAbsJ1 jHome,v500,z10,tGrip", "N209", "MoveAbsJ"),
    ("PickPrat 100", "N209", "PickPart"),
    ("PckPart 100", "N209", "PickPart"),
    ("SetDigitalOut doGrip,1", "N209", "SetDO"),
    ("SetDOs doGrip,1", "N209", "SetDO"),
    ("ResetDO doGrip", "N209", "Reset"),
    ("PulsDO doGrip", "N209", "PulseDO"),
    ("WaitDl diPart,1", "N209", "WaitDI"),
    ("WaitDigital diPart,1", "N209", "WaitDI"),
    ("WaitSeconds 1", "N209", "WaitTime"),
    ("WaitTmie 1", "N209", "WaitTime"),
    ("OpenGripper", "N209", None),
    ("GripperClose 3", "N209", None),
    ('TPWriteLine "a"', "N209", "TPWrite"),
    ('TPWirte "a"', "N209", "TPWrite"),
    ("nParts:=Aera(1,2)", "N209", "Area"),
    ("nParts:=SqRoot(4)", "N209", "Sqrt"),
    ('nParts:=Length("abc")', "N209", "StrLen"),
    ("frame:=PoseMul(frame,frame)", "N209", "PoseMult"),
    ("nParts:=PickPart(1)", "N211", None),
    # Words of other languages
    ("PTP pPick", "N209", "MoveJ"),
    ("LIN pPick", "N209", "MoveL"),
    ("CIRC pPick,pPlace", "N209", "MoveC"),
    ("HALT", "N209", "Stop"),
    ("WAIT SEC 1", "E113", None),
    ("$OUT[1]=TRUE", "E118", None),
    ("movej(pPick, a=1.4, v=1.05)", "E141", None),
    ("movel(pPick)", "T302", None),
    ("movep(pPick)", "N209", "MoveL"),
    ("sleep(1)", "N209", "WaitTime"),
    ("set_digital_out(1, TRUE)", "E141", None),
    ('textmsg("hello")', "N209", "TPWrite"),
    ('popup("hello")', "N209", "UIMsgBox"),
    ("nParts=1", "E140", None),
    # Wrong names of optional arguments
    (r"MoveL pPick,v500,z10,tGrip\WorkObj:=wTable", "T312", r"\WObj"),
    (r"MoveL pPick,v500,z10,tGrip\WOjb:=wTable", "T312", r"\WObj"),
    (r"MoveL pPick,v500\Velocity:=10,z10,tGrip", "T312", r"\V"),
    (r"WaitDI diPart,1\Timeout:=5", "T312", r"\MaxTime"),
    (r"WaitDI diPart,1\MaxTme:=5", "T312", r"\MaxTime"),
    (r"WaitTime\InPosition,1", "T312", r"\InPos"),
    (r"SetDO\Delay:=1,doGrip,1", "T312", r"\SDelay"),
    (r"MoveJ pPick,v500,z10,tGrip\Asap", "T312", None),
    (r"PickPart 10\Slwo", "T312", r"\Slow"),
    (r'TPWrite "a"\Number:=3', "T312", r"\Num"),
    # Arguments swapped, missing, too many
    ("MoveL pPick,z10,v500,tGrip", "T302", None),
    ("MoveL v500,pPick,z10,tGrip", "T302", None),
    ("MoveL pPick,v500,tGrip,z10", "T302", None),
    ("SetDO 1,doGrip", "T301", None),
    ("WaitDI 1,diPart", "T301", None),
    ('TPWrite nParts,"a"', "T301", None),
    ('nParts:=Area("a",2)', "T301", None),
    ("Incr 1", "T303", None),
    ("PickPart", "T302", None),
    ("PickPart 1,2", "T302", None),
    ("MoveL pPick,v500,z10", "T302", None),
    # Names that nothing declares
    ("SetDO doGirp,1", "I801", "doGrip"),
    ("WaitDI diPrat,1", "I801", "diPart"),
    ("SetAO aoFlwo,1", "I801", "aoFlow"),
    ("SetGO goCodes,3", "I801", "goCode"),
    ("IF diDoor=1 Stop", "I801", None),
    ("nParts:=nPart+1", "N201", "nParts"),
    ("MoveL pPik,v500,z10,tGrip", "N201", "pPick"),
    ("MoveL pPick,v500,z10,tGirp", "N201", "tGrip"),
    ("MoveL pPick,v500,z7,tGrip", "N201", None),
    ("CONNECT iStop WITH tStp", "N201", "tStop"),
    ("GOTO nowhere", "F405", None),
]


@pytest.mark.parametrize(("statement", "code", "meant"), INVENTIONS)
def test_an_invention_is_rejected(statement: str, code: str, meant: str | None) -> None:
    text = PROGRAM.replace("@", statement)
    loaded = load([SourceFile("cell.mod", text, "utf-8")], cell=CELL)
    errors = [one for one in loaded.diagnostics if one.severity is Severity.ERROR]
    assert loaded.program is None
    assert {one.line for one in errors} == {LINE}
    found = next(one for one in errors if one.code == code)
    assert f"`{meant}`" in (found.help or "") if meant else "did you mean" not in (found.help or "")


@pytest.mark.parametrize("command", ["check", "run"])
@pytest.mark.parametrize(("statement", "code", "meant"), INVENTIONS[::12])
def test_both_commands_reject_it(
    command: str, statement: str, code: str, meant: str | None, tmp_path: Path
) -> None:
    (tmp_path / "cell.mod").write_text(PROGRAM.replace("@", statement))
    (tmp_path / "rapidsim.toml").write_text(STATION)
    ended = call(command, "cell.mod", cwd=tmp_path)
    assert ended.code == 1
    assert f"error[{code}]" in ended.out
    assert f"cell.mod:{LINE}:" in ended.out
    assert not meant or f"`{meant}`" in ended.out
