"""Loops that only look are taken to where something happens: the same run, at next to no cost."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pytest

from rapidsim.controller import position_reading
from rapidsim.controller.busy_wait import BusyWaitDetector
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.journal.events import EventKind
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.frames.transform import Array
from rapidsim.jobs.checking.check_files import check
from rapidsim.jobs.running.run_files import simulate
from rapidsim.motion.trajectory.samples import Samples
from rapidsim.simulation.results.simulation import End, Simulation

STATION = """
[signals]
diPart = { type = "di", value = 0 }
diOther = { type = "di", value = 0 }
doBusy = { type = "do" }
[[stimulus]]
at = 0.146041
set = { diPart = 1 }
[[stimulus]]
at = 0.05
set = { diOther = 1 }
[[stimulus]]
when = "doBusy = 1"
after = 0.08
set = { diOther = 0 }
"""
LOOPS = {
    "a loop without anything in it": "WHILE diPart=0 DO\nENDWHILE",
    "a jump": "again: IF DInput(diPart)=0 GOTO again;",
    "a loop that calls": "WHILE TRUE DO\nlook;\nIF seen RETURN;\nENDWHILE",
    "loops in a loop": "WHILE diPart=0 DO\nFOR i FROM 1 TO 3 DO\nlast:=i;\nENDFOR\nENDWHILE",
    "a loop that counts now and then": (
        'WHILE diPart=0 DO\nIF diOther=1 AND n=0 THEN\nIncr n;\nTPWrite "other";\nENDIF\nENDWHILE'
    ),
    "a loop that counts its rounds": "WHILE n<8000 DO\nIncr n;\nENDWHILE",
    "a loop that reads a clock": "ClkStart watch;\nWHILE ClkRead(watch)<0.06 DO\nENDWHILE",
    "a loop that remembers what a clock shows": (
        "ClkStart watch;\nWHILE diPart=0 DO\nlast:=ClkRead(watch);\nENDWHILE\nn:=last;"
    ),
    "a loop that remembers where the robot is": (
        "MoveAbsJ\\Conc,[[20,0,0,0,30,0],none],v100,fine,tool0;\n"
        "WHILE diOther=0 DO\nlast:=where();\nENDWHILE\nn:=last;"
    ),
    "one loop after the other": (
        "WHILE diOther=0 DO\nENDWHILE\nSetDO doBusy,1;\nWHILE diOther=1 DO\nENDWHILE"
    ),
    "a trap that ends it": (
        "CONNECT beat WITH tick;\nITimer 0.11,beat;\nWHILE n<3 DO\nENDWHILE\nIDelete beat;"
    ),
    "while the robot moves": (
        "MoveAbsJ [[20,0,0,0,30,0],none],v100,z10,tool0;\nWHILE diPart=0 DO\nENDWHILE"
    ),
    "until an output is set on the way": (
        "TriggIO there,10\\DOp:=doBusy,1;\n"
        "TriggJ CRobT(\\Tool:=tool0),v100,there,fine,tool0;\n"
        "WHILE diPart=0 DO\nENDWHILE"
    ),
    "outputs that are set as they are": (
        "WHILE diOther=0 DO\nReset doBusy;\nSetDO doBusy,0;\nIF diPart=1 n:=5;\nENDWHILE"
    ),
    "outputs between settings": (
        "WHILE n<300 DO\nReset doBusy;\nConfL\\Off;\nReset doBusy;\nIncr n;\nENDWHILE"
    ),
    "an output that changes each turn": (
        "WHILE diPart=0 DO\nSetDO doBusy,1;\nWaitTime 0.01;\nReset doBusy;\nReset doBusy;\nENDWHILE"
    ),
    "an error that is handled": "WHILE diPart=0 DO\nlast:=fails();\nENDWHILE",
}
PROGRAM = """MODULE polls
  CONST extjoint none:=[9E9,9E9,9E9,9E9,9E9,9E9];
  VAR num n;
  VAR num last;
  VAR bool seen;
  VAR clock watch;
  VAR intnum beat;
  VAR triggdata there;
  PROC main()
{loop}
    TPWrite "on with "\\Num:=n;
    WaitTime 0.1;
  ENDPROC
  PROC look()
    IF diPart=1 THEN
      seen:=TRUE;
    ENDIF
  ENDPROC
  FUNC num fails()
    RETURN 1/n;
  ERROR
    RETURN 5;
  ENDFUNC
  FUNC num where()
    VAR pos here;
    here:=CPos(\\Tool:=tool0\\WObj:=wobj0);
    RETURN here.y;
  ENDFUNC
  TRAP tick
    Incr n;
  ENDTRAP
