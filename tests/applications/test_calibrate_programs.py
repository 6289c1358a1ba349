"""Programs to log are clean for small and large arms of all kinds."""

import json
from pathlib import Path

import pytest
from command_line import call

PROGRAMS = ("swings.mod", "corners.mod", "picks.mod")


@pytest.mark.parametrize(
    "arm",
    ["irb120-3-0.58", "irb910sc-3-0.45", "irb460-110-2.4", "irb8700-800-3.5", "irb1600-6-1.2"],
)
def test_programs_to_log_are_clean(tmp_path: Path, arm: str) -> None:
    written = call("calibrate", "--programs", arm, cwd=tmp_path)
    assert written.code == 0, written.err
    assert {file.name for file in tmp_path.iterdir()} == set(PROGRAMS)
    for name in PROGRAMS:
        told = call("check", name, "--robot", arm, "--strict", "--format", "json", cwd=tmp_path)
        report = json.loads(told.out)
        assert (told.code, report["diagnostics"]) == (0, [])
        coverage = report["coverage"]
        assert coverage["checked"] == coverage["moves"] > 4
    again = call("calibrate", "--programs", arm, cwd=tmp_path)
    assert (again.code, "swings.mod is here already" in again.err) == (2, True)


def test_an_arm_without_axis_speeds_has_none(tmp_path: Path) -> None:
    told = call("calibrate", "--programs", "rv-m1", cwd=tmp_path)
    assert (told.code, "no axis speed is known" in told.err) == (2, True)
    assert not list(tmp_path.iterdir())


def test_without_a_log_the_command_names_what_it_needs(tmp_path: Path) -> None:
    told = call("calibrate", cwd=tmp_path)
    assert (told.code, "no log is named" in told.err) == (2, True)
    both = call("calibrate", "log.csv", "--programs", "irb120", cwd=tmp_path)
    assert (both.code, "takes no LOG" in both.err) == (2, True)
