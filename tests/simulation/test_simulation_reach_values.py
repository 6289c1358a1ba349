"""Which moves are known before a program runs, and that what is known is what a run does."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples
from simulation_program import arm
from simulation_reach import checked

from rapidsim.files import SourceFile
from rapidsim.jobs.checking.checked_program import load
from rapidsim.reach.dataflow.program_walk import walk_program
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.simulate import simulate

HEAD = """MODULE cell
  CONST robtarget p:=[[800,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget row{3}:=[[[800,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],
    [[800,50,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],
    [[800,100,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]];
  PERS wobjdata table:=[FALSE,TRUE,"",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  PERS bool busy:=FALSE;
  VAR num n:=3;
  VAR num asked;
"""


def counted(body: str, others: str = "") -> tuple[int, int, int]:
    """Moves of a program with this main that are known by value, by run, not at all."""
    program = f"{HEAD}  PROC main()\n{body}\n  ENDPROC\n{others}\nENDMODULE\n"
    return checked(program).counts


KNOWN = {
    "constant": "MoveJ p,v500,fine,tool0;",
    "literal": "MoveJ [[800,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v10,z1,tool0;",
    "computed": r"MoveJ RelTool(Offs(p,2*n,-n,0),0,0,-5\Rz:=10),v500,fine,tool0\WObj:=table;",
    "frame": "VAR robtarget q; VAR pose f; f:=PoseMult(table.uframe,[[1,2,3],[1,0,0,0]]);"
    "q:=p; q.trans:=q.trans+f.trans; MoveJ q,v500,fine,tool0;",
    "element": "MoveJ row{1+1},v500,fine,tool0;",
    "loop": "FOR i FROM 1 TO 3 DO MoveJ row{i},v500,fine,tool0; ENDFOR",
    "one way": "IF n=3 THEN MoveJ p,v500,fine,tool0; ENDIF",
    "counted": "n:=0; WHILE n<2 DO n:=n+1; MoveJ p,v500,fine,tool0; ENDWHILE",
    "written in a loop": "FOR i FROM 1 TO 2 DO n:=n+i; MoveJ Offs(p,n,0,0),v50,z1,tool0; ENDFOR",
    "displaced": "PDispSet [[0,0,9],[1,0,0,0]]; MoveJ p,v500,fine,tool0; PDispOff;",
    "dead": "RETURN; MoveJ p,v500,fine,tool0;",
    "label": "n:=5; IF TestDI(di1) GOTO on; n:=5; on: MoveJ Offs(p,n,0,0),v500,fine,tool0; n:=6;",
    "jump back": "again: n:=5; MoveJ Offs(p,n,0,0),v500,fine,tool0; IF TestDI(di1) GOTO again;",
    "another case": "TEST n CASE 3: n:=4; CASE 4: MoveJ p,v500,fine,tool0; ENDTEST",
    "output": "MoveLDO p,v500,fine,tool0,doGlue,1;",
    "group output": r"MoveCGO row{1},row{2},v500,fine,tool0,goGlue\Value:=2;",
    "search": r"VAR robtarget q; IF n>9 SearchL \PStop,di1,q,p,v50,tool0;",
    "search for a persistent": r"VAR robtarget q; SearchL \PStop,busy,q,p,v50,tool0;",
    "incremented": "Incr n; Add n,2; MoveJ Offs(p,n,0,0),v500,fine,tool0;",
}


@pytest.mark.parametrize("body", KNOWN.values(), ids=KNOWN.keys())
def test_a_move_is_known_by_value(body: str) -> None:
    assert counted(f"    {body}") == (1, 0, 0)


BY_CALL = {
    "parameter": ("go 10; go 20;", "PROC go(num x) MoveJ Offs(p,x,0,0),v50,fine,tool0; ENDPROC"),
    "tool": ("go tool0;", "PROC go(PERS tooldata t) MoveJ p,v50,fine,t; ENDPROC"),
    "function": (
        "MoveJ above(p),v50,fine,tool0;",
        "FUNC robtarget above(robtarget q) RETURN Offs(q,0,0,50); ENDFUNC",
    ),
    "reference": (
        "VAR num x; set_ x; MoveJ Offs(p,x,0,0),v50,fine,tool0;",
        "PROC set_(INOUT num x) x:=7; ENDPROC",
    ),
    "server": (
        "n:=1; IF n=2 serve; MoveJ Offs(p,n,0,0),v50,fine,tool0;",
        "PROC serve() WHILE TRUE DO n:=n+1; IF TestDI(di1) EXIT; ENDWHILE ENDPROC",
    ),
    "server on some path": (
        "n:=1; IF TestDI(di1) ping; MoveJ Offs(p,n,0,0),v50,fine,tool0;",
        "PROC ping() n:=n+1; pong; ENDPROC PROC pong() n:=n+1; ping; ENDPROC",
    ),
    "never called": ("n:=1;", "PROC spare() MoveJ p,v50,fine,tool0; ENDPROC"),
    "handler": ("n:=1;", "PROC spare() n:=2; ERROR MoveJ p,v50,fine,tool0; RETURN; ENDPROC"),
}


@pytest.mark.parametrize(("body", "others"), BY_CALL.values(), ids=BY_CALL.keys())
def test_calls_are_followed(body: str, others: str) -> None:
    assert counted(f"    {body}", f"  {others}") == (1, 0, 0)


ONLY_RUN = {
    "robot": "VAR robtarget q; MoveJ p,v10,fine,tool0; q:=CRobT(); MoveL q,v50,fine,tool0;",
    "displaced": "MoveJ p,v10,fine,tool0; PDispOn row{1},tool0; MoveJ p,v10,z1,tool0;",
}


@pytest.mark.parametrize("body", ONLY_RUN.values(), ids=ONLY_RUN.keys())
def test_a_run_tells_what_values_do_not(body: str) -> None:
    assert counted(f"    {body}") == (1, 1, 0)


def test_what_nobody_can_tell_is_said_with_its_reason() -> None:
    found = checked(
        f"""{HEAD}  PROC main()
    TPReadNum asked, "how far?";
    MoveJ Offs(p,asked,0,0),v500,fine,tool0;
  ENDPROC
  PROC spare(num x)
    MoveJ Offs(p,x,0,0),v500,fine,tool0;
  ENDPROC
ENDMODULE
"""
    )
    assert found.counts == (0, 0, 2)
    (first, why), (second, whose) = found.reasons
    assert (first, second) == (12, 15)
    assert "`asked` comes from `TPReadNum`" in why
    assert "asked the operator" in why
    assert "parameter `x` differs from call to call" in whose


def test_data_that_a_trap_writes_are_never_known() -> None:
    assert counted(
        "    MoveJ Offs(p,n,0,0),v50,fine,tool0;", "  TRAP often\n    n:=900;\n  ENDTRAP"
    ) == (0, 1, 0)


def test_a_condition_is_not_held_against_the_values_that_decide_it() -> None:
    # Element 4 is never asked for; the branch that this round does not take is looked at, too.
    body = """    FOR i FROM 1 TO 4 DO
      IF i<4 THEN
        MoveJ row{i},v50,fine,tool0;
      ELSE
        MoveJ p,v50,fine,tool0;
      ENDIF
    ENDFOR"""
    assert counted(body) == (2, 0, 0)


# --- what is known is what a run does

numbers = st.integers(-3, 3)
data = st.sampled_from(["a", "b", "n"])
expressions = st.recursive(
    st.one_of(numbers.map(lambda x: f"({x})"), data),
    lambda inner: st.tuples(inner, st.sampled_from("+-*"), inner).map("".join).map("({})".format),
    max_leaves=4,
)
conditions = st.tuples(expressions, st.sampled_from(["<", "=", ">="]), expressions).map("".join)


def blocks(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    """Statements that hold other statements."""
    return st.one_of(
        st.tuples(conditions, inner, inner).map(
            lambda s: f"IF {s[0]} THEN {s[1]} ELSE {s[2]} ENDIF"
        ),
        st.tuples(st.integers(1, 3), inner).map(
            lambda s: f"FOR i FROM 1 TO {s[0]} DO {s[1]} ENDFOR"
        ),
        st.tuples(data, st.integers(1, 2), inner).map(
            # A loop inside may count with the same variable; the other one is never reset.
            lambda s: f"k:=0; WHILE k<{s[1]} AND u<30 DO k:=k+1; u:=u+1; {s[2]} {s[0]}:=k; ENDWHILE"
        ),
        st.tuples(expressions, inner, inner).map(
            lambda s: f"TEST {s[0]} CASE 0,1: {s[1]} DEFAULT: {s[2]} ENDTEST"
        ),
        st.tuples(inner, inner).map(" ".join),
    )


simple = st.one_of(
    st.tuples(data, expressions).map(lambda s: f"{s[0]}:={s[1]};"),
    expressions.map(lambda x: f"MoveJ Offs(p,{x} MOD 9,{x} MOD 7,0),v500,z10,tool0;"),
    expressions.map(lambda x: f"go {x};"),
    st.sampled_from(["hidden;", "change n;", "IF a>1 RETURN;", "ask;", "serve;", "IF a=2 spin;"]),
    # Functions that write, also in expressions that only a run evaluates, or not to their ends.
    st.sampled_from(
        [
            "n:=count(a);",
            "n:=GInput(gi1)+count(a);",
            "IF TestDI(di1) AND odd(b) a:=4;",
            'IF odd(b) OR StrToVal("2",n) b:=5;',
        ]
    ),
    # A jump back has an end; the label is one of the list of the routine.
    st.tuples(conditions, st.integers(0, 2)).map(
        lambda s: f"IF {s[0]} THEN t:=t+1; IF t<4 GOTO l{s[1]}; ENDIF"
    ),
    st.integers(0, 2).map(lambda k: f"t:=t+1; IF t<5 GOTO l{k};"),
    st.integers(0, 2).map(lambda k: f"IF t<5 THEN t:=t+1; GOTO l{k}; ELSE EXIT; ENDIF"),
)
bodies = st.recursive(simple, blocks, max_leaves=8)
routines = st.lists(bodies, min_size=1, max_size=4).map(
    lambda parts: " ".join([parts[0], *(f"l{k}: {one}" for k, one in enumerate(parts[1:]))])
)
"""Bodies of routines; not all of their labels are there."""


def with_labels(body: str) -> str:
    """The body with the labels that it lacks, at its end."""
    missing = (k for k in range(3) if f"l{k}: " not in body)
    return " ".join([body, *(f"l{k}:" for k in missing)])


PROGRAM = """MODULE cell
  CONST robtarget p:=[[800,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR num a:=1;
  VAR num b:=-2;
  VAR num n:=0;
  VAR num k;
  VAR num t;
  VAR num u;
  PROC main()
    {main}
  ENDPROC
  PROC go(num x)
    a:=a+1;
    MoveJ Offs(p,x MOD 9,a MOD 5,b MOD 5),v500,z10,tool0;
    {go}
  ENDPROC
  PROC hidden()
    b:=b+1;
  ENDPROC
  PROC change(INOUT num x)
    x:=x+2;
  ENDPROC
  FUNC num count(num x)
    b:=b+1;
    RETURN x+b;
  ENDFUNC
  FUNC bool odd(num x)
    a:=a+1;
    RETURN x MOD 2=1;
  ENDFUNC
  PROC serve()
    WHILE TRUE DO
      t:=t+1;
      MoveJ Offs(p,0,t MOD 9,0),v500,z10,tool0;
      IF t>6 EXIT;
    ENDWHILE
  ENDPROC
  PROC spin()
    again:
    t:=t+1;
    MoveJ Offs(p,0,0,t MOD 9),v500,z10,tool0;
    IF t>6 EXIT;
    IF t=3 GOTO again;
    spin;
  ENDPROC
  PROC ask()
    b:=TestDI(di1) OR a=5 ? 1:2;
  ENDPROC
ENDMODULE
""".replace("b:=TestDI(di1) OR a=5 ? 1:2;", "IF TestDI(di1) THEN b:=1; ELSE b:=2; ENDIF")


@examples(150)
@given(main=routines, go=routines.filter(lambda s: "go " not in s))
def test_every_move_of_a_run_is_among_those_known(main: str, go: str) -> None:
    text = PROGRAM.format(main=with_labels(main), go=with_labels(go))
    loaded = load([SourceFile("cell.mod", text, "utf-8")])
    assert loaded.program is not None, [d.violation.message for d in loaded.diagnostics]
    walked = walk_program(loaded.program)
    run = simulate(loaded.program, arm(), options=RunOptions(max_time_s=20.0))
    ways: dict[int, set[object]] = {}
    for known in walked.moves:
        before = None if known.previous is None else walked.moves[known.previous].move
        ways.setdefault(known.call.start, set()).update({(known.move, before), (known.move, "any")})
        if known.previous is None:
            ways[known.call.start].add((known.move, None))
    open_ = {walked.written[number][0].start for number in walked.unknown}
    last = None
    for executed in run.moves:
        at = executed.place.span.start
        if at not in open_:
            assert (executed.move, "any") in ways[at]
            assert {(executed.move, last), (executed.move, None)} & ways[at]
        last = executed.move


_FILLED = """MODULE m
  CONST robtarget corner:=[[600,-100,400],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR robtarget place{2,2};
  PROC main()
    ConfJ\\Off;
    fill;
    take reg1;
  ENDPROC
  PROC fill()
    FOR i FROM 1 TO 2 DO
      FOR j FROM 1 TO 2 DO
        place{i,j}:=Offs(corner,0,100*j,50*i);
      ENDFOR
    ENDFOR
  ENDPROC
  PROC take(num n)
%s
  ENDPROC
ENDMODULE
"""


@pytest.mark.parametrize(
    "way",
    [
        "IF n=1 THEN\nGOTO first;\nELSE\nGOTO first;\nENDIF\nfirst:",
        "FOR i FROM 1 TO 2 DO\nIF n=i THEN\nGOTO first;\nELSE\nGOTO first;\nENDIF\nENDFOR\nfirst:",
        "IF n=1 THEN\nRETURN;\nELSE\nEXIT;\nENDIF",
        "TEST n\nCASE 1:\nRETURN;\nDEFAULT:\nRETURN;\nENDTEST",
        "last;\nENDPROC\nPROC last()\nTEST n0\nCASE 1:\nEXIT;\nDEFAULT:\nEXIT;\nENDTEST",
    ],
    ids=["goto", "goto-in-a-loop", "both-end", "all-cases-end", "another-routine"],
)
def test_targets_filled_in_loops_hold_no_zeros_behind_a_way_that_ends(way: str) -> None:
    text = (
        _FILLED % f"{way}\nMoveJ place{{1,2}},v500,fine,tool0;\nMoveL place{{2,1}},v100,fine,tool0;"
    )
    found = checked(text.replace("n0", "reg1"), run=False)
    assert found.codes == []
    assert found.counts == (2, 0, 0)


def test_targets_that_nothing_fills_are_found_there() -> None:
    text = _FILLED % "IF n=1 GOTO first;\nRETURN;\nfirst:\nMoveJ place{1,2},v500,fine,tool0;"
    found = checked(text.replace("    fill;\n", ""), run=False)
    assert [code for code, _ in found.codes] == ["M501"]
