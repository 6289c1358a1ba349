"""Clients load and unload modules."""

from pathlib import Path

from served_controller import Served, serve

PROGRAM = """MODULE Calling
    PERS num made := 0;
    PROC main()
        %"part"%;
        WaitTime 1;
    ENDPROC
ENDMODULE
"""
PART = """MODULE PartMod
    PROC part()
        made := made + 1;
    ENDPROC
ENDMODULE
"""


def test_a_module_that_a_client_uploads_is_loaded_run_and_unloaded(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        file = f"{served.base}/fileservice/$HOME/parts/part.mod"
        async with served.client.put(file, data=PART.encode()) as done:
            assert done.status == 201
        task = "rw/rapid/tasks/T_ROB1?action="
        for wrong in ("", "$HOME/none.mod", "HOME:/../part.mod"):
            assert await served.post(f"{task}loadmod", modulepath=wrong) == (400, -1073438708)
        path = "$HOME/parts/part.mod"
        assert await served.post(f"{task}loadmod", modulepath=path) == (204, 0)
        assert await served.post(f"{task}loadmod", modulepath=path) == (400, -1073438708)
        assert await served.post(f"{task}loadmod", modulepath=path, replace="true") == (204, 0)
        names = [one["name"] for one in await served.get("rw/rapid/modules?task=T_ROB1")]
        assert names == ["Calling", "PartMod"]
        where = "rw/rapid/modules/partmod?task=T_ROB1&resource=module-text"
        (shown,) = await served.get(where)
        assert "made := made + 1" in shown["module-text"]
        execution = "rw/rapid/execution?action="
        await served.post(f"{execution}start")
        assert await served.post(f"{task}unloadmod", module="PartMod") == (400, -1073442809)
        await served.post(f"{execution}stop")
        assert await served.value("made") == "1"
        # It stays when the pointer goes to main.
        await served.post(f"{execution}resetpp")
        assert await served.post(f"{task}unloadmod", module="PartMod") == (204, 0)
        assert await served.post(f"{task}unloadmod", module="PartMod") == (400, -1073442816)

    serve(tmp_path, PROGRAM, use)
