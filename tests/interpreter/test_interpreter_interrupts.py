"""Traps: connected, called between statements, final in their errors."""

from __future__ import annotations

from interpreter_cell import RecordingController, main, run

from rapidsim.language.error_numbers import ERR_ALRDYCNT

DATA = "VAR intnum irq; VAR num n; VAR num d;"
LOOP = "CONNECT irq WITH count; WHILE n < 2 DO ENDWHILE"


def interrupted(text: str, times: int = 2) -> tuple[list[str], RecordingController]:
    controller = RecordingController(raise_at_service=[1.0] * times)
    ran = run(text, controller=controller)
    assert ran.fatal is None, ran.fatal.error.message
    return ran.texts, controller


def test_a_trap_runs_in_a_loop_and_knows_its_interrupt() -> None:
    trap = "TRAP count n := n + 1; TPWrite ValToStr(INTNO = irq); ENDTRAP"
    shown, _ = interrupted(main(LOOP + ' TPWrite "done";', DATA, trap))
    assert shown == ["TRUE", "TRUE", "done"]


def test_a_trap_may_be_named_at_run_time() -> None:
    trap = 'TRAP count2 n := n + 1; TPWrite "trap"; ENDTRAP'
    text = main(LOOP.replace("count", '%"count" + ValToStr(2)%'), DATA, trap)
    assert interrupted(text)[0] == ["trap", "trap"]


def test_errno_is_as_before_behind_a_trap() -> None:
    trap = "TRAP count n := n + 1; n := 1 / d + n; ERROR TRYNEXT; ENDTRAP"
    text = main(
        "CONNECT irq WITH count; RAISE 7;\n"
        "ERROR WHILE n < 2 DO ENDWHILE TPWrite ValToStr(ERRNO); TRYNEXT;",
        DATA,
        trap,
    )
    assert interrupted(text)[0] == ["7"]


def test_an_error_in_a_trap_is_final() -> None:
    trap = "TRAP count\n n := 1 / d;\nENDTRAP"
    controller = RecordingController(raise_at_service=[1.0])
    text = main(LOOP + '\nERROR\nTPWrite "no"; TRYNEXT;', DATA, trap)
    ran = run(text, controller=controller)
    assert ran.texts == []
    assert ran.fatal is not None
    assert [(f.routine, f.line) for f in ran.fatal.stack] == [("main", 4), ("count", 9)]


def test_a_trap_may_return() -> None:
    trap = 'TRAP count n := n + 1; IF n > 0 RETURN; TPWrite "no"; ENDTRAP'
    assert interrupted(main(LOOP, DATA, trap))[0] == []


TRAP = "TRAP count ENDTRAP"


def test_an_interrupt_that_is_connected_cannot_be_connected_again() -> None:
    text = main("CONNECT irq WITH count;\nCONNECT irq WITH count;", DATA, TRAP)
    fatal = run(text).fatal
    assert fatal is not None
    assert fatal.error.errno == ERR_ALRDYCNT
    assert fatal.error.cf == "ABB 40191"
    assert [(frame.routine, frame.line) for frame in fatal.stack] == [("main", 5)]


def test_a_handler_finds_out_that_an_interrupt_is_connected() -> None:
    text = main(
        'CONNECT irq WITH count; CONNECT irq WITH %"count"%; TPWrite ValToStr(irq);\n'
        'ERROR IF ERRNO = ERR_ALRDYCNT TPWrite "again"; TRYNEXT;',
        DATA,
        TRAP,
    )
    assert run(text).texts == ["again", "1"]


def test_an_interrupt_that_was_deleted_is_connected_again() -> None:
    text = main(
        "CONNECT irq WITH count; IDelete irq; CONNECT irq WITH count; TPWrite ValToStr(irq > 0);",
        DATA,
        TRAP,
    )
    ran = run(text)
    assert ran.fatal is None
    assert ran.texts == ["TRUE"]


def test_an_interrupt_passed_by_reference_is_connected_once() -> None:
    text = main(
        'attach irq; attach irq;\nERROR IF ERRNO = ERR_ALRDYCNT TPWrite "again"; TRYNEXT;',
        DATA,
        TRAP + "\nPROC attach(VAR intnum which) CONNECT which WITH count; ENDPROC",
    )
    assert run(text).texts == ["again"]
