"""The page for people at `/ui`: what it tells, what a browser makes of it, and who gets in."""

from __future__ import annotations

import asyncio
import io
import json
import zipfile
from base64 import b64encode
from pathlib import Path
from typing import Any

import aiohttp
import pytest
from browser import CHROMIUM, opened
from command_line import call
from served_controller import Served, serve

from rapidsim.simulation.live import signals, symbols
from rapidsim.simulation.live.states import ControllerState

PROGRAM = r"""MODULE job
  ! A line with <b>marks</b> & "quotes".
  PERS num rounds := 0;
  PROC main()
    MoveAbsJ [[20,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;
    TPWrite "round <i>one</i>";
    WaitDI diGo, 1;
    rounds := rounds + 1;
    SetDO doDone, 1;
    TPReadFK rounds, "Again?", "Yes", "No", stEmpty, stEmpty, stEmpty;
    Stop;
  ENDPROC
ENDMODULE
"""
STATION = """[signals]
diGo = { type = "di" }
doDone = { type = "do" }
aoSpeed = { type = "ao" }
"""


def cell(folder: Path) -> Path:
    (folder / "cell").mkdir()
    (folder / "cell" / "job.mod").write_text(PROGRAM)
    (folder / "cell" / "rapidsim.toml").write_text(STATION)
    return folder


