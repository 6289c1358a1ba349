"""The words of clients: each has its effect, and others are refused."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from every_route import act, stopped, switched_on

from rapidsim.server.engine import Engine
from rapidsim.server.http.bodies import xhtml_refusal
from rapidsim.server.messages import (
    Answer,
    ChangeEvent,
    ErrorAnswer,
    Notification,
    Reply,
    Request,
    Subscribe,
)

TASK = "/rw/rapid/tasks/T_ROB1"


@pytest.fixture(scope="module")
def switched(
    tmp_path_factory: pytest.TempPathFactory,
) -> Iterator[tuple[Engine, list[Notification]]]:
    with switched_on(tmp_path_factory.mktemp("words")) as found:
        yield found


@pytest.mark.parametrize(
    ("path", "action", "form", "shown", "value"),
    [
        ("panel/opmode", "setopmode", {"opmode": "man"}, "panel/opmode", "MANR"),
        ("panel/opmode", "setopmode", {"opmode": "manfs"}, "panel/opmode", "MANF"),
        ("panel/opmode", "setopmode", {"opmode": "manr"}, "panel/opmode", "MANR"),
        ("panel/opmode", "setopmode", {"opmode": "auto"}, "panel/opmode", "AUTO"),
        (
            "panel/ctrlstate",
            "setctrlstate",
            {"ctrl_state": "motoron"},
            "panel/ctrlstate",
            "motoron",
        ),
        (
            "panel",
            "emergencystop",
            {"emergency_stop": "pressed"},
            "panel/ctrlstate",
            "emergencystop",
        ),
        (
            *("panel", "emergencystop", {"emergency_stop": "released"}),
            *("panel/ctrlstate", "emergencystopreset"),
        ),
        (
            "panel/ctrlstate",
            "setctrlstate",
            {"ctrl_state": "motoroff"},
            "panel/ctrlstate",
            "motoroff",
        ),
        ("rapid/execution", "setcycle", {"cycle": "once"}, "rapid/execution", "once"),
        ("rapid/execution", "setcycle", {"cycle": "forever"}, "rapid/execution", "forever"),
    ],
)
def test_a_word_has_its_effect(
    switched: tuple[Engine, list[Notification]],
    path: str,
    action: str,
    form: dict[str, str],
    shown: str,
    value: str,
) -> None:
    engine, _ = switched
    act(engine.reply, f"/rw/{path}", action, **form)
    reply = engine.reply(Request("GET", f"/rw/{shown}"))
    assert value in reply.items[0].fields.values()  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("path", "action", "name", "done", "refused"),
    [
        ("panel", "restart", "restart-mode", ("restart", "pstart", "istart"), ("xstart", "")),
        ("rapid/execution", "stop", "stopmode", ("cycle", "instr", "stop", "qstop"), ("now",)),
        ("rapid/execution", "setcycle", "cycle", ("once", "forever"), ("twice",)),
        ("panel/opmode", "setopmode", "opmode", ("manr", "AUTO"), ("coldet",)),
    ],
)
def test_other_words_are_refused(
    switched: tuple[Engine, list[Notification]],
    path: str,
    action: str,
    name: str,
    done: tuple[str, ...],
    refused: tuple[str, ...],
) -> None:
    engine, _ = switched
    for words, status in ((done, 204), (refused, 400)):
        for word in words:
            stopped(engine.reply)
            request = Request("POST", f"/rw/{path}", {"action": action}, {name: word}, 1)
            assert engine.reply(request).status == status, word


@pytest.mark.parametrize(("word", "code"), [("restart", "10045"), ("pstart", "10046")])
def test_a_restart_is_warm_or_cold(
    switched: tuple[Engine, list[Notification]], word: str, code: str
) -> None:
    engine, _ = switched
    stopped(engine.reply)
    engine.reply(Request("POST", "/rw/elog", {"action": "clearall"}, {}, 1))
    act(engine.reply, "/rw/panel", "restart", restart_mode=word)
    entries = engine.reply(Request("GET", "/rw/elog/0")).resources  # type: ignore[union-attr]
    assert code in [one.fields["code"] for one in entries or ()]


def test_texts_of_a_page_are_in_one_line() -> None:
    text = xhtml_refusal(ErrorAnswer(400, 1, "Q\tb\n<c>\ufffe"), "http://here/")
    assert '<span class="msg">Q b &lt;c&gt;</span>' in text


def test_steps_backwards_are_refused(switched: tuple[Engine, list[Notification]]) -> None:
    engine, _ = switched
    for word in ("stepback", "steplast"):
        stopped(engine.reply)
        form = {"execmode": word}
        reply = engine.reply(Request("POST", "/rw/rapid/execution", {"action": "start"}, form, 1))
        assert reply.status == 400
        assert word in str(reply)


def test_an_axis_is_jogged_as_far_as_said_or_until_it_is_released(
    switched: tuple[Engine, list[Notification]],
) -> None:
    engine, _ = switched

    def jog(**form: str) -> int:
        where = "/rw/motionsystem"
        return engine.reply(Request("POST", where, {"action": "jog"}, form, 1)).status

    def joints(wait_s: float) -> list[float]:
        engine.live.advance(engine.live.now_s + wait_s)
        reply = engine.reply(Request("GET", "/rw/motionsystem/mechunits/ROB_1/jointtarget"))
        fields = reply.items[0].fields  # type: ignore[union-attr]
        return [float(fields[f"rax_{number}"]) for number in range(1, 7)]

    stopped(engine.reply)
    act(engine.reply, "/rw/panel/opmode", "setopmode", opmode="manr")
    act(engine.reply, "/rw/panel/ctrlstate", "setctrlstate", ctrl_state="motoron")
    before = joints(0.0)
    assert jog(frame="joints", by="5") == 204
    assert [a - b for a, b in zip(joints(5.0), before, strict=True)] == pytest.approx([5] + 5 * [0])
    assert jog(frame="joints", axis="2", by="-5", mechunit="rob_1") == 204
    assert joints(5.0)[1] == pytest.approx(before[1] - 5.0)
    # Only a step of a button that is held may be shorter.
    while (status := jog(frame="joints", axis="2", by="30")) == 204:
        joints(5.0)
    assert (status, jog(frame="joints", axis="2", by="30", held="1")) == (400, 204)
    furthest = joints(5.0)[1]
    assert jog(frame="joints", axis="2", by="-30", held="1") == 204
    assert furthest - 10.0 < joints(0.3)[1] < furthest
    assert jog(frame="joints", by="0") == 204
    halted = joints(0.5)[1]
    assert furthest - 20.0 < halted < furthest
    assert joints(5.0)[1] == halted


def test_the_mastership_of_edit_is_that_of_programs_and_configuration(
    switched: tuple[Engine, list[Notification]],
) -> None:
    engine, _ = switched

    def ask(path: str, session: int, generation: int, action: str = "", **form: str) -> int:
        query = {"action": action} if action else {}
        return engine.reply(Request("POST", path, query, form, session, generation)).status

    def shown(path: str, session: int, generation: int) -> tuple[str, ...]:
        reply = engine.reply(Request("GET", path, {}, {}, session, generation))
        (item,) = reply.items  # type: ignore[union-attr]
        names = ("uid", "application", "alias", "mastership", "mastershipheldbyme")
        return (item.kind, *(item.fields[name] for name in names))

    engine.context.sessions[1] = "me"
    for domain, also in (("edit", ("cfg", "rapid")), ("motion", ("motion",))):
        nobody = ("msh-resource", "", "", "", "nomaster", "FALSE")
        assert shown(f"/rw/mastership/{domain}", 1, 2) == nobody
        assert ask(f"/rw/mastership/{domain}/request", 1, 2) == 204
        held = ("msh-resource", "1", "RobAPI2-Client", "me", "remote")
        assert shown(f"/rw/mastership/{domain}", 1, 2) == (*held, "TRUE")
        assert shown(f"/rw/mastership/{also[0]}", 2, 1) == (*held, "FALSE")
        for one in ("cfg", "motion", "rapid"):
            status = ask(f"/rw/mastership/{one}", 2, 1, "request")
            assert status == (403 if one in also else 204)
            ask(f"/rw/mastership/{one}", 2, 1, "release")
        assert ask(f"/rw/mastership/{domain}/release", 1, 2) == 204


def test_states_that_are_subscribed_to_have_events_of_their_own_class(
    switched: tuple[Engine, list[Notification]],
) -> None:
    engine, told = switched
    stopped(engine.reply)
    expected = {
        "/rw/panel/ctrlstate;ctrlstate": ("pnl-ctrlstate-ev", "ctrlstate"),
        "/rw/panel/ctrl-state;ctrlstate": ("pnl-ctrlstate-ev", "ctrlstate"),
        "/rw/panel/ctrl-state": ("pnl-ctrlstate-ev", "ctrlstate"),
        "/rw/panel/opmode;opmode": ("pnl-opmode-ev", "opmode"),
        "/rw/panel/speedratio;speedratio": ("pnl-speedratio-ev", "speedratio"),
        "/rw/panel/coldetstate;coldetstate": ("pnl-coldetstate-ev", "coldetstate"),
        "/rw/rapid/execution;ctrlexecstate": ("rap-ctrlexecstate-ev", "ctrlexecstate"),
        "/rw/rapid/execution;rapidexeccycle": ("rap-execcycle-ev", "cycle"),
        "/rw/rapid/symbol/data/RAPID/T_ROB1/k;value": ("rap-value-ev", "value"),
        "/rw/iosystem/signals/diGo;state": ("ios-signalstate-ev", "lvalue"),
    }
    told.clear()
    engine.reply(Subscribe(tuple(expected), 1, 1, (1,) * len(expected)))
    events = {one.resource: one.items[0] for one in told if isinstance(one, ChangeEvent)}
    assert {key: (one.kind, next(iter(one.fields))) for key, one in events.items()} == expected


@pytest.mark.parametrize(
    ("name", "kind", "word"),
    [
        ("n", "rap-sympropvar", "var"),
        ("k", "rap-symproppers", "per"),
        ("c", "rap-sympropconstant", "con"),
    ],
)
def test_each_storage_has_its_class(
    switched: tuple[Engine, list[Notification]], name: str, kind: str, word: str
) -> None:
    engine, _ = switched
    path = f"/rw/rapid/symbol/properties/RAPID/T_ROB1/Tried/{name}"
    (item,) = engine.reply(Request("GET", path)).items  # type: ignore[union-attr]
    assert (item.kind, item.fields["symtyp"]) == (kind, word)


def test_what_clients_leave_out_or_write_otherwise_is_found(
    switched: tuple[Engine, list[Notification]],
) -> None:
    engine, told = switched

    def ask(method: str, path: str, query: str = "", **form: str) -> Reply:
        words = dict(one.split("=") for one in query.split("&") if one)
        return engine.reply(Request(method, path, words, form, 1))

    def names(reply: Reply) -> list[str]:
        assert isinstance(reply, Answer)
        return [one.fields.get("name", one.title) for one in reply.resources or ()]

    # A disk with a colon or without a dollar sign; no folder is written as a dot.
    note = Request("PUT", "/fileservice/HOME:/note.txt", {}, {}, 1, 1, b"note")
    assert engine.reply(note).status == 201
    assert ask("GET", "/fileservice/home/NOTE.txt").status == 200
    assert ask("GET", "/fileservice/$HOME/./note.txt").status == 404
    search = "/rw/rapid/symbols", "action=search-symbols"
    assert names(ask("POST", *search, blockurl="RAPID/T_ROB1/Tried", regexp="^[kn]$")) == ["n", "k"]
    assert names(ask("POST", *search, blockurl="RAPID/T_ROB1", symtyp="con")) == ["c"]
    assert names(ask("POST", *search, blockurl="RAPID/T_ROB1/Other")) == []
    assert names(ask("GET", "/rw/iosystem/signals", "start=1&limit=1")) == ["aoFlow"]
    datum = "/rw/rapid/symbol/data/RAPID/T_ROB1/Tried/k;value"
    assert ask("POST", datum, "action=set", value="7").status == 204
    (read,) = ask("GET", datum).items  # type: ignore[union-attr]
    assert (read.fields["value"], read.title) == ("7", "RAPID/T_ROB1/Tried/k")
    stopped(engine.reply)
    for action, task, shown in (
        ("deactivate", "T_ROB1", "Off"),
        ("activate", "T_ROB1", "On"),
        ("deactivate", "T_NONE", "On"),
    ):
        status = ask("POST", "/rw/rapid/tasks", f"action={action}", task=task).status
        assert status == (404 if task == "T_NONE" else 204)
        tasks = ask("GET", "/rw/rapid/tasks").resources or ()  # type: ignore[union-attr]
        assert [one.fields["active"] for one in tasks if one.kind == "rap-task-li"] == [shown]
    # The default right in manual mode; a queue of clients is subscribed to by its address.
    assert ask("POST", "/users/rmmp").status == 202
    (right,) = ask("GET", "/users/rmmp").items  # type: ignore[union-attr]
    assert right.fields["privilege"] == "modify"
    queue = {"dipc-queue-name": "told", "dipc-queue-size": "5"}
    assert (
        engine.reply(Request("POST", "/rw/dipc", {"action": "dipc-create"}, queue, 1)).status == 201
    )
    engine.reply(Subscribe(("/rw/dipc/told",), 3, 1, (1,)))
    told.clear()
    sent = {"dipc-src-queue-name": "told", "dipc-data": "hello", "dipc-cmd": "111"}
    sent |= {"dipc-userdef": "1", "dipc-msgtype": "1"}
    engine.reply(Request("POST", "/rw/dipc/told", {"action": "dipc-send"}, sent, 1))
    assert [one.resource for one in told if isinstance(one, ChangeEvent)] == ["/rw/dipc/told"]
    short = {"dipc-queue-name": "short", "dipc-queue-size": "1"}
    engine.reply(Request("POST", "/rw/dipc", {"action": "dipc-create"}, short, 1))
    words = Request("POST", "/rw/dipc/short", {"action": "dipc-send"}, sent, 1)
    assert [engine.reply(words).status for _ in range(2)] == [204, 400]
    breaks = engine.live.task("T_ROB1").breakpoints
    for action, there in (("set", {("tried", 10)}), ("clear", set[tuple[str, int]]())):
        form = {"module": "TRIED", "row": "10"}
        assert ask("POST", f"{TASK}/breakpoints", f"action={action}", **form).status == 204
        assert breaks == there
    # An address without an action is not readable where only actions are.
    assert ask("GET", "/rw/rapid/symbols").status in (400, 404)


def test_the_clock_is_set_and_folders_and_backups_are_made(
    switched: tuple[Engine, list[Notification]],
) -> None:
    engine, told = switched

    def ask(method: str, path: str, **form: str) -> Reply:
        fields = {key.replace("_", "-"): value for key, value in form.items()}
        generation = 2 if path.endswith("/create") else 1
        return engine.reply(Request(method, path, {}, fields, 1, generation))

    parts = {"year": "2031", "month": "2", "day": "3", "hour": "4", "min": "5", "sec": "6"}
    clock = {f"sys_clock_{name}": part for name, part in parts.items()}
    assert ask("PUT", "/ctrl/clock", **clock).status == 204
    reply = ask("GET", "/ctrl/clock")
    assert reply.items[0].fields == {"datetime": "2031-02-03 T 04:05:06"}  # type: ignore[union-attr]
    folder = ask("POST", "/fileservice/$HOME", fs_action="create", fs_newname="new")
    assert folder.status == 201
    home = engine.context.files.home
    assert (home / "new").is_dir()
    assert ask("POST", "/ctrl/backup/create", backup="$BACKUP/later").status == 202
    assert (home / "BACKUP" / "later" / "RAPID" / "TASK1" / "PROGMOD" / "Tried.modx").is_file()
    # Domain 0 of the event log has the entries of all.
    engine.reply(Subscribe(("/rw/elog/0",), 2, 1, (1,)))
    told.clear()
    for state in ("motoroff", "motoron"):
        act(engine.reply, "/rw/panel/ctrlstate", "setctrlstate", ctrl_state=state)
    assert "elog-message-ev" in [
        one.items[0].kind for one in told if isinstance(one, ChangeEvent) and one.group == 2
    ]
