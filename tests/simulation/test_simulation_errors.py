"""An error three calls deep: uncaught, and caught in each of the ways RAPID has."""

import pytest
from simulation_program import calls, ran

PROGRAM = """MODULE cell
  VAR num zero;
  PROC main()
    TPWrite "start";
    weld;
    TPWrite "after weld";
  %(main)s
  ENDPROC
  PROC weld()
    seam;
    TPWrite "after seam";
  %(weld)s
  UNDO
    TPWrite "undo weld";
  ENDPROC
  PROC seam()
    TPWrite "share " + ValToStr(share());
    TPWrite "after share";
  %(seam)s
  ENDPROC
  FUNC num share()
    VAR num part;
    part := 6 / zero;
    RETURN part;
  %(share)s
  ENDFUNC
ENDMODULE
"""


def program(*, listed: str = "", **clauses: str) -> str:
    """The program with ERROR clauses in some of its routines; `listed` is for that of main."""
    head = {"main": f"ERROR {listed}\n    "}
    written = {
        name: head.get(name, "ERROR\n    ") + clauses[name] if name in clauses else ""
        for name in ("main", "weld", "seam", "share")
    }
    return PROGRAM % written


def test_uncaught_it_names_the_calls_that_led_there() -> None:
    it = ran(program())
    assert it.end == "error"
    assert it.texts == ["start"]
    found = it.only("R101")
    assert found.violation.message == "division by zero (ERR_DIVZERO)"
    assert found.span is not None
    assert (found.routine, found.span.line, found.span.text) == ("share", 23, "6 / zero")
    assert calls(found) == [
        ("called from seam", 17),
        ("called from weld", 10),
        ("called from main", 5),
    ]


AFTER_SEAM = ["after share", "after seam", "after weld"]
CAUGHT = {
    "retry where it happens": (
        {"share": "zero := 2; RETRY;"},
        ["start", "share 3", *AFTER_SEAM],
    ),
    "trynext where it happens": (
        {"share": "TRYNEXT;"},
        ["start", "share 0", *AFTER_SEAM],
    ),
    "return where it happens": (
        {"share": "RETURN -1;"},
        ["start", "share -1", *AFTER_SEAM],
    ),
    "retry of the call": (
        {"seam": "zero := 3; RETRY;"},
        ["start", "share 2", *AFTER_SEAM],
    ),
    "trynext behind the call": ({"seam": "TRYNEXT;"}, ["start", *AFTER_SEAM]),
    "return from a caller": (
        {"weld": "RETURN;"},
        ["start", "after weld"],
    ),
    "the end of a clause": (
        {"weld": 'TPWrite "clause";'},
        ["start", "clause", "after weld"],
    ),
    "raise to the caller": (
        {"share": "RAISE;", "seam": 'TPWrite "seam " + ValToStr(ERRNO = ERR_DIVZERO); TRYNEXT;'},
        ["start", "seam TRUE", *AFTER_SEAM],
    ),
    "raise all the way up": (
        {"share": "RAISE;", "seam": "RAISE;", "weld": "RAISE;", "main": "TRYNEXT;"},
        ["start", "after weld"],
    ),
}


@pytest.mark.parametrize("way", CAUGHT)
def test_caught_it_goes_on_as_the_clause_says(way: str) -> None:
    clauses, expected = CAUGHT[way]
    it = ran(program(**clauses))
    assert (it.end, it.findings) == ("ended", [])
    assert it.texts == expected


def test_a_long_jump_lands_in_the_clause_that_lists_the_number() -> None:
    unasked = 'TPWrite "no"; TRYNEXT;'
    it = ran(
        program(share="RAISE;", seam=unasked, weld=unasked, main="TRYNEXT;", listed="(ERR_DIVZERO)")
    )
    assert it.end == "ended"
    assert it.texts == ["start", "undo weld", "after weld"]


def test_the_retry_limit_is_an_error_of_its_own() -> None:
    it = ran(program(share='TPWrite "try"; RETRY;'))
    assert it.end == "error"
    assert it.texts == ["start", *["try"] * 5]
    told = it.only("R101").violation.message
    assert told == "4 retries did not help: division by zero (ERR_EXCRTYMAX)"
    seam = 'TPWrite "seam " + ValToStr(ERRNO = ERR_EXCRTYMAX); TRYNEXT;'
    caught = ran(program(share="RETRY;", seam=seam))
    assert (caught.end, caught.texts) == ("ended", ["start", "seam TRUE", *AFTER_SEAM])


def test_an_error_in_an_error_clause_is_final() -> None:
    it = ran(program(seam="zero := 1 / zero;", weld="TRYNEXT;", main="TRYNEXT;"))
    assert (it.end, it.texts) == ("error", ["start"])
    found = it.only("R101")
    assert (found.routine, found.span and found.span.line) == ("seam", 22)
    # The clause runs at the call in which the error happened.
    assert calls(found)[-1] == ("called from main", 5)


def test_a_number_raised_by_the_program_is_compared_by_its_name() -> None:
    text = """MODULE cell
  VAR errnum ERR_GRIP := -1;
  PROC main()
    BookErrNo ERR_GRIP;
    grip;
  ERROR
    TEST ERRNO
    CASE ERR_DIVZERO, ERR_OUTOFBND:
      TPWrite "no";
    CASE ERR_GRIP:
      TPWrite "grip";
      TRYNEXT;
    ENDTEST
  ENDPROC
  PROC grip()
    RAISE ERR_GRIP;
  ERROR
    RAISE;
  ENDPROC
ENDMODULE
"""
    assert ran(text).texts == ["grip"]


def test_an_error_passes_through_thousands_of_routines() -> None:
    text = """MODULE cell
  VAR num zero;
  PROC main()
    deeper 1;
  ERROR (ERR_DIVZERO)
    TPWrite "main";
    TRYNEXT;
  ENDPROC
  PROC deeper(num n)
    IF n > 3000 zero := 1 / zero;
    deeper n + 1;
  ERROR
    RAISE;
  ENDPROC
ENDMODULE
"""
    assert ran(text).texts == ["main"]


def test_a_connected_interrupt_is_connected_again_only_after_idelete() -> None:
    text = """MODULE cell
  VAR intnum irq;
  PROC main()
    CONNECT irq WITH beat;
    ITimer 1, irq;
    CONNECT irq WITH beat;
    WaitTime 1.5;
    IDelete irq;
    CONNECT irq WITH beat;
    ITimer \\Single, 1, irq;
    WaitTime 1.5;
  ERROR
    IF ERRNO = ERR_ALRDYCNT TPWrite "connected already";
    TRYNEXT;
  ENDPROC
  TRAP beat
    TPWrite "beat";
  ENDTRAP
ENDMODULE
"""
    assert ran(text).texts == ["connected already", "beat", "beat"]
