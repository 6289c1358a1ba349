"""Control flow: branches, loops, GOTO, RETURN, EXIT, unknown calls, places."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import pytest
from interpreter_cell import TICKS, RecordingController, checked, main, run, texts

from rapidsim.language.errors import Stopped

DATA = "VAR num n; VAR num i; VAR num j; VAR string s;"


def said(body: str, data: str = DATA, more: str = "") -> str:
    """The string s after some statements."""
    (text,) = texts(main(f"{body}\nTPWrite s;", data, more))
    return text


@pytest.mark.parametrize(("n", "expected"), [(1, "one"), (2, "two"), (3, "many"), (4, "many")])
def test_if_takes_the_first_branch_that_holds(n: int, expected: str) -> None:
    body = f"""n := {n};
      IF n = 1 THEN s := "one";
      ELSEIF n = 2 THEN s := "two";
      ELSE s := "many";
      ENDIF
    """
    assert said(body) == expected


def test_compact_if() -> None:
    assert said('IF n = 0 s := "zero"; IF n = 1 s := "one";') == "zero"


@pytest.mark.parametrize(("n", "expected"), [(1, "a"), (2, "b"), (3, "b"), (4, "c")])
def test_test_takes_the_first_case(n: int, expected: str) -> None:
    body = f"""n := {n};
      TEST n + 0
      CASE 1: s := "a";
      CASE 2, 1 + 2: s := "b";
      CASE 3: s := "never";
      DEFAULT: s := "c";
      ENDTEST
    """
    assert said(body) == expected


def test_test_of_strings_and_without_default() -> None:
    assert said('s := "b"; TEST s CASE "a": s := "A"; CASE "b": s := "B"; ENDTEST') == "B"
    assert said('s := "c"; TEST s CASE "a": s := "A"; ENDTEST') == "c"


def test_a_case_may_change_what_is_tested() -> None:
    assert said('TEST n CASE 0: n := 1; s := s + "0"; CASE 1: s := s + "1"; ENDTEST') == "0"


def test_while() -> None:
    assert said("WHILE n < 4 DO n := n + 1; s := s + ValToStr(n); ENDWHILE") == "1234"


def test_for_counter_hides_data_of_its_name() -> None:
    body = "i := 7; FOR i FROM 1 TO 2 DO s := s + ValToStr(i); ENDFOR s := s + ValToStr(i);"
    assert said(body) == "127"
    assert said("VAR num i := 7;\n" + body[8:]) == "127"


def test_loops_in_loops_with_one_name() -> None:
    body = """
      FOR i FROM 1 TO 2 DO
        FOR i FROM 5 TO 6 DO s := s + ValToStr(i); ENDFOR
        s := s + ValToStr(i);
      ENDFOR
      FOR i FROM 8 TO 9 DO s := s + ValToStr(i); ENDFOR
    """
    assert said(body) == "56156289"


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ('GOTO done; s := "no"; done: s := s + "x";', "x"),
        ("again: n := n + 1; s := s + ValToStr(n); IF n < 3 GOTO again;", "123"),
        (
            "FOR a FROM 1 TO 9 DO FOR b FROM 1 TO 9 DO "
            'IF a * b = 12 GOTO found; ENDFOR ENDFOR found: s := "f";',
            "f",
        ),
        (
            "FOR a FROM 1 TO 4 DO IF a = 2 GOTO skip; s := s + ValToStr(a); skip: ENDFOR",
            "134",
        ),
        (
            # Out of two loops, to a label of the loop around them.
            "FOR a FROM 1 TO 2 DO WHILE TRUE DO WHILE TRUE DO GOTO out; ENDWHILE ENDWHILE "
            's := "no"; out: s := s + ValToStr(a); ENDFOR',
            "12",
        ),
        (
            # A state machine inside a state machine, each with jumps of its own.
            "top: n := n + 1; FOR a FROM 1 TO 3 DO "
            "IF a = 2 GOTO next; s := s + ValToStr(a); "
            "IF n = 1 AND a = 3 GOTO top; IF n = 2 AND a = 1 GOTO bottom; next: ENDFOR "
            's := s + "no"; bottom: s := s + "e";',
            "131e",
        ),
        (
            'IF n = 0 THEN GOTO inside; s := "no"; inside: s := s + "i"; ENDIF s := s + "o";',
            "io",
        ),
        ('TEST n CASE 0: GOTO end; DEFAULT: s := "d"; ENDTEST s := "no"; end: s := s + "e";', "e"),
        ("back: IF n < 2 THEN n := n + 1; GOTO back; ENDIF s := ValToStr(n); unused: ", "2"),
    ],
)
def test_goto(body: str, expected: str) -> None:
    assert said(body) == expected


def test_return_ends_the_routine() -> None:
    more = 'PROC p() s := "a"; RETURN; s := "b"; ENDPROC'
    assert said("p;", more=more) == "a"


def test_exit_passes_through() -> None:
    ran = run(main('TPWrite "a"; p; TPWrite "c";', "", "PROC p() EXIT; ENDPROC"))
    assert ran.texts == ["a"]
    assert ran.stopped is not None
    assert ran.stopped.reason == "EXIT"


@pytest.mark.parametrize(
    "loop",
    [
        "WHILE TRUE DO ENDWHILE",
        "FOR k FROM 1 TO 1E30 DO ENDFOR",
        "again: GOTO again;",
        "FOR k FROM 1 TO 2 STEP 0 DO ENDFOR",
        "FOR k FROM n TO 1 STEP 0 DO ENDFOR",
    ],
)
def test_an_endless_loop_lets_time_pass(loop: str) -> None:
    controller = RecordingController()
    ran = run(main(loop, DATA), controller=controller)
    assert ran.stopped is not None
    assert ran.stopped.reason == "time limit"
    assert controller.slices == controller.max_slices + 1


def test_a_tick_a_turn() -> None:
    controller = RecordingController()
    run(main("FOR k FROM 1 TO 10 DO WHILE FALSE DO ENDWHILE ENDFOR"), controller=controller)
    assert controller.ticks_left == TICKS - 10


@pytest.mark.parametrize(("calls", "ticks"), [(20, 0), (40, 2)])
def test_a_routine_that_leads_to_more_than_a_thousand_calls_takes_a_tick(
    calls: int, ticks: int
) -> None:
    more = f"""
      PROC outer() {calls * "inner; "} ENDPROC
      PROC inner() {calls * "leaf; "} ENDPROC
      PROC leaf() n := n + 1; ENDPROC
    """
    controller = RecordingController()
    ran = run(main("outer; outer;", "VAR num n;", more), controller=controller)
    assert ran.task.value("n") == 2.0 * calls**2
    assert controller.ticks_left == TICKS - ticks


def test_a_place_says_line_routine_and_arguments() -> None:
    text = main("p 3;", "", 'PROC p(num n)\n  TPWrite "x"\n    \\Num:=n + 1;\nENDPROC')
    (place,) = run(text).controller.places
    assert (place.routine, place.span.line) == ("p", 7)
    assert dict(place.arguments) == {"tptext": '"x"', "num": "n + 1"}


def test_a_call_among_the_arguments_does_not_take_the_place() -> None:
    more = 'FUNC num f()\n  TPWrite "inner";\n  RETURN 1;\nENDFUNC'
    ran = run(main('TPWrite "outer" \\Num:=f();', "", more))
    assert [place.span.line for place in ran.controller.places] == [7, 4]


def test_moves_get_their_arguments() -> None:
    data = """
      CONST robtarget p10 := [[600,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
      PERS tooldata grip := [TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
    """
    ran = run(main("MoveL Offs(p10, 0, 0, 50), v100, fine, grip;", data))
    (move,) = ran.controller.moves
    assert move.to.trans == (600.0, 0.0, 850.0)  # type: ignore[union-attr]
    assert move.tool.tframe.trans.z == 100.0
    (place,) = ran.controller.places
    assert place.arguments["topoint"] == "Offs(p10, 0, 0, 50)"
    assert place.arguments["tool"] == "grip"


def test_an_unknown_routine_is_reported_and_skipped() -> None:
    ran = run(main('TPWrite "a"; AcmeGripperOpen 3 \\Fast; TPWrite "b";'), assumes=True)
    assert ran.texts == ["a", "b"]
    assert ran.controller.skipped == [("AcmeGripperOpen", "skipped")]


def test_undeclared_signals_are_made_on_use() -> None:
    body = 'SetDO doGrip, 1; IF doGrip = 1 TPWrite "closed";'
    assert texts(main(body)) == ["closed"]


def test_conditions_are_evaluated_again_while_waiting() -> None:
    controller = RecordingController()
    body = 'WaitUntil n >= 3; TPWrite "three";'
    trap = "TRAP count n := n + 1; ENDTRAP"
    connect = "CONNECT irq WITH count; "
    text = main(connect + body, "VAR intnum irq; VAR num n;", trap)
    controller.raise_at_service = [1.0, 1.0, 1.0]
    assert run(text, controller=controller).texts == ["three"]


def test_programs_are_checked_before() -> None:
    assert checked(main("")).routines.keys() == {"main"}


def test_an_unknown_function_is_reported_and_has_no_value() -> None:
    ran = run(main('n := AcmeForce(3); TPWrite "n" \\Num:=n;', DATA), assumes=True)
    assert ran.texts == ["n0"]
    assert ran.controller.skipped == [("AcmeForce", "skipped, 0 taken for its value")]


class Comparing(RecordingController):
    """Compares the state of the program at each text with that at the one before."""

    def __init__(self) -> None:
        super().__init__()
        self.program_state: Callable[[], Iterable[object]] = tuple
        self.before: list[object] = []
        self.is_same: list[bool] = []
        self.ends: list[object] = []

    def show(self, text: str) -> None:
        super().show(text)
        state = list(self.program_state())
        self.is_same.append(state == self.before)
        self.before = state
        self.ends.append(state[-1])
        if len(self.texts) == 3:
            raise Stopped("seen enough")


@pytest.mark.parametrize(
    ("loop", "is_same"),
    [
        ('WHILE TRUE DO TPWrite "a"; ENDWHILE', True),
        ('WHILE TRUE DO x := 1; own := 2; TPWrite "a"; ENDWHILE', True),
        ('WHILE TRUE DO count; TPWrite "a"; ENDWHILE', False),
        ('WHILE TRUE DO own := own + 1; TPWrite "a"; ENDWHILE', False),
        ('WHILE TRUE DO list{3} := list{3} + 1; TPWrite "a"; ENDWHILE', False),
        ('WHILE TRUE DO mine{2} := mine{2} + 1; TPWrite "a"; ENDWHILE', False),
        ('WHILE TRUE DO TPWrite "a"; TPWrite "b"; ENDWHILE', False),
        ("WHILE TRUE DO again; ENDWHILE", True),
        ('FOR i FROM 1 TO 9 DO TPWrite "a"; ENDFOR', False),
        ("FOR i FROM 1 TO 9 DO show i; ENDFOR", False),
        ('WHILE TRUE DO FOR i FROM 1 TO 3 DO x := i; ENDFOR TPWrite "a"; ENDWHILE', True),
        ("deeper 1;", False),
    ],
)
def test_a_program_is_where_it_was_before(loop: str, is_same: bool) -> None:
    controller = Comparing()
    run(
        main(
            f"VAR num own; VAR num mine{{2}}; {loop}",
            "VAR num x; VAR num list{3};",
            'PROC count() x := x + 1; ENDPROC PROC again() TPWrite "a"; ENDPROC '
            'PROC show(num i) TPWrite "a"; ENDPROC '
            'PROC deeper(num v) TPWrite "a"; deeper 1; ENDPROC',
        ),
        controller=controller,
    )
    assert controller.is_same == [False, is_same, is_same]
    assert None not in controller.ends


@pytest.mark.parametrize(("elements", "is_compared"), [(19_999, True), (20_000, False)])
def test_a_large_state_is_not_compared(elements: int, is_compared: bool) -> None:
    controller = Comparing()
    data = f"VAR num list{{{elements}}};"
    run(main('WHILE TRUE DO list{1} := 1; TPWrite "a"; ENDWHILE', data), controller=controller)
    assert [one is not None for one in controller.ends] == [is_compared] * 3
