"""Runs of a station that fails, without clients."""

import json
from pathlib import Path

import pytest
from command_line import call
from failing_program import PROGRAM

STATION = """[signals]
diReset = { type = "di", action = "ResetEstop" }
diOn = { type = "di", action = "MotOnStart" }
[[fault]]
kind = "emergency_stop"
at = 0.3
for = 1
[[fault]]
kind = "refuse"
at = 0.1
"""
RESET = """[[stimulus]]
at = 2.0
set = { diReset = 1 }
[[stimulus]]
at = 3.0
set = { diOn = 1 }
"""


def ran(folder: Path, station: str, *options: str, program: str = PROGRAM) -> dict[str, object]:
    (folder / "failing.mod").write_text(program)
    (folder / "rapidsim.toml").write_text(station)
    done = call("run", "failing.mod", "--no-record", "--format", "json", *options, cwd=folder)
    return json.loads(done.out)  # type: ignore[no-any-return]


def test_a_stop_that_is_reset_costs_its_time_and_one_that_is_not_ends_the_run(
    tmp_path: Path,
) -> None:
    straight = ran(tmp_path, "")
    reset = ran(tmp_path, STATION + RESET)
    assert (reset["end"], reset["ok"]) == ("ended", True)
    assert reset["path_mm"] == pytest.approx(straight["path_mm"], rel=1e-3)
    # It stands from 0.3 s, and a little later, to 3 s.
    assert float(reset["time_s"]) - float(straight["time_s"]) == pytest.approx(2.7, abs=0.4)  # type: ignore[arg-type]
    assert [one["kind"] for one in reset["events"]].count("fault") == 3  # type: ignore[attr-defined]
    stopped = ran(tmp_path, STATION)
    assert stopped["end"] == "stopped"
    assert "`emergency_stop` stopped the program here" in json.dumps(stopped["diagnostics"])


def test_limits_end_a_run_that_fails(tmp_path: Path) -> None:
    assert ran(tmp_path, STATION + RESET, "--max-time", "2.5")["end"] == "time_limit"
    many = ran(tmp_path, STATION + RESET, "--cycles", "3")
    assert (many["end"], len(many["moves"])) == ("cycle_limit", 6)  # type: ignore[arg-type]


def test_a_wait_that_nothing_ends_is_an_error_also_beside_system_inputs(tmp_path: Path) -> None:
    waits = PROGRAM.replace("rounds := r", "WaitDI diNever, 1; rounds := r")
    station = '[signals]\ndiNever = { type = "di" }\n' + STATION.replace("[signals]\n", "")
    straight = ran(tmp_path, '[signals]\ndiNever = { type = "di" }\n', program=waits)
    reset = ran(tmp_path, station + RESET, program=waits)
    for run in (straight, reset):
        assert (run["end"], run["ok"]) == ("error", False)
        (found,) = (one for one in run["diagnostics"] if one["code"] == "R106")  # type: ignore[attr-defined]
        assert (found["line"], "`diNever` is waited for" in found["message"]) == (6, True)
    stopped = ran(tmp_path, station, program=waits)
    assert stopped["end"] == "stopped"