ENDMODULE
"""


def ran(folder: Path, loop: str, station: str = STATION) -> Simulation:
    (folder / "rapidsim.toml").write_text(station)
    (folder / "polls.mod").write_text(PROGRAM.format(loop=loop))
    return simulate([folder / "polls.mod"], robot="irb1600")


def told(run: Simulation) -> list[tuple[float, str]]:
    return [(round(event.time_s, 9), event.message) for event in run.events]


def numbers(run: Simulation) -> list[float]:
    return [
        float(event.message)
        for event in run.events
        if event.kind is EventKind.TEXT and "on" not in event.message
    ]


@pytest.mark.parametrize("name", LOOPS)
def test_a_run_that_skips_rounds_is_the_run_that_makes_them(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    skipped = ran(tmp_path, LOOPS[name])
    monkeypatch.setattr(BusyWaitDetector, "observe", lambda self, used, done: None)
    monkeypatch.setattr(BusyWaitDetector, "ticks_left", lambda self, used: 1 << 60)
    made = ran(tmp_path, LOOPS[name])
    assert skipped.end is made.end is End.ENDED
    assert told(skipped) == told(made)
    assert skipped.time_s == pytest.approx(made.time_s, abs=1e-9)
    assert [move.end_s for move in skipped.moves] == [move.end_s for move in made.moves]


UNKNOWN = {
    "skipped": "WHILE TRUE DO\nnobody;\nENDWHILE",
    "a value": "WHILE someone()=0 DO\nENDWHILE",
    "between settings": "WHILE TRUE DO\nn:=1;\nnobody;\nn:=2;\nENDWHILE",
}


@pytest.mark.parametrize("name", UNKNOWN)
def test_a_loop_around_what_is_unknown_goes_on_to_the_time_limit_at_once(
    name: str, tmp_path: Path
) -> None:
    run = ran(tmp_path, UNKNOWN[name], f"{STATION}[check]\nassume-missing = true\n")
    assert (run.end, run.time_s) == (End.TIME_LIMIT, 3600.0)
    (skipped,) = run.unsimulated
    assert 1 < skipped.count < 1000
    codes = {found.violation.code for found in run.diagnostics}
    assert codes - {"F401"} == {"N209", "R104", "R109"}


def test_a_loop_around_what_is_unknown_sees_what_changes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    loop, station = (
        "WHILE diPart=0 DO\nnobody;\nENDWHILE",
        f"{STATION}[check]\nassume-missing = true\n",
    )
    skipped = ran(tmp_path, loop, station)
    monkeypatch.setattr(BusyWaitDetector, "observe", lambda self, used, done: None)
    monkeypatch.setattr(BusyWaitDetector, "ticks_left", lambda self, used: 1 << 60)
    made = ran(tmp_path, loop, station)
    assert skipped.end is made.end is End.ENDED
    assert told(skipped) == told(made)
    assert skipped.unsimulated[0].count < made.unsimulated[0].count


FOLLOWS = """MoveAbsJ\\Conc,[[40,0,0,0,30,0],none],v200,z10,tool0;
WHILE where()<0.5 DO
{between}
ENDWHILE
TPWrite "at "\\Num:=where();"""


@pytest.mark.parametrize("between", ["", "WaitTime 0.0003;"])
def test_a_position_is_seen_as_turn_by_turn_within_a_millisecond(
    between: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    loop = FOLLOWS.format(between=between)
    often = ran(tmp_path, loop)
    monkeypatch.setattr(position_reading, "HOLDS_S", 0.0)
    each_turn = ran(tmp_path, loop)
    texts = [
        [event for event in run.events if event.message.startswith("at")]
        for run in (often, each_turn)
    ]
    assert 0.0 <= texts[0][0].time_s - texts[1][0].time_s <= 1e-3
    shown = [float(text.message.removeprefix("at ")) for (text, *_) in texts]
    assert 0.5 <= shown[1] <= shown[0] <= shown[1] + 200.0 * 1e-3
    # The same arm, to the last move: to look at it does not change how it moves.
    assert [move.end_s for move in often.moves] == [move.end_s for move in each_turn.moves]


def test_readings_made_ahead_are_those_made_one_by_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    loop = (
        "MoveAbsJ\\Conc,[[20,0,0,0,30,0],none],v100,fine,tool0;\n"
        "FOR i FROM 1 TO 40 DO\nTPWrite NumToStr(where(),6);\nWaitTime 0.01;\nENDFOR"
    )
    ahead = ran(tmp_path, loop)
    monkeypatch.setattr(position_reading, "_AT_ONCE", 1)
    assert told(ahead) == told(ran(tmp_path, loop))


def test_readings_in_steps_of_a_coarse_clock_are_made_ahead_too(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whoever waits for what a clock lacks comes microseconds too early or too late."""
    loop = (
        "ClkStart watch;\nWaitTime 100;\n"
        "MoveAbsJ\\Conc,[[20,0,0,0,30,0],none],v100,fine,tool0;\n"
        "FOR i FROM 1 TO 60 DO\nTPWrite NumToStr(where(),6);\n"
        "WaitTime 100+0.004*i-ClkRead(watch\\HighRes);\nENDFOR"
    )
    asked: list[int] = []
    seen = MechanicalUnit.seen

    def counted(self: MechanicalUnit, now_s: float, times: Array) -> Samples:
        asked.append(len(times))
        return seen(self, now_s, times)

    monkeypatch.setattr(MechanicalUnit, "seen", counted)
    ahead = numbers(ran(tmp_path, loop))
    assert len(asked) <= 12
    monkeypatch.setattr(position_reading, "_AT_ONCE", 1)
    one_by_one = numbers(ran(tmp_path, loop))
    assert len(ahead) == 60
    assert ahead[0] == 0.0
    assert ahead[-1] > 5.0
    # In mm; a num has seven digits.
    assert ahead == pytest.approx(one_by_one, abs=2e-5)


