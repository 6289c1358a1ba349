"""`rapidsim calibrate`: a log and its program give lines for the station file."""

import json
from pathlib import Path

import pytest
from cli_helper import rapidsim

PROGRAM = """MODULE short
  CONST robtarget a:=[[600,-100,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ a, v500, fine, tool0;
    FOR i FROM 1 TO 1 DO
      MoveL Offs(a, 0, 30*i, 0), v200, fine, tool0;
    ENDFOR
  ENDPROC
ENDMODULE
"""


def test_a_log_and_its_program_give_lines_for_the_station_file(tmp_path: Path) -> None:
    module = tmp_path / "short.mod"
    module.write_text(PROGRAM)
    (tmp_path / "slow.toml").write_text("[motion]\nfine_dwell = 0.15\n")
    log = tmp_path / "short.csv"
    made = rapidsim(
        *("run", module, "--station", tmp_path / "slow.toml", "--no-record"),
        *("--trace", log, "--dt", "0.008"),
        cwd=tmp_path,
    )
    assert made.code == 0, made.err
    told = rapidsim("calibrate", log)
    assert told.code == 0, told.err
    assert "[motion]\n" in told.out
    dwell_s = float(told.out.partition("fine_dwell = ")[2].split()[0])
    assert dwell_s == pytest.approx(0.15, abs=0.005)
    found = json.loads(rapidsim("calibrate", log, "--format", "json").out)
    assert [one["name"] for one in found["parameters"]] == [
        "torque of axis 1",
        "torque of axis 2",
        "torque of axis 3",
        "wrist",
        "filter_time",
        "fine_dwell",
        "zone_share",
    ]
    assert found["logs"][0]["rms_after_s"] < found["logs"][0]["rms_before_s"]


def test_a_log_without_a_program_is_an_error(tmp_path: Path) -> None:
    log = tmp_path / "short.csv"
    assert "does not exist" in rapidsim("calibrate", log).err
    log.write_text("time,j1,j2,j3,j4,j5,j6\n")
    ended = rapidsim("calibrate", log)
    assert ended.code == 2
    assert "name it with --program, or call it" in ended.err
