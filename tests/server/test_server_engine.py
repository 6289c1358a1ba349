"""How the engine's time passes, and what takes effect when."""

import math
import re
from dataclasses import dataclass
from pathlib import Path

import pytest

from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.server.engine import Engine, FullPace, LockStep, Pace
from rapidsim.server.loading import ready
from rapidsim.server.messages import (
    Answer,
    ChangeEvent,
    ConsoleLine,
    Notification,
    Reply,
    Request,
    Subscribe,
)
from rapidsim.simulation.live.controller import LiveController

PROGRAM = """MODULE Paced
    PERS num rounds := 0;
    PERS num late := 0;
    VAR clock c;
    PROC main()
        rounds := rounds + 1;
        ClkStart c;
        WaitDI diGo, 1;
        late := ClkRead(c);
        WaitTime 1;
        IF rounds = 3 rounds := 1 / (rounds - 3);
    ENDPROC
ENDMODULE
"""
START = Request("POST", "/rw/rapid/execution", {"action": "start"}, {"cycle": "forever"})
GO = Request("POST", "/rw/iosystem/signals/diGo", {"action": "set"}, {"lvalue": "1"})


@dataclass
class HandPace:
    """A clock on the wall that the test holds."""

    wall_s: float = 0.0
    behind_s: float = 0.0

    def begin(self) -> None:
        pass

    def horizon_s(self) -> float:
        return self.wall_s

    def wait_s(self, virtual_s: float) -> float | None:
        return None if math.isinf(virtual_s) else max(0.0, virtual_s - self.wall_s)

    def on_request(self) -> None:
        pass

    def lag_s(self, now_s: float) -> float:
        return self.wall_s - now_s


def engine(folder: Path, pace: Pace, program: str = PROGRAM) -> tuple[Engine, list[Notification]]:
    (folder / "paced.mod").write_text(program)
    made = ready(RunRequest(paths=(str(folder / "paced.mod"),), home=str(folder)))
    told: list[Notification] = []
    return Engine(LiveController(made.setups, made.options), pace, told.append), told


def value(engine: Engine, name: str) -> float:
    reply = engine.reply(Request("GET", f"/rw/rapid/symbol/data/RAPID/T_ROB1/{name}"))
    assert isinstance(reply, Answer)
    return float(reply.items[0].fields["value"])


def test_a_request_takes_effect_at_the_time_on_the_wall_though_nothing_happened_since(
    tmp_path: Path,
) -> None:
    pace = HandPace()
    served, _ = engine(tmp_path, pace)
    assert not served.step()
    assert served.wait_s() is None
    pace.wall_s = 10.0
    served.reply(START)
    pace.wall_s = 12.5
    served.reply(GO)
    assert served.live.now_s == 12.5
    assert value(served, "late") == 2.5
    assert served.wait_s() == 1.0


def test_who_computes_too_long_is_told_and_catches_up(tmp_path: Path) -> None:
    pace = HandPace()
    served, told = engine(tmp_path, pace)
    served.reply(START)
    served.reply(GO)
    pace.wall_s = 1.5
    assert served.step()
    assert [one for one in told if isinstance(one, ConsoleLine)] == []
    pace.wall_s = 2.9
    assert served.step()
    (note,) = [one for one in told if isinstance(one, ConsoleLine)]
    assert note.text == "note: virtual time is 1.9 s behind its pace"
    while served.step():
        pass
    assert served.live.now_s == 2.9


def test_at_full_speed_everything_happens_that_can(tmp_path: Path) -> None:
    served, told = engine(tmp_path, FullPace())
    served.reply(START)
    served.reply(GO)
    while served.step():
        pass
    # The third round divides by zero.
    assert value(served, "rounds") == 3.0
    assert served.wait_s() is None
    assert any(isinstance(one, ConsoleLine) and one.text.startswith("error: ") for one in told)


def test_who_is_slower_than_real_time_at_full_speed_is_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    wall_s = 100.0
    monkeypatch.setattr("rapidsim.server.engine.monotonic", lambda: wall_s)
    served, told = engine(tmp_path, FullPace())
    assert served.wait_s() is None
    # Nobody counts the time before there is anything to do.
    wall_s = 200.0
    served.reply(START)
    served.reply(GO)
    assert served.step()
    assert [one for one in told if isinstance(one, ConsoleLine)] == []
    wall_s = 220.0
    assert served.step()
    notes = [one.text for one in told if isinstance(one, ConsoleLine)]
    assert any(
        re.fullmatch(r"note: virtual time is 1\d\.\d s behind real time", one) for one in notes
    )


def test_what_is_not_simulated_is_told_once(tmp_path: Path) -> None:
    weaves = "MODULE weaves\nPROC main()\nArcRefresh;\nWaitTime 1;\nENDPROC\nENDMODULE\n"
    pace = HandPace()
    served, told = engine(tmp_path, pace, weaves)
    served.reply(START)
    for wall_s in (1.5, 2.5, 3.5):
        pace.wall_s = wall_s
        while served.step():
            pass
    (note,) = [one.text for one in told if isinstance(one, ConsoleLine)]
    assert note.startswith("warning: 0.000 s: `ArcRefresh`")
    assert note.endswith("paced.mod, line 3) [R104]")


def test_in_lock_step_the_same_requests_give_the_same_replies(tmp_path: Path) -> None:
    def run() -> list[Reply | Notification]:
        served, told = engine(tmp_path, LockStep(0.05))
        served.reply(Subscribe(("/rw/rapid/symbol/data/RAPID/T_ROB1/rounds;value",), 1))
        state = Request("GET", "/rw/rapid/execution")
        joints = Request("GET", "/rw/motionsystem/mechunits/ROB_1/jointtarget")
        asked = [state, START, *[joints] * 5, GO, *[state, joints] * 40]
        replies: list[Reply | Notification] = [served.reply(one) for one in asked]
        assert sum(isinstance(one, ChangeEvent) for one in told) >= 3
        return [*replies, *told]

    assert run() == run()
