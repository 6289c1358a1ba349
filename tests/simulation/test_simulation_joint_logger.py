"""From the logger of the docs to a station: a controller's motion is found from what it logs."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest
from command_line import call

LOGGER = Path(__file__).parents[2] / "docs" / "joint_logger.mod"
PROGRAM = """MODULE stops
  PERS bool bLogging:=FALSE;
  CONST robtarget a:=[[600,-100,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    bLogging:=TRUE;
    WaitTime 0.1;
    MoveJ a,v500,fine,tool0;
    MoveL Offs(a,0,30,0),v200,fine,tool0;
    MoveL Offs(a,0,60,0),v200,fine,tool0;
    WaitTime 0.1;
    bLogging:=FALSE;
  ENDPROC
ENDMODULE
"""
TASKS = """
[[task]]
name = "T_ROB1"
modules = ["stops.mod"]
[[task]]
name = "T_LOG"
modules = ["joint_logger.mod"]
type = "semistatic"
motion = false
"""


def test_the_logger_s_file_gives_the_station_of_the_controller_that_wrote_it(
    tmp_path: Path,
) -> None:
    (tmp_path / "stops.mod").write_text(PROGRAM)
    shutil.copy(LOGGER, tmp_path)
    home = tmp_path / "home"
    home.mkdir()
    # The controller stands for longer at stop points than this arm is taken to.
    (tmp_path / "cell.toml").write_text("[motion]\nfine_dwell = 0.15\n" + TASKS)
    ran = call(
        *("run", "stops.mod", LOGGER.name, "--station", "cell.toml", "--home", home),
        *("--no-record", "--format", "json"),
        cwd=tmp_path,
    )
    assert ran.code == 0, ran.err
    shutil.copy(home / "joint_log.csv", tmp_path / "stops.csv")

    found = call("calibrate", "stops.csv", cwd=tmp_path)
    assert found.code == 0, found.err
    (tmp_path / "found.toml").write_text(found.out.partition("For rapidsim.toml:")[2])
    again = call(
        *("run", "stops.mod", "--station", "found.toml", "--no-record", "--format", "json"),
        cwd=tmp_path,
    )
    assert again.code == 0, again.err
    controller, ours = (json.loads(one.out)["time_s"] for one in (ran, again))
    assert ours == pytest.approx(controller, abs=0.005)
