"""Error handling: every kind of statement with every way out of an ERROR clause."""

from __future__ import annotations

import pytest
from interpreter_cell import main, module, run, texts

from rapidsim.language.error_numbers import ERR_DIVZERO, ERR_EXCRTYMAX, ERR_FNCNORET

DATA = "VAR num d; VAR num x; VAR num a{3} := [1,2,3]; VAR pos where; VAR bool b; VAR string name;"
"""The error is a division by d, or an index d, until the ERROR clause sets d to 1."""

STATEMENTS = {
    "assignment": "x := 6 / d;",
    "element": "a{d} := 5;",
    "element read": "x := a{d};",
    "component": "where.x := 6 / d;",
    "array": "a := [6 / d, 1, 1];",
    "call": "inner 6 / d;",
    "call that fails inside": "fails;",
    "instruction": "TPWrite ValToStr(6 / d);",
    "late call": '%"inner"% 6 / d;',
    "function": "x := six();",
    "if": 'IF 6 / d > 5 THEN TPWrite "then"; ELSE TPWrite "else"; ENDIF',
    "else": 'IF 6 / d > 7 THEN TPWrite "then"; ELSE TPWrite "else"; ENDIF',
    "elseif": 'IF d = 9 THEN TPWrite "no"; ELSEIF 6 / d > 5 THEN TPWrite "then"; ENDIF',
    "compact if": 'IF 6 / d > 5 TPWrite "then";',
    "while": 'WHILE 6 / d > 5 DO TPWrite "turn"; d := 6; ENDWHILE',
    "for": "FOR i FROM 1 TO 1 / d DO TPWrite ValToStr(i); ENDFOR",
    "for with float": "FOR i FROM d TO 1 / d DO TPWrite ValToStr(i); ENDFOR",
    "test": 'TEST 6 / d CASE 6: TPWrite "six"; DEFAULT: TPWrite "default"; ENDTEST',
    "default": 'TEST 6 / d CASE 7: TPWrite "seven"; DEFAULT: TPWrite "default"; ENDTEST',
    "case": 'TEST 6 CASE 6 / d: TPWrite "six"; DEFAULT: TPWrite "default"; ENDTEST',
    "and": "b := d >= 0 AND 6 / d > 5;",
    "raise": "IF d = 0 RAISE 7;",
}
INNER = """
  PROC inner(num v) TPWrite "inner " + ValToStr(v); ENDPROC
  PROC fails() x := 6 / d; ENDPROC
  FUNC num six() RETURN 6 / d; ENDFUNC
"""


def routine(statement: str, way: str) -> str:
    more = (
        f'PROC p() TPWrite "before"; {statement} TPWrite "behind"; '
        f'ERROR TPWrite "error"; d := 1; {way} ENDPROC {INNER}'
    )
    return main(
        'p; TPWrite "after";\nERROR\nTPWrite "caller " + ValToStr(ERRNO = 7 OR ERRNO = ERR_DIVZERO '
        "OR ERRNO = ERR_OUTOFBND); TRYNEXT;",
        DATA,
        more,
    )


@pytest.mark.parametrize("kind", STATEMENTS)
def test_trynext_goes_on_behind_the_statement(kind: str) -> None:
    expected = ["before", "error", "behind", "after"]
    assert texts(routine(STATEMENTS[kind], "TRYNEXT;")) == expected


@pytest.mark.parametrize("kind", [kind for kind in STATEMENTS if kind != "raise"])
def test_retry_executes_the_statement_again(kind: str) -> None:
    shown = texts(routine(STATEMENTS[kind], "RETRY;"))
    again = {
        "call": ["inner 6"],
        "instruction": ["6"],
        "late call": ["inner 6"],
        "if": ["then"],
        "else": ["else"],
        "elseif": ["then"],
        "compact if": ["then"],
        "while": ["turn"],
        "for": ["1"],
        "for with float": ["1"],
        "test": ["six"],
        "default": ["default"],
        "case": ["six"],
    }
    assert shown == ["before", "error", *again.get(kind, []), "behind", "after"]


@pytest.mark.parametrize("kind", STATEMENTS)
@pytest.mark.parametrize("way", ["RETURN;", ""])
def test_return_and_the_end_of_the_clause_leave_the_routine(kind: str, way: str) -> None:
    assert texts(routine(STATEMENTS[kind], way)) == ["before", "error", "after"]