def test_to_look_takes_no_time_and_changes_nothing(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        before_s = served.engine.live.now_s
        lines, state = list[str](), dict[str, Any]()
        served.engine.journal = lines.append
        for base in (served.base, served.second):
            headers = {} if base == served.base else _basic()
            async with served.client.get(f"{base}/ui/state", headers=headers) as response:
                state = await response.json()
                assert response.headers["Content-Security-Policy"].startswith("default-src 'none'")
        assert served.engine.live.now_s == before_s
        assert not lines
        assert state["motors"] == "motoron"
        assert [one["name"] for one in state["signals"]] == ["diGo", "doDone", "aoSpeed"]
        (task,) = state["tasks"]
        assert task["pointer"] == ["job", 4]
        assert task["modules"] == ["job"]
        assert len(task["joints"]) == 6
        assert task["measures"] == ["deg"] * 6
        async with served.client.get(f"{served.base}/ui/text?task=T_ROB1&module=JOB") as response:
            text = (await response.json())["text"]
        assert text == PROGRAM
        for path in ("ui/text?task=T_ROB1&module=none", "ui/text?task=none&module=x", "ui/none"):
            async with served.client.get(f"{served.base}/{path}") as response:
                assert response.status == 404

    serve(cell(tmp_path), None, use)


def test_an_external_axis_has_its_own_name_also_where_it_is_the_only_one(tmp_path: Path) -> None:
    (cell(tmp_path) / "cell" / "rapidsim.toml").write_text(
        "[[external_axis]]\nname = 'TABLE'\naxis = 'b'\nkind = 'rotational'\n"
        "limits = [-90, 90]\nspeed = 90\nacceleration = 360\n"
    )

    async def use(served: Served) -> None:
        async with served.client.get(f"{served.base}/ui/state") as response:
            (task,) = (await response.json())["tasks"]
        assert task["external"] == {"eax_b": 0.0}

    serve(tmp_path, None, use)


def test_nothing_is_done_by_get_or_for_a_page_from_elsewhere(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        done = {"path": "/rw/rapid/execution", "action": "start"}
        url = f"{served.base}/ui/do"
        async with served.client.get(url, params=done) as response:
            assert response.status == 404
        for headers in ({"Origin": "http://evil.example"}, {"Host": "evil.example"}):
            async with served.client.post(url, data=done, headers=headers) as response:
                assert response.status == 403
        async with aiohttp.ClientSession() as nobody, nobody.get(f"{served.base}/ui") as response:
            assert response.status == 401
        assert not served.engine.live.executes
        async with served.client.post(url, data=done, headers={"Origin": served.base}) as response:
            assert response.status == 204
        assert served.engine.live.executes
        async with served.client.post(url, data=done) as response:
            assert response.status == 400
            assert await response.text() == "the program executes already"

    serve(cell(tmp_path), None, use)


def test_what_is_uploaded_lies_in_home_whatever_its_name_says(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        url, home = f"{served.base}/ui/upload", served.engine.context.files.home
        for name, status in (("../../a.mod", 201), ("C:\\x\\b.mod", 201), ("..", 404), ("", 404)):
            async with served.client.post(url, params={"name": name}, data=OTHER) as response:
                assert response.status // 100 == status // 100, name
        assert {one.name for one in home.glob("*.mod")} == {"a.mod", "b.mod"}
        elsewhere = {"Origin": "http://evil.example"}
        async with served.client.post(url, params={"name": "c.mod"}, headers=elsewhere) as response:
            assert response.status == 403

    serve(cell(tmp_path), None, use)


def test_a_downloaded_backup_is_a_cell_that_checks(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        async with served.client.get(f"{served.base}/ui/backup.zip") as response:
            assert response.headers["Content-Type"].startswith("application/zip")
            packed = await response.read()
        with zipfile.ZipFile(io.BytesIO(packed)) as archive:
            assert "RAPID/TASK1/PROGMOD/job.mod" in archive.namelist()
            archive.extractall(tmp_path / "backup")

    serve(cell(tmp_path), None, use)
    assert "Reach checked for 1 move on" in call("check", "backup", cwd=tmp_path).out


def test_the_panels_say_what_an_arm_a_task_and_a_rule_are(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        async def read(path: str) -> Any:
            async with served.client.get(f"{served.base}/ui/{path}") as response:
                return await response.json() if response.status == 200 else response.status

        panel = await read("jog?frame=joints&length=10&angle=5")
        assert panel["reason"] == "jogging needs manual mode"
        assert [one["reasons"] for one in panel["steps"]] == [[None, None]] * 6
        assert len(panel["stands"]["room"]) == 6
        assert len((await read("arm?mechunit=ROB_1"))["arm"]["links"]) == 7
        assert await read("joints") == {"joints": [0.0, 0.0, 0.0, 0.0, 30.0, 0.0]}
        task = await read("task?task=T_ROB1&module=JOB")
        assert task["routines"] == ["main"]
        (rounds,) = task["data"]
        assert (rounds["name"], rounds["value"], rounds["settable"]) == ("rounds", "0", True)
        assert (await read("rule?code=r101"))["name"] == "uncaught-error"
        for bad in (
            *("jog", "jog?frame=up&length=1&angle=1", "jog?frame=base&length=nan&angle=1"),
            *("jog?frame=base&length=1e9&angle=1", "task?task=none", "rule?code=X999"),
            *("arm?mechunit=ROB_7", "module?task=T_ROB1&module=none"),
        ):
            assert (await read(bad)) // 100 == 4, bad

    serve(cell(tmp_path), None, use)


@pytest.mark.process
@pytest.mark.screen
@pytest.mark.skipif(CHROMIUM is None, reason="no browser is here")
def test_a_browser_shows_the_controller_and_its_buttons_do_what_they_say(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        live = served.engine.live
        address = served.base.replace("//", "//Default%20User:robotics@")
        async with opened(f"{address}/ui", tmp_path) as page:
            await page.until("document.querySelector('#text li.pointer')")
            assert (
                await page.value("document.querySelector('#text li.pointer').textContent")
                == (PROGRAM.splitlines()[3])
            )
            # Marks of a program are text.
            assert await page.value("document.querySelectorAll('#text b').length") == 0
            assert await page.value("document.getElementById('stop').disabled")
            await page.value("document.getElementById('start').click()")
            await page.until("!document.getElementById('stop').disabled")
            live.advance(live.now_s + 0.2)
            await page.until("document.querySelector('#text li.motion')")
            live.advance(live.now_s + 5.0)
            await page.until("document.getElementById('screen').textContent.includes('<i>one</i>')")
            await page.value("document.querySelector('[aria-label=\"Set diGo to 1\"]').click()")
            await page.until("document.querySelector('#questions button')")
            assert signals.value_of(live, "diGo") == 1.0
            assert signals.value_of(live, "doDone") == 1.0
            await page.value(
                "var i = document.querySelector('#signals input'); i.value = '2.5';"
                " i.dispatchEvent(new Event('change'))"
            )
            row = "document.querySelector('#signals tr[data-name=aoSpeed]')"
            await page.until(f"{row}.dataset.value === '2.5'")
            assert signals.value_of(live, "aoSpeed") == 2.5
            await page.value("document.querySelector('#questions button').click()")
            await page.until("!document.querySelector('#questions button')")
            live.advance(live.now_s + 0.5)
            await page.until("document.getElementById('stop').disabled")
            await page.until("document.querySelectorAll('#log tr').length > 3")
            await page.value("document.getElementById('main').click()")
            await page.until(
                "document.querySelector('#text li.pointer').textContent.includes('PROC main')"
            )
            for name, width, height, dark in (
                ("desktop", 1280, 900, False),
                ("phone", 390, 844, False),
                ("dark", 1280, 900, True),
            ):
                await page.picture(tmp_path / f"{name}.png", width, height, dark=dark)
                # Nothing is wider than the window.
                wide = "document.documentElement.scrollWidth - window.innerWidth"
                assert await page.value(wide) <= 0
            await page.value("document.getElementById('motors').click()")
            await page.until("document.getElementById('start').disabled")
            assert await page.value("document.getElementById('trouble').hidden")
            assert not page.errors

    serve(cell(tmp_path), None, use)


@pytest.mark.process
@pytest.mark.screen
@pytest.mark.skipif(CHROMIUM is None, reason="no browser is here")
def test_a_browser_jogs_loads_steps_and_explains(tmp_path: Path) -> None:
    async def use(served: Served) -> None:
        live = served.engine.live
        address = served.base.replace("//", "//Default%20User:robotics@")

        async def click(selector: str) -> None:
            key = _one(selector)
            await page.until(f"{key} && !{key}.disabled")
            await page.value(f"{key}.click()")

        async def jogged() -> None:
            """Let a step that a button wants begin and end."""
            trajectory = live.task("T_ROB1").unit.trajectory
            while trajectory.duration <= live.now_s:
                await asyncio.sleep(0.02)
            live.advance(live.now_s + 5.0)

        async def choose(selector: str, value: str) -> None:
            """Give a field a value, once it offers it."""
            one = _one(selector)
            options = f"[...({one} && {one}.options || [])].map((each) => each.value)"
            await page.until(
                f"{one} && (!{one}.options || {options}.includes({json.dumps(value)}))"
            )
            await page.value(
                f"(() => {{ const one = {one}; one.value = {json.dumps(value)};"
                " one.dispatchEvent(new Event('change')); })()"
            )

        async def pointer_at(text: str) -> None:
            """Let time pass until the program stands before a statement."""
            line = f"{_one('#text li.pointer')}.textContent"
            while text not in await page.value(line):
                live.advance(live.now_s + 0.1)
                await asyncio.sleep(0.05)
            await page.until(f"!{_one('#start')}.disabled")

        async with opened(f"{address}/ui", tmp_path) as page:
            await page.until("document.querySelector('#text li.pointer')")
            await page.until(f"{_one('#arm')}.width > 0")
            await choose("#speed", "50")
            await page.until(f"{_one('#percent')}.textContent === '50 %'")
            assert live.panel.speed_ratio == 50
            await page.value(f"{_one('#jogging')}.open = true")
            await page.until(f"{_one('.refusal')}.textContent.includes('manual mode')")
            assert await page.value(f"{_one('.step')}.disabled")
            await choose("#mode", "MANR")
            await page.until(f"{_one('#motors')}.textContent === 'Motors on'")
            await click("#motors")
            await click("[data-step='J1+']")
            await jogged()
            joints = "[...document.querySelectorAll('#joints div')].map((one) => one.textContent)"
            await page.until(f"{joints}[0].endsWith('5.00')")
            # What the arm cannot do is said before it is tried.
            await choose("[data-choice=angle]", "30")
            key = _one("[data-step='J3+']")
            await page.until(f"{key}.title.endsWith('30')")
            await click("[data-step='J3+']")
            await jogged()
            await page.until(f"{_one('.step:disabled')}")
            assert "joint 3" in await page.value(f"{_one('.step:disabled')}.title")
            assert "joint 3" in await page.value(f"{_one('.axis small:not(:empty)')}.textContent")
            await choose("[data-choice=frame]", "tool")
            await click("[data-step='x−']")
            await jogged()
            # While a button is held, the arm goes as far as it can.
            await choose("[data-choice=length]", "while held")
            key = _one("[data-step='y+']")
            await page.until(f"{key}.title.endsWith('200')")
            trajectory = live.task("T_ROB1").unit.trajectory
            await page.mouse("mousePressed", key)
            while trajectory.duration <= live.now_s:
                await asyncio.sleep(0.02)
            live.advance(live.now_s + 0.4)
            assert trajectory.duration > live.now_s + 0.5
            await page.mouse("mouseReleased", key)
            while trajectory.duration > live.now_s + 0.3:
                await asyncio.sleep(0.02)
            live.advance(live.now_s + 5.0)
            await page.until(f"!{key}.disabled")
            await page.value("window.scrollTo(0, 0)")
            await page.value(f"{_one('#arm')}.focus()")
            before = await page.value("look.turn")
            await page.key("ArrowLeft")
            assert await page.value("look.turn") != before
            # Data are read and set.
            await page.value(f"{_one('#values')}.open = true")
            await page.until(f"{_one('#data tr[data-name=rounds] input')}")
            await choose("#data tr[data-name=rounds] input", "41")
            rounds = symbols.find(live.task("T_ROB1"), "rounds")
            while symbols.read(live.task("T_ROB1"), rounds) != "41":
                await asyncio.sleep(0.02)
            # A module is loaded, its routine chosen and stepped through until it fails.
            await page.value(
                "(() => { const files = new DataTransfer(); files.items.add(new File("
                f"[{json.dumps(OTHER)}], 'other.mod')); {_one('#upload')}.files = files.files;"
                f" {_one('#upload')}.dispatchEvent(new Event('change')); }})()"
            )
            modules = f"[...{_one('#module')}.options]"
            await page.until(f"{modules}.some((one) => one.value === 'other')")
            await choose("#routine", "fails")
            await click("#go")
            await page.until(f"{_one('#text li.pointer')}.textContent.includes('PROC fails')")
            # A line is chosen and its breakpoint set by keys; a click takes it away.
            await page.value(f"{_one('#text')}.focus()")
            await page.key("ArrowDown")
            await page.key("ArrowDown")
            await page.key("Enter")
            await page.until(f"{_one('#text li.break')}")
            assert "x := 2" in await page.value(f"{_one('#text li.break')}.textContent")
            await click("#start")
            await pointer_at("x := 2")
            await click("#text li.break")
            await page.until(f"!{_one('#text li.break')}")
            for button, comes in (("#step", "x := 3"), ("#over", "x := 1 / 0")):
                await click(button)
                await pointer_at(comes)
            await click("#start")
            while live.task("T_ROB1").has_pointer:
                live.advance(live.now_s + 0.1)
                await asyncio.sleep(0.02)
            await page.until(f"{_one('#log .error button')}")
            await page.value(f"{_one('#log .error button')}.click()")
            await page.until(f"{_one('#text li.found')}.textContent.includes('1 / 0')")
            await page.value(
                "[...document.querySelectorAll('#log button')].at(0).nextSibling.click()"
            )
            await page.until(f"{_one('#explanation')}.open")
            assert "R101" in await page.value(f"{_one('#rule')}.textContent")
            await click("#explanation button")
            for kind, begins in (("#download", "MODULE other"), ("#backup", "PK")):
                address = f"location.origin + {_one(kind)}.getAttribute('href')"
                text = await page.value(f"fetch({address}).then((one) => one.text())")
                assert text.startswith(begins)
            await click("#main")
            await choose("#module", "other")
            await page.value(f"{_one('#follow')}.checked = false")
            await click("#unload")
            await page.until(
                f"![...{_one('#module')}.options].some((one) => one.value === 'other')"
            )
            for name, width, height, dark in (
                ("jog", 1280, 1400, False),
                ("jog_phone", 390, 2400, False),
                ("jog_dark", 1280, 1400, True),
            ):
                await page.picture(tmp_path / f"{name}.png", width, height, dark=dark)
                wide = "document.documentElement.scrollWidth - window.innerWidth"
                assert await page.value(wide) <= 0
            for text, after in (
                ("Release emergency stop", ControllerState.EMERGENCY_STOP),
                ("Emergency stop", ControllerState.EMERGENCY_STOP_RELEASED),
            ):
                await click("#emergency")
                await page.until(f"{_one('#emergency')}.textContent === '{text}'")
                assert live.panel.state is after
                assert await page.value(f"{_one('#start')}.disabled")
            assert not page.errors

    serve(cell(tmp_path), None, use)


OTHER = """MODULE other
  PROC fails()
    VAR num x;
    x := 2;
    x := 3;
    x := 1 / 0;
  ENDPROC
ENDMODULE
"""


def _one(selector: str) -> str:
    return f"document.querySelector({json.dumps(selector)})"


def _basic() -> dict[str, str]:
    said = b64encode(b"Default User:robotics").decode()
    return {"Authorization": f"Basic {said}"}
