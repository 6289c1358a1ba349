"""What rows say that routines do, against their bodies; and no other list of instructions."""

import ast
import re
from collections.abc import Iterator
from dataclasses import fields
from pathlib import Path
from types import CodeType, FunctionType
from typing import Any

import pytest
from library_controller import RecordingController

import rapidsim
from rapidsim.language.moves import MotionSettings
from rapidsim.library.catalogue import ROUTINES
from rapidsim.library.table import LibraryRoutine
from rapidsim.library.traits import Trait

PACKAGE = Path(rapidsim.__file__).parent
QUOTED = re.compile(r"""["'](\w+)["']""")
QUESTIONS = {"ask_number", "ask_choice", "ask_text"}
WAITS = {
    *("wait", "wait_until", "wait_for_signal", "accept_client", "connect_socket", "await_bytes"),
    "await_datagram",
    "await_fingers",
    *("meet", "sync_move_on", "sync_move_off", "leave_team", "suspend_team", "resume_team"),
    *("await_message", "await_answer", "guide", "await_condition", "end_guidance", "give_back"),
}
"""What of the protocols lets time pass, apart from moves and questions."""
ASKED = {
    Trait.MOVE: {"move", "search", "search_joints"},
    Trait.SEARCH: {"search", "search_joints"},
    Trait.ASK: QUESTIONS,
    Trait.WAIT: WAITS | QUESTIONS,
    Trait.OUTPUT: {"write_signal"},
}
"""What a body asks of its controller if it does something."""
OTHERWISE = {
    ("SetAllDataVal", Trait.MOVE): "it searches data",
    ("SetAllDataVal", Trait.SEARCH): "it searches data",
    ("SocketPeek", Trait.WAIT): "it asks for what has arrived, and waits no time",
    ("CamLoadJob", Trait.WAIT): "a job is there at once here",
    ("CamWaitLoadJob", Trait.WAIT): "a job is there at once here",
    ("IODisable", Trait.WAIT): "a device is gone at once here",
    ("IOEnable", Trait.WAIT): "a device is there at once here",
    ("WaitLoad", Trait.WAIT): "a run has loaded the module before",
}
"""Where row and body differ, and why."""
WRITTEN = [
    row for row in ROUTINES.values() if row.function.__module__ != "rapidsim.library.declared"
]


def names_in(code: CodeType) -> Iterator[str]:
    """The names a function uses, those of functions inside it as well."""
    yield from code.co_names
    for inner in code.co_consts:
        if isinstance(inner, CodeType):
            yield from names_in(inner)


def asked_by(body: object, seen: set[object]) -> set[str]:
    """The names of everything that a body may come to ask, through functions of the library."""
    if not isinstance(body, FunctionType) or body in seen:
        return set()
    seen.add(body)
    if not body.__module__.startswith("rapidsim.library"):
        return set()
    names = set(names_in(body.__code__))
    called = [body.__globals__.get(name) for name in names]
    called += [cell.cell_contents for cell in body.__closure__ or ()]
    return names.union(*(asked_by(one, seen) for one in called))


def says_otherwise(row: LibraryRoutine) -> Iterator[Trait]:
    """In what a row and its body differ."""
    asked = asked_by(row.function, set())
    for does, names in ASKED.items():
        if (does in row.traits) != bool(names & asked) and (row.name, does) not in OTHERWISE:
            yield does
    if Trait.INSTANT in row.traits and asked & (ASKED[Trait.MOVE] | ASKED[Trait.WAIT]):
        yield Trait.INSTANT


def test_rows_say_what_their_bodies_ask_for() -> None:
    assert len(WRITTEN) > 350
    assert not {row.name: does for row in WRITTEN if (does := list(says_otherwise(row)))}


def test_reasons_for_differences_are_needed() -> None:
    for name, does in OTHERWISE:
        row = ROUTINES[name.lower()]
        assert (does in row.traits) != bool(ASKED[does] & asked_by(row.function, set()))


def test_fields_that_rows_set_are_those_of_settings() -> None:
    known = {field.name for field in fields(MotionSettings)}
    for row in ROUTINES.values():
        assert known.issuperset(row.sets)
        assert row.back == "" or row.back.replace("\\", " ").split()[0].lower() in ROUTINES


