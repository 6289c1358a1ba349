"""The ways between moves, checked by value: what a run finds on them, and what it goes past."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples
from simulation_program import ran
from simulation_reach import checked

from rapidsim.diagnostics import Fix
from rapidsim.findings.reach_and_motion_data import PathNotReachable

STOPS = ("K601", "K604", "K613", "K614", "K615")
"""Rules of moves that cannot be made."""
NO_AXES = "[9E9,9E9,9E9,9E9,9E9,9E9]"


def program(*lines: str, data: str = "") -> str:
    """A program with these statements; `a` to `d` are targets in front of the arm."""
    points = {"a": (700, -200), "b": (700, 200), "c": (800, 0), "d": (-700, -100)}
    conf = {"a": "[-1,0,-1,0]", "b": "[0,0,0,0]", "c": "[0,0,0,0]", "d": "[-2,0,-2,0]"}
    declared = "\n".join(
        f"  CONST robtarget {name}:=[[{x},{y},500],[0,0,1,0],{conf[name]},{NO_AXES}];"
        for name, (x, y) in points.items()
    )
    body = "\n".join(f"    {line}" for line in lines)
    return f"MODULE cell\n{declared}\n{data}\n  PROC main()\n{body}\n  ENDPROC\nENDMODULE\n"


def test_a_line_that_fails_says_where_as_the_run_does() -> None:
    text = program("MoveJ a,v500,fine,tool0;", "MoveL d,v500,fine,tool0;")
    by_value, by_run = checked(text, run=False).only("K604"), ran(text).only("K604")
    told, seen = by_value.violation, by_run.violation
    assert isinstance(told, PathNotReachable)
    assert isinstance(seen, PathNotReachable)
    assert (told.percent, told.distance_mm) == pytest.approx((seen.percent, seen.distance_mm))
    assert told.reason == seen.reason
    assert [related.span.line for related in by_value.related] == [8]


def test_an_arc_that_fails_is_found() -> None:
    # All three points are in reach; between the first two the arc bulges out of it.
    start, via, end = (f"Offs(c,{x},{y},0)" for x, y in ((200, -500), (350, 350), (200, 500)))
    text = program(
        f"ConfJ\\Off; ConfL\\Off; MoveAbsJ [[0,0,0,0,30,0],{NO_AXES}],v500,fine,tool0;",
        f"MoveJ {start},v100,fine,tool0;",
        f"MoveC {via},{end},v100,fine,tool0;",
    )
    found = checked(text, run=False).only("K604").violation
    assert found == ran(text).only("K604").violation


def test_what_follows_a_failing_line_is_not_blamed() -> None:
    text = program(
        "MoveJ a,v500,fine,tool0;",
        "MoveL d,v500,fine,tool0;",
        "MoveJ a,v500,fine,tool0;",
        "MoveL b,v500,fine,tool0;",
    )
    assert checked(text).codes == [("K604", 9)]


@examples(25)
@given(
    st.lists(
        st.tuples(
            st.sampled_from(["MoveJ", "MoveL"]),
            st.integers(300, 1150),
            st.integers(-700, 700),
            st.integers(100, 900),
            st.sampled_from(["fine", "z10", "z50"]),
        ),
        min_size=1,
        max_size=4,
    )
)
def test_checking_by_value_and_the_run_agree_on_errors(
    moves: list[tuple[str, int, int, int, str]],
) -> None:
    body = [
        f"{name} [[{x},{y},{z}],[0,0,1,0],[0,0,0,0],{NO_AXES}],v500,{zone},tool0;"
        for name, x, y, z, zone in moves
    ]
    text = program(
        "ConfJ\\Off; ConfL\\Off;",
        "MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;",
        *body,
    )
    found = checked(text, run=False)
    errors = [(one.code, one.line) for one in found.findings if one.diagnostic.severity == "error"]
    run = ran(text)
    stopped = [(code, line) for code, line in run.findings if code in STOPS]
    # A run stops at its first error; checking by value goes on.
    assert found.counts == (len(moves) + 1, 0, 0)
    assert errors[:1] == stopped[:1]


def test_a_stale_configuration_comes_with_its_cure() -> None:
    text = program("MoveJ a,v500,fine,tool0;").replace("[-1,0,-1,0]", "[0,0,0,4]")
    found = checked(text).only("K603")
    fix = found.fix
    assert isinstance(fix, Fix)
    assert not fix.safe
    (edit,) = fix.edits
    cured = text[: edit.span.start] + edit.text + text[edit.span.end :]
    assert edit.span.text == "[0,0,0,4]"
    assert checked(cured).codes == []
    assert ran(cured).findings == []


@pytest.mark.parametrize(
    ("off", "where"), [("ConfJ\\Off;", "MoveJ"), ("ConfL\\Off;", "MoveL")], ids=["ConfJ", "ConfL"]
)
def test_a_configuration_that_is_not_monitored_is_not_held_against_a_target(
    off: str, where: str
) -> None:
    text = program("MoveJ c,v500,fine,tool0;", off, f"{where} a,v500,fine,tool0;")
    assert checked(text.replace("[-1,0,-1,0]", "[3,3,3,1]")).codes == []


def test_another_configuration_at_the_end_of_a_line_is_said() -> None:
    text = program("MoveJ a,v500,fine,tool0;", "MoveL b,v500,fine,tool0;", "MoveJ c,v500,z1,tool0;")
    found = checked(text.replace("[0,0,0,0],[9E9", "[0,2,2,1],[9E9", 1)).findings
    assert [(one.code, one.line) for one in found] == [("K606", 9)]
    assert found[0].message.endswith(
        "arrives in configuration [0,0,0,0], not in the stored [0,2,2,1]"
    )


def test_circles_zones_and_moves_without_length() -> None:
    text = program(
        "MoveJ a,v500,fine,tool0;",
        "MoveL Offs(a,0,40,0),v500,z50,tool0;",
        "MoveL b,v500,fine,tool0;",
        "MoveC Offs(b,0,10,0),Offs(b,0,20,0),v100,fine,tool0;",
        "MoveJ c,v500,fine,tool0;",
        "MoveL c,v500,fine,tool0;",
    )
    found = checked(text, run=False).findings
    assert [(one.code, one.line) for one in found] == [("M504", 9), ("M506", 11), ("M505", 13)]
    assert found[0].message == (
        "a zone of 50 mm is more than half of the 40.0 mm before it; 20.0 mm are used"
    )


def test_only_one_finding_tells_of_a_move_that_value_and_run_both_see() -> None:
    text = program(
        "VAR robtarget q;",
        "MoveJ a,v500,fine,tool0;",
        "q:=CRobT();",
        "MoveL q,v500,fine,tool0;",
        "MoveL d,v500,fine,tool0;",
    )
    found = checked(text)
    assert found.counts == (2, 1, 0)
    assert [code for code, _ in found.codes if code == "K604"] == ["K604"]


def test_arms_of_other_kinds_are_checked_too() -> None:
    far = program(
        "MoveJ [[3000,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v50,z1,tool0;"
    )
    for robot in ("irb460", "rvm1", "irb14000", "kr10"):
        assert ("K601", 8) in checked(far, robot=robot, run=False).codes, robot


SERVER = "WHILE TRUE DO TEST GInput(gi1) {cases} ENDTEST ENDWHILE"
"""A program that serves commands."""


@pytest.mark.parametrize(
    ("data", "lines", "severity"),
    [
        # One command gives the target that another one moves to.
        ("VAR robtarget p;", SERVER.format(cases="CASE 1: p:=a; CASE 2: {move}"), "warning"),
        ("VAR robtarget p;", "TEST GInput(gi1) CASE 1: p:=a; CASE 2: {move} ENDTEST", "warning"),
        ("VAR robtarget p;", "IF DInput(di1)=1 p:=a; IF DInput(di1)=0 p:=b; {move}", None),
        ("VAR robtarget p;", "WHILE DInput(di1)=1 DO {move} p:=a; ENDWHILE", "warning"),
        # Nothing gives it a value, or not before the move.
        ("VAR robtarget p;", SERVER.format(cases="CASE 1: {move}"), "error"),
        ("VAR robtarget p;", "{move} p:=a;", "error"),
        ("VAR robtarget p;", "WHILE TRUE DO {move} p:=a; ENDWHILE", "error"),
        ("VAR robtarget p;", "IF TRUE THEN {move} ENDIF p:=a;", "error"),
    ],
)
def test_a_target_that_another_branch_sets_is_an_error_only_where_the_program_surely_comes(
    data: str, lines: str, severity: str | None
) -> None:
    text = program(lines.format(move="MoveL p,v100,fine,tool0;"), data=data)
    found = [one for one in checked(text, run=False).findings if one.code == "M501"]
    assert [one.diagnostic.severity for one in found] == ([] if severity is None else [severity])


def test_a_branch_that_a_first_round_skips_is_judged_by_what_the_loop_writes() -> None:
    # It is taken in the second round, with what the first has written.
    lines = "WHILE n<4 DO IF n MOD 2=0 THEN p:=Offs(a,n,0,0); ELSE {move} ENDIF Incr n; ENDWHILE"
    text = program(
        lines.format(move="MoveL p,v100,fine,tool0;"), data="VAR robtarget p; VAR num n:=0;"
    )
    assert checked(text).codes == []
    assert checked(text, run=False).codes == []
    assert checked(text).counts == (0, 1, 0)
    # So it is in a procedure that the loop calls.
    called = text.replace("MoveL p,v100,fine,tool0;", "go;").replace(
        "ENDMODULE", "PROC go() MoveL p,v100,fine,tool0; ENDPROC ENDMODULE"
    )
    assert checked(called, run=False).codes == []


def test_a_target_out_of_reach_until_another_branch_sets_it_is_no_error() -> None:
    far = f"VAR robtarget p:=[[5800,0,500],[0,0,1,0],[0,0,0,0],{NO_AXES}];"
    move = "MoveL p,v100,fine,tool0;"
    served = program(SERVER.format(cases=f"CASE 1: p:=a; CASE 2: {move}"), data=far)
    assert checked(served, run=False).only("K601").severity == "warning"
    first = program(f"WHILE TRUE DO {move} p:=a; ENDWHILE", data=far)
    assert checked(first, run=False).only("K601").severity == "error"


def test_a_run_that_comes_to_a_target_without_value_is_sure_of_it() -> None:
    # By value it is not: only a run knows the time of day.
    hour = "IF GetTime(\\Hour)<24 MoveL p,v100,fine,tool0; p:=a;"
    text = program(hour, data="VAR robtarget p;")
    assert checked(text, run=False).only("M501").severity == "warning"
    assert checked(text).only("M501").severity == "error"