def test_an_arm_that_stands_is_looked_at_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[float] = []
    seen = MechanicalUnit.seen

    def counted(self: MechanicalUnit, now_s: float, times: Array) -> Samples:
        asked.append(now_s)
        return seen(self, now_s, times)

    monkeypatch.setattr(MechanicalUnit, "seen", counted)
    run = ran(
        tmp_path,
        "MoveAbsJ [[20,0,0,0,30,0],none],v100,fine,tool0;\n"
        "FOR i FROM 1 TO 50 DO\nlast:=where();\nWaitTime 0.01*i;\nENDFOR\n"
        "MoveAbsJ [[0,0,0,0,30,0],none],v100,fine,tool0;\nlast:=where();",
    )
    assert run.end is End.ENDED
    assert len(asked) == 2


def test_a_position_that_nothing_changes_is_not_looked_at_for_ever(tmp_path: Path) -> None:
    run = ran(tmp_path, "WHILE where()<150 DO\nENDWHILE")
    assert [one.violation.code for one in run.diagnostics] == ["R106"]


def test_rounds_that_are_skipped_cost_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    looks = []
    service = TaskClock.service

    def counted(self: TaskClock) -> None:
        looks.append(self)
        service(self)

    monkeypatch.setattr(TaskClock, "service", counted)
    station = STATION.replace("0.146041", "3000.0")
    run = ran(tmp_path, LOOPS["a loop that calls"], station)
    assert run.end is End.ENDED
    assert run.time_s > 3000.0
    # A turn takes 10 us, so the loop is made 300 million times.
    assert len(looks) < 1000


def test_a_loop_that_nothing_ends_is_told_where_it_stands(tmp_path: Path) -> None:
    run = ran(tmp_path, "WHILE diPart<2 DO\nENDWHILE")
    assert run.end is End.ERROR
    (found,) = [one for one in run.diagnostics if one.violation.code == "R106"]
    assert found.span is not None
    assert found.span.text.startswith("WHILE diPart<2")
    assert run.time_s < 1.0


