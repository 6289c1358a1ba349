"""Integers found without running: what is one, between which bounds, and that nobody can tell."""

from __future__ import annotations

from dataclasses import dataclass, field
from unittest import mock

import interpreter_cell
import pytest
from hypothesis import given
from hypothesis import strategies as st
from interpreter_cell import RecordingController, checked, main, module, run
from laws import examples

from rapidsim.analysis.program import RoutineSymbol
from rapidsim.analysis.tree_walk import descendants
from rapidsim.interpreter.codegen import calls, statements
from rapidsim.interpreter.codegen.integer_inference import integers_of
from rapidsim.interpreter.codegen.intervals import LARGEST
from rapidsim.interpreter.linking import translation
from rapidsim.interpreter.linking.constants import Constants
from rapidsim.interpreter.tools.expression_queries import answers, check_query
from rapidsim.syntax import tree

EXACT = 2**24
CONSTANTS = "CONST num LIMIT := 40; CONST num TABLE{2,2} := [[0, 9], [-7, 1]];"


def integers(text: str) -> dict[str, tuple[int, int]]:
    """Bounds of the integers of a program, by name."""
    program = checked(text)
    found = integers_of(program, Constants(program).value_of)
    bounds = {}
    for node, one in found.items():
        if not isinstance(node, tree.DataReference):
            assert isinstance(node, tree.Data | tree.ParameterDeclaration | tree.RoutineNode)
            bounds[node.name.text] = (one.low, one.high)
    return bounds


@pytest.mark.parametrize(
    ("statements", "expected"),
    [
        ("", (0, 0)),
        ("x := 5;", (5, 5)),
        ("x := x + 1;", (0, LARGEST)),
        ("Incr x;", (0, LARGEST)),
        ("Decr x; Clear x;", (-LARGEST, 0)),
        ("x := 7 DIV 2; x := x MOD 3;", (0, 3)),
        ("x := LIMIT;", (40, 40)),
        ("FOR i FROM 3 TO 9 DO x := i * i; ENDFOR", (9, 81)),
        ("FOR i FROM 9 TO 3 STEP -2 DO x := i; ENDFOR", (3, 9)),
        ('x := StrLen("abc");', (0, EXACT)),
        ('x := -StrLen("abc");', (-EXACT, 0)),
        ("x := Dim(list, 1);", (1, EXACT)),
        ("x := twice(4);", (8, 8)),
        ("x := twice(twice(4));", (8, LARGEST)),
        ("x := -3;", (-3, -3)),
        ("x := TABLE{2,x + 1};", (-7, 9)),
        ("FOR i FROM 3 TO 9 DO x := i; ENDFOR x := x * 2;", (0, LARGEST)),
        ("IF Dim(list, 1) > 2 THEN x := 3; ELSE x := 4; ENDIF", (3, 4)),
        ("IF x > 2 THEN x := 3; ELSE x := 4; ENDIF", (0, 4)),
        ("x := 4; ERROR x := 5; RETRY;", (0, 5)),
        ("GOTO past; past: x := 5;", (0, 5)),
        ("VAR num y; y := 4; Clear y; x := y * y;", (0, 16)),
        # What grows often is soon held to have a sign, or to be as large as a num holds exactly.
        ("x := 7; x := 6; x := 5; x := 4; x := 3; x := 1;", (1, 7)),
        ("x := 7; x := 6; x := 5; x := 4; x := 3; Clear x;", (0, 7)),
        ("x := -7; x := -6; x := -5; x := -4; x := -3; x := -1;", (-7, -1)),
        ("x := 2; x := 3; x := 4; x := 5; x := 6; x := 7;", (2, EXACT)),
        ("x := -2; x := -3; x := -4; x := -5; x := -6; x := -7;", (-EXACT, -2)),
    ],
)
def test_bounds(statements: str, expected: tuple[int, int]) -> None:
    body = f"VAR num x;\n{statements}"
    more = "FUNC num twice(num y) RETURN 2 * y; ENDFUNC"
    found = integers(main(body, f"{CONSTANTS} VAR num list{{3}};", more))
    assert found["x"] == expected


