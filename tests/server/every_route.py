"""A served cell without HTTP: the states that it can be in, and an address of every route."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from types import MappingProxyType

from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.server.engine import Engine, LockStep
from rapidsim.server.loading import ready
from rapidsim.server.messages import Notification, Reply, Request
from rapidsim.server.resources.route import Route
from rapidsim.simulation.live.controller import LiveController

PROGRAM = """MODULE Tried
    VAR num n := 0;
    CONST num c := 1;
    PERS tooldata tMine := [TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
    PERS wobjdata wMine := [FALSE,TRUE,"",[[500,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
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
STATION = """[robot]
model = "irb1600-6-1.2"
base = { position = [100, 0, 20] }
[signals]
diGo = { type = "di" }
aoFlow = { type = "ao" }
"""
Asks = Callable[..., Reply]


def _post(path: str, action: str, form: Mapping[str, str]) -> Request:
    return Request("POST", path, {"action": action}, form, 1)


def act(ask: Asks, path: str, action: str, **form: str) -> None:
    ask(_post(path, action, {key.replace("_", "-"): one for key, one in form.items()}))


def stopped(ask: Asks) -> None:
    """In automatic mode, the motors on, the pointer at main."""
    for mode in ("manr", "auto"):
        act(ask, "/rw/panel/opmode", "setopmode", opmode=mode)
    act(ask, "/rw/panel/ctrlstate", "setctrlstate", ctrl_state="motoron")
    act(ask, "/rw/rapid/execution", "stop")
    act(ask, "/rw/rapid/tasks", "activate")
    act(ask, "/rw/rapid/execution", "resetpp")


def _executing(ask: Asks) -> None:
    stopped(ask)
    act(ask, "/rw/rapid/execution", "start", cycle="forever")


def _halted_on_its_path(ask: Asks) -> None:
    _executing(ask)
    for _ in range(6):
        ask(Request("GET", "/rw/system"))
    act(ask, "/rw/rapid/execution", "stop")


def _motors_off(ask: Asks) -> None:
    stopped(ask)
    act(ask, "/rw/panel/ctrlstate", "setctrlstate", ctrl_state="motoroff")


def _manual(ask: Asks) -> None:
    stopped(ask)
    act(ask, "/rw/panel/opmode", "setopmode", opmode="manr")


def _manual_at_full_speed(ask: Asks) -> None:
    _manual(ask)
    act(ask, "/rw/panel/opmode", "setopmode", opmode="manf")


def _begun_in(ask: Asks, routine: str) -> None:
    stopped(ask)
    pointer = "/rw/rapid/tasks/T_ROB1/pcp"
    act(ask, pointer, "set-pp-routine", module="Tried", routine=routine)
    act(ask, "/rw/rapid/execution", "start", cycle="once")
    ask(Request("GET", "/rw/system"))


def _after_an_error(ask: Asks) -> None:
    _begun_in(ask, "fails")


def _asking(ask: Asks) -> None:
    _begun_in(ask, "asks")


STATES = MappingProxyType(
    {
        "stopped": (stopped, "motoron", "AUTO", "stopped"),
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
        "rob_joints": "[0.1,0.2,0.3,0.4,0.5,0.6]",
        "curr_position": "[0.8,0.1,0.7]",
        "curr_orientation": "[0.5,0,0.9,0]",
        "robot_configuration": "[0,-1,0,0]",
        "tool_frame_position": "[0,0,0.1]",
        "tool_frame_orientation": "[1,0,0,0]",
    }
)
"""What requests of all kinds take, together."""


def address_of(route: Route, fill: Callable[[str], str]) -> str:
    """An address of a route; `fill` names what stands in a place of it."""

    def filled(part: str) -> str:
        name = part.removeprefix("$").strip("{}")
        return part if "{" not in part else "$" * part.startswith("$") + fill(name)

    return "/" + "/".join(map(filled, route.parts))


@contextmanager
def switched_on(tmp_path: Path) -> Iterator[tuple[Engine, list[Notification]]]:
    """The engine of the cell, and what it tells."""
    (tmp_path / "tried.mod").write_text(PROGRAM)
    (tmp_path / "rapidsim.toml").write_text(STATION)
    home = tmp_path / "home"
    home.mkdir(exist_ok=True)
    made = ready(RunRequest(paths=(str(tmp_path / "tried.mod"),), home=str(home)))
    told: list[Notification] = []
    made_engine = Engine(LiveController(made.setups, made.options), LockStep(0.05), told.append)
    yield made_engine, told
    made_engine.switch_off()
