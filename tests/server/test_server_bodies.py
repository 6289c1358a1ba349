"""The whole answer of every route, in two states: a change of one field is a difference here.

`UPDATE_GOLDEN=1 pytest` writes them anew; read the difference before you keep it.
"""

from __future__ import annotations

import io
import os
import pickle
import re
import zipfile
from collections.abc import Iterable, Iterator
from pathlib import Path

from every_route import RIGHT, STATES, THERE, address_of, switched_on

from rapidsim import __version__
from rapidsim.server.engine import Engine
from rapidsim.server.http import bodies
from rapidsim.server.messages import Answer, ErrorAnswer, ReadState, Reply, Request
from rapidsim.server.resources import files
from rapidsim.server.resources.route import Route
from rapidsim.server.resources.table import ROUTES
from rapidsim.server.versions import served_versions

_FOLDER = Route("GET", "fileservice/$HOME", files.read)
"""A folder, where its route has a file."""
GOLDEN = Path(__file__).parent / "golden" / "answers.txt"
FORMS = {
    "stopped": {6: bodies.json_body, 7: bodies.hal_body, 8: bodies.hal_body},
    "executing": {6: bodies.xhtml_body, 7: bodies.xhtml_body, 8: bodies.xhtml_body},
    "asking": {6: bodies.json_body, 7: bodies.xhtml_body, 8: bodies.xhtml_body},
}
_UNIT = "rw/motionsystem/mechunits/ROB_1"
FURTHER: dict[str, tuple[tuple[str, dict[str, str]], ...]] = {
    "stopped": (
        *(
            (one, {})
            for one in ("", "rw", "rw/panel", "rw/iosystem", "rw/rapid", "rw/motionsystem")
        ),
        (_UNIT, {"resource": "static"}),
        (f"{_UNIT}/robtarget", {"tool": "tMine", "wobj": "wMine", "coordinate": "Wobj"}),
        (f"{_UNIT}/robtarget", {"coordinate": "Wobj"}),
        (f"{_UNIT}/cartesian", {"coordinate": "Wobj"}),
        ("rw/retcode", {"code": "-1073442809"}),
        ("rw/devices/SW_RESOURCES", {}),
        ("users", {"user-type": "self"}),
    ),
    "executing": (("rw/rapid/uiinstr", {}),),
    "asking": (("rw/rapid/uiinstr/active", {}),),
}
"""Other addresses, with queries, by state."""
_OF_MODULE = {"task": "T_ROB1", "module": "Tried"}
CHANGING: dict[str, dict[str, str]] = {
    "state": {},
    "joints": {},
    "jog": {"frame": "base", "length": "10", "angle": "5"},
}
"""Parts of the operator page, with queries."""
LASTING = {
    "text": _OF_MODULE,
    "module": _OF_MODULE,
    "arm": {},
    "task": _OF_MODULE,
    "rule": {"code": "K601"},
    "backup.zip": {"generation": "2"},
}
"""Parts that are alike in all states."""
LONGEST = {"arm": 500, "rule": 80}
PLACES: dict[str, dict[str, str]] = {
    "ctrl/$": {"name": "HOME"},
    "rw/devices/": {"name": "HW_DEVICES"},
    "rw/elog/": {"domain": "0"},
    "rw/cfg/": {"domain": "MOC", "name": "rob1_1"},
}
"""What stands in the places of some addresses, beside what is there for all."""
_FILE_TIME = re.compile(r'(fs-[cm]date"[^\d]*)[\dT :-]+')
_FIGURE = re.compile(r"-?\d+\.\d{5,}(E-\d+)?")
"""Computers differ in the last digits."""
LENGTH = 3000
"""Longer bodies are lists of many items alike."""