@pytest.mark.parametrize(
    "statements",
    [
        "x := 0.5;",
        "x := 1 / 2;",
        "x := list{1};",
        "x := kept;",
        "x := half(3);",
        "x := 1E10;",
        "x := NONE{1};",
        "x := ZERO{1};",
        "lend x;",
        "FOR i FROM 1 TO 2 STEP 0.5 DO x := i; ENDFOR",
        # Where the factor is 0, floats give a zero with a sign.
        "x := -list_size(-5);",
        "x := list_size(-1) * (-list_size(0));",
        "VAR num none; Clear none; x := none * (-list_size(0));",
        'VAR num some; Incr some; x := some * (-StrLen("abc"));',
        "x := (-7) MOD 7;",
        "x := -0;",
    ],
)
def test_what_is_none(statements: str) -> None:
    more = """
      FUNC num half(num y) RETURN y / 2; ENDFUNC
      FUNC num list_size(num y) RETURN Dim(list, 1) + y; ENDFUNC
      PROC lend(INOUT num y) y := 0.5; ENDPROC
    """
    data = "VAR num list{3}; PERS num kept := 1; "
    data += "CONST num NONE{2} := [1, 0.5]; CONST num ZERO{2} := [1, -0];"
    assert "x" not in integers(main(f"VAR num x;\n{statements}", data, more))


@pytest.mark.parametrize(
    ("calls", "is_one"),
    [
        ("f 1; f 2;", True),
        ("f 1; f 2.5;", False),
        ('f 1; %"f"% 2.5;', False),
        # Whoever is called late without arguments has none that could be a fraction.
        ('f 1; %"main"%;', True),
        ('f 1; Load "HOME:/more.mod";', False),
        ("", False),
    ],
)
def test_parameters(calls: str, is_one: bool) -> None:
    found = integers(main(calls, "", "PROC f(num x) x := x + 1; ENDPROC"))
    assert ("x" in found) is is_one


@pytest.mark.parametrize(
    ("statements", "expected"),
    [
        ("show x;", None),
        ("IF x < 5 RETURN; show x;", (5, LARGEST)),
        ("IF x < 5 OR x > 9 RETURN; show x;", (5, 9)),
        ("IF x < 5 AND x > 1 show x;", (2, 4)),
        ("IF NOT (x >= LIMIT) show x;", (0, 39)),
        ("IF x <= 5 THEN RETURN; ELSEIF 9 = x THEN show x; ENDIF", (9, 9)),
        ("IF x <= 5 THEN show 1; ELSE show x; ENDIF", (6, LARGEST)),
        ("IF x > 5 THEN x := 1; ENDIF show x;", None),
        ("IF x > 5 THEN IF y > 0 RETURN; ELSE RETURN; ENDIF show x;", (6, LARGEST)),
        ("WHILE x <= 9 DO show x; Incr x; ENDWHILE", (0, 9)),
        ("WHILE x <= 9 DO Incr x; show x; ENDWHILE", None),
        ("WHILE x <= 9 DO Incr x; ENDWHILE show x;", (10, LARGEST)),
        ("IF x < 9 THEN FOR i FROM 1 TO 3 DO show x; Incr x; ENDFOR ENDIF", None),
        ("IF x < 9 THEN FOR i FROM 1 TO 3 DO show x; ENDFOR ENDIF", (0, 8)),
        ("IF x < 9 THEN TEST y CASE 1: show x; ENDTEST ENDIF", (0, 8)),
        ("again: IF x < 5 RETURN; show x; GOTO again;", (5, LARGEST)),
        ("IF x < 5 RETURN; again: show x; Decr x; GOTO again;", None),
        ("IF x < 5 RETURN; show x; ERROR TRYNEXT;", None),
        ("IF x < 1 / 2 RETURN; show x;", None),
    ],
)
def test_what_conditions_say(statements: str, expected: tuple[int, int] | None) -> None:
    """Of x, where it is shown."""
    body = f"VAR num x; VAR num y; x := x + 1; Incr y; {statements}"
    more = "PROC show(num value) ENDPROC"
    program = checked(main(body, "CONST num LIMIT := 40;", more))
    found = integers_of(program, Constants(program).value_of)
    shown = [
        found.get(reference)
        for call, symbol in program.symbol_of.items()
        if isinstance(call, tree.Call) and isinstance(symbol, RoutineSymbol)
        for reference in descendants(call)
        if isinstance(reference, tree.DataReference)
    ]
    assert [one and (one.low, one.high) for one in shown] == [expected]