@pytest.mark.parametrize("kind", STATEMENTS)
def test_raise_hands_the_error_to_the_caller(kind: str) -> None:
    expected = ["before", "error", "caller TRUE", "after"]
    assert texts(routine(STATEMENTS[kind], "RAISE;")) == expected


def test_while_retries_in_a_later_turn() -> None:
    body = "x := 0; WHILE 6 / d > 0 AND x < 3 DO x := x + 1; d := 0; ENDWHILE TPWrite ValToStr(x);"
    clause = "ERROR d := 1; RETRY;"
    ran = run(module(f"PROC main() d := 1; {body} {clause} ENDPROC", DATA))
    assert ran.texts == ["3"]


def test_a_function_may_return_a_value_from_its_clause() -> None:
    more = "FUNC num f() RETURN 1 / d; ERROR RETURN 42; ENDFUNC"
    assert texts(main("TPWrite ValToStr(f());", DATA, more)) == ["42"]


def test_a_function_that_falls_off_its_clause_owes_its_value() -> None:
    more = 'FUNC num f() RETURN 1 / d; ERROR TPWrite "x"; ENDFUNC'
    ran = run(main("TPWrite ValToStr(f());", DATA, more))
    assert ran.fatal is not None
    assert ran.fatal.error.errno == ERR_FNCNORET


def test_the_clause_sees_and_writes_locals() -> None:
    more = """
      PROC p(num v)
        VAR num own := 3;
        VAR num lent := 4;
        add lent;
        x := 1 / d;
        TPWrite ValToStr(v) + ValToStr(own) + ValToStr(lent);
      ERROR
        v := v + 1; own := own + 1; lent := lent + 1;
        FOR i FROM 1 TO 2 DO own := own + 1; ENDFOR
        TRYNEXT;
      ENDPROC
      PROC add(INOUT num n) n := n + 1; ENDPROC
    """
    assert texts(main("p 1;", DATA, more)) == ["266"]


def test_without_a_clause_the_caller_gets_the_error() -> None:
    more = 'PROC p() q; TPWrite "no"; ENDPROC PROC q() x := 1 / d; ENDPROC'
    text = main('p; TPWrite "on";\nERROR\nTPWrite "caught"; TRYNEXT;', DATA, more)
    assert texts(text) == ["caught", "on"]


def test_nobody_catches() -> None:
    more = "PROC p(num n)\n  IF n = 0 THEN\n    x := 1 /\n       d;\n  ENDIF\n  p n - 1;\nENDPROC"
    ran = run(main("p 2;", DATA, more))
    assert ran.fatal is not None
    assert ran.fatal.error.errno == ERR_DIVZERO
    assert ran.fatal.error.cf == "ABB 40194"
    frames = [(frame.routine, frame.line) for frame in ran.fatal.stack]
    assert frames == [("main", 4), ("p", 11), ("p", 11), ("p", 8)]
    assert ran.fatal.stack[0].span.text == "p 2"


def test_an_error_passed_on_shows_where_it_happened() -> None:
    more = "PROC p()\n x := 1 / d;\nERROR\n RAISE;\nENDPROC"
    ran = run(main("p;", DATA, more))
    assert ran.fatal is not None
    assert [(f.routine, f.line) for f in ran.fatal.stack] == [("main", 4), ("p", 7)]
    assert ran.fatal.stack[-1].span.text == "1 / d"


def test_columns_are_found_behind_letters_of_several_bytes() -> None:
    ran = run(main('name := "äöü" + ValToStr(1 / d);', DATA))
    assert ran.fatal is not None
    assert ran.fatal.stack[-1].span.text == "1 / d"


def test_an_error_in_a_clause_is_final() -> None:
    more = "PROC p()\n x := 1 / d;\nERROR\n x := 2 / d;\nENDPROC"
    ran = run(main('p;\nERROR\nTPWrite "no"; TRYNEXT;', DATA, more))
    assert ran.texts == []
    assert ran.fatal is not None
    assert [(f.routine, f.line) for f in ran.fatal.stack] == [("main", 4), ("p", 9), ("p", 11)]


def test_an_error_handled_inside_a_clause_is_not_final() -> None:
    more = """
      PROC p() x := 1 / d; ERROR q; TRYNEXT; ENDPROC
      PROC q() x := 1 / d; TPWrite "q"; ERROR TRYNEXT; ENDPROC
    """
    assert texts(main('p; TPWrite "on";', DATA, more)) == ["q", "on"]


