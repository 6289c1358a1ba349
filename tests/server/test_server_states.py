"""Whatever state the controller is in, every resource answers, and none of them ends it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import MappingProxyType

import pytest

from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.server.engine import Engine, LockStep
from rapidsim.server.http import bodies
from rapidsim.server.loading import ready
from rapidsim.server.messages import (
    Answer,
    ConsoleLine,
    ErrorAnswer,
    Notification,
    Reply,
    Request,
    Subscribe,
)
from rapidsim.server.resources.route import Route
from rapidsim.server.resources.table import ROUTES
from rapidsim.server.versions import served_versions
from rapidsim.simulation.live.controller import LiveController

PROGRAM = """MODULE Tried
    VAR num n := 0;
    VAR num answered;
    PERS num k := 0;
    PROC main()
        MoveAbsJ [[4,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, z10, tool0;
        MoveAbsJ [[0,2,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;
        k := k + 1;
    ENDPROC
    PROC fails()
        k := 1 / n;
    ENDPROC
    PROC asks()
        TPReadNum answered, "How many?";
    ENDPROC
ENDMODULE
"""
STATION = '[signals]\ndiGo = { type = "di" }\naoFlow = { type = "ao" }\n'
Asks = Callable[..., Reply]


def _post(path: str, action: str, form: Mapping[str, str]) -> Request:
    return Request("POST", path, {"action": action}, form, 1)


def _act(ask: Asks, path: str, action: str, **form: str) -> None:
    ask(_post(path, action, {key.replace("_", "-"): one for key, one in form.items()}))


def _stopped(ask: Asks) -> None:
    """In automatic mode, the motors on, the pointer at main."""
    for mode in ("manr", "auto"):
        _act(ask, "/rw/panel/opmode", "setopmode", opmode=mode)
    _act(ask, "/rw/panel/ctrlstate", "setctrlstate", ctrl_state="motoron")
    _act(ask, "/rw/rapid/execution", "stop")
    _act(ask, "/rw/rapid/tasks", "activate")
    _act(ask, "/rw/rapid/execution", "resetpp")


def _executing(ask: Asks) -> None:
    _stopped(ask)
    _act(ask, "/rw/rapid/execution", "start", cycle="forever")


def _halted_on_its_path(ask: Asks) -> None:
    _executing(ask)
    for _ in range(6):
        ask(Request("GET", "/rw/system"))
    _act(ask, "/rw/rapid/execution", "stop")


def _motors_off(ask: Asks) -> None:
    _stopped(ask)
    _act(ask, "/rw/panel/ctrlstate", "setctrlstate", ctrl_state="motoroff")


def _manual(ask: Asks) -> None:
    _stopped(ask)
    _act(ask, "/rw/panel/opmode", "setopmode", opmode="manr")


def _manual_at_full_speed(ask: Asks) -> None:
    _manual(ask)
    _act(ask, "/rw/panel/opmode", "setopmode", opmode="manf")


def _begun_in(ask: Asks, routine: str) -> None:
    _stopped(ask)
    pointer = "/rw/rapid/tasks/T_ROB1/pcp"
    _act(ask, pointer, "set-pp-routine", module="Tried", routine=routine)
    _act(ask, "/rw/rapid/execution", "start", cycle="once")
    ask(Request("GET", "/rw/system"))


def _after_an_error(ask: Asks) -> None:
    _begun_in(ask, "fails")


def _asking(ask: Asks) -> None:
    _begun_in(ask, "asks")


STATES = MappingProxyType(
    {
        "stopped": (_stopped, "motoron", "AUTO", "stopped"),
        "executing": (_executing, "motoron", "AUTO", "running"),
        "halted on its path": (_halted_on_its_path, "motoron", "AUTO", "stopped"),
        "motors off": (_motors_off, "motoroff", "AUTO", "stopped"),
        "manual": (_manual, "motoroff", "MANR", "stopped"),
        "manual at full speed": (_manual_at_full_speed, "motoroff", "MANF", "stopped"),
        "after an error": (_after_an_error, "motoron", "AUTO", "stopped"),
        "asking": (_asking, "motoron", "AUTO", "running"),
    }
)
"""How to come to a state, and what of it is shown: motors, mode, execution."""
THERE = MappingProxyType(
    {
        "task": "T_ROB1",
        "unit": "ROB_1",
        "module": "Tried",
        "network": "Local",
        "device": "DRV_1",
        "domain": "rapid",
        "of": "ARM",
        "number": "1",
        "queue": "mine",
        "parameter...": "RAPID/T_ROB1/answered",
        "symbol...": "T_ROB1/Tried/k",
        "address...": "$HOME/note.txt",
    }
)
"""What stands in the places of addresses where something is; else `diGo`, a signal."""
RIGHT = MappingProxyType(
    {
        "ctrl-state": "motoron",
        "opmode": "manr",
        "speed-ratio": "50",
        "cycle": "asis",
        "stopmode": "instr",
        "lvalue": "1",
        "value": "1",
        "task": "T_ROB1",
        "datatype": "num",
        "module": "Tried",
        "routine": "main",
        "modulepath": "$HOME/none.mod",
        "progpath": "$HOME/none.pgf",
        "fs-action": "copy",
        "fs-newname": "$HOME/other.txt",
        "dipc-queue-name": "mine",
        "dipc-queue-size": "10",
        "dipc-src-queue-name": "mine",
        "dipc-cmd": "111",
        "dipc-userdef": "1",
        "dipc-msgtype": "1",
        "dipc-data": "num;5",
        "blockurl": "RAPID",
        "symtyp": "any",
        "username": "somebody",
        "startbyte": "0",
        "signaldata": "1",
        "datamask": "255",
        "tool": "tool0",
        "wobj": "wobj0",
        "coordinate": "Base",
    }
)
"""What requests of all kinds take, together."""
FORMS: tuple[Mapping[str, str], ...] = (
    {},
    RIGHT,
    dict.fromkeys(RIGHT, "\0[\u2603"),
    dict.fromkeys(RIGHT, "9e999"),
)


def _address(route: Route, fill: Callable[[str], str]) -> str:
    def filled(part: str) -> str:
        name = part.removeprefix("$").strip("{}")
        return part if "{" not in part else "$" * part.startswith("$") + fill(name)

    return "/" + "/".join(map(filled, route.parts))


def _requests(route: Route, generation: int) -> Iterator[Request]:
    right = _address(route, lambda name: THERE.get(name, "diGo"))
    wrong = _address(route, lambda name: "no\u2603body")
    for address in dict.fromkeys((right, wrong)):
        for form in FORMS:
            query = {**form, "action": route.action} if route.action else dict(form)
            yield Request(route.method, address, query, form, 1, generation, b"\xff\0")


@pytest.fixture
def engine(tmp_path: Path) -> Iterator[tuple[Engine, list[Notification]]]:
    (tmp_path / "tried.mod").write_text(PROGRAM)
    (tmp_path / "rapidsim.toml").write_text(STATION)
    home = tmp_path / "home"
    home.mkdir()
    made = ready(RunRequest(paths=(str(tmp_path / "tried.mod"),), home=str(home)))
    told: list[Notification] = []
    made_engine = Engine(LiveController(made.setups, made.options), LockStep(0.05), told.append)
    yield made_engine, told
    made_engine.switch_off()


@pytest.mark.parametrize("state", STATES)
def test_every_resource_answers_in_every_state(
    state: str, engine: tuple[Engine, list[Notification]]
) -> None:
    one, told = engine
    enter, *shown = STATES[state]
    enter(one.reply)
    live = one.live

    def is_there() -> bool:
        executes = "running" if live.executes else "stopped"
        return [live.motors.value, live.mode.value, executes] == shown

    assert is_there()
    one.reply(Subscribe(("/rw/rapid/execution;ctrlexecstate", "/rw/iosystem/signals/diGo"), 1))
    for version, routes in ROUTES.items():
        generation = 1 if version == 6 else 2
        one.context.versions = served_versions(None, version)
        # Control stations, and what they leave of RobotWare 7.
        for route in routes if version < 8 else routes[: -len(ROUTES[7])]:
            # A program that executes is seen to; what else a state is, the last one may have ended.
            if route.method != "GET" and not (live.executes and is_there()):
                enter(one.reply)
            for request in _requests(route, generation):
                _show(one.reply(request))
    assert [
        note.text for note in told if isinstance(note, ConsoleLine) and "defect" in note.text
    ] == []
    # It is as alive as before, once it has its program again.
    _stopped(one.reply)
    note = Request("PUT", "/fileservice/$HOME/tried.mod", session=1, content=PROGRAM.encode())
    assert one.reply(note).status == 201
    _act(
        one.reply, "/rw/rapid/tasks/T_ROB1", "loadmod", modulepath="$HOME/tried.mod", replace="true"
    )
    _executing(one.reply)
    assert live.executes


def _show(reply: Reply) -> None:
    """Write it in each form that a client may ask for."""
    if isinstance(reply, ErrorAnswer):
        assert 400 <= reply.status < 500
        for write in (bodies.json_refusal, bodies.hal_refusal, bodies.xhtml_refusal):
            assert write(reply, "http://here/")
        return
    assert isinstance(reply, Answer)
    assert 200 <= reply.status < 300
    for show in (bodies.json_body, bodies.hal_body, bodies.xhtml_body):
        assert show(reply, bodies.RequestLocation("http://here/", "rw"))
