"""Questions of programs wait until a client answers."""

from pathlib import Path

from served_controller import Served, serve

PROGRAM = """MODULE Asking
    PERS num count := 0;
    PERS num key := 0;
    PERS string name := "";
    PERS num broken := 0;
    VAR errnum flag;
    PROC main()
        TPReadNum count, "How many?";
        TPReadFK key, "Which?", "Left", "", "Right", "", "";
        name := UIAlphaEntry(\\Message:="Who?");
        TPReadNum count, "More?" \\MaxTime:=1 \\BreakFlag:=flag;
        broken := flag;
        WaitUntil FALSE;
    ENDPROC
ENDMODULE
"""
ACTIVE = "rw/rapid/uiinstr/active"


def test_a_client_answers_and_wrong_answers_are_refused(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        async def answer(value: str) -> tuple[int, int]:
            where = f"{ACTIVE}/param/RAPID/T_ROB1/TPAnswer?action=set"
            return await served.post(where, value=value)

        async def asked() -> tuple[str, str]:
            (question,) = await served.get(ACTIVE)
            return question["instr"], question["msg"]

        assert await served.status(ACTIVE) == (404, -1073414146)
        await served.post("rw/rapid/execution?action=start")
        for _ in range(10):
            assert await asked() == ("TPReadNum", "How many?")
        assert await answer("many") == (400, -1073445879)
        assert await answer("7") == (204, 0)
        assert (await served.value("count"), await asked()) == ("7", ("TPReadFK", "Which?"))
        assert await answer("2") == (400, -1073445879)
        assert await answer("right") == (204, 0)
        assert (await served.value("key"), (await asked())[0]) == ("3", "IAlphaEntry")
        assert await answer('"Ada"') == (204, 0)
        assert (await served.value("name"), await asked()) == ('"Ada"', ("TPReadNum", "More?"))
        # A second later nobody has answered, and the question is gone.
        for _ in range(22):
            await served.get("rw/system")
        assert await served.status(ACTIVE) == (404, -1073414146)
        assert float(await served.value("broken")) > 0
        assert await answer("1") == (404, -1073414146)

    serve(tmp_path, PROGRAM, use)


def test_a_question_goes_with_its_program(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        resource = "/rw/rapid/uiinstr;uievent"
        form = {"resources": "1", "1": resource, "1-p": "1"}
        async with served.client.post(f"{served.base}/subscription", data=form) as response:
            link = response.headers["Location"]
        socket = await served.client.ws_connect(link, protocols=("robapi2_subscription",))
        # Subscribers first get an empty event.
        assert "<ul></ul>" in await socket.receive_str(timeout=20)
        await served.post("rw/rapid/execution?action=start")
        event = await socket.receive_str(timeout=20)
        assert '<li class="rap-ui-ev" title="uiinstruction">' in event
        assert '<span class="instr">TPReadNum</span><span class="event">SEND</span>' in event
        assert '<span class="execlv">NORMAL</span>' in event
        assert await served.get(ACTIVE)
        await served.post("rw/rapid/execution?action=stop")
        await served.post("rw/rapid/execution?action=resetpp")
        assert await served.status(ACTIVE) == (404, -1073414146)

    serve(tmp_path, PROGRAM, use)
