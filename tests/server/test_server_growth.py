"""A controller that stays on keeps no more after many actions of clients than after few."""

from __future__ import annotations

import gc
from collections import Counter
from collections.abc import Callable, Iterator
from itertools import count
from pathlib import Path

import pytest

from rapidsim.controller.moves import resolve
from rapidsim.controller.queue import plan_cache
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.server.engine import Engine
from rapidsim.server.loading import engine_of, ready
from rapidsim.server.messages import (
    Answer,
    BeginFault,
    EndFaults,
    Inquiry,
    Request,
    SessionEnded,
    Subscribe,
    Unsubscribe,
)
from rapidsim.server.settings import EngineSettings
from rapidsim.simulation.live import event_log

PROGRAM = r"""MODULE served
  PERS num rounds := 0;
  PERS wobjdata seen := [FALSE, TRUE, "", [[0,0,0],[1,0,0,0]], [[0,0,0],[1,0,0,0]]];
  PROC main()
    MoveAbsJ [[20,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v500, z10, tool0;
    MoveAbsJ [[0,10,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v500, fine, tool0;
    rounds := rounds + 1;
    seen.uframe.trans.x := rounds / 1000;
    MoveL [[900,50,1200],[0.5,0,0.866,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v500, fine,
      tool0 \WObj:=seen;
    wrong;
    TPWrite "round" \Num:=rounds;
  ENDPROC
  PROC wrong()
    VAR num zero := 0;
    rounds := rounds / zero;
  ERROR
    TRYNEXT;
  ENDPROC
ENDMODULE
"""
PART = r"""MODULE part
  PROC work()
    TPWrite "part {number}";
    WHILE TRUE DO
      WaitTime 0.01;
    ENDWHILE
  ENDPROC
ENDMODULE
"""
STATION = '[signals]\ndiGo = { type = "di" }\n'
TASK = "rw/rapid/tasks/T_ROB1"


class Client:
    """Clients of a controller in lock-step."""

    def __init__(self, folder: Path) -> None:
        cell, home = folder / "cell", folder / "home"
        cell.mkdir()
        home.mkdir()
        (cell / "served.mod").write_text(PROGRAM)
        (cell / "rapidsim.toml").write_text(STATION)
        made = ready(RunRequest(paths=(str(cell),), home=str(home)))
        settings = EngineSettings(request_s=0.01)
        self.engine: Engine = engine_of(made, settings, lambda told: None, lambda line: None)

    def __call__(self, message: Inquiry) -> None:
        reply = self.engine.reply(message)
        assert isinstance(reply, Answer), (message, reply)

    def post(self, address: str, session: int = 1, **form: str) -> None:
        path, _, action = address.partition("?")
        fields = {key.replace("_", "-"): value for key, value in form.items()}
        self(Request("POST", f"/{path}", {"action": action}, fields, session))

    def put(self, name: str, text: str) -> None:
        self(Request("PUT", f"/fileservice/$HOME/{name}", content=text.encode()))

    def after(self, seconds: float) -> None:
        live = self.engine.live
        live.advance(live.now_s + seconds)

    def motors(self) -> None:
        self.post("rw/panel/ctrlstate?setctrlstate", ctrl_state="motoron")

    def start(self, how: str = "continue") -> None:
        self.post("rw/rapid/execution?start", execmode=how)

    def stop(self) -> None:
        self.post("rw/rapid/execution?stop")

    def to_main(self) -> None:
        self.post("rw/rapid/execution?resetpp")


def runs(client: Client, number: int) -> None:
    if not client.engine.live.executes:
        client.start()
    client.after(4.0)


def stops_and_continues(client: Client, number: int) -> None:
    client.start()
    client.after(0.37)
    client.stop()


def begins_again_where_it_was_stopped(client: Client, number: int) -> None:
    client.to_main()
    client.start()
    client.after(0.37)
    client.stop()


def fails(client: Client, number: int) -> None:
    for fault in ({"kind": "emergency_stop"}, {"kind": "drop", "on": "http"}, {"kind": "elog"}):
        client(BeginFault(fault))
    client(EndFaults())
    client.motors()
    client.start()
    client.after(0.2)


def restarts(client: Client, number: int) -> None:
    client(BeginFault({"kind": "restart", "mode": "cold" if number % 2 else "warm"}))
    client.motors()
    client.start()
    client.after(0.2)


def loads_and_steps(client: Client, number: int) -> None:
    client.stop()
    name = f"part{number}.mod"
    client.put(name, PART.replace("{number}", str(number)))
    client.post(f"{TASK}?loadmod", modulepath=f"HOME:/{name}", replace="true")
    client(Request("DELETE", f"/fileservice/$HOME/{name}"))
    client.post(f"{TASK}/pcp?set-pp-routine", module="part", routine="work")
    for _ in range(3):
        client.start("stepin")
        client.after(0.1)
    client.to_main()


def subscribes(client: Client, number: int) -> None:
    session = 100 + number
    client.post("rw/dipc?dipc-create", session, dipc_queue_name=f"q{number}")
    resources = ("/rw/iosystem/signals/diGo;state", "/rw/elog/0", "/rw/rapid/execution")
    client(Subscribe(resources, session, session))
    client.post("rw/iosystem/signals/diGo?set", lvalue=str(number % 2))
    if number % 2:
        client(Unsubscribe(session))
    client(SessionEnded(session))
    client(Unsubscribe(session))


def jogs(client: Client, number: int) -> None:
    client.post("rw/panel/opmode?setopmode", opmode="MANR")
    client.motors()
    by = "1" if number % 2 else "-1"
    client.post("rw/motionsystem?jog", frame="joints", axis="1", by=by, mechunit="ROB_1")
    client.after(0.5)


Action = Callable[[Client, int], None]
ACTIONS = (
    runs,
    stops_and_continues,
    begins_again_where_it_was_stopped,
    fails,
    restarts,
    loads_and_steps,
    subscribes,
    jogs,
)


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Client]:
    with pytest.MonkeyPatch.context() as patch:
        # What is kept for later is full soon.
        patch.setattr(plan_cache, "_MOST_NEW", 30)
        patch.setattr(plan_cache, "_MOST", 30)
        patch.setattr(plan_cache, "_MOST_HASHES", 30)
        patch.setattr(resolve, "_MOST_REPEATS", 1)
        patch.setattr(event_log, "MOST_ENTRIES", 5)
        yield Client(tmp_path_factory.mktemp("growth"))


def kept(client: Client) -> Counter[str]:
    """The number of objects of each class, once what is older than ten seconds is discarded."""
    client.after(25.0)
    gc.collect()
    return Counter(f"{type(one).__module__} {type(one).__qualname__}" for one in gc.get_objects())


@pytest.mark.parametrize("action", ACTIONS)
def test_nothing_grows(client: Client, action: Action) -> None:
    client.post("rw/panel/opmode?setopmode", opmode="AUTO")
    client.motors()
    client.to_main()
    numbers = count()
    counts = []
    for _ in range(3):
        for _ in range(12):
            action(client, next(numbers))
        client.stop()
        counts.append(kept(client))
    grown = {name: number for name, number in (counts[2] - counts[1]).items() if number >= 12}
    assert not grown
