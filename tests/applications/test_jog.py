"""Arms moved by hand on a page: what it answers, what it writes, and what a browser makes of it."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import Any

import aiohttp
import numpy as np
import pytest
from browser import CHROMIUM, Page, opened
from command_line import call

from rapidsim.applications.jog.jog_answers import JogAnswers
from rapidsim.applications.jog.jog_cell import JogCell, bare_cell, cell_of
from rapidsim.applications.jog.jog_page import jog_page
from rapidsim.applications.jog.taught_targets import TaughtModules
from rapidsim.files import InputError, SourceFile
from rapidsim.jobs.inputs.job import job
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.jobs.running.run_files import loaded, prepared
from rapidsim.motion.robot.robot import load_robot
from rapidsim.server.http.connections import Connections
from rapidsim.server.http.local_page import LocalPage, application
from rapidsim.server.http.open_port import listen
from rapidsim.simulation.live import position
from rapidsim.simulation.live.controller import LiveController

MODULE = """MODULE Job
  PERS tooldata tPin := [TRUE,[[0,0,120],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  TASK PERS wobjdata wBench := [FALSE,TRUE,"",[[500,0,300],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  CONST robtarget pFirst := [[0,0,100],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  ! Behind the targets.
  PROC main()
    MoveJ pFirst, v100, fine, tPin \\WObj:=wBench;
  ENDPROC
ENDMODULE
"""
STATION = """[robot]
model = "irb1600-6-1.2"

[[object]]
name = "bench"
box = [400, 400, 20]
pose = { position = [200, 0, 0] }
parent = "wobj:wBench"

[[object]]
name = "pin"
cylinder = { diameter = 20, length = 120 }
pose = { position = [0, 0, 60] }
parent = "tool"
"""


def folder_with_cell(folder: Path) -> Path:
    (folder / "job.mod").write_text(MODULE, newline="")
    (folder / "rapidsim.toml").write_text(STATION)
    return folder


@pytest.fixture(scope="module")
def cell(tmp_path_factory: pytest.TempPathFactory) -> JogCell:
    folder = folder_with_cell(tmp_path_factory.mktemp("jog"))
    return cell_of(RunRequest(paths=(str(folder),), home=str(folder)))


def fields(joints: list[float], tool: str = "tool0", wobj: str = "wobj0") -> dict[str, str]:
    return {"joints": ",".join(map(str, joints)), "tool": tool, "wobj": wobj}


@pytest.mark.parametrize(
    "name", ["rv-m1", "kr10-r1100-sixx", "irb120", "irb910sc", "irb660", "yumi"]
)
def test_every_kind_of_arm_stands_and_steps_along_its_frames(name: str) -> None:
    answers = JogAnswers(bare_cell(load_robot(name)))
    start: Any = answers.start({})
    here = fields(start["joints"])
    stands: Any = answers.standing(here)
    assert len(stands["room"]) == len(start["limits"]) == len(start["joints"])
    branches: Any = answers.branches(here)
    assert sum(one["here"] for one in branches["branches"]) == 1
    for frame in ("joints", "base", "tool"):
        steps: Any = answers.steps({**here, "frame": frame, "length": "10", "angle": "1"})
        assert len(steps["steps"]) == (len(start["joints"]) if frame == "joints" else 6)
    moved: Any = answers.move({**here, "frame": "base", "axis": "3", "by": "-5"})
    then: Any = answers.standing(fields(moved["joints"]))
    assert np.allclose(np.subtract(then["trans"], stands["trans"]), [0, 0, -5], atol=1e-2)


def test_an_arm_without_known_speeds_stands_in_a_cell_too(tmp_path: Path) -> None:
    (tmp_path / "job.mod").write_text("MODULE Job\nPROC main()\nENDPROC\nENDMODULE\n")
    cell = cell_of(RunRequest(paths=(str(tmp_path),), robot="rv-m1", home=str(tmp_path)))
    assert len(cell.start) == 5


def test_a_program_with_errors_or_standard_input_is_not_jogged(tmp_path: Path) -> None:
    (tmp_path / "job.mod").write_text("MODULE Job\nPROC main()\n  x := 1;\nENDPROC\nENDMODULE\n")
    rejected = call("jog", "job.mod", cwd=tmp_path)
    assert (rejected.code, rejected.out) == (1, "")
    assert "N201" in rejected.err
    assert "standard input" in call("jog", "-", cwd=tmp_path).err


def test_the_robtarget_is_that_of_tool_and_work_object_and_is_reached_again(cell: JogCell) -> None:
    answers = JogAnswers(cell)
    start: Any = answers.start({})
    assert start["tools"] == ["tool0", "tPin"]
    assert start["wobjs"] == ["wobj0", "wBench"]
    bare: Any = answers.standing(fields([10, 20, 0, 5, 60, 0]))
    with_tool: Any = answers.standing(fields([10, 20, 0, 5, 60, 0], "tPin", "wBench"))
    apart = np.subtract(with_tool["trans"], bare["trans"]) + np.array([500, 0, 300])
    assert np.linalg.norm(apart) == pytest.approx(120.0, abs=1e-3)
    assert bare["rot"] == with_tool["rot"]
    target = with_tool["robtarget"]
    assert target.endswith("[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]]")
    branches: Any = answers.branches(fields([10, 20, 0, 5, 60, 0]))
    for one in branches["branches"]:
        again: Any = answers.standing(fields(one["joints"]))
        assert np.allclose(again["trans"], bare["trans"], atol=0.01)
        assert again["configuration"] == one["confdata"]


def test_an_arm_on_a_track_stands_where_its_controller_says(tmp_path: Path) -> None:
    (tmp_path / "job.mod").write_text(MODULE)
    (tmp_path / "rapidsim.toml").write_text(
        "[robot]\nmodel = 'irb1600-6-1.2'\nbase = { position = [100, 50, 400] }\n"
        "[[external_axis]]\nname = 'TRACK'\naxis = 'a'\nkind = 'linear'\ncarries = 'robot'\n"
        "limits = [500, 3000]\nspeed = 1000\nacceleration = 2000\n"
    )
    request = RunRequest(paths=(str(tmp_path),), home=str(tmp_path))
    answers, run = JogAnswers(cell_of(request)), prepared(loaded(job(request)))
    (task,) = LiveController(run.setups, run.options).tasks.values()
    start: Any = answers.start({})
    stands: Any = answers.standing(fields(start["joints"], "tPin", "wBench"))
    there = position.target(task, "tPin", "wBench", position.Coordinates.WOBJ)
    assert np.allclose(stands["trans"], there.trans, atol=1e-4)
    assert np.allclose(stands["rot"], there.rot, atol=1e-7)
    assert stands["robtarget"].endswith("[500,9E+09,9E+09,9E+09,9E+09,9E+09]]")


def test_bodies_that_touch_are_named_also_those_passed_by_a_step(cell: JogCell) -> None:
    answers = JogAnswers(cell)
    start: Any = answers.start({})
    assert [one["name"] for one in start["objects"]] == ["bench", "pin"]
    free: Any = answers.standing(fields([0, 30, 0, 0, 60, 0]))
    assert all(one["distance"] for one in free["contacts"])
    assert free["objects"][0]["place"] == [700, 0, 300]
    at, seen = [0.0, 30.0, 10.0, 0.0, 50.0, 0.0], list[set[str]]()
    for _ in range(12):
        step = {**fields(at, "tPin"), "frame": "wobj", "axis": "3", "by": "-40"}
        moved: Any = answers.move(step)
        at = moved["joints"]
        there: Any = answers.standing(fields(at))
        ends = [one for one in there["contacts"] if not one["distance"]]
        # What touches at the end of a step has touched on its course.
        assert all(one in moved["contacts"] for one in ends)
        seen += [{one["first"], one["second"]} for one in moved["contacts"]]
    assert seen[0] == {"`pin`", "`bench`"}


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"joints": "1,2"}, "6 numbers"),
        ({"joints": "1,2,3,4,5,nan"}, "6 numbers"),
        ({"joints": "x"}, "cannot be"),
        ({"tool": "none"}, "cannot be"),
        ({"frame": "none"}, "cannot be"),
        ({"by": "1000"}, "at most"),
        ({"axis": "9"}, "no axis 9"),
    ],
)
def test_a_wrong_field_is_refused(cell: JogCell, wrong: dict[str, str], message: str) -> None:
    right = {**fields([0, 0, 0, 0, 30, 0]), "frame": "base", "axis": "1", "by": "10"}
    assert JogAnswers(cell).move(right)
    with pytest.raises(InputError, match=message):
        JogAnswers(cell).move({**right, **wrong})


def test_a_target_is_declared_behind_the_last_one_and_never_over_a_change(tmp_path: Path) -> None:
    place = tmp_path / "job.mod"
    place.write_bytes(MODULE.replace("\n", "\r\n").encode())
    read = SourceFile(str(place), place.read_bytes().decode(), "utf-8")
    modules = TaughtModules((read,))
    target = JogAnswers(bare_cell(load_robot("irb120"))).taught(fields([0, 0, 0, 0, 30, 0]))
    for name in ("pFirst", "PFIRST", "main", "job", "robtarget", "1a", "a b", "IF", "", "a" * 33):
        with pytest.raises(InputError):
            modules.write(str(place), name, target)
    written = modules.write(str(place), "pTaught", target)
    assert modules.write(str(place), "pNext", target).line == written.line + 1
    lines = place.read_bytes().decode().split("\r\n")
    assert lines[written.line - 1].startswith("  CONST robtarget pTaught := [[364.353")
    assert [*lines[:4], *lines[6:]] == MODULE.split("\n")
    place.write_text(MODULE)
    with pytest.raises(InputError, match="has changed"):
        modules.write(str(place), "pLast", target)
    with pytest.raises(InputError, match="no module"):
        modules.write(str(tmp_path / "other.mod"), "pLast", target)
    assert place.read_text() == MODULE


def use_page(page: LocalPage, use: Callable[[str], Awaitable[None]]) -> None:
    async def serve() -> None:
        connections = Connections()
        port = await listen(application(page, "key", connections), connections, "127.0.0.1", 0)
        try:
            await use(port.address)
        finally:
            await port.close()

    asyncio.run(serve())


def test_only_who_knows_the_key_comes_in_and_only_post_writes(
    cell: JogCell, tmp_path: Path
) -> None:
    place = Path(cell.files[0].name)

    async def use(address: str) -> None:
        async with aiohttp.ClientSession() as client:

            async def status(path: str, method: str = "GET", **more: Any) -> int:
                async with client.request(method, f"{address}/{path}", **more) as response:
                    assert "default-src 'none'" in response.headers["Content-Security-Policy"]
                    return response.status

            teach = {**fields([0, 0, 0, 0, 30, 0]), "module": str(place), "name": "pNew"}
            assert await status("key/") == 200
            assert await status("key/jog.js") == 200
            assert await status("") == await status("other/") == await status("jog.js") == 404
            assert await status("key/start", headers={"Host": "evil.example"}) == 403
            elsewhere = {"Origin": "http://evil.example"}
            assert await status("key/teach", "POST", data=teach, headers=elsewhere) == 403
            assert await status("other/teach", "POST", data=teach) == 404
            assert await status("key/teach", params=teach) == 404
            assert await status("key/standing") == 400
            assert place.read_text() == MODULE

    use_page(jog_page(cell), use)


async def tap(page: Page, key: str) -> None:
    """Touch a button, which moves the arm."""
    before = await page.value("joints.join()")
    await page.call("Emulation.setTouchEmulationEnabled", enabled=True)
    await page.value(f"{key}.scrollIntoView({{ block: 'center' }})")
    place = await page.value(
        f"(() => {{ const box = {key}.getBoundingClientRect();"
        " return { x: box.x + box.width / 2, y: box.y + box.height / 2 }; })()"
    )
    await page.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[place])
    await page.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])
    await page.until(f"joints.join() !== '{before}'")
    await page.call("Emulation.setTouchEmulationEnabled", enabled=False)


@pytest.mark.process
@pytest.mark.screen
@pytest.mark.skipif(CHROMIUM is None, reason="no browser is here")
def test_a_browser_moves_the_arm_by_slider_step_branch_and_key_and_teaches(tmp_path: Path) -> None:
    folder = folder_with_cell(tmp_path)
    cell = cell_of(RunRequest(paths=(str(folder),), home=str(folder)))

    async def use(address: str) -> None:
        async with opened(f"{address}/key/", tmp_path) as page:
            value = "document.querySelector('[aria-label=\"Joint {}\"]')"
            await page.until("document.querySelectorAll('#branches button').length > 1")
            assert await page.value("document.getElementById('arm').width > 0")
            await page.value(f"{value.format(1)}.focus()")
            before = await page.value("joints[0]")
            await page.call("Input.dispatchKeyEvent", type="keyDown", key="ArrowRight",
                            code="ArrowRight", windowsVirtualKeyCode=39)  # fmt: skip
            await page.until(f"Math.abs(joints[0] - {before} - 0.1) < 1e-6")
            await page.value(
                f"(() => {{ const one = {value.format(2)}; one.value = 58;"
                " one.dispatchEvent(new Event('input')); })()"
            )
            await page.until("joints[1] === 58")
            await page.value(
                "(() => { const one = document.querySelector('[data-choice=frame]');"
                " one.value = 'tool'; one.dispatchEvent(new Event('change')); })()"
            )
            key = "document.querySelector('[data-step=\"z+\"]')"
            await page.until(f"{key} && !{key}.disabled")
            await page.value(f"{key}.click()")
            await page.until("joints[1] !== 58")
            for name, width, height, dark in (
                ("desktop", 1280, 900, False),
                ("phone", 390, 844, False),
                ("dark", 1280, 900, True),
            ):
                await page.picture(tmp_path / f"{name}.png", width, height, dark=dark)
                rights = "[...document.querySelectorAll('main *')].map(RIGHT)".replace(
                    "RIGHT", "(one) => one.getBoundingClientRect().right"
                )
                assert await page.value(f"Math.max(...{rights})") <= width
                if name == "phone":
                    await tap(page, key)
            other = "[...document.querySelectorAll('#branches button:not(.here)')]"
            await page.value(f"{other}.find((one) => !one.disabled).click()")
            await page.until("document.querySelector('#branches .here')")
            await page.value("document.getElementById('name').value = 'pTaught'")
            await page.value("document.querySelector('#teach button').click()")
            await page.until("document.getElementById('written').textContent.endsWith(':5')")
            assert "CONST robtarget pTaught := " in (folder / "job.mod").read_text()
            await page.value("document.getElementById('home').click()")
            await page.until("joints[4] === 30")
            assert await page.value("document.getElementById('trouble').hidden")
            assert not page.errors

    use_page(jog_page(cell), use)
