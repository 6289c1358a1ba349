"""Clients and programs send each other messages."""

from pathlib import Path

from served_controller import Served, serve

PROGRAM = """MODULE Talking
    RECORD ping
        bool flag;
    ENDRECORD
    PERS num heard := 0;
    PERS string last := "";
    VAR intnum words;
    VAR string pair{2};
    VAR rmqslot asked;
    VAR rmqmessage one;
    PROC main()
        CONNECT words WITH listen;
        IRMQMessage pair, words;
        WHILE TRUE DO
            WaitTime 0.1;
        ENDWHILE
    ENDPROC
    TRAP listen
        RMQGetMessage one;
        RMQGetMsgData one, pair;
        heard := heard + 1;
        last := pair{2};
        RMQFindSlot asked, "client";
        RMQSendMessage asked, heard;
    ENDTRAP
ENDMODULE
"""


def test_a_message_raises_its_interrupt_and_is_answered(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        assert await served.post("rw/dipc?action=dipc-create", dipc_queue_name="client") == (201, 0)
        again = await served.post("rw/dipc?action=dipc-create", dipc_queue_name="client")
        assert again == (400, -1073445879)
        assert await served.get("rw/dipc/client/?action=dipc-read") == []
        await served.post("rw/rapid/execution?action=start")

        async def send(data: str, queue: str = "RMQ_T_ROB1") -> tuple[int, int]:
            return await served.post(
                f"rw/dipc/{queue}?action=dipc-send",
                dipc_src_queue_name="client",
                dipc_cmd="111",
                dipc_userdef="7",
                dipc_msgtype="1",
                dipc_data=data,
            )

        assert await send('string;["a, b","c"]') == (204, 0)
        assert (await served.value("heard"), await served.value("last")) == ("1", '"c"')
        assert await send('string;["x","y"]', "T_ROB1") == (204, 0)
        answers = await served.get("rw/dipc/client?action=dipc-read")
        assert [one["dipc-data"] for one in answers] == ["num;1", "num;2"]
        assert {one["_type"] for one in answers} == {"dipc-read-li"}
        assert await served.get("rw/dipc/client?action=dipc-read") == []
        # What nobody has ordered raises nothing.
        assert await send("num;5") == (204, 0)
        assert await send("ping;[TRUE]") == (204, 0)
        assert await served.value("heard") == "2"
        assert await send("no message") == (400, -1073445879)
        # Clients among themselves send what they like.
        assert await send("text; of any kind ", "client") == (204, 0)
        (answer,) = await served.get("rw/dipc/client?action=dipc-read")
        assert answer["dipc-data"] == "text; of any kind "
        assert await send("num;5", "nobody") == (404, -1073414146)

    serve(tmp_path, PROGRAM, use)


def test_a_queue_ends_with_its_session(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        await served.post("rw/dipc?action=dipc-create", dipc_queue_name="client")
        await served.get("logout")
        assert await served.status("rw/dipc/client") == (404, -1073414146)

    serve(tmp_path, PROGRAM, use)
