"""How programs end, and what they may not exceed."""

import pytest
from simulation_program import calls, ran

from rapidsim.interpreter.limits import NotExecutableError
from rapidsim.simulation.results.verdict import run_verdict

MOVES = """
  CONST jointtarget a:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget b:=[[20,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
"""


def stopping(statement: str) -> str:
    return (
        f'MODULE cell\n{MOVES}\n  PROC main()\n    TPWrite "before";\n    inner;\n'
        '    TPWrite "never";\n  ERROR\n    TRYNEXT;\n  UNDO\n    TPWrite "undo";\n  ENDPROC\n'
        f"  PROC inner()\n    MoveAbsJ b,v100,z50,tool0;\n    {statement}\n"
        "    MoveAbsJ a,v100,fine,tool0;\n  ERROR\n    TRYNEXT;\n  ENDPROC\nENDMODULE\n"
    )


@pytest.mark.parametrize(
    ("statement", "name"),
    [
        ("Stop;", "Stop"),
        (r"Stop \NoRegain;", "Stop"),
        ("Break;", "Break"),
        ("EXIT;", "EXIT"),
        (r"SystemStopAction \Halt;", "SystemStopAction"),
    ],
)
def test_a_program_that_stops_itself_says_where(statement: str, name: str) -> None:
    it = ran(stopping(statement))
    assert it.end == "stopped"
    # Only EXIT leaves the routines.
    assert it.texts == ["before", *(["undo"] if name == "EXIT" else [])]
    assert len(it.run.moves) == 1
    found = it.only("R107")
    assert found.severity == "note"
    assert found.violation.message == f"`{name}` stopped the program here, and nothing restarts it"
    assert (found.routine, found.span and found.span.line) == ("inner", 17)
    assert calls(found) == [("called from main", 8)]


def test_stop_waits_until_the_robot_stands() -> None:
    it = ran(stopping("Stop;"))
    assert it.run.time_s >= it.run.moves[0].end_s


CYCLES = """MODULE cell
  VAR num cycle;
  PROC main()
    VAR num fresh;
    cycle := cycle + 1;
    fresh := fresh + 1;
    TPWrite ValToStr(cycle) + " " + ValToStr(fresh);
    inner;
    TPWrite "end";
  ERROR
    TRYNEXT;
  ENDPROC
  PROC inner()
    IF cycle = 2 ExitCycle;
  ERROR
    TRYNEXT;
  ENDPROC
ENDMODULE
"""


def test_exitcycle_begins_the_next_cycle() -> None:
    it = ran(CYCLES, max_cycles=3)
    assert it.end == "cycle_limit"
    assert it.texts == ["1 1", "end", "2 1", "3 1", "end"]


def test_one_cycle_ends_as_programmed() -> None:
    assert ran(CYCLES).end == "ended"
    only = "MODULE cell\n PROC main()\n  ExitCycle;\n ENDPROC\nENDMODULE\n"
    assert (ran(only).end, ran(only).findings) == ("ended", [])


def test_exitcycle_in_a_trap_leaves_what_it_interrupted() -> None:
    text = """MODULE cell
  VAR intnum irq;
  VAR num cycle;
  PROC main()
    cycle := cycle + 1;
    TPWrite "cycle " + ValToStr(cycle);
    IDelete irq;
    CONNECT irq WITH enough;
    ITimer \\Single, 1, irq;
    WaitTime 5;
    TPWrite "never";
  ENDPROC
  TRAP enough
    ExitCycle;
  ENDTRAP
ENDMODULE
"""
    it = ran(text, max_cycles=2)
    assert (it.end, it.texts) == ("cycle_limit", ["cycle 1", "cycle 2"])
    assert it.run.time_s == pytest.approx(2.0)


def test_endless_recursion_is_one_error_that_no_handler_catches() -> None:
    text = """MODULE cell
  PROC main()
    deeper 1;
  ERROR
    TRYNEXT;
  ENDPROC
  PROC deeper(num n)
    deeper n + 1;
  ENDPROC
ENDMODULE
"""
    it = ran(text)
    assert it.end == "error"
    found = it.only("R101")
    assert found.violation.message.startswith("the stack overflowed in deeper")
    shown = calls(found)
    assert len(shown) == 10
    assert shown[0] == ("called from deeper", 8)
    assert "calls in between omitted" in shown[5][0]
    assert shown[-1] == ("called from main", 3)


def test_thousands_of_calls_deep_is_deep_enough() -> None:
    text = """MODULE cell
  PROC main()
    TPWrite ValToStr(sum(3000));
  ENDPROC
  FUNC num sum(num n)
    IF n = 0 RETURN 0;
    RETURN n + sum(n - 1);
  ENDFUNC
ENDMODULE
"""
    assert ran(text).texts == ["4.5015E+06"]


