"""Clients load and unload modules."""

from pathlib import Path

from served_controller import Served, serve

from rapidsim.diagnostics import Severity
from rapidsim.jobs.checking.check_files import check_job
from rapidsim.jobs.inputs.job import job
from rapidsim.jobs.inputs.run_request import RunRequest

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


def test_a_controller_without_a_program_has_it_loaded_later(tmp_path: Path) -> None:
    (tmp_path / "cell").mkdir()
    program = "MODULE Late\nPERS num made := 0;\nPROC main()\nmade := 7;\nENDPROC\nENDMODULE\n"

    async def use(served: Served) -> None:
        (task,) = await served.get("rw/rapid/tasks")
        assert (task["name"], task["excstate"]) == ("T_ROB1", "uninitialized")
        start = "rw/rapid/execution?action=start"
        assert await served.post(start) == (400, -1073442809)
        async with served.client.put(f"{served.base}/fileservice/$HOME/l.mod", data=program) as put:
            assert put.status == 201
        load = "rw/rapid/tasks/T_ROB1?action=loadmod"
        assert await served.post(load, modulepath="$HOME/l.mod") == (204, 0)
        assert await served.post("rw/rapid/execution?action=resetpp") == (204, 0)
        assert await served.post(start, cycle="once") == (204, 0)
        assert await served.value("made") == "7"
        names = [one["name"] for one in await served.get("rw/rapid/modules?task=T_ROB1")]
        assert names == ["user", "Late"]

    serve(tmp_path, None, use)


def test_a_backup_is_a_cell_that_check_takes(tmp_path: Path) -> None:
    (tmp_path / "home" / "logs").mkdir(parents=True)
    (tmp_path / "home" / "logs" / "a.txt").write_text("one")
    moves = "MoveAbsJ [[4,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;\nSetDO doX, 1;"
    program = PROGRAM.replace('%"part"%;', f"{moves} made := made + 1;")

    async def use(served: Served) -> None:
        await served.post("rw/rapid/execution?action=start", cycle="once")
        while await served.executes():
            pass
        assert (await served.get("ctrl/backup?action=backupstate"))[0]["backup state"] == "None"
        url = f"{served.base}/ctrl/backup?action=backup"
        for wrong in ("/fileservice/$HOME/b", "$BACKUP//", "$NOWHERE/b", "b", "$BACKUP/../b"):
            async with served.client.post(url, data={"backup": wrong}) as done:
                assert 400 <= done.status < 500, wrong
        place = {"backup": "/fileservice/$BACKUP/day"}
        async with served.client.post(url, data=place) as done:
            assert (done.status, done.headers["Location"]) == (202, "/progress/1")
        assert (await served.get("progress/1"))[0]["_title"] == "backup"
        async with served.client.post(url, data=place) as done:
            assert done.status == 400

    serve(tmp_path, program, use)
    backup = tmp_path / "home" / "BACKUP" / "day"
    assert (backup / "HOME" / "logs" / "a.txt").read_text() == "one"
    assert "made := 1" in (backup / "RAPID" / "TASK1" / "PROGMOD" / "Calling.mod").read_text()
    found = check_job(job(RunRequest(paths=(str(backup),))))
    assert [one for one in found.diagnostics if one.severity is Severity.ERROR] == []
    station = job(RunRequest(paths=(str(backup),))).station
    assert (str(station.robotware), station.robot) == ("6.16", "irb1600-6-1.2")
    assert [one.name for one in station.io.signals] == ["doX"]


OTHER = """MODULE Other
    PERS num rounds := 0;
    PROC main()
        count;
    ENDPROC
    PROC count()
        rounds := rounds + 1;
        WaitTime 0.2;
    ENDPROC
    PROC give(num much)
        rounds := much;
    ENDPROC
ENDMODULE
"""
LIST = "<Program><Module>other.mod</Module><Module>part.mod</Module></Program>"


def test_another_program_takes_the_place_of_the_one_that_is_there(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        part = PART.replace("made := made + 1;", "")
        texts = {"other.mod": OTHER, "part.mod": part, "all.pgf": LIST, "bad.mod": "MODULE x PROC"}
        for name, text in texts.items():
            file = f"{served.base}/fileservice/$HOME/{name}"
            async with served.client.put(file, data=text.encode()) as done:
                assert done.status == 201
        load = "rw/rapid/tasks/T_ROB1/program?action=loadprog"
        for wrong in ("$HOME/none.pgf", "$HOME/bad.mod", ""):
            assert await served.post(load, progpath=wrong) == (400, -1073438708)
        names = [one["name"] for one in await served.get("rw/rapid/modules?task=T_ROB1")]
        assert names == ["Calling"]
        # A name alone is one of the home folder.
        for path in ("$HOME/all.pgf", "all.pgf"):
            assert await served.post(load, progpath=path) == (204, 0)
            names = [one["name"] for one in await served.get("rw/rapid/modules?task=T_ROB1")]
            assert names == ["Other", "PartMod"]
        execution = "rw/rapid/execution?action="
        assert await served.post(f"{execution}resetpp") == (204, 0)
        assert await served.post(f"{execution}start", cycle="once") == (204, 0)
        while await served.executes():
            pass
        assert await served.value("rounds") == "1"

    serve(tmp_path, PROGRAM, use)


def test_a_pointer_is_put_to_a_routine_which_runs_once(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        put = "rw/rapid/tasks/T_ROB1/pcp?action=set-pp-routine"
        for wrong in (
            {"routine": "none"},
            {"routine": "give"},
            {"module": "none", "routine": "count"},
        ):
            assert (await served.post(put, **wrong))[0] == 400
        assert await served.post(put, module="Other", routine="COUNT") == (204, 0)
        (pointer,) = await served.get("rw/rapid/tasks/T_ROB1/pcp")
        assert (pointer["routinename"], pointer["beginposition"]) == ("count", "6,10")
        execution = "rw/rapid/execution?action="
        assert await served.post(f"{execution}start", cycle="forever") == (204, 0)
        assert (await served.post(put, routine="count"))[0] == 400
        while await served.executes():
            pass
        assert await served.value("rounds") == "1"

    serve(tmp_path, OTHER, use)


def test_a_saved_module_has_the_current_values_of_its_persistents(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        made = "rw/rapid/symbol/data/RAPID/T_ROB1/Calling/made?action=set"
        assert await served.post(made, value="7") == (204, 0)
        where = f"{served.base}/rw/rapid/modules/calling?task=T_ROB1&action=save"

        async def save(**form: str) -> int:
            async with served.client.post(where, data=form) as response:
                return response.status

        assert await save(name="Copy", path="$TEMP") == 204
        saved = (tmp_path / "home" / "TEMP" / "Copy.mod").read_text()
        assert saved == PROGRAM.replace("made := 0", "made := 7")
        assert (await save(name="../Copy", path="$HOME"), await save(name="Copy")) == (404, 400)
        # Controllers have three of the predefined data in a module.
        (tool,) = await served.get("rw/rapid/symbol/data/RAPID/T_ROB1/BASE/tool0")
        assert tool["value"].startswith("[TRUE,[[0,0,0],[1,0,0,0]]")
        unknown = "rw/rapid/symbol/data/RAPID/T_ROB1/BASE/v100"
        assert await served.status(unknown) == (400, -1073414146)

    serve(tmp_path, PROGRAM, use)
