"""A journal tells a controller's life, and the same life can be lived again."""

import json
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from command_line import call
from hypothesis import given
from hypothesis import strategies as st
from laws import examples

from rapidsim.files import InputError
from rapidsim.interpreter.limits import RUNNING_DEPTH, recursion_limit
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.server.engine import Engine, LockStep, Pace
from rapidsim.server.journal import JournalFile, read_journal
from rapidsim.server.loading import ReadyController, ready
from rapidsim.server.messages import (
    BeginFault,
    EndFaults,
    Message,
    Request,
    SessionEnded,
    Subscribe,
)
from rapidsim.server.replay import replayed
from rapidsim.simulation.live.controller import LiveController

PROGRAM = """MODULE Lived
    PERS num rounds := 0;
    VAR num heard;
    VAR intnum called;
    VAR rmqmessage one;
    VAR iodev file;
    PROC main()
        IDelete called;
        CONNECT called WITH listen;
        IRMQMessage heard, called;
        MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, z50, tool0;
        MoveAbsJ [[8,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
        WaitDI diGo, 1;
        PulseDO \\PLength:=0.07, doPulse;
        rounds := rounds + 1;
        IF rounds = 2 THEN
            Open "RAMDISK:" \\File:="a.txt", file \\Read;
            TPWrite ReadStr(file);
            Close file;
        ENDIF
    ENDPROC
    TRAP listen
        RMQGetMessage one;
        RMQGetMsgData one, heard;
        TPWrite ValToStr(heard);
    ENDTRAP
ENDMODULE
"""
EXECUTION, GO = "/rw/rapid/execution", "/rw/iosystem/signals/diGo"
ACTS: tuple[Message, ...] = (
    Request("POST", EXECUTION, {"action": "start"}, {"cycle": "forever"}, 1),
    Request("POST", EXECUTION, {"action": "stop"}, {}, 1),
    Request("POST", EXECUTION, {"action": "resetpp"}, {}, 2),
    Request("POST", GO, {"action": "set"}, {"lvalue": "1"}, 1),
    Request("POST", GO, {"action": "set"}, {"lvalue": "0"}, 2),
    Request("GET", "/rw/motionsystem/mechunits/ROB_1/jointtarget", {}, {}, 1),
    Request("POST", "/rw/dipc", {"action": "dipc-create"}, {"dipc-queue-name": "q"}, 1),
    Request("POST", "/rw/dipc/RMQ_T_ROB1", {"action": "dipc-send"}, {"dipc-data": "num;5"}, 2),
    Request("PUT", "/fileservice/$RAMDISK/a.txt", {}, {}, 1, content=b"uploaded \xff\n"),
    Request("POST", "/rw/panel/speedratio", {"action": "setspeedratio"}, {"speed-ratio": "30"}, 1),
    SessionEnded(1),
    Subscribe(("/rw/iosystem/signals/doPulse;state", "/rw/rapid/execution;ctrlexecstate"), 1),
    *(
        BeginFault(fault)
        for fault in (
            {"kind": "emergency_stop", "for": 0.5},
            {"kind": "guard_stop", "when": "doPulse", "after": 0.1, "nth": [1]},
            {"kind": "general_stop"},
            {"kind": "restart"},
            {"kind": "restart", "mode": "cold", "every": 2.0},
            {"kind": "full_disk", "for": 0.3},
            {"kind": "elog", "code": 50204},
            {"kind": "device_lost", "device": "any", "for": 0.3},
            {"kind": "drop", "on": "socket"},
            {"kind": "none"},
        )
    ),
    EndFaults(),
    Request(
        "POST", "/rw/panel/ctrlstate", {"action": "setctrlstate"}, {"ctrl-state": "motoron"}, 1
    ),
)
START, STOP, RESET, GO_ON = ACTS[0], ACTS[1], ACTS[2], ACTS[3]
UPLOAD = ACTS[8]


@dataclass
class HandPace:
    """A clock on the wall that the test holds; an engine may be far behind it."""

    wall_s: float = 0.0

    def begin(self) -> None:
        pass

    def horizon_s(self) -> float:
        return self.wall_s

    def wait_s(self, virtual_s: float) -> float | None:
        return max(0.0, virtual_s - self.wall_s)

    def on_request(self) -> None:
        pass

    def lag_s(self, now_s: float) -> float:
        return self.wall_s - now_s


@dataclass
class Lived:
    """A controller that keeps its journal."""

    made: ReadyController
    pace: Pace
    lines: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        live = LiveController(self.made.setups, self.made.options)
        self.engine = Engine(live, self.pace, lambda told: None, self.lines.append)

    def end(self) -> list[str]:
        self.engine.switch_off()
        return self.lines


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> ReadyController:
    folder = tmp_path_factory.mktemp("lived")
    (folder / "lived.mod").write_text(PROGRAM)
    (folder / "home").mkdir()
    return ready(RunRequest(paths=(str(folder / "lived.mod"),), home=str(folder / "home")))