def test_a_million_elements() -> None:
    text = """MODULE cell
  VAR num line{1000000};
  VAR num grid{100,100,100};
  PROC main()
    FOR i FROM 1 TO 1000000 STEP 1000 DO
      line{i} := i;
    ENDFOR
    grid{100,100,100} := 7;
    TPWrite ValToStr(line{999001}) + " " + ValToStr(grid{100,100,100});
    TPWrite ValToStr(Dim(line,1)) + " " + ValToStr(Dim(grid,3));
    line{1000001} := 1;
  ERROR
    TPWrite ValToStr(ERRNO = ERR_OUTOFBND);
    TRYNEXT;
  ENDPROC
ENDMODULE
"""
    assert ran(text).texts == ["999001 7", "1E+06 100", "TRUE"]


@pytest.mark.parametrize(
    "text",
    [
        "MODULE cell\n VAR num a{10000,10000,10};\n PROC main()\n ENDPROC\nENDMODULE\n",
        "MODULE cell\n PROC main()\n  VAR num a{10000,10000};\n ENDPROC\nENDMODULE\n",
        "MODULE cell\n VAR num a{2000,4000};\n PERS pos b{2000,4000};\n PROC main()\n ENDPROC\n"
        "ENDMODULE\n",
    ],
)
def test_arrays_beyond_the_memory_of_a_run_are_refused(text: str) -> None:
    with pytest.raises(NotExecutableError, match="more than 500 MB in all arrays"):
        ran(text)


def test_a_string_holds_80_characters() -> None:
    text = """MODULE cell
  PROC main()
    VAR string s := "0123456789012345678901234567890123456789";
    s := s + s;
    TPWrite ValToStr(StrLen(s));
    s := s + "x";
    TPWrite ValToStr(StrLen(s));
  ERROR
    TPWrite ValToStr(ERRNO = ERR_STRTOOLNG);
    TRYNEXT;
  ENDPROC
ENDMODULE
"""
    assert ran(text).texts == ["80", "TRUE", "80"]


def test_unknown_calls_are_named_with_what_was_taken_instead() -> None:
    text = """MODULE cell
  PROC main()
    VAR num n := 9;
    AcmeGrip 5;
    AcmeGrip 6;
    n := AcmeForce(3) + 1;
    IF AcmeReady() n := 7;
    TPWrite AcmeName() + ValToStr(n);
    SpyStart "spy.log";
  ENDPROC
ENDMODULE
"""
    it = ran(text, assumes=True)
    assert (it.end, it.texts) == ("ended", ["1"])
    assert run_verdict(it.run).headline == (
        "ended after 0.000 s; 5 calls of 4 unknown routines skipped"
    )
    assert [(one.name, one.count, one.treated_as) for one in it.run.unsimulated] == [
        ("AcmeGrip", 2, "skipped"),
        ("AcmeForce", 1, "skipped, 0 taken for its value"),
        ("AcmeReady", 1, "skipped, FALSE taken for its value"),
        ("AcmeName", 1, 'skipped, "" taken for its value'),
        ("SpyStart", 1, "accepted without effect: nothing is written"),
    ]
    assert it.findings == [*(("R104", line) for line in (4, 6, 7, 8)), ("R119", 9)]


def test_backward_is_mentioned_once() -> None:
    text = """MODULE cell
  PROC main()
    inner;
    inner;
  BACKWARD
    TPWrite "never";
  ENDPROC
  PROC inner()
    TPWrite "forward";
  BACKWARD
    TPWrite "never";
  ENDPROC
ENDMODULE
"""
    it = ran(text)
    assert it.texts == ["forward", "forward"]
    assert it.findings == [("R108", 2)]
    found = it.only("R108")
    assert found.severity == "note"
    assert calls(found) == [("nor is that of inner", 8)]


def test_long_literal_targets_have_equal_findings_on_every_line() -> None:
    lines = "\n".join(
        f"    MoveL [[700,{y}.25,600],[0,0,1,0],[9,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v200,z1,tool0;"
        for y in range(50, 53)
    )
    home = "MoveAbsJ [[4,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;"
    text = f"MODULE cell\n  PROC main()\n{home}\n{lines}\n  ENDPROC\nENDMODULE\n"
    it = ran(text, nearest_configuration=True)
    said = {d.violation.message for d in it.run.diagnostics if d.violation.code == "K603"}
    assert [line for code, line in it.findings if code == "K603"] == [4, 5, 6]
    assert len(said) == 1
    assert "`[[...]]`" in said.pop()
