"""Clients are told what changes."""

import math
import re
from pathlib import Path

import aiohttp
import pytest
from served_controller import Served, serve

from rapidsim.server.messages import Subscribe

PROGRAM = """MODULE Telling
    PERS num rounds := 0;
    PROC main()
        rounds := rounds + 1;
        PulseDO \\PLength:=0.1, doPulse;
        WaitTime 1;
        IF rounds = 2 ErrWrite "Two", "rounds";
    ENDPROC
ENDMODULE
"""
ROUNDS = "/rw/rapid/symbol/data/RAPID/T_ROB1/rounds;value"
PULSE = "/rw/iosystem/signals/doPulse;state"


async def _listen(served: Served, *resources: str) -> aiohttp.ClientWebSocketResponse:
    form = {"resources": "1"}
    for number, resource in enumerate(resources, start=1):
        form |= {str(number): resource, f"{number}-p": "1"}
    async with served.client.post(f"{served.base}/subscription?json=1", data=form) as response:
        assert response.status == 201
        text, link = await response.text(), response.headers["Location"]
    # Public clients look for exactly this.
    assert re.search(r'<a href="ws://.*(/poll/\d+)" rel="self">', text)
    return await served.client.ws_connect(link, protocols=("robapi2_subscription",))


async def _heard(socket: aiohttp.ClientWebSocketResponse, count: int) -> list[tuple[str, str]]:
    found = []
    for _ in range(count):
        text = await socket.receive_str(timeout=20)
        assert "\n" not in text
        kind = re.search(r'<li class="([^"]+)"', text)
        value = re.search(r'<span class="(?:lvalue|value|ctrlexecstate|seqnum)">([^<]*)<', text)
        assert kind
        assert value
        found.append((kind[1], value[1]))
    return found


def test_values_are_told_first_and_then_every_change(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        execution = "/rw/rapid/execution;ctrlexecstate"
        socket = await _listen(served, execution, ROUNDS, PULSE, "/rw/elog/8")
        signal, state, value = "ios-signalstate-ev", "rap-ctrlexecstate-ev", "rap-value-ev"
        assert sorted(await _heard(socket, 3)) == [(signal, "0"), (state, "stopped"), (value, "0")]
        await served.post("rw/rapid/execution?action=start")
        assert sorted(await _heard(socket, 3)) == [(signal, "1"), (state, "running"), (value, "1")]
        for _ in range(50):
            await served.get("rw/system")
        heard = await _heard(socket, 6)
        assert heard[:3] == [(signal, "0"), (value, "2"), (signal, "1")]
        assert ("elog-message-ev", "4") in heard
        await socket.close()

    serve(tmp_path, PROGRAM, use)


def test_data_that_always_change_are_told_as_often_as_their_priority_says(tmp_path: Path) -> None:
    program = """MODULE Telling
    PERS num rounds := 0;
    PROC main()
        rounds := rounds + 1;
        WaitTime 0.01;
    ENDPROC
ENDMODULE
"""

    async def use(served: Served) -> None:
        engine, heard = served.engine, list[tuple[float, int]]()
        engine.subscriptions.on_event = lambda event: heard.append((engine.live.now_s, event.group))
        engine.subscriptions.is_paced = True
        resource = ("/rw/rapid/symbol/data/RAPID/T_ROB1/rounds;value",)
        for priority in (0, 1, 2):
            engine.reply(Subscribe(resource, priority, priorities=(priority,)))
        assert await served.post("rw/rapid/execution?action=start", cycle="forever") == (204, 0)
        heard.clear()
        while engine.live.now_s < 21.0:
            engine.live.step(engine.live.now_s + 0.01)
            engine.subscriptions.publish_changes(has_changed=True)
        for priority, period_s in enumerate((5.25, 0.4, 0.05)):
            times = [time_s for time_s, group in heard if group == priority]
            assert (times[-1] - times[0]) / (len(times) - 1) == pytest.approx(period_s, abs=0.011)
        await served.post("rw/rapid/execution?action=stop")
        # The last value is never missed, and its event has a time.
        assert engine.subscriptions.next_due_s < math.inf
        heard.clear()
        engine.live.advance(30.0)
        engine.step()
        assert 0 in {group for _, group in heard}
        assert engine.subscriptions.next_due_s == math.inf

    serve(tmp_path, program, use)


def test_a_group_ends_with_its_websocket_its_deletion_or_its_session(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        first = await _listen(served, ROUNDS)
        await first.close()
        # Clients that want to go on reconnect after a broken connection, but not after CLOSE.
        second = await _listen(served, ROUNDS)
        await _heard(second, 1)
        async with served.client.delete(f"{served.base}/subscription/2") as response:
            assert response.status == 200
        assert (await second.receive(timeout=20)).type is aiohttp.WSMsgType.CLOSED
        third = await _listen(served, ROUNDS)
        await _heard(third, 1)
        await served.get("logout")
        assert (await third.receive(timeout=20)).type is aiohttp.WSMsgType.CLOSED
        assert served.engine.subscriptions.groups == 0

    serve(tmp_path, PROGRAM, use)


def test_what_nobody_can_listen_to_is_refused(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        async def status(*resources: str) -> int:
            form = {
                f"{number}{end}": one for number, one in enumerate(resources) for end in ("", "-p")
            }
            async with served.client.post(f"{served.base}/subscription", data=form) as response:
                return response.status

        assert await status() == 400
        assert await status("/rw/nothing") == 404
        assert await status(PULSE, "/rw/iosystem/signals/diNone;state") == 404
        assert await status("/rw/rapid/symbol/data/RAPID/T_ROB1/nothing;value") == 404
        assert served.engine.subscriptions.groups == 0
        assert await served.status("poll/99") == (404, -1073414146)

    serve(tmp_path, PROGRAM, use)


def test_a_client_that_does_not_answer_does_not_hold_the_end_up(tmp_path: Path) -> None:
    """It hears that its websocket is closed, and reads it or not."""

    async def use(served: Served) -> Served:
        sockets.append(await _listen(served, ROUNDS))
        sockets.append(await _listen(served, PULSE))
        assert served.engine.subscriptions.groups == 2
        return served

    sockets: list[aiohttp.ClientWebSocketResponse] = []
    assert serve(tmp_path, PROGRAM, use).engine.subscriptions.groups == 0