def clean(made: ReadyController) -> None:
    (made.ramdisk / "a.txt").unlink(missing_ok=True)


WALKS = st.lists(
    st.tuples(st.floats(0.0, 0.9), st.integers(0, 3), st.sampled_from(ACTS)),
    min_size=3,
    max_size=25,
)


@given(walk=WALKS)
@examples(20)
def test_a_journal_lived_again_gives_the_same_journal(
    made: ReadyController, walk: list[tuple[float, int, Message]]
) -> None:
    clean(made)
    pace = HandPace()
    lived = Lived(made, pace)
    with recursion_limit(RUNNING_DEPTH):
        for message in (START, GO_ON):
            lived.engine.reply(message)
        for passes_s, steps, message in walk:
            pace.wall_s += passes_s
            for _ in range(steps):
                lived.engine.step()
            lived.engine.reply(message)
        lines = lived.end()
    clean(made)
    told: list[str] = []
    replayed(made, read_journal(lines, "lines"), told.append)
    assert told == []


def script(made: ReadyController, *, slowly: bool) -> list[str]:
    """What a client does, who waits for each answer; a slow one lets the engine look meanwhile."""
    clean(made)
    lived = Lived(made, LockStep(0.05))
    for message in (UPLOAD, START, *[ACTS[5]] * 12, GO_ON, ACTS[6], ACTS[7], *[ACTS[5]] * 30, STOP):
        lived.engine.reply(message)
        while slowly and lived.engine.step():
            pass
    return lived.end()


def test_in_lock_step_a_script_gives_one_journal_however_slow_it_is(made: ReadyController) -> None:
    first = script(made, slowly=False)
    assert script(made, slowly=False) == first
    assert script(made, slowly=True) == first
    read = [json.loads(line) for line in first]
    requests = [one for one in read if one["kind"] == "request"]
    assert [one["t"] for one in requests] == [k * 0.05 for k in range(1, len(requests) + 1)]
    assert {one["what"]["status"] for one in requests} <= {200, 201, 204}
    happened = [one["what"]["message"] for one in read if one["what"].get("kind") == "text"]
    assert happened == ["5", "uploaded ÿ"]
    # What a request brings about comes after it.
    at = next(i for i, one in enumerate(read) if one["what"].get("path") == GO)
    assert read[at + 1]["what"]["message"] == "diGo = 1"


def test_run_replays_a_journal_and_tells_where_another_program_departs(
    made: ReadyController, tmp_path: Path
) -> None:
    (tmp_path / "home").mkdir()
    (tmp_path / "lived.mod").write_text(PROGRAM)
    lines = script(made, slowly=False)
    journal = tmp_path / "a.jsonl"
    # Killed while it wrote: the last line is not whole.
    journal.write_text("".join(lines[:-1]) + lines[-1][:20])
    command = ("run", "lived.mod", "--home", "home", "--replay", "a.jsonl", "--no-record")
    (tmp_path / "lived.mod").write_text(PROGRAM.replace("[8,0", "[20,0"))
    done = call(*command, "--format", "json", "--trace", "a.csv", cwd=tmp_path)
    assert done.code == 0, done.err
    run = json.loads(done.out)
    end_s = json.loads(lines[-1])["t"]
    assert (run["end"], run["time_s"]) == ("stopped", pytest.approx(end_s, abs=1e-6))
    assert run["moves"][1]["joints_deg"][0] == pytest.approx(20.0)
    assert [one["message"] for one in run["events"] if one["kind"] == "text"] == ["5", "uploaded ÿ"]
    assert "departs from line" in done.err
    done = call(*command, "--max-time", "1", cwd=tmp_path)
    assert done.code == 3
    assert "--max-time ended it" in done.err


def test_where_nothing_can_be_written_is_told(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="--journal: "):
        JournalFile(tmp_path / "none" / "a.jsonl", print)
    (tmp_path / "lived.mod").write_text(PROGRAM)
    with pytest.raises(InputError, match="--ramdisk: none is not a folder"):
        ready(RunRequest(paths=(str(tmp_path / "lived.mod"),), home=str(tmp_path), ramdisk="none"))


@pytest.mark.parametrize(
    "line",
    [
        "",
        "[]\n",
        "not json\n",
        '{"t": 0, "kind": "event", "what": {}}\n',
        '{"t": NaN, "kind": "request", "what": {"unsubscribe": 1}}\n',
        '{"t": 0, "kind": "event", "what": {"kind": "on", "motors": "maybe", "opmode": "AUTO"}}\n',
        "[" * 100_000 + "\n",
    ],
)
def test_what_is_no_journal_is_told(line: str) -> None:
    with pytest.raises(InputError):
        read_journal([line], "a.jsonl")
