"""Signals of a cell: declared and limited, wired, stimulated, waited for, raising interrupts."""

from pathlib import Path

import pytest
from simulation_program import Ran, ran

from rapidsim.controller.cell.description import CellIo
from rapidsim.controller.journal.events import EventKind
from rapidsim.files import InputError, SourceFile
from rapidsim.jobs.checking.checked_program import load
from rapidsim.station.cell_names import declared_names
from rapidsim.station.read import read_io
from rapidsim.station.station import Station


def io(folder: Path, text: str) -> CellIo:
    file = folder / "io.toml"
    file.write_text(text)
    return read_io(file)


def run(statements: str, given: CellIo | None = None, more: str = "") -> Ran:
    text = f"MODULE cell\n{more}\nPROC main()\n{statements}\nENDPROC\nENDMODULE\n"
    return ran(text, io=given or CellIo(), max_time_s=200.0)


def times_of(run: Ran, message: str) -> list[float]:
    return [round(e.time_s, 6) for e in run.run.events if e.message == message]


def test_declared_signals_start_where_the_station_says_and_keep_their_limits(
    tmp_path: Path,
) -> None:
    declared = io(
        tmp_path,
        """
        [signals]
        diReady = { type = "di", value = 1 }
        goProgram = { type = "go", width = 4 }
        aoFlow = { type = "ao", min = 0, max = 10 }
        """,
    )
    statements = """
        TPWrite "ready "\\Bool:=TestDI(diReady);
        SetGO goProgram,15;
        SetGO goProgram,16;
        SetAO aoFlow,10.5;
        SetDO diReady,0;
      ERROR
        IF ERRNO=ERR_GO_LIM TPWrite "group";
        IF ERRNO=ERR_AO_LIM TPWrite "analog";
        IF ERRNO=ERR_SIG_NAME TPWrite "input";
        TRYNEXT;
    """
    assert run(statements, declared).texts == ["ready TRUE", "group", "analog", "input"]


def test_a_signal_follows_those_it_is_wired_to_at_the_same_instant(tmp_path: Path) -> None:
    wired = io(
        tmp_path,
        """
        [[cross]]
        set = "doLamp"
        from = "doRun and not doFault"
        [[cross]]
        set = "doHorn"
        from = "not doLamp"
        """,
    )
    statements = """
        WaitTime 1;
        Set doRun;
        WaitTime 1;
        Set doFault;
        TPWrite "lamp "\\Num:=DOutput(doLamp);
        TPWrite "horn "\\Num:=DOutput(doHorn);
    """
    done = run(statements, wired)
    assert done.texts == ["lamp 0", "horn 1"]
    assert times_of(done, "doLamp = 1") == times_of(done, "doHorn = 0") == [1.0]
    assert times_of(done, "doLamp = 0") == times_of(done, "doHorn = 1") == [2.0]


def test_stimuli_come_by_the_clock_and_after_conditions(tmp_path: Path) -> None:
    world = io(
        tmp_path,
        """
        [[stimulus]]
        at = 1
        every = 2
        pulse = 0.5
        set = { diTick = 1 }
        [[stimulus]]
        when = "diTick = 1 and giCount < 2"
        after = 0.25
        set = { giCount = 2 }
        """,
    )
    done = run("WaitTime 4;\nWaitGI giCount,2;", world)
    assert times_of(done, "diTick = 1") == [1.0, 3.0]
    assert times_of(done, "diTick = 0") == [1.5, 3.5]
    assert times_of(done, "giCount = 2") == [1.25]


def test_a_stimulus_acts_at_the_occurrences_that_it_names(tmp_path: Path) -> None:
    world = io(
        tmp_path,
        """
        [[stimulus]]
        when = "doAsk = 1"
        after = 0.25
        set = { diAll = 1 }
        pulse = 0.1
        [[stimulus]]
        when = "doAsk = 1"
        set = { diNotSecond = 1 }
        pulse = 0.1
        skip = [2]
        [[stimulus]]
        at = 0.5
        every = 1
        set = { diTick = 1 }
        pulse = 0.1
        nth = [4, 1]
        [[stimulus]]
        every = 2
        set = { diTock = 1 }
        pulse = 0.1
        skip = [1, 2]
        """,
    )
    done = run("FOR i FROM 1 TO 3 DO\nPulseDO doAsk;\nWaitTime 2;\nENDFOR\nWaitTime 2;", world)
    assert times_of(done, "diAll = 1") == [0.25001, 2.25002, 4.25003]
    assert times_of(done, "diNotSecond = 1") == [1e-05, 4.00003]
    assert times_of(done, "diTick = 1") == [0.5, 3.5]
    assert times_of(done, "diTock = 1") == [6.0, 8.0]