def _answers(engine: Engine, state: str, version: int, routes: Iterable[Route]) -> Iterator[str]:
    generation, show = 1 if version == 6 else 2, FORMS[state][version]
    enter, _, _, executes = STATES[state]
    enter(engine.reply)
    # A queue with a message, and an operation that has ended.
    for path, action, form in (
        ("/rw/dipc", "dipc-create", RIGHT),
        ("/rw/dipc/mine", "dipc-send", RIGHT),
        ("/ctrl/backup", "backup", {"backup": "$TEMP/b"}),
    ):
        engine.reply(Request("POST", path, {"action": action}, form, 1))
    for address, query in FURTHER[state]:
        request = Request("GET", f"/{address}", query, {}, 1, generation)
        shown = "&".join(f"{key}={one}" for key, one in query.items())
        text = _FIGURE.sub(_rounded, _shown(engine.reply(request), show, address))
        yield f"{version} {state} GET /{address}?{shown}\n  {text[:LENGTH]}"
    for route in routes:
        if route.method == "DELETE":
            note = Request("PUT", "/fileservice/$HOME/note.txt", session=1, content=b"note")
            engine.reply(note)
        if engine.live.executes is not (executes == "running"):
            enter(engine.reply)
        prefix = next((one for one in PLACES if route.address.startswith(one)), "")
        places = {**THERE, **PLACES.get(prefix, {})}
        address = address_of(route, lambda name, places=places: places.get(name, "diGo"))  # type: ignore[misc]
        query = {"action": route.action} if route.action else dict[str, str]()
        if address == "/rw/rapid/modules" or address.startswith("/rw/rapid/modules/"):
            query["task"] = "T_ROB1"
        sent = {} if route.method == "GET" else RIGHT
        request = Request(route.method, address, query, sent, 1, generation, b"note")
        text = _shown(engine.reply(request), show, address)
        text = _FIGURE.sub(_rounded, text)
        text = _FILE_TIME.sub(r"\1TIME", text).replace(__version__, "VERSION")
        action = f"?action={route.action}" if route.action else ""
        yield f"{version} {state} {route.method} {address}{action}\n  {text[:LENGTH]}"


def _parts(engine: Engine, state: str) -> Iterator[str]:
    """The parts of the operator page in a state."""
    STATES[state][0](engine.reply)
    for view, query in (CHANGING | (LASTING if state == "stopped" else {})).items():
        reply = engine.reply(ReadState(view, query))
        assert isinstance(reply, Answer)
        content = reply.content or b""
        if view.endswith(".zip"):
            names = zipfile.ZipFile(io.BytesIO(content)).namelist()
            content = "\n".join(names).encode()
        text = _FIGURE.sub(_rounded, content.decode().replace("\n", "\\n"))
        yield f"ui {state} {view}\n  {text[: LONGEST.get(view, 2 * LENGTH)]}"


def _rounded(figure: re.Match[str]) -> str:
    return f"{float(figure[0]):.4f}"


def _shown(reply: Reply, show: object, address: str) -> str:
    if isinstance(reply, ErrorAnswer):
        return f"{reply.status} {reply.code} {reply.message}"
    assert isinstance(reply, Answer)
    # It passes between the processes.
    assert pickle.loads(pickle.dumps(reply)) == reply
    assert callable(show)
    if reply.content is not None:
        return f"{reply.status} {reply.content!r}"
    location = bodies.RequestLocation("http://here/", address.strip("/"))
    return str(reply.status) + ("" if reply.status == 204 else f" {show(reply, location)}")


def test_answers_are_as_they_were(tmp_path: Path) -> None:
    found = list[str]()
    for state in (*FORMS, "after an error"):
        folder = tmp_path / state
        folder.mkdir()
        with switched_on(folder) as (engine, _):
            found += _parts(engine, state)
    for version, routes in ROUTES.items():
        # Of RobotWare 8, what 7 has not.
        own = (*routes, _FOLDER) if version < 8 else routes[: -len(ROUTES[7])]
        # What is read comes first, as the rest changes it.
        chosen = sorted(own, key=lambda route: route.method != "GET")
        for state in FORMS:
            folder = tmp_path / f"{version}{state}"
            folder.mkdir()
            (folder / "home").mkdir()
            (folder / "home" / "note.txt").write_text("note")
            with switched_on(folder) as (engine, _):
                engine.context.versions = served_versions(None, version)
                found += _answers(engine, state, version, () if state == "asking" else chosen)
    text = "\n".join(found) + "\n"
    if os.environ.get("UPDATE_GOLDEN"):
        GOLDEN.parent.mkdir(exist_ok=True)
        GOLDEN.write_text(text, encoding="utf-8")
    expected = GOLDEN.read_text(encoding="utf-8").splitlines()
    assert text.splitlines() == expected
