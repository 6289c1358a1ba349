"""Clients start, stop and watch programs."""

from pathlib import Path

from served_controller import Served, serve

COUNTING = """MODULE Counting
    PERS num rounds := 0;
    VAR num total := 0;
    PROC main()
        rounds := rounds + 1;
        total := total + 1;
        WaitTime 0.2;
        IF total = 3 SetDO doThird, 1;
    ENDPROC
ENDMODULE
"""


def test_a_program_is_started_stopped_and_begun_anew(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        assert not await served.executes()
        assert await served.post("rw/rapid/execution?action=start", cycle="forever") == (204, 0)
        assert await served.executes()
        for _ in range(20):
            await served.get("rw/system")
        assert await served.post("rw/rapid/execution?action=stop", stopmode="stop") == (204, 0)
        assert not await served.executes()
        rounds, total = await served.value("rounds"), await served.value("total")
        assert float(rounds) == float(total) > 4
        (signal,) = await served.get("rw/iosystem/signals/Local/DRV_1/doThird")
        assert signal["lvalue"] == "1"
        assert await served.post("rw/rapid/execution?action=resetpp") == (204, 0)
        assert (await served.value("rounds"), await served.value("total")) == (rounds, "0")

    serve(tmp_path, COUNTING, use)
