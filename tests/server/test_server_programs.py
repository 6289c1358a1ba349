"""Clients start, stop and watch programs, and change what programs use."""

import re
from base64 import b64encode
from pathlib import Path

import pytest
from served_controller import Served, serve

COUNTING = """MODULE Counting
    PERS num rounds := 0;
    PERS num sizes{3} := [1,2,3];
    LOCAL PERS string hidden := "here";
    CONST num fixed := 4;
    VAR num total := 0;
    PROC main()
        rounds := rounds + 1;
        total := total + 1;
        WaitTime 0.2;
        IF total = 3 SetDO doThird, 1;
        IF total = 4 ErrWrite \\I, "Four", "rounds" \\RL2:="are enough";
    ENDPROC
ENDMODULE
"""
EXECUTION = "rw/rapid/execution?action="


def test_a_program_is_started_stopped_and_begun_anew(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        assert not await served.executes()
        assert await served.post(f"{EXECUTION}start", cycle="forever") == (204, 0)
        assert await served.executes()
        assert await served.post(f"{EXECUTION}start") == (400, -1073442809)
        assert await served.post(f"{EXECUTION}resetpp") == (400, -1073442809)
        for _ in range(20):
            await served.get("rw/system")
        assert await served.post(f"{EXECUTION}stop", stopmode="stop") == (204, 0)
        assert not await served.executes()
        rounds, total = await served.value("rounds"), await served.value("total")
        assert float(rounds) == float(total) > 4
        (signal,) = await served.get("rw/iosystem/signals/Local/DRV_1/doThird")
        assert signal["lvalue"] == "1"
        assert await served.post(f"{EXECUTION}resetpp") == (204, 0)
        assert (await served.value("rounds"), await served.value("total")) == (rounds, "0")
        entries = await served.get("rw/elog/8/?lang=en")
        assert [(one["code"], one["msgtype"], one["argc"]) for one in entries] == [
            ("80003", "1", "3")
        ]
        assert [one["value"] for one in entries[0]["argv"]] == ["Four", "rounds", "are enough"]
        (task,) = await served.get("rw/rapid/tasks")
        assert (task["excstate"], task["active"], task["motiontask"]) == ("stopped", "On", "TRUE")

    serve(tmp_path, COUNTING, use)


@pytest.mark.parametrize(
    "name", ["T_ROB1/rounds", "T_ROB1/Counting/rounds", "rounds", "Counting/ROUNDS"]
)
def test_data_are_found_however_much_of_their_address_is_given(tmp_path: Path, name: str) -> None:
    async def use(served: Served) -> None:
        assert await served.post(f"rw/rapid/symbol/data/RAPID/{name}?action=set", value="7") == (
            204,
            0,
        )
        (found,) = await served.get(f"rw/rapid/symbol/data/RAPID/{name};value")
        assert found["value"] == "7"

    serve(tmp_path, COUNTING, use)


def test_what_there_is_and_is_not_among_data(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        data = "rw/rapid/symbol/data/RAPID/T_ROB1"
        assert await served.post(f"{data}/rounds?action=set", value="seven") == (400, -1073445879)
        assert await served.post(f"{data}/rounds?action=set") == (400, -1073445879)
        assert await served.post(f"{data}/fixed?action=set", value="5") == (403, -1073445881)
        assert await served.status(f"{data}/nothing") == (400, -1073414146)
        (tool,) = await served.get(f"{data}/tool0")
        assert tool["value"].startswith("[TRUE,[[0,0,0],[1,0,0,0]],")
        (shape,) = await served.get("rw/rapid/symbol/properties/RAPID/T_ROB1/Counting/sizes")
        assert (shape["dattyp"], shape["ndim"], shape["dim"], shape["symtyp"]) == (
            "num",
            "1",
            "3",
            "per",
        )
        found = await served.search(
            "rw/rapid/symbols?action=search-symbols", blockurl="RAPID/T_ROB1", symtyp="per"
        )
        assert [one["name"] for one in found] == ["rounds", "sizes", "hidden"]
        assert [one["local"] for one in found] == ["false", "false", "true"]

    serve(tmp_path, COUNTING, use)


def test_elements_and_components_are_data_too(tmp_path: Path) -> None:
    program = COUNTING.replace(
        "VAR num total",
        "PERS robtarget path{3} := [[[1,2,3],[1,0,0,0],[0,0,0,0],[0,0,0,0,0,0]],"
        "[[4,5,6],[1,0,0,0],[0,0,0,0],[0,0,0,0,0,0]],[[7,8,9],[1,0,0,0],[0,0,0,0],"
        "[0,0,0,0,0,0]]];\n    PERS num grid{2,2} := [[1,2],[3,4]];\n    VAR num total",
    )
    target = "[[1500,0,1789],[0,0,1,0],[0,0,0,0],[9E+9,9E+9,9E+9,9E+9,9E+9,9E+9]]"

    async def use(served: Served) -> None:
        data = "rw/rapid/symbol/data/RAPID/T_ROB1/Counting"
        element = f"{data}/path%7B2%7D"
        assert await served.post(f"{element}?action=set", value=target) == (204, 0)
        for path, value in (
            (element, target.replace("9E+9", "9E+09")),
            (f"{data}/path%7B1%7D.trans", "[1,2,3]"),
            (f"{data}/PATH{{3}}.trans.y", "8"),
            (f"{data}/grid{{2,1}}", "3"),
            (f"{data}/grid{{2}}", "[3,4]"),
            ("rw/rapid/symbol/data/RAPID/T_ROB1/tool0.tframe.rot", "[1,0,0,0]"),
        ):
            (state,) = await served.get(path)
            assert state["value"] == value
        assert await served.post(f"{data}/grid{{2,1}}?action=set", value="7") == (204, 0)
        assert await served.value("grid") == "[[1,2],[7,4]]"
        assert await served.post(f"{data}/grid{{2,1}}?action=set", value="[7]") == (
            400,
            -1073445879,
        )
        properties = "rw/rapid/symbol/properties/RAPID/T_ROB1/Counting"
        (shape,) = await served.get(f"{properties}/path{{2}}")
        assert (shape["dattyp"], shape["ndim"]) == ("robtarget", "0")
        for nothing in ("path{0}", "path{4}", "path{n}", "path{1", "path.x", "grid{1}{1}{1}"):
            assert await served.status(f"{data}/{nothing}") == (400, -1073414146), nothing

    serve(tmp_path, program, use)


def test_the_panel(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        assert await served.post(
            "rw/panel/ctrlstate?action=setctrlstate", ctrl_state="motoroff"
        ) == (204, 0)
        (state,) = await served.get("rw/panel/ctrlstate")
        assert state == {"_type": "pnl-ctrlstate", "_title": "ctrlstate", "ctrlstate": "motoroff"}
        assert await served.post(f"{EXECUTION}start") == (400, -1073442809)
        ratio = "rw/panel/speedratio"
        for text, answer in (("50.0", 204), ("101", 400), ("inf", 400), ("fast", 400)):
            status, _ = await served.post(f"{ratio}?action=setspeedratio", speed_ratio=text)
            assert status == answer
        (state,) = await served.get(ratio)
        assert (state["_type"], state["speedratio"]) == ("pnl-speedratio", "50")
        assert await served.post("rw/panel/opmode?action=setopmode", opmode="manf") == (
            400,
            -1073442809,
        )

    serve(tmp_path, COUNTING, use)


def test_where_the_robot_is(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        unit = "rw/motionsystem/mechunits/ROB_1"
        (joints,) = await served.get(f"{unit}/jointtarget")
        assert joints["_type"] == "ms-jointtarget"
        assert (joints["rax_5"], joints["eax_f"]) == ("30", "9E+09")
        (target,) = await served.get(f"{unit}/robtarget?tool=tool0&wobj=wobj0&coordinate=Base")
        assert target["eaxa"] == target["eax_a"] == "9E+09"
        assert sum(float(target[f"q{index}"]) ** 2 for index in range(1, 5)) == pytest.approx(1.0)
        assert await served.status(f"{unit}/robtarget?coordinate=Moon") == (400, -1073445879)
        assert await served.status("rw/motionsystem/mechunits/ROB_2/jointtarget") == (
            404,
            -1073414146,
        )

    serve(tmp_path, COUNTING, use)


def test_a_mastership_is_held_by_one_session(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        set_rounds = "rw/rapid/symbol/data/RAPID/T_ROB1/rounds?action=set"
        assert await served.post("rw/mastership/rapid?action=request") == (204, 0)
        assert await served.post(set_rounds, value="1") == (204, 0)
        other = await served.second_client()
        assert await other.post(set_rounds, value="2") == (403, -1073445862)
        assert await other.post("rw/mastership?action=request") == (403, -1073445862)
        await served.get("logout")
        assert await other.post(set_rounds, value="2") == (204, 0)
        # A public client asks for all of them so.
        assert await other.post("rw/mastership") == (204, 0)
        await other.client.close()

    serve(tmp_path, COUNTING, use)


def test_what_is_not_there_is_answered_as_a_controller_does(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        assert await served.status("rw/nothing/here") == (404, -1073414146)
        assert await served.status("rw/iosystem/signals/diNone") == (404, -1073445866)
        assert await served.post("rw/rapid/execution?action=dance") == (400, -1073445879)
        # Nothing changes by GET.
        assert await served.status("rw/rapid/execution?action=start") == (400, -1073445879)
        assert not await served.executes()
        async with served.client.get(f"{served.base}/rw/nothing") as response:
            assert response.headers["Content-Type"] == "application/xhtml+xml"
            assert '<span class="code">-1073414146</span>' in await response.text()
        # Addresses above resources lead to them.
        async with served.client.get(f"{served.base}/rw/panel") as response:
            assert 'href="speedratio"' in await response.text()

    serve(tmp_path, COUNTING, use)


def test_what_lies_below_an_address_is_told_as_far_as_it_can_be_read(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        headers = {"Accept": "application/xhtml+xml;v=2.0"}
        login = b64encode(b"Default User:robotics").decode()
        async with served.client.get(
            f"{served.second}/rw", headers={**headers, "Authorization": f"Basic {login}"}
        ) as response:
            below = set(re.findall(r'href="([^"]+)"', await response.text()))
        assert {"rw/panel", "rw/rapid", "rw/iosystem"} <= below
        # Where streams are ended, nothing can be read.
        assert not {"rw/infostream", "rw/_istream"} & below

    serve(tmp_path, COUNTING, use)


def test_programs_are_stepped_and_their_pointer_is_at_what_comes_next(tmp_path: Path) -> None:
    program = """MODULE Stepped
  VAR num n := 0;
  PROC main()
    n := 1;
    more; n := 3;
    WaitTime 0;
  ENDPROC
  PROC more()
    n := 2;
  ENDPROC
ENDMODULE
"""

    async def use(served: Served) -> None:
        async def step(how: str) -> tuple[str, str, str]:
            assert await served.post(f"{EXECUTION}start", execmode=how) == (204, 0)
            (state,) = await served.get("rw/rapid/execution")
            assert state["ctrlexecstate"] == "stopped"
            (at,) = await served.get("rw/rapid/tasks/T_ROB1/pcp")
            return at["routinename"], at["beginposition"], at["endposition"]

        for how in ("stepback", "steplast", "hop"):
            assert await served.post(f"{EXECUTION}start", execmode=how) == (400, -1073445879)
        assert await step("stepin") == ("main", "5,5", "5,9")
        assert await step("stepin") == ("more", "9,5", "9,11")
        assert await step("stepout") == ("main", "6,5", "6,15")
        assert await step("stepover") == ("main", "4,5", "4,11")

    serve(tmp_path, program, use)
