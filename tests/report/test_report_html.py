"""The report: all in one file, nothing fetched, nothing of the program taken for markup."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from changed_run import with_robot

import rapidsim
from rapidsim.controller.journal.events import Event, EventKind
from rapidsim.controller.moves.executed_moves import moves_of
from rapidsim.files import InputError
from rapidsim.frames.transform import Array, Transform
from rapidsim.report.html.packing import packed
from rapidsim.report.html.write import report_page, write_report
from rapidsim.simulation.results.simulation import Simulation

TARGET = "[[{x},{y},{z}],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
FAR = TARGET.format(x=2500, y=0, z=700)
NEAR = TARGET.format(x=600, y=-200, z=700)
PROGRAM = f"""MODULE Evil
  CONST robtarget pNear:={NEAR};
  CONST robtarget pFar:={FAR};
  PROC main()
    ConfJ\\Off;
    MoveJ pNear, v500, z50, tool0;
    MoveL Offs(pNear,0,300,0), v200, fine, tool0;
    TPWrite "</script><script>alert(1)</script><b>&amp;";
    SetDO doPump, 1;
    MoveL pFar, v200, fine, tool0;
  ERROR
    TRYNEXT;
  ENDPROC
ENDMODULE
"""
CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "google-chrome", "chrome"))), None)


@pytest.fixture(scope="module")
def simulation(tmp_path_factory: pytest.TempPathFactory) -> Simulation:
    program = tmp_path_factory.mktemp("report") / "Evil.mod"
    program.write_text(PROGRAM)
    return rapidsim.simulate([program], robot="irb1600")


@pytest.fixture(scope="module")
def page(simulation: Simulation) -> str:
    return report_page(simulation, simulation.diagnostics)


def data_of(page: str) -> dict[str, object]:
    found = re.search(r'<script type="application/json" id="run">(.*?)</script>', page, re.S)
    assert found is not None
    data: dict[str, object] = json.loads(found[1])
    return data


def robot_of(page: str, number: int = 0) -> dict[str, Any]:
    robots = data_of(page)["robots"]
    assert isinstance(robots, list)
    robot: dict[str, Any] = robots[number]
    return robot


def unpacked(column: dict[str, object]) -> Array:
    values: Array = np.cumsum(column["steps"]) / column["scale"]  # type: ignore[call-overload]
    return values


def test_it_fetches_nothing(page: str) -> None:
    assert "default-src 'none'" in page
    assert not re.search(r"https?://|//cdn|<link|@import|src=|fetch\(|XMLHttpRequest", page)


def test_the_program_cannot_add_markup(page: str) -> None:
    assert "<script>alert" not in page
    assert "&lt;/script&gt;&lt;script&gt;alert(1)" in page
    # Two scripts open and two close: the numbers and the code.
    assert page.count("<script") == page.count("</script>") == 2


def test_it_says_how_the_run_ended_and_why(page: str) -> None:
    assert "stopped with an error" in page
    assert re.search(r"error K601</b> <code>pFar</code> cannot be", page)


def test_its_numbers_are_the_run_s(page: str, simulation: Simulation) -> None:
    robot = robot_of(page)
    times = unpacked(robot["t"])
    samples = simulation.only.trajectory.at(times)
    joints = np.stack([unpacked(column) for column in robot["joints"]], axis=1)
    assert np.abs(joints - np.degrees(samples.joints)).max() < 0.006
    tcp = np.stack([unpacked(column) for column in robot["tcp"]], axis=1)
    assert np.abs(tcp - 1000.0 * samples.base_from_tcp.translation).max() < 0.06
    speed = unpacked(robot["speed"])
    assert np.abs(speed - 1000.0 * samples.tcp_speed).max() < 0.06
    assert np.abs(np.stack([unpacked(one) for one in robot["joint_speed"]])).max() <= 101.0


def test_what_failed_is_drawn_where_it_is(page: str) -> None:
    failed = robot_of(page)["failed"]
    assert [(one["code"], one["line"], one["at"]) for one in failed] == [
        ("K601", 10, [2500.0, 0.0, 700.0]),
    ]


def test_packed_numbers_add_up_without_error() -> None:
    values = np.array([0.004, -17.2349, 1e6, np.nan, 3.0])
    assert np.array_equal(unpacked(packed(values, 2)), [0.0, -17.23, 1e6, 0.0, 3.0])


def test_the_same_run_gives_the_same_file(page: str, simulation: Simulation) -> None:
    assert report_page(simulation, simulation.diagnostics) == page


def test_a_run_without_moves_has_a_report(simulation: Simulation) -> None:
    idle = replace(with_robot(simulation, moves=(), lines=(), failed_moves=()), events=())
    page = report_page(idle, ())
    assert robot_of(page)["moves"] == []
    assert 'id="times"' not in page


def test_many_moves_make_a_small_file(tmp_path: Path) -> None:
    angle = 0.05 * np.arange(400)
    places = [(700 + 150 * np.cos(a), 150 * np.sin(a), 600 + a) for a in angle]
    moves = "\n".join(
        f"MoveL {TARGET.format(x=round(x, 3), y=round(y, 3), z=round(z, 3))},v200,z1,tool0;"
        for x, y, z in places
    )
    program = tmp_path / "Many.mod"
    first = moves.replace("MoveL", "MoveJ", 1)
    program.write_text(
        f"MODULE Many\nPROC main()\nConfL\\Off;\nConfJ\\Off;\n{first}\nENDPROC\nENDMODULE\n"
    )
    run = rapidsim.simulate([program], robot="irb1600")
    assert len(run.moves) == 400
    without = len(report_page(replace(with_robot(run, moves=(), lines=()), events=()), ()))
    of_a_move = (len(report_page(run, ())) - without) / 400
    # 10,000 such moves shall stay under 5 MB; the table of lines ends after 300.
    assert without + 10_000 * of_a_move < 5_000_000


def test_signals_have_lanes(simulation: Simulation) -> None:
    event = Event(1.0, "T_ROB1", EventKind.SIGNAL, None, "", {"signal": "do1", "value": 1.0})
    page = report_page(replace(simulation, events=(event,)), ())
    assert data_of(page)["signals"] == [{"name": "do1", "changes": [[0.0, 0.0], [1.0, 1.0]]}]


def test_several_robots_stand_in_the_world_they_share(simulation: Simulation) -> None:
    first = simulation.robots[0]
    shift = Transform(np.eye(3), np.array([0.0, 2.0, 0.0]))
    moves = moves_of(replace(move, task="T_ROB2") for move in first.moves)
    other = replace(first, task="T_ROB2", world_from_base=shift, moves=moves)
    page = report_page(replace(simulation, robots=(first, other)), ())
    assert data_of(page)["frame"] == "world"
    one, two = (np.stack([unpacked(c) for c in robot_of(page, k)["tcp"]]) for k in (0, 1))
    assert np.allclose(two - one, np.array([[0.0], [2000.0], [0.0]]))
    assert "T_ROB2: main" in page
    assert "Nearest joint limit of T_ROB1" in page
    assert f'<p class="robot">{first.robot.title} and {first.robot.title}</p>' in page


def test_the_older_report_stays_when_the_folder_is_gone(
    simulation: Simulation, tmp_path: Path
) -> None:
    with pytest.raises(InputError, match="does not exist"):
        write_report(simulation, (), tmp_path / "nowhere" / "report.html")


@pytest.mark.screen
@pytest.mark.skipif(CHROMIUM is None, reason="there is no Chromium here")
def test_it_opens_in_a_browser(simulation: Simulation, tmp_path: Path) -> None:
    path = write_report(simulation, simulation.diagnostics, tmp_path / "report.html")
    assert CHROMIUM is not None
    arguments = ["--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=2000"]
    shown = subprocess.run(
        [CHROMIUM, *arguments, f"--user-data-dir={tmp_path}", "--dump-dom", path.as_uri()],
        capture_output=True,
        text=True,
        check=True,
        timeout=90,
    ).stdout
    # What the code of the page adds, from its first lines to its last.
    assert '<a href="#times">Cycle time</a>' in shown
    assert "joint acceleration</button>" in shown
    assert re.search(r'class="readout">0\.000 s', shown)


def test_a_block_to_paste_keeps_its_lines(tmp_path: Path) -> None:
    program = tmp_path / "waits.mod"
    program.write_text(
        "MODULE waits\n  PROC main()\n    WaitDI diReady,1\\MaxTime:=0.5;\n"
        "  ERROR\n    TRYNEXT;\n  ENDPROC\nENDMODULE\n"
    )
    run = rapidsim.load(program, robot="irb1600").run()
    page = report_page(run.simulation, run.diagnostics)
    assert "<pre>[signals]\ndiReady = { type = &quot;di&quot; }</pre>" in page
    assert "\ufffd" not in page