def test_a_check_does_not_go_round_for_ever_either(tmp_path: Path) -> None:
    loop = (
        "WHILE diPart<2 DO\nENDWHILE\nMoveAbsJ [[DInput(diPart),0,0,0,30,0],none],v100,fine,tool0;"
    )
    (tmp_path / "rapidsim.toml").write_text(STATION)
    (tmp_path / "polls.mod").write_text(PROGRAM.format(loop=loop))
    found = check([tmp_path / "polls.mod"], robot="irb1600")
    assert [one.violation.code for one in found.diagnostics if one.span and one.span.line == 10]


TASKS = """
[robot]
model = "irb120"
[signals]
diGo = {{ type = "di", value = 0 }}
doNext = {{ type = "do", value = 0 }}
[[stimulus]]
at = {at_s}
set = {{ diGo = 1 }}
[[task]]
name = "T_ROB1"
modules = ["t0.mod"]
motion = true
"""
POLLING_TASKS = {
    "an input": "WHILE diGo=0 DO\nENDWHILE",
    "a persistent of another task": "WHILE turn<{number} DO\nENDWHILE",
    "a clock": "ClkStart watch;\nWHILE ClkRead(watch)<0.00{number}3 AND diGo=0 DO\nENDWHILE",
    "an output of another task": "WHILE diGo=0 DO\nENDWHILE\nWHILE DOutput(doNext)=0 DO\nENDWHILE",
    "a loop in a loop": "WHILE diGo=0 DO\nFOR i FROM 1 TO {number} DO\nlast:=i;\nENDFOR\nENDWHILE",
}


def polling_tasks(folder: Path, loops: Sequence[str], at_s: float) -> Simulation:
    """Tasks that poll, each of which lets the next one go on when it has seen enough."""
    station = TASKS.format(at_s=at_s)
    folder.mkdir(exist_ok=True)
    for number, loop in enumerate(loops):
        if number:
            station += f'[[task]]\nname = "T_{number}"\nmodules = ["t{number}.mod"]\n'
        text = f"""MODULE t{number}
  PERS num turn:=0;
  VAR num last;
  VAR clock watch;
  PROC main()
    {loop.format(number=number)}
    turn:=turn+1;
    SetDO doNext,1;
    TPWrite "past {number}";
  ENDPROC
ENDMODULE
"""
        (folder / f"t{number}.mod").write_text(text)
    (folder / "rapidsim.toml").write_text(station)
    return simulate([str(folder)])


def seen_by_tasks(run: Simulation) -> dict[str, float]:
    """When each task has seen enough."""
    return {event.message: event.time_s for event in run.events if event.kind is EventKind.TEXT}


@pytest.mark.parametrize("first", POLLING_TASKS)
@pytest.mark.parametrize("second", POLLING_TASKS)
def test_tasks_that_poll_each_other_skip_to_what_they_would_see(
    first: str, second: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    loops = (POLLING_TASKS["an input"], POLLING_TASKS[first], POLLING_TASKS[second])
    skipped = seen_by_tasks(polling_tasks(tmp_path / "a", loops, 0.0063))
    monkeypatch.setattr(BusyWaitDetector, "observe", lambda self, used, done: None)
    monkeypatch.setattr(BusyWaitDetector, "ticks_left", lambda self, used: 1 << 60)
    each_round = seen_by_tasks(polling_tasks(tmp_path / "b", loops, 0.0063))
    assert len(skipped) == 3
    # Two or three ticks: in which order tasks look within one, a rounding decides.
    assert skipped == pytest.approx(each_round, abs=5e-5)


def test_tasks_that_poll_each_other_cost_little(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An hour in which five tasks wait for an input in loops of their own."""
    services = 0
    service = TaskClock.service

    def counted(clock: TaskClock) -> None:
        nonlocal services
        services += 1
        service(clock)

    monkeypatch.setattr(TaskClock, "service", counted)
    run = polling_tasks(tmp_path, [POLLING_TASKS["an input"]] * 5, 3000.0)
    assert run.end is End.ENDED
    assert list(seen_by_tasks(run)) == [f"past {number}" for number in range(5)]
    assert services < 20_000


def test_tasks_that_poll_each_other_for_ever_are_found(tmp_path: Path) -> None:
    loop = "WHILE turn=0 DO\nENDWHILE"
    run = polling_tasks(tmp_path, [loop, loop], 1.0)
    assert run.end is End.ERROR
    assert [found.code for found in run.diagnostics if found.severity.value == "error"] == ["R106"]
