"""An error in a program does not keep a check from looking at the moves it knows."""

from pathlib import Path

from rapidsim.jobs.checking.check_files import check
from rapidsim.jobs.checking.check_result import CheckResult

PROGRAM = """MODULE cell
  CONST robtarget near:=[[700,-200,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget far:=[[2700,-200,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num n:=1;
  PROC main()
    VAR num own;
    MoveJ near,v500,fine,tool0;
    {faulty}
    MoveL far,v500,fine,tool0;
  ENDPROC
ENDMODULE
"""


def checked(folder: Path, faulty: str) -> CheckResult:
    (folder / "cell.mod").write_text(PROGRAM.format(faulty=faulty))
    return check([folder / "cell.mod"], robot="irb1600")


def codes(found: CheckResult) -> set[str]:
    return {one.violation.code for one in found.diagnostics if one.severity.value == "error"}


def test_what_is_known_is_checked_beside_an_error(tmp_path: Path) -> None:
    for faulty in ("x:=1;", "n:=unknown;", "n:=TRUE;", 'WaitTime "long";'):
        found = checked(tmp_path, faulty)
        assert {"K601"} < codes(found), faulty
        assert (found.coverage.checked, found.coverage.moves) == (2, 2)


def test_a_faulty_move_is_not_checked_itself(tmp_path: Path) -> None:
    found = checked(tmp_path, "MoveL near,v500,fine,gripper;")
    assert {"K601", "N201"} <= codes(found)
    assert (found.coverage.checked, found.coverage.moves) == (2, 3)
    assert [one.reason for one in found.coverage.unchecked] == ["there is an error in it"]


def test_where_data_of_the_routine_are_in_doubt_nothing_is_said(tmp_path: Path) -> None:
    found = checked(tmp_path, "own:=unknown;")
    assert "K601" not in codes(found)
    assert found.coverage.checked == 0