def test_retries_are_limited() -> None:
    more = 'PROC p() x := 1 / d; ERROR TPWrite "again"; RETRY; ENDPROC'
    ran = run(main("p;", DATA, more))
    assert ran.texts == ["again"] * 5
    assert ran.fatal is not None
    assert ran.fatal.error.errno == ERR_EXCRTYMAX


@pytest.mark.parametrize(
    ("number", "caught"),
    [("7", "7"), ("90", "90"), ("91", "illegal"), ("0", "illegal"), ("1.5", "illegal")],
)
def test_raise_allows_its_own_numbers(number: str, caught: str) -> None:
    text = main(
        f'x := {number}; RAISE x;\nERROR\nIF ERRNO = ERR_ILLRAISE TPWrite "illegal"; '
        "IF ERRNO <= 90 TPWrite ValToStr(ERRNO); TRYNEXT;",
        DATA,
    )
    assert texts(text) == [caught]


def test_a_loop_under_protection_keeps_its_jumps() -> None:
    body = """
      FOR i FROM 1 TO 3 DO
        x := 6 / d;
        IF x = 3 GOTO done;
        TPWrite "turn";
      ENDFOR
      done:
      TPWrite ValToStr(x);
    """
    ran = run(module(f"PROC main() {body} ERROR d := d + 2; RETRY; ENDPROC", DATA))
    assert ran.texts == ["3"]


LONG_JUMP = """
  VAR errnum my_error := 7;
  PROC main()
    top;
    TPWrite "main goes on";
  ERROR (my_error)
    TPWrite "main " + ValToStr(ERRNO);
    TRYNEXT;
  ENDPROC
  PROC top() middle; TPWrite "no"; ERROR TPWrite "top passes"; RAISE; ENDPROC
  PROC middle() bottom; TPWrite "no"; ERROR TPWrite "no"; RAISE; UNDO TPWrite "undo"; ENDPROC
  PROC bottom() RAISE 7; ERROR TPWrite "bottom"; RAISE; ENDPROC
"""


def test_a_long_jump_skips_clauses_and_runs_undo() -> None:
    assert texts(module(LONG_JUMP)) == ["bottom", "undo", "main 7", "main goes on"]


def test_a_long_jump_clause_with_other_numbers_is_passed() -> None:
    text = module(LONG_JUMP.replace("my_error := 7", "my_error := 8"))
    assert texts(text) == ["bottom", "no", "top passes", "main 7", "main goes on"]


def test_a_long_jump_finds_the_right_turn_of_a_recursion() -> None:
    more = """
      PROC main() deep 3; ENDPROC
      PROC deep(num n)
        IF n = 0 RAISE 7;
        deep n - 1;
        TPWrite "back in " + ValToStr(n);
      ERROR (7)
        IF n = 0 RAISE;
        TPWrite "caught in " + ValToStr(n);
        TRYNEXT;
      ENDPROC
    """
    assert texts(module(more)) == ["caught in 1", "back in 1", "back in 2", "back in 3"]


def test_undo_runs_when_the_program_ends_inside() -> None:
    more = 'PROC p() q; UNDO TPWrite "undo"; ENDPROC PROC q() EXIT; ENDPROC'
    ran = run(main('p; TPWrite "no";', "", more))
    assert ran.texts == ["undo"]
    assert ran.stopped is not None


def test_undo_does_not_run_otherwise() -> None:
    more = 'PROC p() x := 1; UNDO TPWrite "undo"; ENDPROC'
    assert texts(main('p; TPWrite "on";', DATA, more)) == ["on"]


def test_endless_recursion_is_a_stack_overflow_that_nothing_catches() -> None:
    more = 'PROC p() p; ERROR TPWrite "no"; TRYNEXT; ENDPROC'
    ran = run(main("p;", "", more))
    assert ran.texts == []
    assert ran.fatal is not None
    assert ran.fatal.error.cf == "ABB 40222"
    assert "stack overflow" in ran.fatal.error.message


def test_deep_recursion_is_no_error() -> None:
    more = "FUNC num p(num n) IF n = 0 RETURN 0; RETURN 1 + p(n - 1); ENDFUNC"
    assert texts(main("TPWrite ValToStr(p(4000));", "", more)) == ["4000"]