@pytest.mark.parametrize(
    ("keys", "problem"),
    [
        ("at = 1\nset = { diA = 1 }\nskip = [1]", "skip: it counts how often `when` is met"),
        ("every = 1\nset = { diA = 1 }\nnth = [0]", "nth: whole numbers from 1 up are needed"),
        ("every = 1\nset = { diA = 1 }\nnth = [1]\nskip = [2]", "give `nth`, .* or `skip`"),
    ],
)
def test_occurrences_are_whole_numbers_of_what_repeats(
    tmp_path: Path, keys: str, problem: str
) -> None:
    with pytest.raises(InputError, match=problem):
        io(tmp_path, f"[[stimulus]]\n{keys}")


@pytest.mark.parametrize(
    ("statement", "named"),
    [
        ("WaitDI diNever,1;", "diNever"),
        ("WaitUntil diNever=1 OR doOther=1;", "`diNever`, `doOther`"),
        (
            "StopMove;\nMoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;",
            "Stop",
        ),
    ],
)
def test_a_wait_that_nothing_can_end_ends_the_run(statement: str, named: str) -> None:
    done = run(statement)
    found = done.only("R106")
    assert named in found.violation.message
    assert found.span is not None
    assert (done.end, found.span.line) == ("error", 3 + statement.count("\n") + 1)


def test_a_wait_for_what_stimuli_may_bring_goes_on(tmp_path: Path) -> None:
    chain = io(
        tmp_path,
        """
        [[stimulus]]
        when = "doStart = 1"
        after = 1
        set = { diA = 1 }
        [[cross]]
        set = "diB"
        from = "diA"
        """,
    )
    done = run('Set doStart;\nWaitDI diB,1;\nTPWrite "there";\nWaitDI diC,1;', chain)
    assert done.texts == ["there"]
    assert times_of(done, "there") == [1.0]
    assert "`diC`" in done.only("R106").violation.message


def test_interrupts_of_analog_signals_persistents_and_all_values(tmp_path: Path) -> None:
    world = io(
        tmp_path,
        """
        [[stimulus]]
        at = 1
        set = { aiLevel = 4 }
        [[stimulus]]
        at = 2
        set = { aiLevel = 6 }
        [[stimulus]]
        at = 3
        set = { aiLevel = 6.5 }
        [[stimulus]]
        at = 4
        set = { aiLevel = 9 }
        """,
    )
    done = run(
        """
        CONNECT level WITH said;
        ISignalAI aiLevel,AIO_ABOVE_HIGH,5,0,1,level;
        CONNECT parts WITH counted;
        IPers count,parts;
        WaitTime 5;
        count:=3;
        WaitTime 1;
        IDelete parts;
        count:=4;
        WaitTime 1;
        """,
        world,
        """
        VAR intnum level;
        VAR intnum parts;
        PERS num count:=0;
        TRAP said
          TPWrite "level "\\Num:=AInput(aiLevel);
        ENDTRAP
        TRAP counted
          TPWrite "count "\\Num:=count;
        ENDTRAP
        """,
    )
    assert done.texts == ["level 6", "level 9", "count 3"]
    assert times_of(done, "count 3") == [5.0]


def test_what_happens_while_an_interrupt_sleeps_is_not_made_up_for() -> None:
    done = run(
        """
        CONNECT i WITH said;
        ISignalDO\\Single,doA,1,i;
        ISleep i;
        PulseDO\\PLength:=0.1,doA;
        WaitTime 1;
        IWatch i;
        PulseDO\\PLength:=0.1,doA;
        WaitTime 1;
        PulseDO\\PLength:=0.1,doA;
        """,
        more='VAR intnum i;\nTRAP said\nTPWrite "said";\nENDTRAP',
    )
    assert times_of(done, "said") == [1.0]


def test_a_trap_that_raises_itself_ends_the_run() -> None:
    done = run(
        "CONNECT i WITH again;\nISignalDO doA,edge,i;\nSet doA;",
        more="VAR intnum i;\nTRAP again\nInvertDO doA;\nENDTRAP",
    )
    assert done.end == "error"
    assert "again was raised" in done.only("R110").violation.message
    assert sum(e.kind is EventKind.INTERRUPT for e in done.run.events) > 1000


def test_signals_that_the_station_names_are_not_reported_as_unknown(tmp_path: Path) -> None:
    world = io(
        tmp_path,
        """
        [signals]
        doA = { type = "do" }
        [[stimulus]]
        when = "doB = 1"
        set = { diC = 1 }
        """,
    )
    text = (
        "MODULE m\nPROC main()\nSet doA;\nSet doB;\nWaitDI diC,1;\nSet doD;\nENDPROC\nENDMODULE\n"
    )
    names = declared_names(Station(io=world))
    found = load([SourceFile("m.mod", text, "utf-8")], cell=names).diagnostics
    assert [(d.violation.code, d.span.line) for d in found if d.span] == [("I801", 6)]