def test_an_option_may_be_absent() -> None:
    assert integers(main("f;", "", "PROC f(\\num x) IF Present(x) x := x + 1; ENDPROC")) == {}


names = st.sampled_from(["x", "y", "z"])
literals = st.sampled_from(["0", "1", "2", "3", "7", "100", "16777215", "16777216", "1E20", "0.5"])
atoms = st.one_of(
    names,
    names,
    literals,
    st.sampled_from(["i", "a{1}", "a{i}", "i - 1", "Dim(a, 1)", "own", "T{x}", "T{3}"]),
)


def combined(children: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    operators = st.sampled_from(["+", "-", "*", "+", "-", "*", "DIV", "MOD", "/"])
    return st.one_of(
        st.tuples(children, operators, children).map(lambda t: f"({t[0]} {t[1]} {t[2]})"),
        children.map(lambda e: f"(-{e})"),
        children.map(lambda e: f"a{{{e}}}"),
        st.tuples(children, children).map(lambda t: f"f({t[0]}, {t[1]})"),
    )


nums = st.recursive(atoms, combined, max_leaves=5)
conditions = st.tuples(nums, st.sampled_from(["=", "<>", "<", ">="]), nums).map(" ".join)
simple = st.one_of(
    st.tuples(names, nums).map(lambda t: f"{t[0]} := {t[1]};"),
    st.tuples(names, nums).map(lambda t: f"{t[0]} := {t[0]} + {t[1]};"),
    st.tuples(names, names).map(lambda t: f"{t[0]} := {t[1]} * {t[1]};"),
    st.tuples(nums, nums).map(lambda t: f"a{{{t[0]}}} := {t[1]};"),
    names.map(lambda name: f"Incr {name};"),
    names.map(lambda name: f"Decr {name};"),
    nums.map(lambda e: f"show {e};"),
    st.tuples(st.sampled_from(["own", "a{2}", "a{x}"]), nums).map(
        lambda t: f"bump {t[0]}, {t[1]};"
    ),
    st.tuples(nums, nums).map(lambda t: f"exchange a{{{t[0]}}}, a{{{t[1]}}};"),
    names.map(lambda name: f"a{{i - 1}} := a{{i}} + {name} / i;"),
    conditions.map(lambda e: f"IF {e} RETURN;"),
)


def nested(children: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    body = st.lists(children, min_size=1, max_size=3).map(" ".join)
    ranges = st.sampled_from(["1 TO 3", "x TO y", "y TO x", "1 TO x MOD 4", "x TO 1 STEP -2"])
    return st.one_of(
        st.tuples(conditions, body, body).map(lambda t: f"IF {t[0]} THEN {t[1]} ELSE {t[2]} ENDIF"),
        st.tuples(ranges, body).map(lambda t: f"FOR i FROM {t[0]} DO {t[1]} ENDFOR"),
        st.tuples(conditions, body).map(
            lambda t: f"WHILE turns < 9 AND {t[0]} DO turns := turns + 1; {t[1]} ENDWHILE"
        ),
        st.tuples(nums, nums, body, body).map(
            lambda t: f"TEST {t[0]} CASE {t[1]}, 1: {t[2]} DEFAULT: {t[3]} ENDTEST"
        ),
    )


bodies = st.lists(st.recursive(simple, nested, max_leaves=6), min_size=1, max_size=5)
handlers = st.sampled_from(["", "ERROR TRYNEXT;", "ERROR x := 1; y := 2; RETRY;", "ERROR"])
starts = st.sampled_from(["0", "1", "3", "16777215", "4097"])
results = st.sampled_from(["u + v", "u * v - 1", "u DIV 3 + v", "(u - v) MOD 7", "u", "-u"])


@dataclass
class Watching(RecordingController):
    """Notes when something is shown; after a few ticks there is a trap, and then an end."""

    ticks_left: int = 4
    max_slices: int = 40
    raise_at_service: list[float] = field(default_factory=lambda: [1.0, 1.0, 1.0])
    instants: list[tuple[int, int]] = field(default_factory=list)

    def show(self, text: str) -> None:
        super().show(text)
        self.instants.append((self.slices, self.ticks_left))


def seen(text: str) -> object:
    """All that anybody can tell of a run."""
    with mock.patch.object(interpreter_cell, "TICKS", 7):
        ran = run(text, controller=Watching())
    cell = ran.controller
    assert isinstance(cell, Watching)
    fatal = ran.fatal and (ran.fatal.error.message, ran.fatal.stack)
    places = [one.span.start for one in cell.places]
    values = [ran.task.value(name) for name in ("a", "last", "traps")]
    ended = fatal, ran.stopped and ran.stopped.reason, cell.slices, cell.ticks_left
    # A zero may have a sign.
    return repr((cell.texts, cell.instants, places, values, ended))


@examples(75)
@given(bodies, handlers, st.tuples(starts, starts, starts), results)
def test_nobody_can_tell(
    body: list[str], handler: str, start: tuple[str, str, str], result: str
) -> None:
    x, y, z = start
    text = module(
        f"""
        PROC main()
          VAR num x := {x};
          VAR num y := {y};
          VAR num z := {z};
          VAR num own;
          VAR num turns;
          CONNECT irq WITH count;
          FOR i FROM 2 TO 3 DO
            {" ".join(body)}
          ENDFOR
          show x;
          show y;
          show z;
        {handler}
        ENDPROC
        FUNC num f(num u, num v)
          IF u > 1 AND u < 50 RETURN f(u - 1, v + 1);
          RETURN {result};
        ENDFUNC
        PROC bump(INOUT num v, num by)
          v := v + by;
        ENDPROC
        PROC exchange(INOUT num p, INOUT num q)
          VAR num old;
          old := p;
          p := q / 2;
          IF 1 / p > 0 q := old;
        ENDPROC
        PROC show(num value)
          last := value;
          TPWrite NumToStr(value, 0) + " " + ValToStr(value) \\Num:=value;
        ENDPROC
        TRAP count
          FOR i FROM 1 TO 3 DO Incr traps; ENDFOR
          show traps;
        ENDTRAP
        """,
        "CONST num T{3} := [3, 0, -2]; VAR num a{3} := [1, 2, 3]; VAR num last; VAR num traps;"
        "VAR intnum irq;",
    )
    found = seen(text)
    plainly = mock.patch.multiple(
        translation, integers_of=lambda *_: {}, count_locally=lambda *_: None
    )
    counters = mock.patch.object(statements, "position_once", lambda body, *_: body)
    with plainly, counters, mock.patch.object(calls, "takes_elements", return_value=False):
        expected = seen(text)
    assert found == expected


def test_a_question_may_call_with_a_fraction() -> None:
    ran = run(
        main("last := rest(5);", "VAR num last;", "FUNC num rest(num x) RETURN x MOD 2; ENDFUNC")
    )
    asked = check_query("rest(2.5) = last", "question", ran.task.program, ())
    assert asked.question is not None
    (answer,) = answers(ran.task, [asked.question], {})
    assert answer.error == "MOD takes integers, not 2.5"