@pytest.mark.parametrize(
    ("name", "arguments", "options"),
    [
        ("VelSet", (50.0, 300.0), {}),
        ("AccSet", (50.0, 50.0), {"fine_point_ramp": 50.0}),
        ("ConfJ", (), {"off": True}),
        ("ConfL", (), {"off": True}),
        ("SingArea", (), {"wrist": True}),
        ("CirPathMode", (), {"object_frame": True}),
    ],
)
def test_an_instruction_sets_what_its_row_says(
    name: str, arguments: tuple[float, ...], options: dict[str, Any]
) -> None:
    controller = RecordingController()
    before = controller.settings
    ROUTINES[name.lower()].body(controller, *arguments, **options)
    changed = {
        field.name
        for field in fields(MotionSettings)
        if getattr(before, field.name) != getattr(controller.settings, field.name)
    }
    assert changed == set(ROUTINES[name.lower()].sets)


def test_what_follows_from_parameters_is_not_forgotten() -> None:
    def names(does: Trait) -> set[str]:
        return {row.name for row in ROUTINES.values() if does in row.traits}

    assert {"MoveAbsJ", "TriggJIOs", "ContactL", "EGMMoveC"} <= names(Trait.MOVE)
    assert {"SyncMoveOn", "UINumTune", "RMQReadWait", "IOEnable"} <= names(Trait.WAIT)
    assert {"TPReadFK", "UINumTune"} <= names(Trait.ASK)
    assert {"ArcL", "EGMMoveC", "ContactL"} <= names(Trait.CARTESIAN) <= names(Trait.MOVE)
    by_axes = {"ArcMoveExtJ", "MoveAbsJ", "MoveExtJ", "SearchExtJ", "TriggAbsJ"}
    assert names(Trait.AXES) == by_axes
    assert ROUTINES["syncmoveon"].limit == "TimeOut"
    # It is given with each call.
    assert ROUTINES["ioenable"].limit is None


# Rooms and files where words stand that are names of routines, too: keywords of files, styles of
# text, parts of messages.
ELSEWHERE = {
    "__init__.py": {"load"},
    "analysis/passes/task_check.py": {"load"},
    "analysis/tolerated_syntax.py": {"DIM"},
    "applications": {"dim", "distance", "load", "set", "type", "write"},
    "applications/calibrate/standard_programs.py": {"MoveJ", "MoveL"},
    "cli/commands/serve.py": {"max"},
    "cli/tools/debugger.py": {"continue"},
    "collisions": {"type"},
    "controller": {
        *("ClearPath", "RestoPath", "StorePath", "SyncMoveOn", "SyncMoveOff", "SyncMoveSuspend"),
        *("SyncMoveResume", "stop", "load", "RMQSendMessage"),
    },
    "controller/cell/description.py": {"load", "set", "Stop"},
    "dap": {"type", "continue", "write"},
    "egm": {"type"},
    "interpreter/codegen/integer_inference.py": {"dim", "strlen"},
    "interpreter/codegen/special_forms.py": {
        *("argname", "dim", "ispers", "isvar", "present", "strlen", "type"),
    },
    "interpreter/linking/loader.py": {"load"},
    "interpreter/linking/namespace.py": {"ArgName"},
    "json_records": {"type"},
    "recording/scene/shading.py": {"max", "min", "type"},
    "language": {"write", "stop"},
    "lsp/token_pieces.py": {"type"},
    "motion/timing/constraints.py": {"PathAccLim", "WorldAccLim"},
    "plots": {"round"},
    "recording": {"clear"},
    "report": {"dim", "distance", "stop"},
    "server": {"type", "Type", "opmode", "stop", "set", "continue", "dim", "clear", "min", "save"},
    "simulation": {"stop"},
    "station": {"type", "set", "close", "load", "max", "min", "stop", "STOP"},
    "syntax": {"EXP", "open", "close"},
}


def test_no_other_list_of_instructions() -> None:
    found = {}
    for file in sorted(PACKAGE.rglob("*.py")):
        place = file.relative_to(PACKAGE).as_posix()
        room = place.split("/")[0]
        if room == "library":
            continue
        allowed = ELSEWHERE.get(place, ELSEWHERE.get(room, set()))
        text = file.read_text("utf-8")
        if not any(word.lower() in ROUTINES for word in QUOTED.findall(text)):
            continue  # Most files; to parse them all takes seconds.
        texts = {
            node.value
            for node in ast.walk(ast.parse(text))
            if isinstance(node, ast.Constant) and isinstance(node.value, str)
        }
        if names := {text for text in texts - allowed if text.lower() in ROUTINES}:
            found[place] = names
    assert not found, "ask for a trait of the row instead (rapidsim/library/traits.py)"
