"""What Python's own tools see of a RAPID program: code, lines, tracebacks, limits."""

from __future__ import annotations

import linecache
import sys
import traceback
from collections import Counter
from pathlib import Path
from types import FrameType
from typing import Any

import pytest
from interpreter_cell import RecordingController, checked, main, module, run
from whole_findings import assert_section, sections

from rapidsim.interpreter.limits import NotExecutableError
from rapidsim.interpreter.linking.loader import FatalError, load
from rapidsim.interpreter.linking.translation import show_python
from rapidsim.interpreter.tools.inspection import place_of, rapid_text
from rapidsim.language.controller import uniform_controller

HERE = Path(__file__).parent
SHAPES = sections(HERE / "shapes.txt")
"""Statements of main, and behind `||` other items."""
DATA = (
    "VAR num x; VAR num y; VAR bool b; VAR string s; VAR num a{10}; VAR pose p; VAR pose q{3}; "
    "VAR intnum irq;"
)


@pytest.mark.parametrize("shape", SHAPES)
def test_shapes(shape: str) -> None:
    body, _, more = SHAPES[shape].partition("|| ")
    found = show_python(checked(main(body, DATA, more), assumes=True))
    assert_section(HERE / "golden" / "shapes.txt", shape, found)


LINES = """MODULE cell
VAR num x;
VAR num d := 2;
PROC main()
  VAR num own;
  own := 1;
  FOR i FROM 1 TO 2 DO
    x := x +
      i / d;
  ENDFOR
  IF x = 100 THEN
    x := 0;
  ELSEIF x > 1 THEN
    x := 9 / d;
  ENDIF
  WHILE x > 5 DO
    x := 0;
  ENDWHILE
  TEST 4 / d
  CASE 1:
    x := 1;
  CASE 2:
    x := 2;
  ENDTEST
  p 1 / d,
    own
    ;
ERROR
  d := 1;
  RETRY;
ENDPROC
PROC p(num a, INOUT num b)
  b := a;
ENDPROC
ENDMODULE
"""


def test_each_statement_is_one_line_event() -> None:
    """Protected or not, on one line or several: once each time it is executed."""
    controller = RecordingController()
    task = load(checked(LINES), uniform_controller(controller))
    counted: Counter[int] = Counter()

    def trace(frame: FrameType, event: str, argument: Any) -> Any:
        if frame.f_code.co_filename != "cell.mod":
            return None
        if event == "line":
            counted[frame.f_lineno] += 1
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        task.run()
    finally:
        sys.settrace(before)
    once = {5, 6, 11, 13, 20, 22, 23, 25, 33}
    assert {line: counted[line] for line in once} == dict.fromkeys(once, 1)
    assert counted[8] == 2
    # Under protection a branching statement is seen again when its decision is carried out.
    assert counted[19] == 2
    assert counted[14] == 1
    assert not {9, 10, 12, 17, 21, 26, 27, 29, 30} & counted.keys()


def test_tracebacks_show_rapid_lines() -> None:
    text = module('PROC main()\n  VAR num d;\n  TPWrite "ä" + ValToStr(1 / d);\nENDPROC')
    with pytest.raises(FatalError) as caught:
        load(checked(text), uniform_controller(RecordingController())).run()
    shown = "".join(traceback.format_exception(caught.value))
    assert 'File "cell.mod", line 5, in main' in shown
    assert 'TPWrite "ä" + ValToStr(1 / d);' in shown
    assert linecache.getline("cell.mod", 5).strip().startswith("TPWrite")


def test_the_recursion_limit_is_put_back() -> None:
    before = sys.getrecursionlimit()
    run(main("p;", "", "PROC p() p; ENDPROC"))
    assert sys.getrecursionlimit() == before


def nested(depth: int, inner: str) -> str:
    opening = "".join(f"FOR i{n} FROM 1 TO 1 DO " for n in range(depth))
    return opening + inner + "ENDFOR " * depth


@pytest.mark.parametrize("inner", ["x := 1 / x; ", "WHILE 1 / x < 0 DO ENDWHILE "])
def test_fifteen_loops_fit_with_everything_around(inner: str) -> None:
    depth = 15 - inner.startswith("WHILE")
    body = f"{nested(depth, inner)} ERROR RETURN; UNDO x := 1;"
    assert run(main(body, "VAR num x := 1;")).fatal is None


def test_more_loops_are_refused_before_anything_runs() -> None:
    with pytest.raises(NotExecutableError) as caught:
        run(main(nested(16, "x := 1; "), "VAR num x;"))
    assert "a loop inside 15 others cannot be simulated" in str(caught.value)
    assert caught.value.diagnostic.span is not None


def test_many_branches() -> None:
    cases = "".join(f"CASE {n}: x := {n};\n" for n in range(900))
    chain = "IF x = -1 THEN x := 0;\n" + "".join(
        f"ELSEIF x = {n} THEN x := {n};\n" for n in range(190)
    )
    body = f"x := 899;\nTEST x\n{cases} ENDTEST\n{chain} ENDIF\nx := 1 / x;\nERROR RETURN;"
    assert run(main(body, "VAR num x;")).fatal is None


def test_code_is_the_same_each_time() -> None:
    text = main(SHAPES["protected"], DATA)
    assert show_python(checked(text)) == show_python(checked(text))


@pytest.mark.parametrize(
    "statement",
    [
        "x := " + "(" * 150 + "1" + ")" * 150 + ";",
        "x := " + " + ".join("x" * 150) + ";",
        "x := " + "-(" * 70 + "x" + ")" * 70 + ";",
        "x := 1 / x; " + "IF x = 1 / x THEN " * 150 + "x := 2; " + "ENDIF " * 150,
    ],
)
def test_deep_nesting_that_the_parser_allows(statement: str) -> None:
    assert run(main(f"x := 1;\n{statement}\nERROR RETURN;", "VAR num x;")).fatal is None


def test_a_debugger_sees_elements_that_a_small_routine_gets() -> None:
    text = main(
        "exchange a{2}, a{3};",
        "VAR num a{3} := [1, 2, 3];",
        "PROC exchange(INOUT num p, INOUT num q)\nVAR num old;\n"
        "old := p;\np := q;\nq := old;\nENDPROC",
    )
    seen = []

    def trace(frame: FrameType, event: str, _: Any) -> Any:
        if frame.f_code.co_name == "exchange" and event == "line":
            seen.append((place_of(frame), rapid_text("p", frame), rapid_text("q", frame)))
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        run(text)
    finally:
        sys.settrace(before)
    assert [(p, q) for _, p, q in seen] == [("2", "3")] * 3 + [("3", "3")]
    assert {place for place, _, _ in seen} == {"exchange"}
