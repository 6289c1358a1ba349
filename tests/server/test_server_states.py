"""Whatever state the controller is in, every resource answers, and none of them ends it."""

from __future__ import annotations

import pickle
from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest
from every_route import PROGRAM, RIGHT, STATES, THERE, act, address_of, stopped, switched_on

from rapidsim.server.engine import Engine
from rapidsim.server.http import bodies
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

FORMS: tuple[Mapping[str, str], ...] = (
    {},
    RIGHT,
    dict.fromkeys(RIGHT, "\0[\u2603"),
    dict.fromkeys(RIGHT, "9e999"),
)


def _requests(route: Route, generation: int) -> Iterator[Request]:
    right = address_of(route, lambda name: THERE.get(name, "diGo"))
    wrong = address_of(route, lambda name: "no\u2603body")
    for address in dict.fromkeys((right, wrong)):
        for form in FORMS:
            query = {**form, "action": route.action} if route.action else dict(form)
            yield Request(route.method, address, query, form, 1, generation, b"\xff\0")


@pytest.fixture
def engine(tmp_path: Path) -> Iterator[tuple[Engine, list[Notification]]]:
    with switched_on(tmp_path) as made:
        yield made


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
        return [live.panel.state.value, live.panel.mode.value, executes] == shown

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
    assert pickle.loads(pickle.dumps(told)) == told
    assert [
        note.text for note in told if isinstance(note, ConsoleLine) and "defect" in note.text
    ] == []
    # It is as alive as before, once it has its program again.
    stopped(one.reply)
    note = Request("PUT", "/fileservice/$HOME/tried.mod", session=1, content=PROGRAM.encode())
    assert one.reply(note).status == 201
    act(
        one.reply, "/rw/rapid/tasks/T_ROB1", "loadmod", modulepath="$HOME/tried.mod", replace="true"
    )
    STATES["executing"][0](one.reply)
    assert live.executes


def _show(reply: Reply) -> None:
    """Write it in each form that a client may ask for, after its way between the processes."""
    assert pickle.loads(pickle.dumps(reply)) == reply
    if isinstance(reply, ErrorAnswer):
        assert 400 <= reply.status < 500
        for write in (bodies.json_refusal, bodies.hal_refusal, bodies.xhtml_refusal):
            assert write(reply, "http://here/")
        return
    assert isinstance(reply, Answer)
    assert 200 <= reply.status < 300
    for show in (bodies.json_body, bodies.hal_body, bodies.xhtml_body):
        assert show(reply, bodies.RequestLocation("http://here/", "rw"))
